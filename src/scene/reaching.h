/// @file reaching.h
/// Wood that has become so thick that it reaches into an obstacle. Private to scene.
#pragma once

#include "frond/growth.h"
#include "frond/scene.h"

/// The seeds of a scene.
typedef struct FrSeeds {
    const FrSeed *at;
    const uint32_t *plants; ///< the scene's plant of each
    uint32_t count;
    const GPtrArray *definitions; ///< FrPlantDef of species, in the order of their numbers
} FrSeeds;

/// Tells, for each element that has placed seeds, how far the wood of their plants reaches into
/// obstacles. The scene is drawn. Left out are species that collide with nothing, those that climb,
/// whose stems may lie half in what they hold on to, and obstacles that nobody sees.
void fr_reaching_tell(const FrScene *scene, const FrSeeds *seeds, const FrContext *context);
