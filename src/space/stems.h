/// @file stems.h
/// How far a point is from the bark of many stems: straight, round, thinner or thicker at one end.
/// Private to the library.
///
/// The answer depends on the point and on which stems there are, not on their order.
#pragma once

#include "frond/vector.h"

typedef struct FrStem {
    double from[3], to[3]; ///< ends of its middle line
    double radius[2];      ///< there
} FrStem;

/// What is nearest to a point.
typedef struct FrBark {
    double distance;   ///< INFINITY: nothing within reach; below 0 inside
    double outward[3]; ///< unit: away from the middle line
    double radius;     ///< of the stem where it is nearest
} FrBark;

/// Stems that have been put into order. Immutable.
typedef struct FrStems FrStems;

/// NULL if `count` is 0.
FrStems *fr_stems_new(const FrStem *stems, uint32_t count);
void fr_stems_free(FrStems *stems);
/// Bytes that fr_stems_new() takes for so many.
uint64_t fr_stems_bytes(uint64_t count);
uint32_t fr_stems_count(const FrStems *stems); ///< 0 for NULL
/// The nearest bark that is nearer than `reach`, where the stem is not thinner than `thinnest`.
/// Distances are measured from the nearest point of the middle line, less the radius there. Nothing
/// is near NULL.
FrBark fr_stems_near(const FrStems *stems, const double at[3], double reach, double thinnest);
