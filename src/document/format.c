#include "document/format.h"

#include <string.h>

#define FR_PARAM_STRUCT FrFrondParams
static const FrParam frond_rows[] = {FR_FROND_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrCurveParams
static const FrParam curve_rows[] = {FR_CURVE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrFunctionParams
static const FrParam function_rows[] = {FR_FUNCTION_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrPlantParams
static const FrParam plant_rows[] = {FR_PLANT_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrSlider
static const FrParam slider_rows[] = {FR_SLIDER_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrDefineParams
static const FrParam define_rows[] = {FR_DEFINE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrLinkParams
static const FrParam link_rows[] = {FR_LINK_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrSceneParams
static const FrParam scene_rows[] = {FR_SCENE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrPlace
static const FrParam place_rows[] = {FR_PLACE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrViewParams
static const FrParam view_rows[] = {FR_VIEW_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

#define TABLE(name, struct_type, text)                                                             \
    static const FrParamTable name##_table = {.element = #name,                                    \
                                              .meaning = text,                                     \
                                              .rows = name##_rows,                                 \
                                              .count = G_N_ELEMENTS(name##_rows),                  \
                                              .struct_size = sizeof(struct_type)}
TABLE(frond, FrFrondParams, "a document");
TABLE(curve, FrCurveParams, "a hand-drawn curve y(x), to be named in numbers and expressions");
TABLE(function, FrFunctionParams, "a function for expressions; its text is the expression");
TABLE(plant, FrPlantParams, "a plant");
TABLE(slider, FrSlider,
      "a number that the numbers of its plant may use by its id: one handle for many attributes");
TABLE(define, FrDefineParams, "a number that an L-system knows by this name");
TABLE(link, FrLinkParams, "where one component is made, another is made on it");
TABLE(scene, FrSceneParams, "where plants stand and how they are lit and seen");
TABLE(place, FrPlace, "a plant that stands somewhere");
TABLE(view, FrViewParams, "a view of the scene");

const FrParamTable *fr_slider_table(void) {
    return &slider_table;
}

const FrParamTable *fr_scene_table(void) {
    return &scene_table;
}

const FrParamTable *fr_place_table(void) {
    return &place_table;
}

const FrParamTable *fr_view_table(void) {
    return &view_table;
}

#define SET(id) ((FrElementSet)1 << FR_ELEMENT_##id)
#define COMPONENTS ((((FrElementSet)1 << FR_COMPONENT_COUNT) - 1) << FR_ELEMENT_COMPONENT)

static const FrElement elements[FR_ELEMENT_COMPONENT] = {
    [FR_ELEMENT_FROND] = {.name = "frond",
                          .table = &frond_table,
                          .required = "version",
                          .children =
                              SET(CURVE) | SET(FUNCTION) | SET(MATERIAL) | SET(PLANT) | SET(SCENE)},
    [FR_ELEMENT_CURVE] = {.name = "curve",
                          .table = &curve_table,
                          .has_id = true,
                          .required = "points"},
    [FR_ELEMENT_FUNCTION] = {.name = "function",
                             .table = &function_table,
                             .has_id = true,
                             .has_text = true},
    [FR_ELEMENT_MATERIAL] = {.name = "material", .has_id = true},
    [FR_ELEMENT_PLANT] = {.name = "plant",
                          .table = &plant_table,
                          .has_id = true,
                          .children = SET(SLIDER) | SET(PGRAPH) | SET(EDITS) | SET(LSYSTEM) |
                                      SET(SKELETON) | SET(RAMIFIED) | SET(SPECIES) | SET(NURBS) |
                                      SET(VARY)},
    [FR_ELEMENT_SLIDER] = {.name = "slider", .table = &slider_table, .has_id = true},
    [FR_ELEMENT_PGRAPH] = {.name = "pgraph",
                           .meaning = "linked components that are expanded to a plant "
                                      "(Lintermann, Deussen 1999)",
                           .is_once = true,
                           .children = SET(LINK) | COMPONENTS},
    [FR_ELEMENT_LINK] = {.name = "link", .table = &link_table, .required = "from to"},
    [FR_ELEMENT_LSYSTEM] = {.name = "lsystem",
                            .is_once = true,
                            .has_text = true,
                            .children = SET(DEFINE)},
    [FR_ELEMENT_DEFINE] = {.name = "define",
                           .table = &define_table,
                           .has_id = true,
                           .required = "value"},
    [FR_ELEMENT_EDITS] = {.name = "edits",
                          .meaning = "changes of single instances of the plant's <pgraph>, by hand",
                          .is_once = true,
                          .children = SET(EDIT)},
    [FR_ELEMENT_EDIT] = {.name = "edit", .required = "at"},
    [FR_ELEMENT_SKELETON] = {.name = "skeleton", .is_once = true, .has_text = true},
    [FR_ELEMENT_RAMIFIED] = {.name = "ramified", .is_once = true, .has_text = true},
    [FR_ELEMENT_NURBS] = {.name = "nurbs", .is_once = true},
    [FR_ELEMENT_SPECIES] = {.name = "species",
                            .is_once = true,
                            .children = SET(ORDER) | SET(SLIDERS)},
    [FR_ELEMENT_ORDER] = {.name = "order"},
    [FR_ELEMENT_SLIDERS] = {.name = "sliders", .is_once = true},
    [FR_ELEMENT_VARY] = {.name = "vary",
                         .is_once = true,
                         .required = "base",
                         .children = SET(STROKE) | SET(INDICATOR)},
    [FR_ELEMENT_STROKE] = {.name = "stroke", .has_text = true},
    [FR_ELEMENT_INDICATOR] = {.name = "indicator", .required = "to"},
    [FR_ELEMENT_SCENE] = {.name = "scene",
                          .table = &scene_table,
                          .is_once = true,
                          .children = SET(SUN) | SET(LIGHT) | SET(LAMP) | SET(OBSTACLE) |
                                      SET(TERRAIN) | SET(PLACE) | SET(ROW) | SET(STREW) |
                                      SET(GROWTH) | SET(VIEW)},
    [FR_ELEMENT_PLACE] = {.name = "place", .table = &place_table, .required = "plant"},
    [FR_ELEMENT_ROW] = {.name = "row", .required = "plants", .has_text = true},
    [FR_ELEMENT_STREW] = {.name = "strew", .required = "plants"},
    [FR_ELEMENT_VIEW] = {.name = "view", .table = &view_table, .required = "name"},
    [FR_ELEMENT_GROWTH] = {.name = "growth", .is_once = true, .children = SET(PARTICLES)},
    [FR_ELEMENT_PARTICLES] = {.name = "particles", .has_text = true},
    [FR_ELEMENT_OBSTACLE] = {.name = "obstacle", .has_text = true},
    [FR_ELEMENT_TERRAIN] = {.name = "terrain", .is_once = true, .required = "file"},
    [FR_ELEMENT_LAMP] = {.name = "lamp"},
    [FR_ELEMENT_SUN] = {.name = "sun", .is_once = true},
    [FR_ELEMENT_LIGHT] = {.name = "light", .is_once = true},
};

/// Attributes that are declared where they are used; NULL: none are.
static const FrParamTable *table_elsewhere(FrElementId id) {
    static const FrParamTable *(*const tables[FR_ELEMENT_COMPONENT])(void) = {
        [FR_ELEMENT_MATERIAL] = fr_material_table,
        [FR_ELEMENT_LSYSTEM] = fr_lsystem_table,
        [FR_ELEMENT_EDIT] = fr_edit_table,
        [FR_ELEMENT_SKELETON] = fr_skeleton_table,
        [FR_ELEMENT_RAMIFIED] = fr_ramified_table,
        [FR_ELEMENT_NURBS] = fr_nurbs_table,
        [FR_ELEMENT_SPECIES] = fr_species_table,
        [FR_ELEMENT_ORDER] = fr_order_table,
        [FR_ELEMENT_SLIDERS] = fr_species_sliders_table,
        [FR_ELEMENT_VARY] = fr_vary_table,
        [FR_ELEMENT_STROKE] = fr_stroke_table,
        [FR_ELEMENT_INDICATOR] = fr_indicator_table,
        [FR_ELEMENT_ROW] = fr_row_table,
        [FR_ELEMENT_STREW] = fr_strew_table,
        [FR_ELEMENT_GROWTH] = fr_growth_table,
        [FR_ELEMENT_PARTICLES] = fr_particles_table,
        [FR_ELEMENT_OBSTACLE] = fr_obstacle_table,
        [FR_ELEMENT_TERRAIN] = fr_terrain_table,
        [FR_ELEMENT_LAMP] = fr_lamp_table,
        [FR_ELEMENT_SUN] = fr_sun_table,
        [FR_ELEMENT_LIGHT] = fr_light_table,
    };
    return tables[id] == NULL ? NULL : tables[id]();
}

FrElement fr_element(FrElementId id) {
    FrElement element = {.has_id = true};
    if (id < FR_ELEMENT_COMPONENT) {
        element = elements[id];
    } else {
        element.table = fr_pgraph_table((FrComponentKind)(id - FR_ELEMENT_COMPONENT));
        element.name = element.table->element;
        element.children = id == FR_ELEMENT_COMPONENT + FR_COMPONENT_GRAFT ? SET(DEFINE) : 0;
    }
    if (element.table == NULL && id < FR_ELEMENT_COMPONENT) {
        element.table = table_elsewhere(id);
    }
    if (element.meaning == NULL) {
        element.meaning = element.table->meaning;
    }
    if (id == FR_ELEMENT_COMPONENT + FR_COMPONENT_GRAFT) {
        element.required = "plant";
    }
    if (element.required == NULL) {
        element.required = "";
    }
    return element;
}

FrElementId fr_element_find(const char *name) {
    for (FrElementId id = 0; id < FR_ELEMENT_COUNT; id++) {
        if (strcmp(fr_element(id).name, name) == 0) {
            return id;
        }
    }
    return FR_ELEMENT_COUNT;
}

bool fr_element_requires(const FrElement *element, const char *attribute) {
    size_t length = strlen(attribute);
    for (const char *word = element->required; *word != '\0';) {
        size_t word_length = strcspn(word, " ");
        if (word_length == length && memcmp(word, attribute, length) == 0) {
            return true;
        }
        word += word_length + strspn(word + word_length, " ");
    }
    return false;
}

bool fr_id_is_valid(const char *id) {
    gunichar first = g_utf8_get_char(id);
    if (!g_unichar_isalpha(first) && first != '_') {
        return false;
    }
    for (const char *at = id; *at != '\0'; at = g_utf8_next_char(at)) {
        gunichar c = g_utf8_get_char(at);
        if (!g_unichar_isalnum(c) && c != '_' && c != '-') {
            return false;
        }
    }
    return true;
}
