/// @file venation.h
/// The veins of a blade, in blade space (outline.h).
#pragma once

#include "material/outline.h"

typedef struct FrVein {
    float x, y;
    uint32_t parent; ///< towards the petiole; FR_NONE for the first
    float radius;    ///< by Murray's law from the tips it feeds
} FrVein;

/// Two veins that meet.
typedef struct FrVeinJoin {
    uint32_t from, to;
} FrVeinJoin;

typedef struct FrVenation {
    GArray *veins; ///< FrVein, parents first; the first is where the petiole enters
    GArray *joins; ///< FrVeinJoin; empty for open venation
} FrVenation;

/// `finest`: veins nearer to each other than this are left out. Cancelled, it leaves out the rest.
FrVenation *fr_venation_new(const FrMaterialParams *params, const FrOutline *outline, FrKey key,
                            float finest, FrProgress *progress);
void fr_venation_free(FrVenation *venation);
