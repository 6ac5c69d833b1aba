// How a stem bends from internode to internode.
//
// Directions are taken at the middles of internodes, so that a stem's form does not depend on how
// many there are; what turns from the last middle to the tip is handed on to what grows there.
#include "pgraph/stem.h"

#include "frond/noise.h"
#include "pgraph/along.h"
#include "plant/frames.h"

#include <cglm/struct.h>
#include <math.h>

static const versors identity = {{0, 0, 0, 1}};

// What is left of an internode is left out if it is a smaller part than this.
#define LEAST_STUMP 0.02

// How far along the stem the walk is, and what has been turned up to there.
typedef struct Walk {
    double at;
    double bend;
    double gnarl_x, gnarl_y;
} Walk;

// The bend of a stretch where the curvature differs along the stem.
static double bend_between(const FrStem *stem, double from, double to) {
    const FrCurve *curve = ((const FrStemParams *)stem->prepared->params)->curvature_curve;
    double stretch = (to - from) * stem->whole;
    if (curve != NULL && stretch > 0) {
        stretch = fr_curve_integral(curve, to * stem->whole) -
                  fr_curve_integral(curve, from * stem->whole);
    }
    return fr_along_mean(stem, FR_ALONG_CURVATURE, from, to) * stretch;
}

static double twist_between(const FrStem *stem, double from, double to) {
    return fr_is_along(stem, FR_ALONG_TWIST)
               ? fr_along_mean(stem, FR_ALONG_TWIST, from, to) * stem->whole * (to - from)
               : stem->twist * (to - from);
}

static double strength(const FrStem *stem, FrAlong which, double value, double from, double to) {
    return fr_is_along(stem, which) ? fr_along_mean(stem, which, from, to) : value;
}

static FrTropism tropism_between(const FrStem *stem, double from, double to) {
    FrTropism whole = stem->tropism;
    if (stem->prepared->along == 0) {
        return whole;
    }
    return (FrTropism){
        .up = strength(stem, FR_ALONG_PHOTOTROPISM, whole.up, from, to),
        .down = strength(stem, FR_ALONG_GRAVITROPISM, whole.down, from, to),
        .flat = strength(stem, FR_ALONG_PLAGIOTROPISM, whole.flat, from, to),
    };
}

static bool has_tropism(const FrStem *stem) {
    return fr_tropism_acts(stem->tropism) || fr_is_along(stem, FR_ALONG_PHOTOTROPISM) ||
           fr_is_along(stem, FR_ALONG_GRAVITROPISM) || fr_is_along(stem, FR_ALONG_PLAGIOTROPISM) ||
           stem->align != 0 || stem->aim != 0 || stem->elasticity > 0;
}

static bool has_gnarl(const FrStem *stem) {
    return stem->gnarl > 0 || stem->gnarl_fine > 0 || fr_is_along(stem, FR_ALONG_GNARL);
}

// How far its outer half is bent besides up to `at`.
static double bent_back(const FrStem *stem, double at) {
    return stem->curvature_back != 0 ? stem->curvature_back * fmax(0, 2 * at * stem->whole - 1) : 0;
}

// How far the stem is bent up to `at`, beyond where the walk is.
static double bend_up_to(const FrStem *stem, const Walk *walk, double at) {
    double back = bent_back(stem, at);
    const FrStemParams *params = stem->prepared->params;
    if (fr_is_along(stem, FR_ALONG_CURVATURE)) {
        return walk->bend + bend_between(stem, walk->at, at) + back - bent_back(stem, walk->at);
    }
    if (params->curvature_curve == NULL) {
        return stem->curvature * at * stem->whole + back;
    }
    at *= stem->whole;
    return stem->curvature * (fr_curve_integral(params->curvature_curve, at) -
                              fr_curve_integral(params->curvature_curve, 0)) +
           back;
}

static G_GNUC_NO_INLINE double trembling_at(const FrStem *stem, FrKey limb, uint64_t side,
                                            double at) {
    FrKey key = fr_key_child(fr_key_child(limb, fr_purpose(FR_STEM_gnarl_fine)), side);
    return 2 * stem->gnarl_fine * fr_noise1(key, at * stem->gnarl_fine_frequency);
}

// Two octaves of noise, in radians. Both begin at 0, so a stem sets out as it was placed.
static double gnarl_at(const FrStem *stem, FrKey limb, uint64_t side, double at) {
    FrKey key = fr_key_child(fr_key_child(limb, fr_purpose(FR_STEM_gnarl)), side);
    double x = at * stem->gnarl_frequency;
    double gnarl =
        fr_is_along(stem, FR_ALONG_GNARL) ? fr_along_at(stem, FR_ALONG_GNARL, at) : stem->gnarl;
    double wander = gnarl * (1.4 * fr_noise1(key, x) + 0.6 * fr_noise1(~key, 2 * x));
    return stem->gnarl_fine > 0 ? wander + trembling_at(stem, limb, side, at) : wander;
}

// The turn of a grown stem from where the walk is to `at`, fields not counted, in its own frame.
static versors walk_to(const FrStem *stem, FrKey key, Walk *walk, double at, double zigzag_x,
                       double zigzag_y) {
    double bend = bend_up_to(stem, walk, at);
    double part = stem->whole * (at - walk->at);
    double x = walk->bend - bend + zigzag_x - stem->bend * part;
    double y = zigzag_y + stem->bend_aside * part;
    if (has_gnarl(stem)) {
        double gnarl_x = gnarl_at(stem, key, 0, at), gnarl_y = gnarl_at(stem, key, 1, at);
        x += gnarl_x - walk->gnarl_x;
        y += gnarl_y - walk->gnarl_y;
        walk->gnarl_x = gnarl_x;
        walk->gnarl_y = gnarl_y;
    }
    double twist = twist_between(stem, walk->at, at);
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

// A limb on its way into the plant.
typedef struct Growth {
    const FrStem *stem;
    const FrLimb *limb;
    FrPlant *plant;
    const FrFields *fields;
    uint32_t axis;   // of the plant
    uint32_t before; // node; FR_NONE: on the ground
    bool is_base;    // nothing of the stem has grown yet
    uint32_t end;    // last node before what it has met; FR_NONE: it has met nothing
    bool has_met;
    uint64_t out; // bits of forces that it has been outside of
} Growth;

static versors frame_before(const Growth *growth) {
    return growth->before != FR_NONE ? growth->plant->nodes.frame[growth->before] : identity;
}

// Adds to `turn` what what it stands on, where it aims at and its own weight turn the stem by.
static versors with_own(const Growth *growth, versors turn, double at, double step) {
    const FrStem *stem = growth->stem;
    versors parent = frame_before(growth);
    if (stem->align != 0) {
        versors frame = fr_frame_step(parent, turn);
        versors aligned = fr_align_turn(stem->align * step, stem->align_to, frame);
        turn = turned_further(parent, turn, aligned);
    }
    if (stem->aim != 0) {
        versors frame = fr_frame_step(parent, turn);
        turn = turned_further(parent, turn, fr_align_turn(stem->aim * step, stem->aim_at, frame));
    }
    if (stem->elasticity > 0) {
        versors frame = fr_frame_step(parent, turn);
        double sag = fr_stem_sag(stem, at - 0.5 * step);
        turn = turned_further(parent, turn, fr_sag_turn(sag * step, frame));
    }
    return turn;
}

// Adds to `turn` what the fields turn the stem by over `step` up to `at`, from the middle of the
// last internode.
static versors with_fields(const Growth *growth, versors turn, double at, double step) {
    const FrStem *stem = growth->stem;
    FrTropism tropism = tropism_between(stem, at - step, at);
    const FrNodes *nodes = &growth->plant->nodes;
    versors parent = frame_before(growth);
    versors frame = fr_frame_step(parent, turn);
    if (!stem->is_in_field) {
        return turned_further(parent, turn, fr_tropism_turn(tropism, frame, step));
    }
    FrDraw draw = {
        .tropism = tropism,
        .length = stem->length,
        .finest = stem->step,
        .weight = stem->force_weight,
    };
    uint32_t before = growth->before;
    vec3s from = growth->is_base ? fr_plant_axis_origin(growth->plant, growth->axis)
                                 : fr_advanced(nodes->position[before], nodes->frame[before],
                                               -0.5f * nodes->length[before]);
    return turned_further(parent, turn, fr_field_turn(growth->fields, &draw, frame, from, step));
}

// Adds to `turn` what keeps an internode out of what is solid.
static versors deflected(const Growth *growth, versors turn, double length, double radius) {
    versors parent = frame_before(growth), aside;
    vec3s from = growth->is_base ? fr_plant_axis_origin(growth->plant, growth->axis)
                                 : growth->plant->nodes.position[growth->before];
    bool is_turned = fr_field_deflect(growth->fields, fr_frame_step(parent, turn), from, length,
                                      1.1 * radius, &aside);
    return is_turned ? turned_further(parent, turn, aside) : turn;
}

// Shortens an internode to where it meets what stems end at; from then on all are shed.
static double stopped(Growth *growth, uint32_t node, versors turn, double length) {
    FrNodes *nodes = &growth->plant->nodes;
    if (growth->has_met) {
        nodes->flags[node] |= FR_SHED;
        return 0;
    }
    vec3s from = growth->is_base ? fr_plant_axis_origin(growth->plant, growth->axis)
                                 : nodes->position[growth->before];
    bool is_cut;
    versors frame = fr_frame_step(frame_before(growth), turn);
    // What begins inside on the ground grows out of it; branches there are none.
    double free = fr_field_free(growth->fields, frame, from, length, &growth->out, &is_cut);
    if (free >= length) {
        return length;
    }
    bool is_gone = free < LEAST_STUMP * length;
    nodes->flags[node] |= is_gone ? FR_SHED : 0;
    growth->has_met = true;
    growth->end = is_cut ? FR_NONE : is_gone ? growth->before : node;
    if (is_cut) {
        growth->plant->axes.flags[growth->axis] |= FR_CUT;
    }
    return free;
}

// Writes the next node of a growth.
static void write_node(Growth *growth, uint32_t node, versors rotation, double length,
                       double radius, double flatness) {
    FrNodes *nodes = &growth->plant->nodes;
    FrAxes *axes = &growth->plant->axes;
    uint32_t axis = growth->axis;
    nodes->parent[node] = growth->before;
    nodes->axis[node] = axis;
    nodes->rotation[node] = rotation;
    nodes->length[node] = (float)length;
    nodes->radius[node] = (float)radius;
    nodes->flatness[node] = (float)flatness;
    if (axes->first[axis] == FR_NONE) {
        axes->first[axis] = node;
    } else {
        nodes->next[growth->before] = node;
    }
    axes->last[axis] = node;
    fr_update_frame(nodes, axes, node);
    growth->before = node;
    growth->is_base = false;
}

// Whether every internode but the first turns by the same, fields not counted.
static bool is_steady(const FrStem *stem) {
    const FrStemParams *params = stem->prepared->params;
    return stem->gaps == 0 && !has_gnarl(stem) && params->curvature_curve == NULL &&
           !fr_is_along(stem, FR_ALONG_CURVATURE) && !fr_is_along(stem, FR_ALONG_TWIST) &&
           stem->curvature_back == 0;
}

// Where the walk along a limb begins: in the middle of the internode before it.
static Walk walk_of(const FrStem *stem, const FrLimb *limb) {
    Walk walk = {0};
    if (limb->before == FR_NONE) {
        return walk;
    }
    const FrLimb *before = &stem->limbs[limb->before];
    double at = before->end - 0.5 * (before->end - before->start) / before->internodes;
    walk.bend = bend_up_to(stem, &walk, at);
    walk.at = at;
    if (has_gnarl(stem)) {
        walk.gnarl_x = gnarl_at(stem, limb->key, 0, walk.at);
        walk.gnarl_y = gnarl_at(stem, limb->key, 1, walk.at);
    }
    return walk;
}

// What a limb is turned by before internode k other than along its way: by its fork, the rest of
// which it takes back, or away from the branch at the place just passed.
static void turn_aside(const FrStem *stem, const FrLimb *limb, uint32_t k, double step, double *x,
                       double *y) {
    *x = *y = 0;
    if (limb->turn != 0) {
        double part = (k == 0) - limb->straightness * step / limb->span;
        *x = part * limb->turn_x;
        *y = part * limb->turn_y;
    }
    uint32_t each = stem->gaps > 0 ? stem->internodes / stem->gaps : 0;
    if (each > 0 && k > 0 && k % each == 0) {
        double azimuth = (double)(k / each - 1) * stem->places.divergence;
        *x = stem->deviation * sin(azimuth);
        *y = -stem->deviation * cos(azimuth);
    }
}

static versors grow_evenly(Growth *growth, uint32_t first, versors start) {
    const FrStem *stem = growth->stem;
    const FrLimb *limb = growth->limb;
    Walk walk = walk_of(stem, limb);
    double end = limb->start;
    bool steady = is_steady(stem), has_fields = has_tropism(stem) || stem->is_in_field;
    versors turn = identity;
    for (uint32_t k = 0; k < limb->internodes; k++) {
        double begin = end, aside_x, aside_y;
        end = fr_limb_node_end(stem, limb, k);
        double middle = 0.5 * (begin + end), step = middle - walk.at;
        double length = (end - begin) * stem->length, radius = fr_limb_radius(stem, limb, end);
        if (k <= 1 || !steady) {
            turn_aside(stem, limb, k, middle - fmax(walk.at, limb->start), &aside_x, &aside_y);
            turn = walk_to(stem, limb->key, &walk, middle, aside_x, aside_y);
        }
        walk.at = middle;
        versors own = growth->is_base ? fr_frame_step(start, turn) : turn;
        if (has_fields) {
            own = with_own(growth, with_fields(growth, own, middle, step), middle, step);
        }
        if (stem->is_in_field) {
            own = deflected(growth, own, length, radius);
            length = stopped(growth, first + k, own, length);
        }
        write_node(growth, first + k, own, length, radius, fr_stem_flatness(stem, end));
    }
    double step = 1 - walk.at;
    if (steady) {
        walk.bend = bend_up_to(stem, &walk, walk.at);
    }
    turn = walk_to(stem, limb->key, &walk, 1, 0, 0);
    return has_fields ? with_own(growth, with_fields(growth, turn, 1, step), 1, step) : turn;
}

static versors grow_steps(Growth *growth, uint32_t first, versors start) {
    const FrStem *stem = growth->stem;
    double length = stem->step_length;
    for (uint32_t k = 0; k < stem->internodes; k++) {
        versors turn = k > 0 ? stem->step_turn : fr_frame_step(start, stem->step_chord);
        write_node(growth, first + k, turn, length, fr_stem_radius(stem, fr_stem_node_end(stem, k)),
                   fr_stem_flatness(stem, fr_stem_node_end(stem, k)));
        length = fmin(length * stem->step_scale, 1e6);
    }
    // From the chord's frame back to that of the last cross-section, which has turned once more.
    versors back = stem->step_chord;
    back = (versors){{-back.x, -back.y, -back.z, back.w}};
    return fr_frame_step(stem->step_turn, back);
}

// A point of the polyline, `at` of it counted in its pieces.
static vec3s point_of(const vec3s *points, uint32_t pieces, double at) {
    uint32_t k = (uint32_t)fmin(floor(at), pieces - 1);
    return glms_vec3_lerp(points[k], points[k + 1], (float)(at - k));
}

static versors grow_path(Growth *growth, uint32_t first, versors start) {
    const FrStem *stem = growth->stem;
    const vec3s *points = (const vec3s *)(const void *)stem->path->data;
    versors frame = identity; // of the internode, in the stem's own coordinates
    double each = 1.0 / stem->internodes;
    for (uint32_t k = 0; k < stem->internodes; k++) {
        vec3s chord = glms_vec3_sub(points[k + 1], points[k]);
        if (stem->reach < 1) {
            chord = glms_vec3_sub(point_of(points, stem->internodes, (k + 1) * stem->reach),
                                  point_of(points, stem->internodes, k * stem->reach));
        }
        float length = glms_vec3_norm(chord);
        versors turn = identity;
        if (length > 0) {
            // The least rotation from chord to chord: no twist but the one asked for.
            versors back = {{-frame.x, -frame.y, -frame.z, frame.w}};
            vec3s ahead = fr_turned(back, glms_vec3_divs(chord, length));
            turn = fr_rotation_between((vec3s){{0, 0, 1}}, ahead);
        }
        double twist = twist_between(stem, k * each, (k + 1) * each);
        if (twist != 0) {
            turn = fr_frame_step(turn, fr_rotation_about((vec3s){{0, 0, 1}}, (float)twist));
        }
        frame = fr_frame_step(frame, turn);
        write_node(growth, first + k, k > 0 ? turn : fr_frame_step(start, turn),
                   (double)length * stem->scale, fr_stem_radius(stem, fr_stem_node_end(stem, k)),
                   fr_stem_flatness(stem, fr_stem_node_end(stem, k)));
    }
    return identity;
}

versors fr_limb_grow(const FrStem *stem, const FrLimb *limb, FrPlant *plant, uint32_t axis,
                     uint32_t first, versors start, const FrFields *fields, uint32_t *end) {
    uint32_t last = plant->axes.last[axis];
    Growth growth = {
        .stem = stem,
        .limb = limb,
        .plant = plant,
        .fields = fields,
        .axis = axis,
        .before = last != FR_NONE ? last : plant->axes.bearer[axis],
        .is_base = limb->before == FR_NONE,
        .out = stem->is_on_ground ? 0 : UINT64_MAX,
    };
    versors turn = stem->course == FR_COURSE_PATH    ? grow_path(&growth, first, start)
                   : stem->course == FR_COURSE_STEPS ? grow_steps(&growth, first, start)
                                                     : grow_evenly(&growth, first, start);
    *end = growth.has_met && growth.end != FR_NONE ? growth.end : growth.before;
    return turn;
}
