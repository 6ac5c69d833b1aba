/// @file floating.h
/// Seeds that stand on nothing. Private to scene.
#pragma once

#include "frond/growth.h"
#include "frond/scene.h"
#include "frond/terrain.h"

/// Tells, for each element, the seeds that are higher above the ground, and farther from any of the
/// obstacles, than a first internode is long. Nothing is told in scenes without ground or where
/// plants do not rise against z. `definitions` are FrPlantDef of species, in the order of their
/// numbers.
void fr_floating_tell(const FrSeed *seeds, uint32_t count, const GPtrArray *definitions,
                      const FrScene *scene, const FrHills *hills, const FrGrowthSetup *setup,
                      const FrContext *context);
