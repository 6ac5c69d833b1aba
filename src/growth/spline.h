/// @file spline.h
/// Internodes as they are drawn: straight parts of a spline through the nodes of an axis.
#pragma once

#include "growth/engine.h"

/// Tangents of a Catmull-Rom spline through the nodes of the axes, each as long as its internode.
typedef struct FrTangents {
    vec3s *in, *out; ///< by node: at the base and at the tip of its internode
} FrTangents;

FrTangents fr_spline_tangents(const FrGrownPlant *plant);
void fr_spline_clear(FrTangents *tangents);

enum { FR_MOST_PARTS = 5 };
/// An internode in straight parts: part k leads from point k − 1 to point k.
typedef struct FrInternodeParts {
    uint32_t count;
    vec3s at[FR_MOST_PARTS + 1]; ///< relative to the seed
    float radius[FR_MOST_PARTS + 1];
} FrInternodeParts;

/// `radii` are those of the plant's nodes.
FrInternodeParts fr_spline_parts(const FrGrownPlant *plant, const FrSpeciesParams *params,
                                 const FrTangents *tangents, const float *radii, uint32_t node);
