/// @file bluenoise.h
/// Points strewn over a surface so that none are near each other.
///
/// After: D. Mitchell. Spectrally Optimal Sampling for Distribution Ray Tracing. SIGGRAPH 1991
/// (best candidate). Point i is the best of some candidates, and these are drawn by key and i: the
/// first points do not depend on how many follow.
#pragma once

#include "frond/progress.h"
#include "frond/random.h"

typedef enum FrStrewnForm { FR_STREWN_DISC, FR_STREWN_SQUARE, FR_STREWN_RING } FrStrewnForm;

/// How dense points shall be at a place, from 0 to 1, and how far they lie from the middle at most.
typedef struct FrStrewnDensity {
    double reach[2]; ///< along x and y, in (0, 1]
    double (*at)(const void *data, const double point[2]);
    const void *data;
} FrStrewnDensity;

/// Fills `points` with `count` points of a disc or ring of radius 1 or the square from −1 to 1.
/// `inner` is the radius of a ring's hole; `candidates` ≥ 1, of which 1 leaves all to chance.
/// Once `progress` (may be NULL) is cancelled they are left to chance: nobody will see them.
/// With a `density` (NULL: 1 everywhere) distances are measured in those that are usual where a
/// point is; a point for which no place is found where the density is more than 0 is (NAN, NAN),
/// and so are all if the first finds none. Cost: count · candidates · log(count).
void fr_bluenoise(double (*points)[2], uint32_t count, FrStrewnForm form, double inner,
                  uint32_t candidates, FrKey key, const FrStrewnDensity *density,
                  const FrProgress *progress);
