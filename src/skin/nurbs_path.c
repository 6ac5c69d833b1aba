// The points of a branch, collected in order.
//
// Where a branch bears another, the last points of the bearing one begin the path of the other:
// both curves then leave the shared points in the same direction, and the branch starts inside its
// parent. A branch that stands aside of its bearer's tip shares the points moved there.
#include "skin/nurbs.h"

#include <string.h>

// A ring thinner than this, or than this share of the branch, is no ring to a CAD program.
#define THINNEST 2e-5
#define THINNEST_SHARE 0.02

static FrNurbsStation *append(FrNurbsPath *path) {
    if (path->count == path->room) {
        path->room = MAX(2 * path->room, 64);
        path->stations = g_renew(FrNurbsStation, path->stations, path->room);
        path->along = g_renew(double, path->along, path->room);
    }
    return &path->stations[path->count++];
}

void fr_nurbs_path_clear(FrNurbsPath *path) {
    g_clear_pointer(&path->stations, g_free);
    g_clear_pointer(&path->along, g_free);
    path->count = path->room = 0;
}

void fr_nurbs_path_add(FrNurbsPath *path, const double at[3], double radius, double flatness,
                       uint32_t node) {
    if (path->count > 0) {
        FrNurbsStation *last = &path->stations[path->count - 1];
        double step[3] = {at[0] - last->at[0], at[1] - last->at[1], at[2] - last->at[2]};
        double reach = fabs(at[0]) + fabs(at[1]) + fabs(at[2]);
        if (!(sqrt(fr_dot3(step, step)) > 1e-5 + 1e-6 * reach)) {
            return;
        }
    }
    FrNurbsStation *station = append(path);
    *station = (FrNurbsStation){.radius = radius, .flatness = flatness, .node = node};
    memcpy(station->at, at, sizeof station->at);
}

static void to_double(vec3s from, double to[3]) {
    for (int k = 0; k < 3; k++) {
        to[k] = (double)from.raw[k];
    }
}

/// Where the internode of `node` begins.
static void base_of(const FrPlan *plan, uint32_t node, double at[3]) {
    const FrPlant *plant = plan->plant;
    uint32_t axis = plant->nodes.axis[node], parent = plant->nodes.parent[node];
    bool is_first = plant->axes.first[axis] == node;
    to_double(is_first || parent == FR_NONE ? fr_plant_axis_origin(plant, axis)
                                            : plant->nodes.position[parent],
              at);
}

// The points before the origin of a branch on `bearer`: one or two of its parent's.
static void add_shared(FrNurbsPath *path, const FrPlan *plan, uint32_t bearer,
                       const double origin[3], double radius, bool is_smooth) {
    const FrNodes *nodes = &plan->plant->nodes;
    double tip[3], base[3], before[3], way[3], aside[3];
    to_double(nodes->position[bearer], tip);
    base_of(plan, bearer, base);
    uint32_t parent = nodes->parent[bearer];
    bool has_before = parent != FR_NONE && nodes->axis[parent] == nodes->axis[bearer];
    if (has_before) {
        base_of(plan, parent, before);
    }
    for (int k = 0; k < 3; k++) {
        way[k] = tip[k] - base[k];
        aside[k] = origin[k] - tip[k];
        before[k] = has_before ? before[k] : 2.0 * base[k] - tip[k];
    }
    double squared = fr_dot3(way, way), moved = fr_dot3(aside, aside);
    if (!(squared > 1e-12)) {
        return;
    }
    // A branch that begins further down shares only as much of the internode as is below it.
    double part = moved > 1e-16 ? 1.0 + fr_dot3(aside, way) / squared : 1.0;
    part = fmin(fmax(part, 0.1), 1.0);
    double flatness = (double)nodes->flatness[bearer];
    if (is_smooth) {
        double first[3];
        for (int k = 0; k < 3; k++) {
            first[k] = origin[k] - part * (tip[k] - before[k]);
        }
        fr_nurbs_path_add(path, first, radius, flatness, bearer);
    }
    double second[3];
    for (int k = 0; k < 3; k++) {
        second[k] = origin[k] - part * way[k];
    }
    fr_nurbs_path_add(path, second, radius, flatness, bearer);
}

static void thicken(FrNurbsPath *path) {
    double most = 0.0;
    for (uint32_t i = 0; i < path->count; i++) {
        double radius = path->stations[i].radius;
        most = isfinite(radius) ? fmax(most, radius) : most;
    }
    double least = fmax(THINNEST, THINNEST_SHARE * most);
    for (uint32_t i = 0; i < path->count; i++) {
        FrNurbsStation *station = &path->stations[i];
        station->radius = station->radius > least ? fmin(station->radius, most) : least;
        station->flatness = station->flatness > 0.02 ? fmin(station->flatness, 50.0) : 0.02;
    }
}

void fr_nurbs_path(FrNurbsPath *path, const FrPlan *plan, const FrTube *tube,
                   const FrNurbsParams *params) {
    const FrPlant *plant = plan->plant;
    const FrNodes *nodes = &plant->nodes;
    path->count = path->shared = 0;
    double at[3], radius = (double)fr_tube_base_radius(plan, tube);
    to_double(fr_tube_origin(plan, tube), at);
    uint32_t bearer = tube->start == FR_START_BRANCH  ? plant->axes.bearer[tube->axis]
                      : tube->start == FR_START_JOINT ? tube->from
                                                      : FR_NONE;
    bool is_smooth = params->join == FR_JOIN_SMOOTH;
    if (bearer != FR_NONE) {
        add_shared(path, plan, bearer, at, radius, is_smooth);
    }
    if (!tube->is_point_sets) {
        fr_nurbs_path_add(path, at, radius, (double)nodes->flatness[tube->first], tube->first);
    }
    path->shared = bearer != FR_NONE && path->count == (is_smooth ? 3 : 2) ? path->count : 0;
    for (uint32_t node = tube->first;; node = fr_plan_next(plan, node)) {
        to_double(nodes->position[node], at);
        fr_nurbs_path_add(path, at, (double)nodes->radius[node], (double)nodes->flatness[node],
                          node);
        if (node == tube->last) {
            break;
        }
    }
    thicken(path);
}

uint32_t fr_nurbs_rows(const FrNurbsPath *path, const FrNurbsParams *params) {
    uint32_t count = path->count;
    if (count < 2 || count <= path->shared) {
        return 0;
    }
    if (params->join == FR_JOIN_SMOOTH) {
        return path->shared == 3 ? count + 1 : count + 2;
    }
    return MAX(count, 4);
}
