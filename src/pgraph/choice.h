/// @file choice.h
/// Variation: one of what follows.
#pragma once

#include "pgraph/instance.h"

/// How much a link of a Variation counts.
typedef struct FrWeight {
    uint32_t to;
    FrLinkKind kind;
    double weight;
} FrWeight;

/// The weights of a variation's links (FrWeight), or NULL and an error.
GArray *fr_weights_new(const FrPgraph *graph, uint32_t component, FrDiags *diags);
/// Which link of its stage the variation in `row` follows; its variables are set.
uint32_t fr_choose(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
