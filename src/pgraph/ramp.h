/// @file ramp.h
/// Materials whose colour depends on the season, age or chance: one for each step of the ramp.
#pragma once

#include "pgraph/instance.h"

/// Whether any material of the graph has a ramp.
bool fr_has_ramps(const FrPgraph *graph);
/// Adds the steps of all ramps to the plant. For each material there was, the first of its steps or
/// FR_NONE; to be freed with g_free(). NULL if none has a ramp.
uint32_t *fr_ramps_add(FrPlant *plant);
/// The step for the instance in `row`.
uint8_t fr_ramp_step(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// Takes out the steps that nothing has.
void fr_ramps_drop_unused(FrPlant *plant, const uint32_t *ramps);
