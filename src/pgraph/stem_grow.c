// How a stem bends from internode to internode.
//
// Directions are taken at the middles of internodes, so that a stem's form does not depend on how
// many there are; what turns from the last middle to the tip is handed on to what grows there.
#include "pgraph/stem.h"

#include "frond/noise.h"
#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

static const versors identity = {{0, 0, 0, 1}};

// How far along the stem the walk is, and what has been turned up to there.
typedef struct Walk {
    double at;
    double bend;
    double gnarl_x, gnarl_y;
} Walk;

static double bend_up_to(const FrStem *stem, double at) {
    const FrStemParams *params = stem->prepared->params;
    if (params->curvature_curve == NULL) {
        return stem->curvature * at * stem->whole;
    }
    at *= stem->whole;
    return stem->curvature * (fr_curve_integral(params->curvature_curve, at) -
                              fr_curve_integral(params->curvature_curve, 0));
}

// Two octaves of noise, in radians. Both begin at 0, so a stem sets out as it was placed.
static double gnarl_at(const FrStem *stem, uint64_t side, double at) {
    FrKey key = fr_key_child(fr_key_child(stem->key, FR_STEM_gnarl), side);
    double x = at * stem->gnarl_frequency;
    return stem->gnarl * (1.4 * fr_noise1(key, x) + 0.6 * fr_noise1(~key, 2 * x));
}

// The turn of a grown stem from where the walk is to `at`, fields not counted, in its own frame.
static versors walk_to(const FrStem *stem, Walk *walk, double at, double zigzag_x,
                       double zigzag_y) {
    double bend = bend_up_to(stem, at);
    double x = walk->bend - bend + zigzag_x, y = zigzag_y;
    if (stem->gnarl > 0) {
        double gnarl_x = gnarl_at(stem, 0, at), gnarl_y = gnarl_at(stem, 1, at);
        x += gnarl_x - walk->gnarl_x;
        y += gnarl_y - walk->gnarl_y;
        walk->gnarl_x = gnarl_x;
        walk->gnarl_y = gnarl_y;
    }
    double twist = stem->twist * (at - walk->at);
    walk->bend = bend;
    walk->at = at;
    versors turn = identity;
    double angle = sqrt(x * x + y * y);
    if (angle > 0) {
        turn =
            fr_rotation_about((vec3s){{(float)(x / angle), (float)(y / angle), 0}}, (float)angle);
    }
    if (twist != 0) {
        turn = fr_frame_step(turn, fr_rotation_about((vec3s){{0, 0, 1}}, (float)twist));
    }
    return turn;
}

// The same turn as the parent sees it, before which the stem had turned by `turn`.
static versors turned_further(versors parent, versors turn, versors field) {
    versors back = {{-parent.x, -parent.y, -parent.z, parent.w}};
    // The same rotation about its axis as the parent sees it.
    vec3s axis = fr_turned(back, (vec3s){{field.x, field.y, field.z}});
    versors own = {{axis.x, axis.y, axis.z, field.w}};
    return fr_frame_step(own, turn);
}

static versors frame_before(const FrPlant *plant, uint32_t axis, uint32_t first, uint32_t k) {
    uint32_t before = k > 0 ? first + k - 1 : plant->axes.bearer[axis];
    return before != FR_NONE ? plant->nodes.frame[before] : identity;
}

// Where the walk is: in the middle of the internode before.
static vec3s walk_place(const FrPlant *plant, uint32_t axis, uint32_t first, uint32_t k) {
    if (k == 0) {
        return fr_plant_axis_origin(plant, axis);
    }
    uint32_t before = first + k - 1;
    return fr_advanced(plant->nodes.position[before], plant->nodes.frame[before],
                       -0.5f * plant->nodes.length[before]);
}

// Adds to `turn` what the fields turn the stem by over `step`, before internode k.
static versors with_fields(const FrStem *stem, const FrPlant *plant, uint32_t axis, uint32_t first,
                           uint32_t k, versors turn, double step, const FrFields *fields) {
    versors parent = frame_before(plant, axis, first, k);
    versors frame = fr_frame_step(parent, turn);
    if (!stem->is_in_field) {
        return turned_further(parent, turn, fr_tropism_turn(stem->tropism, frame, step));
    }
    FrDraw draw = {.tropism = stem->tropism, .length = stem->length, .finest = stem->step};
    vec3s from = walk_place(plant, axis, first, k);
    return turned_further(parent, turn, fr_field_turn(fields, &draw, frame, from, step));
}

// Adds to `turn` what keeps internode k out of what is solid.
static versors deflected(const FrStem *stem, const FrPlant *plant, uint32_t axis, uint32_t first,
                         uint32_t k, versors turn, double length, const FrFields *fields) {
    versors parent = frame_before(plant, axis, first, k), aside;
    vec3s from = k > 0 ? plant->nodes.position[first + k - 1] : fr_plant_axis_origin(plant, axis);
    double radius = 1.1 * fr_stem_radius(stem, fr_stem_node_end(stem, k));
    bool is_turned =
        fr_field_deflect(fields, fr_frame_step(parent, turn), from, length, radius, &aside);
    return is_turned ? turned_further(parent, turn, aside) : turn;
}

static void write_node(FrPlant *plant, uint32_t axis, uint32_t node, uint32_t first,
                       versors rotation, double length, double radius, double flatness) {
    FrNodes *nodes = &plant->nodes;
    bool is_first = node == first;
    nodes->parent[node] = is_first ? plant->axes.bearer[axis] : node - 1;
    nodes->axis[node] = axis;
    nodes->rotation[node] = rotation;
    nodes->length[node] = (float)length;
    nodes->radius[node] = (float)radius;
    nodes->flatness[node] = (float)flatness;
    if (!is_first) {
        nodes->next[node - 1] = node;
    }
    fr_update_frame(nodes, &plant->axes, node);
}

// Whether every internode but the first turns by the same, fields not counted.
static bool is_steady(const FrStem *stem) {
    const FrStemParams *params = stem->prepared->params;
    return stem->gaps == 0 && stem->gnarl <= 0 && params->curvature_curve == NULL;
}

static versors grow_evenly(const FrStem *stem, FrPlant *plant, uint32_t axis, uint32_t first,
                           versors start, const FrFields *fields) {
    Walk walk = {0};
    double end = 0;
    uint32_t each = stem->gaps > 0 ? stem->internodes / stem->gaps : stem->internodes;
    bool steady = is_steady(stem), has_fields = fr_tropism_acts(stem->tropism) || stem->is_in_field;
    versors turn = identity;
    for (uint32_t k = 0; k < stem->internodes; k++) {
        double begin = end, zigzag_x = 0, zigzag_y = 0;
        end = fr_stem_node_end(stem, k);
        if (k > 0 && k % each == 0) { // away from the branch at the place just passed
            double azimuth = (double)(k / each - 1) * stem->places.divergence;
            zigzag_x = stem->deviation * sin(azimuth);
            zigzag_y = -stem->deviation * cos(azimuth);
        }
        double middle = 0.5 * (begin + end), step = middle - walk.at;
        if (k <= 1 || !steady) {
            turn = walk_to(stem, &walk, middle, zigzag_x, zigzag_y);
        }
        walk.at = middle;
        versors own = k > 0 ? turn : fr_frame_step(start, turn);
        if (has_fields) {
            own = with_fields(stem, plant, axis, first, k, own, step, fields);
        }
        if (stem->is_in_field) {
            own = deflected(stem, plant, axis, first, k, own, (end - begin) * stem->length, fields);
        }
        write_node(plant, axis, first + k, first, own, (end - begin) * stem->length,
                   fr_stem_radius(stem, end), stem->flatness);
    }
    double step = 1 - walk.at;
    walk.bend = bend_up_to(stem, walk.at);
    turn = walk_to(stem, &walk, 1, 0, 0);
    return has_fields ? with_fields(stem, plant, axis, first, stem->internodes, turn, step, fields)
                      : turn;
}

static versors grow_steps(const FrStem *stem, FrPlant *plant, uint32_t axis, uint32_t first,
                          versors start) {
    double length = stem->step_length;
    for (uint32_t k = 0; k < stem->internodes; k++) {
        versors turn = k > 0 ? stem->step_turn : fr_frame_step(start, stem->step_chord);
        write_node(plant, axis, first + k, first, turn, length,
                   fr_stem_radius(stem, fr_stem_node_end(stem, k)), stem->flatness);
        length = fmin(length * stem->step_scale, 1e6);
    }
    // From the chord's frame back to that of the last cross-section, which has turned once more.
    versors back = stem->step_chord;
    back = (versors){{-back.x, -back.y, -back.z, back.w}};
    return fr_frame_step(stem->step_turn, back);
}

static versors grow_path(const FrStem *stem, FrPlant *plant, uint32_t axis, uint32_t first,
                         versors start) {
    const vec3s *points = (const vec3s *)(const void *)stem->prepared->path->data;
    versors frame = identity; // of the internode, in the stem's own coordinates
    double twist = stem->twist / stem->internodes;
    for (uint32_t k = 0; k < stem->internodes; k++) {
        vec3s chord = glms_vec3_sub(points[k + 1], points[k]);
        float length = glms_vec3_norm(chord);
        versors turn = identity;
        if (length > 0) {
            // The least rotation from chord to chord: no twist but the one asked for.
            versors back = {{-frame.x, -frame.y, -frame.z, frame.w}};
            vec3s ahead = fr_turned(back, glms_vec3_divs(chord, length));
            turn = fr_rotation_between((vec3s){{0, 0, 1}}, ahead);
        }
        if (twist != 0) {
            turn = fr_frame_step(turn, fr_rotation_about((vec3s){{0, 0, 1}}, (float)twist));
        }
        frame = fr_frame_step(frame, turn);
        write_node(plant, axis, first + k, first, k > 0 ? turn : fr_frame_step(start, turn),
                   (double)length * stem->scale, fr_stem_radius(stem, fr_stem_node_end(stem, k)),
                   stem->flatness);
    }
    return identity;
}

versors fr_stem_grow(const FrStem *stem, FrPlant *plant, uint32_t axis, uint32_t first,
                     versors start, const FrFields *fields) {
    const FrStemParams *params = stem->prepared->params;
    if (stem->internodes == 0) {
        return start;
    }
    plant->axes.first[axis] = first;
    plant->axes.last[axis] = first + stem->internodes - 1;
    switch (params->course) {
    case FR_COURSE_PATH:
        return grow_path(stem, plant, axis, first, start);
    case FR_COURSE_STEPS:
        return grow_steps(stem, plant, axis, first, start);
    default:
        return grow_evenly(stem, plant, axis, first, start, fields);
    }
}
