/// @file graft.h
/// Grafts: plants made elsewhere that stand where a component is. All of a level are grown before
/// it is measured, each by one thread, and copied into the plant when it is made.
#pragma once

#include "pgraph/instance.h"

/// A plant on its way into another.
typedef struct FrScion {
    FrPlant *plant;
    uint32_t *materials, *shapes; ///< of the plant that receives it, by those of the scion
    uint32_t *profiles, *finishes;
    uint32_t deformers; ///< first of its scopes in the plant that receives it
    float *lengths;     ///< m, of the scion's axes
    uint32_t places;    ///< organs without a shape: where children stand
} FrScion;

/// What is common to the grafts of a build.
typedef struct FrGrafting {
    const FrGraft *graft;
    GArray *scions;   ///< FrScion, of the rows of the level at hand that are grafts
    uint32_t *scion;  ///< of each row of the level: index into scions, FR_NONE
    uint32_t count;   ///< of the grafts of the level
    uint64_t largest; ///< nodes and organs of the largest so far
    GHashTable *told; ///< places of warnings that were passed on
} FrGrafting;

void fr_grafting_init(FrGrafting *grafting, const FrGraft *graft);
void fr_grafting_clear(FrGrafting *grafting);
/// Grows the grafts of the level at hand. Limits count the plant so far and all of them.
FR_MUST_USE FrStatus fr_grafts_grow(FrGrafting *grafting, FrExpansion *expansion,
                                    const FrContext *context);
/// Frees what was grown for the level.
void fr_grafts_drop(FrGrafting *grafting);
/// Counts what the graft in `row` makes.
void fr_graft_measure(const FrExpansion *expansion, uint32_t row);
static inline const FrScion *fr_scion_of(const FrGrafting *grafting, uint32_t row) {
    return &g_array_index(grafting->scions, FrScion, grafting->scion[row]);
}
/// What an organ without a shape is the place for.
static inline const char *fr_scion_symbol(const FrPlant *plant, uint32_t organ) {
    return g_array_index(plant->components, FrComponent, plant->organs.component[organ]).id;
}
/// Places of a symbol.
uint32_t fr_scion_places(const FrScion *scion, char symbol);
