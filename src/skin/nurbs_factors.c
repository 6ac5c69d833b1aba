// Global factors: wind, light and gravity. Beneš, Generating a Model of Plant Using NURBS,
// Figure 6.
//
// Each is a vector. How far a point of a branch yields follows from the vector, from the point's
// distance σ from where the branch of length L begins, and from the branch's radius r:
//
//     turn(σ) = yield · |F⊥| · (σ/L)² · (yield-radius / r)^exponent
//
// where F⊥ is the part of the vector across the branch. Control points are turned towards the
// vector, not shifted, so branches keep their lengths, and what a branch bears is carried along. A
// petiole is such a branch; points of a blade turn about the midrib by their distance from it. Only
// control points are moved. The wind comes in waves: sin(ωt − kσ) and as far along the wind.
#include "skin/nurbs.h"

#include <cglm/struct.h>

#include <string.h>

/// Joints that a bending axis has at least.
enum { JOINTS = 6, JOINTS_MOST_NODES = 10000000, RANDOM_WAVE = 71 };
/// Thin twigs yield no more than this times a branch of the yield radius.
#define WEAKEST 3.0

bool fr_nurbs_is_blown(const FrNurbsParams *params) {
    const vec3s *factors[] = {&params->wind, &params->light, &params->gravity};
    bool acts = false;
    for (size_t i = 0; i < G_N_ELEMENTS(factors); i++) {
        acts |= factors[i]->x != 0.0F || factors[i]->y != 0.0F || factors[i]->z != 0.0F;
    }
    return acts && (params->yield > 0.0 || params->blade_yield > 0.0);
}

/// All vectors at a place that the wind reaches `along` later, with its own irregularity.
static vec3s force_at(const FrNurbsParams *params, vec3s at, double along, FrKey key) {
    double strength = (double)glms_vec3_norm(params->wind);
    double before = strength > 0.0 ? (double)glms_vec3_dot(at, params->wind) / strength : 0.0;
    double wave = 2.0 * G_PI * (before + along) / params->wave;
    double own = fr_random_signed(key, RANDOM_WAVE, 0);
    double gust = 0.5 + 0.5 * sin(params->phase - wave + own);
    vec3s wind = glms_vec3_scale(params->wind, (float)(1.0 - params->gust * (1.0 - gust)));
    return glms_vec3_add(wind, glms_vec3_add(params->light, params->gravity));
}

/// The turn of `heading` towards `force` by `angle`, but not past it.
static versors turn_towards(vec3s heading, vec3s force, double angle) {
    vec3s axis = glms_vec3_cross(heading, force);
    double across = (double)glms_vec3_norm(axis), along = (double)glms_vec3_dot(heading, force);
    if (!(across > 1e-9) || !(angle > 0.0)) {
        return glms_quat_identity();
    }
    vec3s unit = glms_vec3_scale(axis, (float)(1.0 / across));
    return fr_rotation_about(unit, (float)fmin(angle, atan2(across, along)));
}

/// Radians for a vector of length 1 at the tip.
static double weakness(const FrNurbsParams *params, double radius) {
    double thinner = params->yield_radius / fmax(radius, 1e-9);
    return params->yield * fmin(pow(thinner, params->yield_exponent), WEAKEST);
}

static double across_length(vec3s heading, vec3s force) {
    return (double)glms_vec3_norm(glms_vec3_cross(heading, force));
}

// ---- branches ----------------------------------------------------------------------------------

/// Axes that go on from one another bend as one.
typedef struct FrReach {
    double *before; ///< by axis: length of those it goes on from
    double *whole;  ///< by axis: of all, from the first to the last
} FrReach;

static FrReach measure(const FrPlant *plant) {
    const FrAxes *axes = &plant->axes;
    FrReach reach = {g_new0(double, (size_t)axes->count + 1),
                     g_new0(double, (size_t)axes->count + 1)};
    uint32_t *first = g_new(uint32_t, (size_t)axes->count + 1);
    for (uint32_t a = 0; a < axes->count; a++) {
        uint32_t bearer = axes->bearer[a];
        bool goes_on = bearer != FR_NONE && (axes->flags[a] & FR_CONTINUES) != 0;
        uint32_t from = goes_on ? plant->nodes.axis[bearer] : FR_NONE;
        double length = 0.0;
        for (uint32_t n = axes->first[a]; n != FR_NONE; n = plant->nodes.next[n]) {
            length += (double)plant->nodes.length[n];
        }
        first[a] = goes_on ? first[from] : a;
        reach.before[a] = goes_on ? reach.whole[from] : 0.0;
        reach.whole[a] = reach.before[a] + length;
    }
    for (uint32_t a = axes->count; a-- > 0;) { // the whole of the first, then of all
        reach.whole[first[a]] = fmax(reach.whole[first[a]], reach.whole[a]);
    }
    for (uint32_t a = 0; a < axes->count; a++) {
        reach.whole[a] = reach.whole[first[a]];
    }
    g_free(first);
    return reach;
}

static void bend_branches(FrPlant *plant, const FrNurbsParams *params) {
    FrNodes *nodes = &plant->nodes;
    FrReach reach = measure(plant);
    double *along = g_new0(double, (size_t)nodes->count + 1),
           *turned = g_new0(double, nodes->count + 1);
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t axis = nodes->axis[i], parent = nodes->parent[i];
        bool is_first = plant->axes.first[axis] == i;
        bool goes_on = (plant->axes.flags[axis] & FR_CONTINUES) != 0;
        double before = is_first ? reach.before[axis] : along[parent];
        along[i] = before + (double)nodes->length[i];
        versors base = parent != FR_NONE ? nodes->frame[parent] : glms_quat_identity();
        versors carried = fr_frame_step(base, nodes->rotation[i]);
        vec3s heading = fr_frame_heading(carried);
        vec3s at = parent != FR_NONE ? nodes->position[parent] : plant->axes.offset[axis];
        vec3s force = force_at(params, at, along[i], plant->axes.path[axis]);
        double share = reach.whole[axis] > 0.0 ? along[i] / reach.whole[axis] : 0.0;
        turned[i] = weakness(params, (double)nodes->radius[i]) * share * share;
        double last = is_first && !goes_on ? 0.0 : parent != FR_NONE ? turned[parent] : 0.0;
        double angle = fmax(turned[i] - last, 0.0) * across_length(heading, force);
        versors turn = turn_towards(heading, force, angle);
        versors frame = glms_quat_normalize(glms_quat_mul(turn, carried));
        nodes->rotation[i] = glms_quat_mul(glms_quat_conjugate(base), frame);
        nodes->frame[i] = frame;
        vec3s way = glms_vec3_scale(fr_frame_heading(frame), nodes->length[i]);
        vec3s from = is_first ? fr_plant_axis_origin(plant, axis) : nodes->position[parent];
        nodes->position[i] = glms_vec3_add(from, way);
    }
    g_free(along);
    g_free(turned);
    g_free(reach.before);
    g_free(reach.whole);
    fr_plant_update_frames(plant, 0);
}

FrPlant *fr_nurbs_posed(const FrPlant *plant, const FrNurbsParams *params) {
    bool is_blown = fr_nurbs_is_blown(params);
    if (params->weights == FR_WEIGHTS_OWN && !is_blown) {
        return NULL;
    }
    uint16_t *joints = g_new0(uint16_t, (size_t)plant->axes.count + 1);
    for (uint32_t a = 0; a < plant->axes.count && is_blown; a++) {
        joints[a] = JOINTS;
    }
    if (fr_plant_refined_nodes(plant, joints) > JOINTS_MOST_NODES) {
        memset(joints, 0, sizeof *joints * plant->axes.count);
    }
    FrPlant *posed = fr_plant_refined(plant, joints);
    g_free(joints);
    fr_plant_weigh(posed, (FrWeights)params->weights, params->thinnest, params->ratio,
                   params->pipe_exponent);
    if (is_blown) {
        bend_branches(posed, params);
    }
    return posed;
}

// ---- organs ------------------------------------------------------------------------------------

static vec3s to_single(const double v[3]) {
    return (vec3s){{(float)v[0], (float)v[1], (float)v[2]}};
}

static void turn_about(double point[4], const double from[3], const double to[3], versors turn) {
    double v[3] = {point[0] - from[0], point[1] - from[1], point[2] - from[2]};
    const double q[4] = {(double)turn.x, (double)turn.y, (double)turn.z, (double)turn.w};
    double t[3] = {2.0 * (q[1] * v[2] - q[2] * v[1]), 2.0 * (q[2] * v[0] - q[0] * v[2]),
                   2.0 * (q[0] * v[1] - q[1] * v[0])};
    double u[3] = {q[1] * t[2] - q[2] * t[1], q[2] * t[0] - q[0] * t[2], q[0] * t[1] - q[1] * t[0]};
    for (int k = 0; k < 3; k++) {
        point[k] = to[k] + v[k] + q[3] * t[k] + u[k];
    }
}

/// The middle of a ring, whose last point is its first.
static void ring_middle(const double (*ring)[4], uint32_t width, double middle[3], double *radius) {
    memset(middle, 0, 3 * sizeof *middle);
    for (uint32_t i = 0; i + 1 < width; i++) {
        for (int k = 0; k < 3; k++) {
            middle[k] += ring[i][k] / (width - 1);
        }
    }
    double nearest = INFINITY;
    for (uint32_t i = 0; i + 1 < width; i++) {
        double way[3] = {ring[i][0] - middle[0], ring[i][1] - middle[1], ring[i][2] - middle[2]};
        nearest = fmin(nearest, sqrt(fr_dot3(way, way)));
    }
    *radius = nearest;
}

/// How what stands at the end of a stem is carried: turned, from a place to another.
typedef struct FrCarried {
    versors turn;
    double from[3], to[3];
} FrCarried;

/// Bends a petiole row by row; answers what becomes of its end.
static FrCarried bend_petiole(const FrNurbsParams *params, const FrNurbsSurface *stem, vec3s force,
                              double (*points)[4]) {
    uint32_t width = stem->count_u, rows = stem->count_v;
    FrCarried end = {.turn = glms_quat_identity()};
    double radius, last[3];
    ring_middle((const double(*)[4])points, width, end.from, &radius);
    memcpy(end.to, end.from, sizeof end.to);
    memcpy(last, end.from, sizeof last);
    double weak = weakness(params, radius), before = 0.0;
    for (uint32_t j = 1; j < rows; j++) {
        double(*ring)[4] = points + (size_t)j * width;
        double middle[3], share = (double)j / (rows - 1);
        ring_middle((const double(*)[4])ring, width, middle, &radius);
        vec3s way = {{(float)(middle[0] - last[0]), (float)(middle[1] - last[1]),
                      (float)(middle[2] - last[2])}};
        vec3s heading = glms_vec3_normalize(glms_quat_rotatev(end.turn, way));
        double turned = weak * share * share;
        double angle = (turned - before) * across_length(heading, force);
        end.turn =
            glms_quat_normalize(glms_quat_mul(turn_towards(heading, force, angle), end.turn));
        double step[4] = {middle[0], middle[1], middle[2], 1.0};
        turn_about(step, last, end.to, end.turn);
        memcpy(last, middle, sizeof last);
        memcpy(end.from, middle, sizeof end.from);
        memcpy(end.to, step, sizeof end.to);
        before = turned;
        for (uint32_t i = 0; i < width; i++) {
            turn_about(ring[i], end.from, end.to, end.turn);
        }
    }
    return end;
}

/// Turns the points of half a blade about its midrib, by their distance from it over `half`.
static void bend_half(const FrNurbsParams *params, const FrNurbsPiece *piece, vec3s force,
                      double half, double (*points)[4]) {
    uint32_t width = piece->surface.count_u, rows = piece->surface.count_v;
    uint32_t midrib = piece->kind == FR_NURBS_RIGHT ? rows - 1 : 0;
    for (uint32_t i = 0; i < width; i++) {
        const double *foot = points[(size_t)midrib * width + i];
        for (uint32_t j = 0; j < rows; j++) {
            double *point = points[(size_t)j * width + i];
            double way[3] = {point[0] - foot[0], point[1] - foot[1], point[2] - foot[2]};
            double reach = sqrt(fr_dot3(way, way));
            if (j != midrib && reach > 0.0) {
                vec3s heading = glms_vec3_scale(to_single(way), (float)(1.0 / reach));
                double angle = params->blade_yield * reach / half * across_length(heading, force);
                turn_about(point, foot, foot, turn_towards(heading, force, angle));
            }
        }
    }
}

static double widest(const FrNurbsPiece *piece, const double (*points)[4]) {
    uint32_t width = piece->surface.count_u, rows = piece->surface.count_v;
    double most = 0.0;
    for (uint32_t i = 0; i < width; i++) {
        const double *a = points[i], *b = points[(size_t)(rows - 1) * width + i];
        double way[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        most = fmax(most, sqrt(fr_dot3(way, way)));
    }
    return most;
}

/// True for the tube of a petiole: a blade follows. Rachises of compound leaves stay as they are.
static bool is_petiole(const FrNurbsPiece *pieces, uint32_t tube, uint32_t count,
                       const FrBlade *blade) {
    uint32_t next = tube + 1;
    while (next < count &&
           (pieces[next].kind == FR_NURBS_FOOT || pieces[next].kind == FR_NURBS_CAP)) {
        next++;
    }
    bool has_petioles = blade->compound == FR_COMPOUND_SIMPLE || blade->leaflet_petiole > 0.0F;
    return has_petioles && next < count && pieces[next].kind == FR_NURBS_RIGHT;
}

void fr_nurbs_blow_organ(const FrNurbsParams *params, const FrPlant *plant, uint32_t organ,
                         const FrNurbsPiece *pieces, uint32_t count, double (*points)[4]) {
    bool is_blade = false;
    for (uint32_t i = 0; i < count; i++) {
        is_blade |= pieces[i].kind == FR_NURBS_RIGHT || pieces[i].kind == FR_NURBS_LEFT;
    }
    if (!is_blade) {
        return;
    }
    vec3s at;
    versors rotation;
    fr_plant_organ_pose(plant, organ, &at, &rotation);
    vec3s force = force_at(params, at, 0.0, plant->organs.path[organ]);
    const FrBlade *blade = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]).blade;
    FrCarried end = {.turn = glms_quat_identity()};
    double half = 0.0;
    double(*own)[4] = points;
    for (uint32_t i = 0; i < count; i++) {
        size_t size = (size_t)pieces[i].surface.count_u * pieces[i].surface.count_v;
        if (pieces[i].kind == FR_NURBS_TUBE && is_petiole(pieces, i, count, blade)) {
            end = bend_petiole(params, &pieces[i].surface, force, own);
        } else if (pieces[i].kind == FR_NURBS_TUBE) {
            end = (FrCarried){.turn = glms_quat_identity()};
        } else {
            bool is_carried = pieces[i].kind != FR_NURBS_FOOT;
            for (size_t k = 0; k < size && is_carried; k++) {
                turn_about(own[k], end.from, end.to, end.turn);
            }
            bool is_half = pieces[i].kind == FR_NURBS_RIGHT || pieces[i].kind == FR_NURBS_LEFT;
            half = is_half ? fmax(half, widest(&pieces[i], (const double(*)[4])own)) : half;
        }
        own += size;
    }
    own = points;
    for (uint32_t i = 0; i < count; i++) {
        if ((pieces[i].kind == FR_NURBS_RIGHT || pieces[i].kind == FR_NURBS_LEFT) && half > 0.0) {
            bend_half(params, &pieces[i], force, half, own);
        }
        own += (size_t)pieces[i].surface.count_u * pieces[i].surface.count_v;
    }
}
