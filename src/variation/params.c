// The parameter tables of variation.
#include "frond/variation.h"

#define FR_PARAM_STRUCT FrVaryParams
static const FrParam vary_rows[] = {FR_VARY_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrStrokeParams
static const FrParam stroke_rows[] = {FR_STROKE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrIndicatorParams
static const FrParam indicator_rows[] = {FR_INDICATOR_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

const FrParamTable *fr_vary_table(void) {
    static const FrParamTable table = {.element = "vary",
                                       .meaning = "a plant made from another one of the document "
                                                  "by other shapes of its branches",
                                       .rows = vary_rows,
                                       .count = G_N_ELEMENTS(vary_rows),
                                       .struct_size = sizeof(FrVaryParams)};
    return &table;
}

const FrParamTable *fr_stroke_table(void) {
    static const FrParamTable table = {
        .element = "stroke",
        .meaning = "a line drawn in space that branches follow; its text is its points, "
                   "x,y,z x,y,z …",
        .rows = stroke_rows,
        .count = G_N_ELEMENTS(stroke_rows),
        .struct_size = sizeof(FrStrokeParams)};
    return &table;
}

const FrParamTable *fr_indicator_table(void) {
    static const FrParamTable table = {.element = "indicator",
                                       .meaning = "a vector of wind, sun or rain that branches "
                                                  "turn towards; all that meet are summed",
                                       .rows = indicator_rows,
                                       .count = G_N_ELEMENTS(indicator_rows),
                                       .struct_size = sizeof(FrIndicatorParams)};
    return &table;
}
