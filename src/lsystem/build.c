// Segments become internodes: a segment where the last one ended continues its axis, also behind
// branches; behind `[` and behind a jump begins a new one.
#include "lsystem/build.h"

#include <cglm/struct.h>

#include <math.h>

// Nodes are appended to the plant by so many at once.
#define BLOCK 1024

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
    builder->segment_component = fr_plant_add_component(builder->plant, "F", (FrSpan){0});
    builder->organ_component = fr_plant_add_component(builder->plant, "organs", (FrSpan){0});
    const FrLsettings *settings = &derivation->settings;
    builder->wood = add_material(builder->plant, settings->axes, settings->inherits, "wood",
                                 (vec3s){{0.42F, 0.33F, 0.24F}}, 0);
    builder->leaf = add_material(builder->plant, settings->organs, settings->inherits, "leaf",
                                 (vec3s){{0.30F, 0.48F, 0.16F}}, 0.35);
    builder->unit = settings->unit;
    builder->sites = settings->sites;
    for (const char *site = builder->sites; site != NULL && *site != '\0'; site++) {
        fr_plant_add_component(builder->plant, (char[]){*site, '\0'}, (FrSpan){0});
    }
    for (int k = 0; k < 3; k++) {
        builder->drawn.min[k] = INFINITY;
        builder->drawn.max[k] = -INFINITY;
    }
    return builder;
}

void fr_lbuilder_free(FrLbuilder *builder) {
    if (builder != NULL) {
        fr_plant_free(builder->plant);
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

FrPlant *fr_lbuilder_end(FrLbuilder *builder) {
    FrPlant *plant = builder->plant;
    plant->nodes.count = builder->nodes;
    if (builder->view->style == FR_LSTYLE_PIXEL) {
        scale_pixels(builder);
    }
    if (builder->unit != 1) {
        scale_units(plant, (float)builder->unit);
    }
    fr_plant_update_frames(plant, 0);
    builder->plant = NULL;
    return plant;
}

// Shepperd's method (1978): the largest component first.
versors fr_lbuilder_frame(const double heading[3], const double left[3]) {
    double z[3] = {heading[0], -heading[2], heading[1]};
    double x[3] = {left[0], -left[2], left[1]}, y[3];
    fr_lvector_cross(z, x, y);
    double trace = x[0] + y[1] + z[2], q[4];
    if (trace > 0) {
        double s = 2 * sqrt(trace + 1);
        q[3] = s / 4;
        q[0] = (y[2] - z[1]) / s;
        q[1] = (z[0] - x[2]) / s;
        q[2] = (x[1] - y[0]) / s;
    } else if (x[0] > y[1] && x[0] > z[2]) {
        double s = 2 * sqrt(1 + x[0] - y[1] - z[2]);
        q[3] = (y[2] - z[1]) / s;
        q[0] = s / 4;
        q[1] = (y[0] + x[1]) / s;
        q[2] = (z[0] + x[2]) / s;
    } else if (y[1] > z[2]) {
        double s = 2 * sqrt(1 + y[1] - x[0] - z[2]);
        q[3] = (z[0] - x[2]) / s;
        q[0] = (y[0] + x[1]) / s;
        q[1] = s / 4;
        q[2] = (z[1] + y[2]) / s;
    } else {
        double s = 2 * sqrt(1 + z[2] - x[0] - y[1]);
        q[3] = (x[1] - y[0]) / s;
        q[0] = (z[0] + x[2]) / s;
        q[1] = (z[1] + y[2]) / s;
        q[2] = s / 4;
    }
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0)) {
        return GLMS_QUAT_IDENTITY;
    }
    return (versors){{(float)(q[0] / length), (float)(q[1] / length), (float)(q[2] / length),
                      (float)(q[3] / length)}};
}

static versors conjugate(versors q) {
    return (versors){{-q.x, -q.y, -q.z, q.w}};
}

static void include(FrLdrawn *drawn, const double point[3]) {
    for (int k = 0; k < 3; k++) {
        drawn->min[k] = fmin(drawn->min[k], point[k]);
        drawn->max[k] = fmax(drawn->max[k], point[k]);
    }
}

static uint32_t add_node(FrLbuilder *builder) {
    FrPlant *plant = builder->plant;
    if (builder->nodes == plant->nodes.count) {
        FrStatus status =
            fr_limit_check(builder->nodes + UINT64_C(1), builder->context->limits.nodes, "nodes",
                           "the segments of the string", (FrSpan){0}, builder->context->diags);
        if (status != FR_OK) {
            builder->status = status;
            return FR_NONE;
        }
        fr_plant_append_nodes(plant, BLOCK);
    }
    return builder->nodes++;
}

static uint32_t begin_axis(FrLbuilder *builder, const FrLpose *pose, const FrLsegment *segment) {
    FrPlant *plant = builder->plant;
    vec3s start = fr_lturtle_world(segment->start), offset = {{0, 0, 0}};
    if (pose->node == FR_NONE) {
        offset = start;
    } else if (!pose->is_at_tip) {
        offset = glms_vec3_sub(start, plant->nodes.position[pose->node]);
        offset = glms_quat_rotatev(conjugate(plant->nodes.frame[pose->node]), offset);
    }
    uint32_t axis = fr_plant_add_axis(plant, pose->node, offset, (float)(segment->start_width / 2));
    plant->axes.component[axis] = builder->segment_component;
    plant->axes.material[axis] = builder->wood;
    plant->axes.path[axis] = fr_key_child(fr_key_root(0), segment->module);
    return axis;
}

void fr_lbuilder_segment(FrLbuilder *builder, FrLpose *pose, const FrLsegment *segment) {
    FrPlant *plant = builder->plant;
    double length = 0;
    for (int k = 0; k < 3; k++) {
        double d = segment->end[k] - segment->start[k];
        length += d * d;
    }
    length = sqrt(length);
    include(&builder->drawn, segment->start);
    include(&builder->drawn, segment->end);
    if (length == 0) {
        return;
    }
    uint32_t node = add_node(builder);
    if (node == FR_NONE) {
        return;
    }
    builder->drawn.segments++;
    builder->drawn.length += length;
    FrNodes *nodes = &plant->nodes;
    bool continues = pose->node != FR_NONE && pose->is_at_tip && !pose->is_lateral &&
                     nodes->next[pose->node] == FR_NONE;
    uint32_t axis = continues ? nodes->axis[pose->node] : begin_axis(builder, pose, segment);
    uint32_t parent = pose->node;
    versors base = parent == FR_NONE ? GLMS_QUAT_IDENTITY : nodes->frame[parent];
    bool is_backward =
        fr_lvector_dot(segment->heading, (double[3]){segment->end[0] - segment->start[0],
                                                     segment->end[1] - segment->start[1],
                                                     segment->end[2] - segment->start[2]}) < 0;
    double heading[3];
    for (int k = 0; k < 3; k++) {
        heading[k] = is_backward ? -segment->heading[k] : segment->heading[k];
    }
    versors frame = fr_lbuilder_frame(heading, segment->left);
    nodes->rotation[node] = glms_quat_normalize(glms_quat_mul(conjugate(base), frame));
    nodes->frame[node] = fr_frame_step(base, nodes->rotation[node]);
    nodes->position[node] = fr_lturtle_world(segment->end);
    nodes->parent[node] = parent;
    nodes->axis[node] = axis;
    nodes->length[node] = (float)length;
    nodes->radius[node] = (float)(segment->end_width / 2);
    if (continues) {
        nodes->next[parent] = node;
    } else {
        plant->axes.first[axis] = node;
    }
    plant->axes.last[axis] = node;
    pose->node = node;
    pose->is_at_tip = true;
    pose->is_lateral = false;
}

void fr_lbuilder_organ(FrLbuilder *builder, const FrLpose *pose, const double at[3], uint32_t shape,
                       double scale, uint32_t material) {
    FrPlant *plant = builder->plant;
    FrStatus status =
        fr_limit_check(plant->organs.count + UINT64_C(1), builder->context->limits.organs, "organs",
                       "the organs of the string", (FrSpan){0}, builder->context->diags);
    if (status != FR_OK || !(scale > 1e-9) || !isfinite(scale)) {
        builder->status = MAX(builder->status, status);
        return;
    }
    uint32_t organ = fr_plant_append_organs(plant, 1);
    versors frame = fr_lbuilder_frame(pose->heading, pose->left);
    vec3s offset = fr_lturtle_world(at);
    if (pose->node != FR_NONE) {
        versors back = conjugate(plant->nodes.frame[pose->node]);
        offset = glms_quat_rotatev(back, glms_vec3_sub(offset, plant->nodes.position[pose->node]));
        frame = glms_quat_normalize(glms_quat_mul(back, frame));
    }
    FrOrgans *organs = &plant->organs;
    organs->node[organ] = pose->node;
    organs->offset[organ] = offset;
    organs->rotation[organ] = frame;
    organs->scale[organ] = (float)MIN(scale, 1e9);
    organs->shape[organ] = shape;
    organs->material[organ] = material;
    organs->component[organ] = builder->organ_component;
    organs->path[organ] = fr_key_child(fr_key_root(1), organ);
}

void fr_lbuilder_site(FrLbuilder *builder, const FrLpose *pose, char symbol, double scale) {
    const char *site = strchr(builder->sites, symbol);
    uint32_t before = builder->plant->organs.count;
    // What is placed has its own unit, whatever that of the file is.
    fr_lbuilder_organ(builder, pose, pose->position, FR_NONE, scale / builder->unit, FR_NONE);
    if (builder->plant->organs.count > before) {
        builder->plant->organs.component[before] =
            builder->organ_component + 1 + (uint32_t)(site - builder->sites);
    }
}
