// The plant that the turtle draws: its begin, organs, and its end.
#include "lsystem/build.h"

#include <cglm/struct.h>

#include <math.h>

// One group in so many is counted to estimate how much room a string needs.
#define SAMPLED 8

/// A material: that of the settings, none where it is inherited, or one of its own.
static uint32_t add_material(FrPlant *plant, FrMaterial *given, bool inherits, const char *name,
                             vec3s colour, double translucency) {
    if (given != NULL || inherits) {
        return given == NULL ? FR_NONE : fr_plant_add_material(plant, given);
    }
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.colour = colour;
    params.translucency = translucency;
    FrMaterial *material = fr_material_new(name, &params, NULL, (FrSpan){0});
    fr_params_clear(fr_material_table(), &params);
    uint32_t index = fr_plant_add_material(plant, material);
    fr_material_unref(material);
    return index;
}

FrLbuilder *fr_lbuilder_new(const FrLderivation *derivation, const FrContext *context) {
    FrLbuilder *builder = g_new0(FrLbuilder, 1);
    builder->plant = fr_plant_new("lsystem");
    builder->context = context;
    builder->view = derivation->view;
    builder->status = FR_OK;
    builder->derivation = derivation;
    builder->makers = derivation->system->productions->len + 1;
    builder->components = g_new(uint32_t, builder->makers);
    memset(builder->components, 0xFF, builder->makers * sizeof *builder->components);
    const FrLsettings *settings = &derivation->settings;
    builder->wood = add_material(builder->plant, settings->axes, settings->inherits, "wood",
                                 (vec3s){{0.42F, 0.33F, 0.24F}}, 0);
    builder->leaf = add_material(builder->plant, settings->organs, settings->inherits, "leaf",
                                 (vec3s){{0.30F, 0.48F, 0.16F}}, 0.35);
    builder->colour_count = (uint32_t)settings->colour_count;
    builder->colours = g_new(uint32_t, settings->colour_count);
    for (size_t i = 0; i < settings->colour_count; i++) {
        builder->colours[i] = fr_plant_add_material(builder->plant, settings->colours[i]);
    }
    const FrLview *view = builder->view;
    builder->section = view->section == NULL || view->style != FR_LSTYLE_CYLINDER
                           ? FR_NONE
                           : fr_plant_add_profile(builder->plant, (const double(*)[2])view->section,
                                                  view->section_count, true);
    builder->palette = settings->palette;
    builder->unit = settings->unit;
    builder->sites = settings->sites;
    if (settings->keeps_origins) {
        builder->origins = g_array_new(FALSE, FALSE, sizeof(uint64_t));
        builder->organ_origins = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    }
    for (const char *site = builder->sites; site != NULL && *site != '\0'; site++) {
        fr_plant_add_component(builder->plant, (char[]){*site, '\0'}, (FrSpan){0});
    }
    return builder;
}

void fr_lbuilder_free(FrLbuilder *builder) {
    if (builder != NULL) {
        fr_plant_free(builder->plant);
        g_free(builder->colours);
        g_free(builder->components);
        g_clear_pointer(&builder->origins, g_array_unref);
        g_clear_pointer(&builder->organ_origins, g_array_unref);
        g_free(builder);
    }
}

// Radii of lines that are so many pixels wide: a pixel is a thousandth of the plant.
static void scale_pixels(FrLbuilder *builder) {
    FrPlant *plant = builder->plant;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double side = builder->drawn.max[k] - builder->drawn.min[k];
        square += side > 0 ? side * side : 0;
    }
    float pixel = square > 0 ? (float)(sqrt(square) / 500) : 0.001F;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        plant->nodes.radius[i] *= pixel;
    }
    for (uint32_t i = 0; i < plant->axes.count; i++) {
        plant->axes.base_radius[i] *= pixel;
    }
}

/// From units of the file to metres.
static void scale_units(FrPlant *plant, float unit) {
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        plant->nodes.length[i] *= unit;
        plant->nodes.radius[i] *= unit;
        plant->nodes.position[i] = glms_vec3_scale(plant->nodes.position[i], unit);
    }
    for (uint32_t i = 0; i < plant->axes.count; i++) {
        plant->axes.base_radius[i] *= unit;
        plant->axes.offset[i] = glms_vec3_scale(plant->axes.offset[i], unit);
    }
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        plant->organs.offset[i] = glms_vec3_scale(plant->organs.offset[i], unit);
        plant->organs.scale[i] *= unit;
    }
}

static versors conjugate(versors q) {
    return (versors){{-q.x, -q.y, -q.z, q.w}};
}

// ---- room -------------------------------------------------------------------------------------

#define CHAINS 8

/// Symbols in a part of a string.
typedef struct Count {
    uint64_t segments, brackets;
} Count;

/// Counts eight parts abreast: where a module begins is known only after the one before it, so one
/// part alone would mostly wait.
static Count count_abreast(const uint32_t *words, const uint64_t begin[CHAINS],
                           const uint64_t end[CHAINS]) {
    Count count = {0, 0};
    uint64_t at[CHAINS];
    memcpy(at, begin, sizeof at);
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (int c = 0; c < CHAINS; c++) {
            if (at[c] < end[c]) {
                uint32_t head = words[at[c]];
                unsigned symbol = fr_lhead_symbol(head);
                count.segments += symbol == 'F' || symbol == 'G';
                count.brackets += symbol == '[';
                at[c] += 1 + fr_lhead_count(head);
                goes_on = true;
            }
        }
    }
    return count;
}

/// Counts a group of parts that is not the last of the string.
static Count count_group(const FrLstring *string, size_t group) {
    uint64_t begin[CHAINS], end[CHAINS];
    for (size_t c = 0; c < CHAINS; c++) {
        begin[c] = g_array_index(string->marks, FrLmark, group * CHAINS + c).word;
        end[c] = g_array_index(string->marks, FrLmark, group * CHAINS + c + 1).word;
    }
    return count_abreast(string->words, begin, end);
}

void fr_lbuilder_reserve(FrLbuilder *builder, const FrLstring *string) {
    const GArray *marks = string->marks;
    size_t groups = (marks->len + CHAINS - 1) / CHAINS;
    if (groups < 2 * SAMPLED) {
        return; // small plants grow as they are
    }
    Count count = {0, 0};
    uint64_t seen = 0;
    for (size_t i = 0; i < groups - 1; i += SAMPLED) {
        Count more = count_group(string, i);
        count.segments += more.segments;
        count.brackets += more.brackets;
        seen += g_array_index(marks, FrLmark, (i + 1) * CHAINS).word -
                g_array_index(marks, FrLmark, i * CHAINS).word;
    }
    // A little more than the sample lets expect; where that is not enough, there is room made
    // later.
    double scale = 1.02 * (double)string->count / (double)seen;
    double most = (double)MIN(builder->context->limits.nodes, UINT32_MAX / 2);
    double nodes = MIN((double)count.segments * scale, most);
    double axes = MIN((double)count.brackets * scale, nodes);
    fr_plant_reserve(builder->plant, (uint32_t)nodes + FR_LBLOCK, (uint32_t)axes + FR_LBLOCK);
}

FrStatus fr_lbuilder_limit(const FrLbuilder *builder, uint64_t wanted, uint64_t limit,
                           const char *limit_name, const char *what) {
    return fr_lderive_limit(builder->derivation, wanted, limit, limit_name,
                            fr_lderive_maker(builder->derivation, builder->maker), what,
                            builder->module, builder->context);
}

// ---- organs -----------------------------------------------------------------------------------

uint32_t fr_lbuilder_material(FrLbuilder *builder, const FrLpose *pose, uint32_t plain) {
    bool is_own = pose->colour >= 1 && (uint32_t)pose->colour <= builder->colour_count;
    return is_own ? builder->colours[pose->colour - 1]
                  : fr_lbuilder_painted(builder, pose->colour, plain);
}

// Where an organ stands is told in the plant's coordinates until the end.
void fr_lbuilder_organ(FrLbuilder *builder, const FrLpose *pose, const double at[3], uint32_t shape,
                       double scale, uint32_t material) {
    FrPlant *plant = builder->plant;
    FrStatus status = fr_lbuilder_limit(builder, plant->organs.count + UINT64_C(1),
                                        builder->context->limits.organs, "organs", "the string");
    if (status != FR_OK || !(scale > 1e-9) || !isfinite(scale)) {
        builder->status = MAX(builder->status, status);
        return;
    }
    uint32_t organ = fr_plant_append_organs(plant, 1), node = fr_lstand_node(pose->stand);
    vec3s offset = fr_lturtle_world(at);
    FrOrgans *organs = &plant->organs;
    organs->node[organ] = node;
    organs->offset[organ] =
        node == FR_NONE ? offset : glms_vec3_sub(offset, plant->nodes.position[node]);
    organs->rotation[organ] = fr_lbuilder_frame(pose->heading, pose->left);
    organs->scale[organ] = (float)MIN(scale, 1e9);
    organs->shape[organ] = shape;
    organs->material[organ] = material;
    organs->component[organ] = fr_lbuilder_component(builder, builder->maker);
    if (builder->organ_origins != NULL) {
        uint64_t origin = builder->module << 16 | builder->maker;
        g_array_append_val(builder->organ_origins, origin);
    }
    organs->path[organ] = fr_key_child(fr_key_root(1), organ);
}

void fr_lbuilder_site(FrLbuilder *builder, const FrLpose *pose, char symbol, double scale) {
    const char *site = strchr(builder->sites, symbol);
    uint32_t before = builder->plant->organs.count;
    // What is placed has its own unit, whatever that of the file is.
    fr_lbuilder_organ(builder, pose, pose->position, FR_NONE, scale / builder->unit, FR_NONE);
    if (builder->plant->organs.count > before) {
        builder->plant->organs.component[before] = (uint32_t)(site - builder->sites);
    }
}

// ---- at the end -------------------------------------------------------------------------------

/// conj(a)·b
static inline versors between(versors a, versors b) {
    return (versors){{a.w * b.x - a.x * b.w - (a.y * b.z - a.z * b.y),
                      a.w * b.y - a.y * b.w - (a.z * b.x - a.x * b.z),
                      a.w * b.z - a.z * b.w - (a.x * b.y - a.y * b.x),
                      a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z}};
}

static void settle(FrPlant *plant) {
    FrAxes *axes = &plant->axes;
    FrOrgans *organs = &plant->organs;
    for (uint32_t i = 0; i < axes->count; i++) {
        vec3s *offset = &axes->offset[i];
        if (axes->bearer[i] != FR_NONE && (offset->x != 0 || offset->y != 0 || offset->z != 0)) {
            *offset = glms_quat_rotatev(conjugate(plant->nodes.frame[axes->bearer[i]]), *offset);
        }
    }
    for (uint32_t i = 0; i < organs->count; i++) {
        if (organs->node[i] != FR_NONE) {
            versors frame = plant->nodes.frame[organs->node[i]];
            organs->offset[i] = glms_quat_rotatev(conjugate(frame), organs->offset[i]);
            organs->rotation[i] = glms_quat_normalize(between(frame, organs->rotation[i]));
        }
    }
}

FrPlant *fr_lbuilder_end(FrLbuilder *builder) {
    FrPlant *plant = builder->plant;
    fr_lbuilder_settle_frames(builder);
    plant->nodes.count = builder->nodes;
    plant->axes.count = builder->axes;
    settle(plant);
    if (builder->view->style == FR_LSTYLE_PIXEL) {
        scale_pixels(builder);
    }
    if (builder->unit != 1) {
        scale_units(plant, (float)builder->unit);
    }
    builder->plant = NULL;
    return plant;
}
