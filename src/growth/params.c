// The parameter tables of growth.
#include "frond/growth.h"

#define FR_PARAM_STRUCT FrSpeciesParams
static const FrParam species_rows[] = {FR_SPECIES_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrOrderParams
static const FrParam order_rows[] = {FR_ORDER_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrSpeciesSliders
static const FrParam slider_rows[] = {FR_SPECIES_SLIDERS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrGrowthParams
static const FrParam growth_rows[] = {FR_GROWTH_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

const FrParamTable *fr_species_table(void) {
    static const FrParamTable table = {.element = "species",
                                       .meaning = "a kind of plant that grows bud by bud",
                                       .rows = species_rows,
                                       .count = G_N_ELEMENTS(species_rows),
                                       .struct_size = sizeof(FrSpeciesParams)};
    return &table;
}

const FrParamTable *fr_order_table(void) {
    static const FrParamTable table = {.element = "order",
                                       .meaning = "how a species builds its axes of one order, the "
                                                  "trunk first; the last is that of all further",
                                       .rows = order_rows,
                                       .count = G_N_ELEMENTS(order_rows),
                                       .struct_size = sizeof(FrOrderParams)};
    return &table;
}

const FrParamTable *fr_species_sliders_table(void) {
    static const FrParamTable table = {.element = "sliders",
                                       .meaning = "plain numbers that change a species as a whole",
                                       .rows = slider_rows,
                                       .count = G_N_ELEMENTS(slider_rows),
                                       .struct_size = sizeof(FrSpeciesSliders)};
    return &table;
}

const FrParamTable *fr_growth_table(void) {
    static const FrParamTable table = {.element = "growth",
                                       .meaning = "the world that plants grow in, bud by bud",
                                       .rows = growth_rows,
                                       .count = G_N_ELEMENTS(growth_rows),
                                       .struct_size = sizeof(FrGrowthParams)};
    return &table;
}

FrGrowthParams fr_growth_default(void) {
    FrGrowthParams params;
    fr_params_init(fr_growth_table(), &params);
    return params;
}

FrSpecies fr_species_default(void) {
    FrSpecies species = {0};
    fr_params_init(fr_species_table(), &species.params);
    return species;
}
