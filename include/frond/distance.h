/// @file distance.h
/// How far a point is from a surface of triangles, and on which side of it.
///
/// The answer comes from a tree of boxes in double precision and does not depend on threads or
/// instruction sets.
#pragma once

#include "frond/vector.h"

/// A surface that has been put into order. Immutable.
typedef struct FrDistance FrDistance;

/// `indices` are three a triangle; triangles without area have no say. NULL if none is left.
FR_API FrDistance *fr_distance_new(const vec3s *positions, uint32_t vertex_count,
                                   const uint32_t *indices, uint32_t index_count);
FR_API void fr_distance_free(FrDistance *distance);
/// Bytes that fr_distance_new() takes at most for so many triangles.
FR_API uint64_t fr_distance_bytes(uint64_t triangles);
/// True if every edge has a triangle on both sides: then there is an inside.
FR_API bool fr_distance_is_closed(const FrDistance *distance);
/// The distance of a point, negative inside a closed surface. `outward` receives the unit direction
/// in which it grows: away from the nearest point of the surface, or along the surface's normal for
/// a point on it.
FR_API double fr_distance_at(const FrDistance *distance, const double at[3], double outward[3]);
/// The same where the surface is nearer than `reach`; else INFINITY, and `outward` stays as it is.
FR_API double fr_distance_within(const FrDistance *distance, const double at[3], double reach,
                                 double outward[3]);
