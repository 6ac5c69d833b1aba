/// @file farthest.h
/// Of several candidates for each point the one that is farthest from all points before.
#pragma once

#include "frond/progress.h"
#include "frond/random.h"

/// How candidates are drawn.
typedef struct FrCandidates {
    /// Where a candidate of a point is, whose key is the child of `key` that its number names.
    void (*draw)(const void *data, FrKey point, uint32_t candidate, double at[3]);
    const void *data;
    FrKey key;
    uint32_t count; ///< of a point; 1 leaves all to chance
    double area;    ///< on which they lie
} FrCandidates;

/// The number of the candidate chosen for each of `count` points, of equals the first; to be freed.
/// Once `progress` (may be NULL) is cancelled it is 0 for the rest: nobody will see them.
uint32_t *fr_choose_farthest(const FrCandidates *candidates, uint32_t count,
                             const FrProgress *progress);
