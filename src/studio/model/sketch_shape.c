#include "studio/model/sketch_shape.h"

#include "frond/vector.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

enum { ORDERS = 32 };

static const float thin = 1.1f, thick = 4.2f; // pixels

StudioSketchColours studio_sketch_colours(bool is_dark) {
    static const StudioSketchColours dark = {
        {150, 158, 146, 255}, {84, 160, 255, 255},  {255, 182, 64, 255}, {120, 220, 130, 255},
        {245, 245, 240, 255}, {255, 120, 110, 255}, {110, 160, 80, 150}};
    static const StudioSketchColours light = {
        {110, 114, 104, 255}, {20, 96, 220, 255}, {214, 120, 0, 255}, {28, 136, 56, 255},
        {30, 30, 34, 255},    {204, 40, 40, 255}, {84, 140, 60, 150}};
    return is_dark ? dark : light;
}

// ---- branches ----------------------------------------------------------------------------------

static bool is_shown(const FrPlant *plant, uint32_t node) {
    uint16_t flags = plant->nodes.flags[node] | plant->axes.flags[plant->nodes.axis[node]];
    return (flags & (FR_SHED | FR_HIDDEN)) == 0;
}

static vec3s begin_of(const FrPlant *plant, uint32_t node) {
    return plant->axes.first[plant->nodes.axis[node]] == node
               ? fr_plant_axis_origin(plant, plant->nodes.axis[node])
               : plant->nodes.position[plant->nodes.parent[node]];
}

static void add_line(GArray *lines, vec3s from, vec3s to, float width, const uint8_t colour[4]) {
    StudioLine line = {{from.x, from.y, from.z}, {to.x, to.y, to.z}, width, {0}};
    memcpy(line.colour, colour, sizeof line.colour);
    g_array_append_val(lines, line);
}

static uint32_t order_of(const FrPlant *plant, uint32_t node) {
    return MIN(plant->axes.order[plant->nodes.axis[node]], ORDERS - 1);
}

// The highest order that is drawn so that there are at most so many internodes; at least 0.
static uint32_t highest_order(const FrPlant *plant, uint32_t most) {
    uint32_t counts[ORDERS] = {0};
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        counts[order_of(plant, i)]++;
    }
    uint64_t sum = counts[0];
    uint32_t order = 0;
    while (order + 1 < ORDERS && sum + counts[order + 1] <= most) {
        sum += counts[++order];
    }
    return order;
}

static float thickest_radius(const FrPlant *plant) {
    float most = 1e-9f;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        most = fmaxf(most, plant->nodes.radius[i]);
    }
    return most;
}

// Draws all branches, each in the colour of its axis.
static void add_branches(GArray *lines, const FrPlant *plant, uint32_t most,
                         const uint8_t *(*colour_of)(const void *user, uint32_t axis),
                         const void *user, const uint8_t *bare) {
    uint32_t highest = highest_order(plant, most);
    float largest = thickest_radius(plant);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        const uint8_t *colour = colour_of(user, plant->nodes.axis[i]);
        if (is_shown(plant, i) && (order_of(plant, i) <= highest || colour != bare)) {
            float part = sqrtf(fmaxf(plant->nodes.radius[i], 0) / largest);
            float width = thin + (thick - thin) * part + (colour != bare ? 1.2f : 0);
            add_line(lines, begin_of(plant, i), plant->nodes.position[i], width, colour);
        }
    }
}

typedef struct ByState {
    const uint8_t *states;
    const StudioSketchColours *colours;
} ByState;

static const uint8_t *colour_by_state(const void *user, uint32_t axis) {
    const ByState *by = user;
    return by->states[axis] == FR_SELECTED       ? by->colours->selected
           : by->states[axis] == FR_UNDETERMINED ? by->colours->undetermined
                                                 : by->colours->bare;
}

void studio_sketch_states(const FrPlant *plant, const FrSelection *selection, StudioChosen chosen,
                          uint32_t component, uint8_t *states) {
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        bool is_chosen = chosen == STUDIO_CHOSEN_ALL || plant->axes.component[a] == component;
        states[a] = chosen == STUDIO_CHOSEN_PAINTED ? (uint8_t)fr_selection_state(selection, a)
                                                    : (is_chosen ? FR_SELECTED : FR_UNSELECTED);
    }
}

void studio_sketch_add_skeleton(GArray *lines, const FrPlant *plant, const uint8_t *states,
                                const StudioSketchColours *colours, uint32_t most) {
    ByState by = {states, colours};
    add_branches(lines, plant, most, colour_by_state, &by, colours->bare);
}

typedef struct ByStroke {
    const uint32_t *stroke;
    const StudioSketchColours *colours;
} ByStroke;

static const uint8_t *colour_by_stroke(const void *user, uint32_t axis) {
    const ByStroke *by = user;
    return by->stroke != NULL && by->stroke[axis] != FR_NONE ? by->colours->shaped
                                                             : by->colours->bare;
}

void studio_sketch_add_instance(GArray *lines, const FrPlant *plant, const uint32_t *stroke,
                                const StudioSketchColours *colours, uint32_t most) {
    ByStroke by = {stroke, colours};
    add_branches(lines, plant, most, colour_by_stroke, &by, colours->bare);
}

// ---- leaves ------------------------------------------------------------------------------------

static float leaf_length(const FrShape *shape) {
    return shape->kind == FR_SHAPE_BLADE ? shape->blade.petiole_length + shape->blade.length
                                         : shape->size.z;
}

void studio_sketch_add_leaves(GArray *lines, const FrPlant *plant,
                              const StudioSketchColours *colours, uint32_t most) {
    const FrOrgans *organs = &plant->organs;
    uint32_t step = most == 0 ? FR_NONE : organs->count / most + 1;
    for (uint32_t i = 0; i < organs->count && step != FR_NONE; i += MIN(step, organs->count - i)) {
        if ((organs->flags[i] & (FR_SHED | FR_HIDDEN)) != 0) {
            continue;
        }
        vec3s at;
        versors turn;
        fr_plant_organ_pose(plant, i, &at, &turn);
        const FrShape *shape = &g_array_index(plant->shapes, FrShape, organs->shape[i]);
        float length = organs->scale[i] * leaf_length(shape);
        add_line(lines, at, glms_vec3_add(at, glms_vec3_scale(fr_frame_heading(turn), length)),
                 2.2f, colours->leaf);
    }
}

// ---- strokes and arrows ------------------------------------------------------------------------

void studio_sketch_add_stroke_line(GArray *lines, const FrStroke *stroke, const float at[3],
                                   double scale, float width, const uint8_t colour[4]) {
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    vec3s base = {{at[0], at[1], at[2]}}, last = base;
    for (size_t i = 1; i < count; i++) {
        vec3s from = glms_vec3_sub(points[i].at, points[0].at);
        vec3s to = glms_vec3_add(base, glms_vec3_scale(from, (float)scale));
        float pressed = points[i].pressure > 0 ? 0.5f + 0.5f * (float)points[i].pressure : 1;
        add_line(lines, last, to, width * pressed, colour);
        last = to;
    }
}

void studio_sketch_add_arrow(GArray *lines, const float from[3], const float to[3], float width,
                             const uint8_t colour[4]) {
    vec3s a = {{from[0], from[1], from[2]}}, b = {{to[0], to[1], to[2]}};
    vec3s along = glms_vec3_sub(b, a);
    float length = glms_vec3_norm(along);
    if (!(length > 0)) {
        return;
    }
    vec3s heading = glms_vec3_scale(along, 1 / length);
    versors frame = fr_frame_from_heading(heading, (vec3s){{0, 0, 1}});
    vec3s left = fr_frame_left(frame), up = fr_frame_up(frame);
    add_line(lines, a, b, width, colour);
    for (int i = 0; i < 4; i++) {
        vec3s side = glms_vec3_scale(i < 2 ? left : up, (i % 2 == 0 ? 0.09f : -0.09f) * length);
        vec3s back = glms_vec3_sub(b, glms_vec3_scale(heading, 0.2f * length));
        add_line(lines, b, glms_vec3_add(back, side), width, colour);
    }
}

// ---- measures ----------------------------------------------------------------------------------

static void extend(double min[3], double max[3], vec3s at) {
    for (int i = 0; i < 3; i++) {
        min[i] = fmin(min[i], (double)at.raw[i]);
        max[i] = fmax(max[i], (double)at.raw[i]);
    }
}

uint32_t studio_sketch_first(const FrPlant *plant, const uint8_t *states) {
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (states[a] == FR_SELECTED) {
            return a;
        }
    }
    return FR_NONE;
}

void studio_sketch_bounds(const FrPlant *plant, double min[3], double max[3]) {
    vec3s low, high;
    fr_plant_bounds(plant, &low, &high);
    for (int i = 0; i < 3; i++) {
        min[i] = (double)low.raw[i];
        max[i] = (double)high.raw[i];
    }
}

StudioLens studio_sketch_lens(const StudioCamera *camera, double aspect) {
    mat4s project = studio_camera_projection(camera, aspect, camera->distance);
    return (StudioLens){glms_mat4_mul(project, studio_camera_view(camera)), (float)camera->distance,
                        (float)(0.02 * camera->distance)};
}

// Where lines are in a picture, from −1 to 1: left, bottom, right, top. False: nowhere.
static bool range_of(const StudioLens *lens, GArray *const *layers, size_t count, double range[4]) {
    bool is_any = false;
    for (size_t layer = 0; layer < count; layer++) {
        for (guint i = 0; layers[layer] != NULL && i < 2 * layers[layer]->len; i++) {
            const StudioLine *line = &g_array_index(layers[layer], StudioLine, i / 2);
            const float *end = i % 2 == 0 ? line->from : line->to;
            vec4s at = glms_mat4_mulv(lens->project, (vec4s){{end[0], end[1], end[2], 1}});
            for (int k = 0; k < 2 && at.w > 0; k++) {
                double place = (double)(at.raw[k] / at.w);
                range[k] = is_any ? fmin(range[k], place) : place;
                range[k + 2] = is_any ? fmax(range[k + 2], place) : place;
            }
            is_any = is_any || at.w > 0;
        }
    }
    return is_any;
}

void studio_sketch_fit(StudioCamera *camera, GArray *const *layers, size_t count, double aspect) {
    double min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t layer = 0; layer < count; layer++) {
        for (guint i = 0; layers[layer] != NULL && i < layers[layer]->len; i++) {
            const StudioLine *line = &g_array_index(layers[layer], StudioLine, i);
            extend(min, max, (vec3s){{line->from[0], line->from[1], line->from[2]}});
            extend(min, max, (vec3s){{line->to[0], line->to[1], line->to[2]}});
        }
    }
    studio_camera_frame(camera, min, max, aspect);
    for (int pass = 0; pass < 4; pass++) {
        StudioLens lens = studio_sketch_lens(camera, aspect);
        double range[4];
        if (!range_of(&lens, layers, count, range)) {
            return;
        }
        studio_camera_pan(camera, 0.25 * aspect * (range[0] + range[2]),
                          0.25 * (range[1] + range[3]));
        double half = 0.5 * fmax(range[2] - range[0], range[3] - range[1]);
        studio_camera_zoom(camera, half > 1e-6 ? half / 0.9 : 1);
    }
}

void studio_sketch_add_chosen(GArray *lines, const FrPlant *plant, const uint8_t *states) {
    static const uint8_t white[4] = {255, 255, 255, 255};
    bool is_part = states != NULL && studio_sketch_first(plant, states) != FR_NONE;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        if (is_shown(plant, i) && (!is_part || states[plant->nodes.axis[i]] == FR_SELECTED)) {
            add_line(lines, begin_of(plant, i), plant->nodes.position[i], 1, white);
        }
    }
}

double studio_sketch_length(const FrPlant *plant, uint32_t axis) {
    double length = 0;
    for (uint32_t i = plant->axes.first[axis]; i != FR_NONE; i = plant->nodes.next[i]) {
        length += (double)plant->nodes.length[i];
    }
    return length;
}
