/// @file scene/placing.h
/// All plants of a document with their places. Private to scene.
#pragma once

#include "frond/scene.h"
#include "frond/terrain.h"

/// A plant that is to stand somewhere.
typedef struct FrPlaced {
    const FrPlantDef *plant;
    FrStand stand; ///< but for its index of a plant
    int64_t seed;  ///< of the plant there; < 0: its own
    FrKey key;     ///< of this plant, whatever else stands there and in whatever order
    FrSpan span;   ///< of what has placed it
} FrPlaced;

/// FrPlaced, by hand first, then rows, then areas; free with g_array_unref(). Empty if the document
/// places nothing. They stand on `hills`, where there are any; NULL: on level ground.
FR_MUST_USE FrStatus fr_scene_places(const FrDocument *document, const FrHills *hills,
                                     const FrContext *context, GArray **placed);
