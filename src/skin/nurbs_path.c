// The points of a branch, collected in order.
//
// Where a branch bears another, the last points of the bearing one begin the path of the other:
// both curves then leave the shared points in the same direction, and the branch starts inside its
// parent. Where internodes are long that is far below the fork, so by default the first point is
// taken nearer. A branch that stands aside of its bearer's tip shares the points moved there.
//
// A spline rounds off the corners of its control polygon, by a sixth of its second difference.
// Where that is more than a part of the radius, what the branch bears at the corner would hang in
// the air: there the polygon gets a point on either side.
#include "skin/nurbs.h"

#include <string.h>

// A ring thinner than this, or than this share of the branch, is no ring to a CAD program.
#define THINNEST 2e-5
#define THINNEST_SHARE 0.02
// Radii of the parent from the fork to where a branch begins.
#define NEAREST 2.0

// Part of the radius that the surface may stay away from a corner of its path.
#define AWAY 0.4

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
    if (!isfinite(at[0] + at[1] + at[2])) {
        return;
    }
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
                       const double origin[3], double radius, FrNurbsJoin join) {
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
    double squared = fr_dot3(way, way);
    if (!(squared > 1e-12)) {
        return;
    }
    // A branch that begins further down shares only as much of the internode as is below it.
    double along = fr_dot3(aside, way) / squared, part = fmin(fmax(1.0 + along, 0.1), 1.0);
    double flatness = (double)nodes->flatness[bearer], first[3], second[3];
    bool is_near = join == FR_JOIN_NEAR;
    if (is_near) {
        double near = NEAREST * fmax((double)nodes->radius[bearer], radius);
        part = fmin(part, near / sqrt(squared));
    }
    for (int k = 0; k < 3; k++) {
        // Near a fork the first point is in the middle of the wood, whatever is beside it.
        double from = is_near ? tip[k] + along * way[k] : origin[k];
        first[k] = from - part * (tip[k] - before[k]);
        second[k] = from - part * way[k];
    }
    if (join == FR_JOIN_SMOOTH) {
        fr_nurbs_path_add(path, first, radius, flatness, bearer);
    }
    fr_nurbs_path_add(path, second, radius, flatness, bearer);
}

// A branch that goes on where its bearer ends begins there, without a step, in its direction.
static void add_onward(FrNurbsPath *path, const FrPlan *plan, uint32_t bearer, uint32_t node,
                       const double origin[3], double radius) {
    const FrNodes *nodes = &plan->plant->nodes;
    double way[3], at[3], flatness = (double)nodes->flatness[node];
    to_double(fr_frame_heading(nodes->frame[bearer]), way);
    double step = fmin(radius, (double)nodes->length[node] / 3.0);
    for (int k = 0; k < 3; k++) {
        at[k] = origin[k] + step * way[k];
    }
    fr_nurbs_path_add(path, origin, radius, flatness, bearer);
    fr_nurbs_path_add(path, at, radius, flatness, node);
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

/// How far from a corner the points beside it must be, 0 for none.
static double corner_room(const FrNurbsStation *before, const FrNurbsStation *corner,
                          const FrNurbsStation *after) {
    double in[3], out[3], second[3], turn[3];
    for (int k = 0; k < 3; k++) {
        in[k] = corner->at[k] - before->at[k];
        out[k] = after->at[k] - corner->at[k];
        second[k] = out[k] - in[k];
    }
    double wanted = AWAY * corner->radius * fmin(corner->flatness, 1.0);
    double lengths[2] = {fr_unit3(in), fr_unit3(out)};
    for (int k = 0; k < 3; k++) {
        turn[k] = out[k] - in[k];
    }
    double turned = sqrt(fr_dot3(turn, turn));
    // Lengths that differ are no bend.
    double rounded =
        fmin(sqrt(fr_dot3(second, second)), turned * fmax(lengths[0], lengths[1])) / 6.0;
    return turned > 0.02 && rounded > wanted ? 6.0 * wanted / turned : 0.0;
}

static FrNurbsStation between(const FrNurbsStation *corner, const FrNurbsStation *other,
                              double room, uint32_t node) {
    double way[3];
    for (int k = 0; k < 3; k++) {
        way[k] = other->at[k] - corner->at[k];
    }
    double part = fmin(room / fmax(sqrt(fr_dot3(way, way)), 1e-12), 0.4);
    FrNurbsStation station = *corner;
    for (int k = 0; k < 3; k++) {
        station.at[k] += part * way[k];
    }
    station.radius += part * (other->radius - corner->radius);
    station.flatness += part * (other->flatness - corner->flatness);
    station.node = node;
    return station;
}

/// Gives corners their points, from the last to the first.
static void keep_corners(FrNurbsPath *path) {
    uint32_t first = MAX(path->shared, 1), count = path->count, more = 0;
    for (uint32_t i = first; i + 1 < count; i++) {
        const FrNurbsStation *s = &path->stations[i];
        more += corner_room(s - 1, s, s + 1) > 0.0 ? 2 : 0;
    }
    if (more == 0) {
        return;
    }
    for (uint32_t i = 0; i < more; i++) {
        append(path);
    }
    uint32_t to = path->count;
    FrNurbsStation after = path->stations[count - 1];
    path->stations[--to] = after;
    for (uint32_t i = count - 1; i-- > first;) {
        FrNurbsStation corner = path->stations[i], before = path->stations[i - 1];
        double room = corner_room(&before, &corner, &after);
        if (room > 0.0) {
            path->stations[--to] = between(&corner, &after, room, after.node);
            path->stations[--to] = corner;
            path->stations[--to] = between(&corner, &before, room, corner.node);
        } else {
            path->stations[--to] = corner;
        }
        after = corner;
    }
    FR_ASSERT(to == first);
}

void fr_nurbs_path(FrNurbsPath *path, const FrPlan *plan, const FrTube *tube,
                   const FrNurbsParams *params, bool has_fork) {
    const FrPlant *plant = plan->plant;
    const FrNodes *nodes = &plant->nodes;
    path->count = path->shared = 0;
    double at[3], radius = (double)fr_tube_base_radius(plan, tube);
    to_double(fr_tube_origin(plan, tube), at);
    uint32_t bearer = has_fork                         ? FR_NONE
                      : tube->start == FR_START_BRANCH ? plant->axes.bearer[tube->axis]
                      : tube->start == FR_START_JOINT  ? tube->from
                                                       : FR_NONE;
    bool is_smooth = params->join == FR_JOIN_SMOOTH;
    bool goes_on =
        tube->start == FR_START_JOINT || (plant->axes.flags[tube->axis] & FR_CONTINUES) != 0;
    if (bearer != FR_NONE && goes_on && params->join == FR_JOIN_NEAR) {
        add_onward(path, plan, bearer, tube->first, at, radius);
    } else {
        if (bearer != FR_NONE) {
            add_shared(path, plan, bearer, at, radius, (FrNurbsJoin)params->join);
        }
        fr_nurbs_path_add(path, at, radius, (double)nodes->flatness[tube->first], tube->first);
        path->shared = bearer != FR_NONE && path->count == (is_smooth ? 3 : 2) ? path->count : 0;
    }
    for (uint32_t node = tube->first;; node = fr_plan_next(plan, node)) {
        to_double(nodes->position[node], at);
        fr_nurbs_path_add(path, at, (double)nodes->radius[node], (double)nodes->flatness[node],
                          node);
        if (node == tube->last) {
            break;
        }
    }
    thicken(path);
    if (params->corners) {
        keep_corners(path);
    }
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
