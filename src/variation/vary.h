/// @file vary.h
/// A variation and its plan, as the files of this layer share them.
#pragma once

#include "variation/controller.h"

typedef struct FrDrawn {
    FrStroke *stroke; ///< owned
    char *choice;     ///< owned
    FrApply apply;
    FrSpan span;
} FrDrawn;

typedef struct FrPushed {
    vec3s vector;
    char *choice; ///< owned
    FrApply apply;
    FrSpan span;
} FrPushed;

struct FrVary {
    FrVaryParams params;
    GArray *strokes;    ///< FrDrawn
    GArray *indicators; ///< FrPushed
};

struct FrVaryPlan {
    const FrVary *vary;
    const FrPlant *base; ///< what instances are copies of: the plant varied, or `refined`
    FrPlant *refined;    ///< the plant varied with more joints, owned; NULL if it has enough
    FrController controller;
    uint32_t *stroke;  ///< of every axis, FR_NONE
    versors *rotation; ///< of every node as drawn; NULL: the base's
    vec3s *indicator;  ///< of every axis, times the tangent of the tilt; NULL: none at all
};

/// Words × axes that a choice looks at.
uint64_t fr_choice_words(const char *choice);
/// Adds 1 to marks[axis] of every axis chosen; all if the choice is empty. An error for every word
/// that names none.
FR_MUST_USE FrStatus fr_choice_mark(const char *choice, const FrPlant *plant, FrSpan span,
                                    FrDiags *diags, uint8_t *marks);
/// Replaces the marks of those chosen by those of the ones that `apply` reaches from them.
void fr_apply_spread(const FrPlant *plant, FrApply apply, uint8_t *marks);
