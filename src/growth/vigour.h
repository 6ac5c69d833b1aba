/// @file vigour.h
/// Vigour: what light becomes at the base, and how it is shared out.
#pragma once

#include "growth/engine.h"

#include <string.h>

/// Of one internode.
typedef struct FrFlow {
    double main, lateral; ///< light of what goes on at its tip, and of what stands beside
    double vigour;        ///< that enters it
    uint32_t count;       ///< internodes and buds from it on
    uint32_t rank;        ///< priority: among all of its axis
} FrFlow;

/// Share of the axis at forks of a plant so old, in steps.
double fr_vigour_favour(const FrSpeciesParams *params, uint64_t age);
/// Vigour of all internodes and buds, by forks …
void fr_growth_flux(const FrGrowth *growth, FrGrownPlant *plant, FrFlow *flow);
/// … or by rank.
void fr_growth_priority(const FrGrowth *growth, FrGrownPlant *plant, FrFlow *flow,
                        FrScratch *scratch);
