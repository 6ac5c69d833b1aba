/// @file spread.h
/// Multipliers whose children stand in the multiplier's own frame: Phiball, Hydra and their like.
#pragma once

#include "pgraph/instance.h"

typedef struct FrSpread {
    const FrExpansion *expansion;
    const FrStage *stage;
    uint32_t row;
    uint32_t count; ///< children for each link, those that flags leave out counted
    uint32_t at;    ///< row of the next level that the next child goes to
    FrEvaluator *evaluator, *place;
    FrPose centre;
} FrSpread;

/// Begins with the multiplier in `row`, whose variables are set.
FrSpread fr_spread_begin(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                         FrEvaluator *place);
/// Whether any link makes child i.
bool fr_spread_wants(const FrSpread *spread, uint32_t i);
/// Sets `place` to child i.
void fr_spread_enter(FrSpread *spread, uint32_t i);
/// Writes child i, which was entered, for every link that makes it.
void fr_spread_write(FrSpread *spread, uint32_t i, FrPose site);
/// A place `by` from the centre, turned, for a child of that size.
FrPose fr_spread_site(const FrSpread *spread, vec3s by, versors turn, double scale);

/// Whether any multiplied link of a stage makes iteration i of n.
bool fr_is_wanted(const FrExpansion *expansion, const FrStage *stage, uint32_t i, uint32_t n);
/// Turned about z, then about the new y, then about the new z. A child's y axis, its upper side,
/// looks to the parent's tip where the last angle is a quarter turn.
versors fr_turned_zyz(double azimuth, double down, double roll);
