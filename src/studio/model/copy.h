/// @file copy.h
/// A copy of what stands in the studio, to be written while what stands goes on.
#pragma once

#include "studio/model/builder.h"

/// A copy that has been asked for.
typedef struct StudioCopy StudioCopy;

/// Which plants are meant.
typedef struct StudioWhich {
    bool is_one; ///< only the plant with this origin and number, as in FrStand …
    uint32_t origin, number;
    bool in_place; ///< … where it stands, else at the origin
} StudioWhich;

/// Asks for a copy of what stands when all that has been requested before is built. Plants that
/// grow bud by bud are as they have grown, whatever was changed between their steps.
StudioCopy *studio_builder_copy(StudioBuilder *builder, const StudioWhich *which);
/// Waits for the copy, on any thread but the main one. FR_CANCELLED where the context's progress is
/// cancelled or the document has gone; FR_ERR_DOCUMENT with a diagnostic where nothing stands, or
/// not that plant. `is_behind`: what stands is older than the document, of which nothing could be
/// made.
FR_MUST_USE FrStatus studio_copy_take(StudioCopy *copy, const FrContext *context, FrScene **scene,
                                      bool *is_behind);
void studio_copy_free(StudioCopy *copy);
