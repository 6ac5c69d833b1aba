#include "material/unread.h"

#include "expr/unread.h"

#define MADE "leaf petal bark-furrowed bark-smooth bark-plated"

static const FrParamCondition conditions[] = {
    {"*", "second_colour size seed", "texture", MADE},
    {"*", "relief", "texture normal_map", MADE " *"},
    {"*", "tile_width tile_height", "texture picture normal_map roughness_map",
     "bark-furrowed bark-smooth bark-plated *"},
    {"*", "venation vein_pattern vein_density", "texture", "leaf"},
    {"*", "outline teeth tooth_depth", "texture", "leaf petal"},
    {"*", "tooth_depth", "teeth", "!0"},
};

char *fr_material_why_unread(const FrMaterialParams *params, const FrParam *row) {
    return fr_params_why_unread(conditions, G_N_ELEMENTS(conditions), fr_material_table(), params,
                                row);
}
