/// @file making.h
/// An FrPlant in the making from a grown plant.
#pragma once

#include "growth/engine.h"

#include <string.h>

typedef struct FrMaking {
    const FrGrowth *growth;
    const FrGrownPlant *from;
    const FrReadySpecies *species;
    FrPlant *plant;
    uint32_t *node_of; ///< by grown node: the made one at its tip
    uint32_t *axis_of; ///< by grown axis; FR_NONE: without internodes
    float *radii;      ///< by grown node
    uint32_t leaf_component;
} FrMaking;

void fr_making_add_leaves(FrMaking *making);
