// Segments become internodes: a segment where the last one ended continues its axis, also behind
// branches; behind `[` and behind a jump begins a new one. While the turtle walks only what it
// knows is written, in the plant's coordinates; frames follow at the end, all at once.
#include "lsystem/build.h"

#include <cglm/struct.h>

#include <math.h>

// Rows are appended to the plant by so many at once: few enough to be in the nearest cache still
// when they are written.
#define BLOCK 256
// One group in so many is counted to estimate how much room a string needs.
#define SAMPLED 8
// Squared length of a line that is too short to be drawn.
#define NO_LINE 1e-5
#define GRAIN 8192

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
    size_t makers = derivation->system->productions->len + 1;
    builder->components = g_new(uint32_t, makers);
    memset(builder->components, 0xFF, makers * sizeof *builder->components);
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

// Shepperd's method (1978): the largest component first. z is the heading, x the left.
static versors frame_of(const float z[3], const float x[3]) {
    float y[3] = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
    float q[4], trace = x[0] + y[1] + z[2];
    if (trace > 0) {
        q[3] = trace + 1;
        q[0] = y[2] - z[1];
        q[1] = z[0] - x[2];
        q[2] = x[1] - y[0];
    } else if (x[0] > y[1] && x[0] > z[2]) {
        q[3] = y[2] - z[1];
        q[0] = 1 + x[0] - y[1] - z[2];
        q[1] = y[0] + x[1];
        q[2] = z[0] + x[2];
    } else if (y[1] > z[2]) {
        q[3] = z[0] - x[2];
        q[0] = y[0] + x[1];
        q[1] = 1 + y[1] - x[0] - z[2];
        q[2] = z[1] + y[2];
    } else {
        q[3] = x[1] - y[0];
        q[0] = z[0] + x[2];
        q[1] = z[1] + y[2];
        q[2] = 1 + z[2] - x[0] - y[1];
    }
    float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(square > 0)) {
        return GLMS_QUAT_IDENTITY;
    }
    float scale = 1 / sqrtf(square);
    return (versors){{q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale}};
}

versors fr_lbuilder_frame(const double heading[3], const double left[3]) {
    vec3s z = fr_lturtle_world(heading), x = fr_lturtle_world(left);
    return frame_of(z.raw, x.raw);
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
    fr_plant_reserve(builder->plant, (uint32_t)nodes + BLOCK, (uint32_t)axes + BLOCK);
}

FrStatus fr_lbuilder_limit(const FrLbuilder *builder, uint64_t wanted, uint64_t limit,
                           const char *limit_name, const char *what) {
    return fr_lderive_limit(builder->derivation, wanted, limit, limit_name,
                            fr_lderive_maker(builder->derivation, builder->maker), what,
                            builder->module, builder->context);
}

// ---- while the turtle walks -------------------------------------------------------------------

/// Room for one more node; false after a failure.
static bool grow_nodes(FrLbuilder *builder, const FrLsegment *segment) {
    builder->maker = segment->maker;
    builder->module = segment->module;
    uint64_t most = MIN(builder->context->limits.nodes, FR_NONE - UINT64_C(1));
    FrStatus status = fr_lbuilder_limit(builder, builder->nodes + UINT64_C(1), most, "nodes",
                                        "the segments of the string");
    if (status != FR_OK) {
        builder->status = status;
        return false;
    }
    fr_plant_append_nodes(builder->plant, (uint32_t)MIN(most - builder->nodes, BLOCK));
    return true;
}

/// The material of a colour in the palette, or `otherwise` where that does not say.
static uint32_t painted(FrLbuilder *builder, int32_t colour, uint32_t otherwise) {
    FrMaterial *material = builder->palette == NULL ? NULL : builder->palette[colour & 255];
    return material == NULL ? otherwise : fr_plant_add_material(builder->plant, material);
}

/// What made something: the production whose successor its module was in, or the axiom.
static uint32_t component_of(FrLbuilder *builder, uint32_t maker) {
    const FrLproduction *production = fr_lderive_maker(builder->derivation, maker);
    maker = production == NULL ? 0 : maker;
    if (builder->components[maker] == FR_NONE) {
        const FrLunit *unit = g_ptr_array_index(builder->derivation->system->units, 0);
        builder->components[maker] =
            fr_plant_add_component(builder->plant, production == NULL ? "axiom" : production->name,
                                   production == NULL ? unit->axiom_span : production->span);
    }
    return builder->components[maker];
}

/// Begins an axis with the node made last, where the segment starts; its offset is in the plant's
/// coordinates until the end.
static uint32_t begin_axis(FrLbuilder *builder, FrLstand stand, const FrLsegment *segment) {
    FrPlant *plant = builder->plant;
    FrAxes *axes = &plant->axes;
    if (builder->axes == axes->count) {
        fr_plant_append_axes(plant, BLOCK); // there are never more than nodes
    }
    uint32_t axis = builder->axes++, node = fr_lstand_node(stand);
    vec3s start = fr_lturtle_world(segment->start);
    if (node == FR_NONE) {
        axes->offset[axis] = start;
    } else {
        uint16_t order = axes->order[plant->nodes.axis[node]];
        axes->order[axis] = (uint16_t)(order + (order < UINT16_MAX));
        if ((stand & FR_LSTAND_TIP) == 0) {
            axes->offset[axis] = glms_vec3_sub(start, plant->nodes.position[node]);
        }
    }
    axes->first[axis] = builder->nodes - 1;
    axes->bearer[axis] = node;
    axes->base_radius[axis] = segment->start_width / 2;
    axes->component[axis] = component_of(builder, segment->maker);
    axes->material[axis] = painted(builder, segment->colour, builder->wood);
    axes->profile[axis] = builder->section;
    axes->path[axis] = fr_key_child(fr_key_root(0), segment->module);
    return axis;
}

void fr_lbuilder_count(FrLbuilder *builder, const FrLsegment *segment) {
    if (segment->length * segment->length > NO_LINE && segment->end_width > 0) {
        builder->drawn.segments++;
        builder->drawn.length += segment->length;
    }
}

/// Whether an axis has the colour of a segment; another begins another axis.
static inline bool is_coloured(FrLbuilder *builder, uint32_t axis, const FrLsegment *segment) {
    return builder->palette == NULL ||
           builder->plant->axes.material[axis] == painted(builder, segment->colour, builder->wood);
}

/// Unless it has no length.
void fr_lbuilder_node(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment) {
    if (!(segment->length > 0) ||
        (builder->nodes == builder->plant->nodes.count && !grow_nodes(builder, segment))) {
        return;
    }
    FrNodes *nodes = &builder->plant->nodes;
    uint32_t node = builder->nodes++, parent = fr_lstand_node(*stand), axis;
    if (parent != FR_NONE && (*stand & ~FR_LSTAND_NODE) == FR_LSTAND_TIP &&
        nodes->next[parent] == FR_NONE && is_coloured(builder, nodes->axis[parent], segment)) {
        axis = nodes->axis[parent];
        nodes->next[parent] = node;
    } else {
        axis = begin_axis(builder, *stand, segment);
    }
    builder->plant->axes.last[axis] = node;
    nodes->parent[node] = parent;
    nodes->axis[node] = axis;
    nodes->position[node] = fr_lturtle_world(segment->end);
    nodes->length[node] = (float)segment->length;
    nodes->radius[node] = segment->end_width / 2;
    vec3s heading = fr_lturtle_world(segment->heading), left = fr_lturtle_world(segment->left);
    float sign = segment->is_backward ? -1 : 1;
    // Heading and left wait in the columns that their frame will take.
    nodes->frame[node] = (versors){{sign * heading.x, sign * heading.y, sign * heading.z, left.x}};
    nodes->rotation[node] = (versors){{left.y, left.z, 0, 1}};
    *stand = node | FR_LSTAND_TIP;
}

void fr_lbuilder_segment(FrLbuilder *builder, FrLstand *stand, const FrLsegment *segment) {
    fr_lbuilder_count(builder, segment);
    fr_lbuilder_node(builder, stand, segment);
}

uint32_t fr_lbuilder_material(FrLbuilder *builder, const FrLpose *pose, uint32_t plain) {
    bool is_own = pose->colour >= 1 && (uint32_t)pose->colour <= builder->colour_count;
    return is_own ? builder->colours[pose->colour - 1] : painted(builder, pose->colour, plain);
}

// Where an organ stands is told in the plant's coordinates until the end.
void fr_lbuilder_organ(FrLbuilder *builder, const FrLpose *pose, const double at[3], uint32_t shape,
                       double scale, uint32_t material) {
    FrPlant *plant = builder->plant;
    FrStatus status =
        fr_lbuilder_limit(builder, plant->organs.count + UINT64_C(1),
                          builder->context->limits.organs, "organs", "the organs of the string");
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
    organs->component[organ] = component_of(builder, builder->maker);
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

static void frame_nodes(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrNodes *nodes = &((FrLbuilder *)data)->plant->nodes;
    for (size_t i = begin; i < end; i++) {
        versors a = nodes->frame[i], b = nodes->rotation[i];
        float left[3] = {a.w, b.x, b.y};
        nodes->frame[i] = frame_of(a.raw, left);
    }
}

/// conj(a)·b
static inline versors between(versors a, versors b) {
    return (versors){{a.w * b.x - a.x * b.w - (a.y * b.z - a.z * b.y),
                      a.w * b.y - a.y * b.w - (a.z * b.x - a.x * b.z),
                      a.w * b.z - a.z * b.w - (a.x * b.y - a.y * b.x),
                      a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z}};
}

static void turn_nodes(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrNodes *nodes = &((FrLbuilder *)data)->plant->nodes;
    for (size_t i = begin; i < end; i++) {
        uint32_t parent = nodes->parent[i];
        nodes->rotation[i] =
            parent == FR_NONE ? nodes->frame[i] : between(nodes->frame[parent], nodes->frame[i]);
    }
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
    const FrContext *context = builder->context;
    plant->nodes.count = builder->nodes;
    plant->axes.count = builder->axes;
    fr_parallel_for(context->pool, builder->nodes, GRAIN, frame_nodes, builder, NULL);
    fr_parallel_for(context->pool, builder->nodes, GRAIN, turn_nodes, builder, NULL);
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
