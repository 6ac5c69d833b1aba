/// @file sunken.h
/// Seeds so deep below the ground that they do not come out of it. Private to scene.
#pragma once

#include "frond/growth.h"
#include "frond/scene.h"
#include "frond/terrain.h"

/// Tells, for each element, seeds below the ground, on hills if not NULL and else level, that a
/// first internode does not reach. `definitions` are FrPlantDef of species, in the order of their
/// numbers.
void fr_sunken_tell(const FrSeed *seeds, uint32_t count, const GPtrArray *definitions,
                    const FrScene *scene, const FrHills *hills, const FrContext *context);
