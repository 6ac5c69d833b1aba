/// @file varied.h
/// A plant ready to be varied: its base, built once, and the plan of its variation.
#pragma once

#include "frond/scene.h"

typedef struct FrVaried {
    FrPlant *base;
    uint64_t instances;
    uint64_t *by_component;
    uint64_t modules;
    FrVary *plain; ///< the default variation, where the definition has none
    FrVaryPlan *plan;
} FrVaried;

/// Builds the base of `definition` with the base's own seed. For a plant that is no variation this
/// is the plant itself, with the default variation.
FR_MUST_USE FrStatus fr_varied_new(const FrDocument *document, const FrPlantDef *definition,
                                   double time, const FrContext *context, FrVaried **varied);
void fr_varied_free(FrVaried *varied);
/// The instance of a seed with its counts.
FrScenePlant fr_varied_instance(const FrVaried *varied, uint64_t seed);
/// The counts of the base, for an instance that is there already; takes it.
FrScenePlant fr_varied_counts(const FrVaried *varied, FrPlant *instance);
