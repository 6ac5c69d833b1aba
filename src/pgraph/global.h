/// @file global.h
/// Components that act on all that follows: FFD, Hyperpatch, World, Force.
#pragma once

#include "pgraph/field.h"
#include "pgraph/instance.h"

static inline bool fr_is_scope(FrComponentKind kind) {
    return kind == FR_COMPONENT_FFD || kind == FR_COMPONENT_HYPERPATCH;
}

static inline bool fr_is_field(FrComponentKind kind) {
    return kind == FR_COMPONENT_WORLD || kind == FR_COMPONENT_FORCE;
}

static inline bool fr_is_global(FrComponentKind kind) {
    return fr_is_scope(kind) || fr_is_field(kind);
}

/// The key of an instance at a place. Global components are no part of paths: what follows on one
/// keeps its random numbers and edits when it is put in or taken out.
static inline FrKey fr_path_key(FrKey place, const FrPrepared *prepared) {
    return fr_is_global(prepared->kind) ? place : fr_key_child(place, prepared->key_word);
}

/// What can be wrong with its texts; FR_OK for other kinds.
FrStatus fr_check_global(const FrPrototype *prototype, FrDiags *diags);
/// Works out what all its instances share, once it has passed its check; nothing for other kinds.
void fr_prepare_global(FrPrepared *made, const FrPrototype *prototype, uint32_t component,
                       FrPlant *plant, GHashTable *faults);
/// Makes the instance in `row`, whose count has become its index.
void fr_make_global(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
