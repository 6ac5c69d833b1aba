/// @file segments.h
/// Through which of the eight octants of a cell do rays pass? Many are asked about at once.
/// Private to light.
#pragma once

#include "light/paths.h"

enum { FR_SEGMENTS = 64 };

/// Parts of rays as seen from the middle of a cell, in floats.
typedef struct FrSegments {
    float middle[3][FR_SEGMENTS];
    float half[3][FR_SEGMENTS]; ///< from the middle to an end, without sign
    float way[3][FR_SEGMENTS];  ///< direction
    float slack[FR_SEGMENTS];   ///< more than the rounding of any test
} FrSegments;

/// Sets the segment number `i`: the first `reach` metres of a ray, seen from `middle`.
static inline void fr_segments_set(FrSegments *segments, uint32_t i, const FrRay *ray, double reach,
                                   const double middle[3], float quarter) {
    float size = quarter;
    for (int c = 0; c < 3; c++) {
        double half = 0.5 * reach * (double)ray->direction[c];
        float at = (float)((double)ray->origin[c] + half - middle[c]);
        segments->middle[c][i] = at;
        segments->half[c][i] = fabsf((float)half);
        segments->way[c][i] = ray->direction[c];
        size += fabsf(at) + segments->half[c][i];
    }
    segments->slack[i] = 2e-6f * size;
}

/// The octants that each of the first `count` segments passes through, as bits; bit 0 of an
/// octant's number is set on the far side in x, bit 1 in y, bit 2 in z. `quarter` is that of the
/// cell's width. Where in doubt an octant counts as passed through.
void fr_segments_octants(const FrSegments *segments, uint32_t count, float quarter,
                         int32_t *octants);
