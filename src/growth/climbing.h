/// @file climbing.h
/// Climbers and the wood of other plants.
#pragma once

#include "growth/engine.h"
#include "space/stems.h"

/// Makes growth->bark what climbers can hold on to of the plants that carry themselves, as they
/// are; NULL where nobody climbs, or no wood is near.
void fr_growth_find_bark(FrGrowth *growth, const FrContext *context);
/// How much room there is between bark, which is told too, and a place of a straight way, at a part
/// of its length; an internode will bend around wood, so that its middle lies farther out.
double fr_climb_room(const FrGrowth *growth, const FrSpeciesParams *params, const double from[3],
                     const double way[3], double part, FrBark *bark);
/// Moves the wood of climbers off bark that has thickened, so that it touches it, and what hangs on
/// it along. The cells that it occupies go with it.
void fr_growth_carry(FrGrowth *growth, const FrContext *context);
