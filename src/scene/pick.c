#include "frond/pick.h"

#include "scene/pick_solid.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

// A ray in the coordinates of a plant, whose unit is `scale` metres.
typedef struct Ray {
    double origin[3], direction[3];
    double spread;
} Ray;

// How a stand turns and scales is undone.
static Ray within(const FrStand *stand, const double origin[3], const double direction[3],
                  double spread) {
    double c = cos(stand->turn), s = sin(stand->turn);
    double from[3];
    for (int i = 0; i < 3; i++) {
        from[i] = (origin[i] - stand->at[i]) / stand->scale;
    }
    return (Ray){
        .origin = {c * from[0] + s * from[1], -s * from[0] + c * from[1], from[2]},
        .direction = {c * direction[0] + s * direction[1], -s * direction[0] + c * direction[1],
                      direction[2]},
        .spread = spread,
    };
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Along the ray where it comes nearest to a segment, if that is within the segment's thickness
// there or the ray's own; else infinity. The closest points of two lines (Ericson 2005, 5.1.9).
static double meet(const Ray *ray, vec3s from, vec3s to, double from_radius, double to_radius) {
    double along[3] = {to.x - from.x, to.y - from.y, to.z - from.z};
    double away[3] = {ray->origin[0] - from.x, ray->origin[1] - from.y, ray->origin[2] - from.z};
    double a = dot(along, along), b = dot(ray->direction, along);
    double c = dot(ray->direction, away), f = dot(along, away);
    double bend = a - b * b;
    double t = bend > 1e-12 * a ? (b * f - c * a) / bend : -c;
    double s = a > 0 ? (b * t + f) / a : 0;
    s = s < 0 ? 0 : s > 1 ? 1 : s;
    t = b * s - c;
    if (t <= 0) {
        return INFINITY;
    }
    double squared = 0;
    for (int i = 0; i < 3; i++) {
        double gap = away[i] + t * ray->direction[i] - s * along[i];
        squared += gap * gap;
    }
    double reach = fmax(from_radius + s * (to_radius - from_radius), t * ray->spread);
    return squared <= reach * reach ? t : INFINITY;
}

static bool is_gone(uint16_t flags) {
    return (flags & (FR_SHED | FR_HIDDEN)) != 0;
}

static void meet_axes(const FrPlant *plant, const Ray *ray, double scale, FrPick *best) {
    const FrNodes *nodes = &plant->nodes;
    const FrAxes *axes = &plant->axes;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t axis = nodes->axis[i];
        if (is_gone((uint16_t)(nodes->flags[i] | axes->flags[axis]))) {
            continue;
        }
        bool is_first = axes->first[axis] == i;
        uint32_t parent = nodes->parent[i];
        vec3s from = is_first ? fr_plant_axis_origin(plant, axis) : nodes->position[parent];
        double radius = is_first ? axes->base_radius[axis] : nodes->radius[parent];
        double t = meet(ray, from, nodes->position[i], radius, nodes->radius[i]) * scale;
        if (t < best->distance) {
            best->distance = t;
            best->node = i;
            best->organ = FR_NONE;
            best->component = axes->component[axis];
            best->path = axes->path[axis];
        }
    }
}

// The middle of a shape at scale 1 along its z axis, and how far it reaches from there.
static void extent_of(const FrShape *shape, double *middle, double *reach) {
    if (shape->kind == FR_SHAPE_BLADE) {
        const FrBlade *blade = &shape->blade;
        *middle = blade->petiole_length + 0.5 * blade->length;
        *reach = 0.35 * fmin(blade->length, 2.5 * blade->width);
    } else {
        *middle = 0.5 * shape->size.z;
        *reach = 0.5 * fmax(shape->size.x, fmax(shape->size.y, shape->size.z));
    }
}

static void meet_organs(const FrPlant *plant, const Ray *ray, double scale, FrPick *best) {
    const FrOrgans *organs = &plant->organs;
    for (uint32_t i = 0; i < organs->count; i++) {
        if (organs->shape[i] >= plant->shapes->len || is_gone(organs->flags[i])) {
            continue;
        }
        vec3s at;
        versors turn;
        double middle, reach;
        extent_of(&g_array_index(plant->shapes, FrShape, organs->shape[i]), &middle, &reach);
        fr_plant_organ_pose(plant, i, &at, &turn);
        vec3s up = glms_quat_rotatev(turn, (vec3s){{0, 0, 1}});
        vec3s centre = glms_vec3_add(at, glms_vec3_scale(up, organs->scale[i] * (float)middle));
        reach *= organs->scale[i];
        double t = meet(ray, centre, centre, reach, reach) * scale;
        if (t < best->distance) {
            best->distance = t;
            best->node = FR_NONE;
            best->organ = i;
            best->component = organs->component[i];
            best->path = organs->path[i];
        }
    }
}

static void meet_solids(const FrPlant *plant, const Ray *ray, FrPick *best) {
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        double t = fr_pick_solid(plant, i, ray->origin, ray->direction);
        if (t < best->distance) {
            best->distance = t;
            best->node = FR_NONE;
            best->organ = i;
            best->component = FR_NONE;
            best->path = 0;
        }
    }
}

bool fr_scene_pick(const FrScene *scene, const double origin[3], const double direction[3],
                   double spread, FrPick *pick) {
    *pick = (FrPick){.node = FR_NONE, .organ = FR_NONE, .distance = INFINITY};
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        Ray ray = within(stand, origin, direction, spread);
        double before = pick->distance;
        if (i < fr_scene_stand_count(scene)) {
            meet_axes(plant, &ray, stand->scale, pick);
            meet_organs(plant, &ray, stand->scale, pick);
        } else {
            meet_solids(plant, &ray, pick);
        }
        if (pick->distance < before) {
            pick->stand = i;
            pick->plant = stand->plant;
        }
    }
    return isfinite(pick->distance);
}
