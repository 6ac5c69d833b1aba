/// Free space, asked by plants that know no voxels: distances to wood and obstacles. What grows is
/// new in every step, so its internodes are taken as they are, round, and not as surfaces. Ways
/// ahead are walked in steps that are as long as nothing is nearer (Hart 1996, Sphere Tracing).
#include "scene/clearance.h"

#include "growth/obstacles.h"
#include "scene/solids.h"

#include <math.h>
#include <string.h>

struct FrClearance {
    FrDistance *still;  ///< obstacles and finished plants; NULL: none
    FrStems **moving;   ///< by plant of the scene, of its stand; NULL: nothing there yet
    uint8_t *is_moving; ///< by plant of the scene
    uint32_t count;
};

void fr_clearance_free(FrClearance *room) {
    if (room == NULL) {
        return;
    }
    fr_distance_free(room->still);
    for (uint32_t i = 0; i < room->count; i++) {
        fr_stems_free(room->moving[i]);
    }
    g_free(room->moving);
    g_free(room->is_moving);
    g_free(room);
}

/// The ground leaves room.
static bool takes_room(const FrGrowthObstacle *solid) {
    return !solid->is_ground;
}

/// The surfaces of all solids as one; NULL without any.
static FrStatus join(const FrSolids *solids, const FrContext *context, FrDistance **joined) {
    return fr_obstacles_join((const FrGrowthObstacle *)(const void *)solids->all->data,
                             solids->all->len, takes_room, "the room of plants", context, joined);
}

static const FrPlant *plant_of(const FrScene *scene, const FrStand *stand) {
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
    return plant == NULL || plant->nodes.count == 0 ? NULL : plant;
}

/// What moves alone is asked for by nobody, as no plant is in its own way.
static void forget_single(FrClearance *room) {
    uint32_t moving = 0;
    for (uint32_t i = 0; i < room->count; i++) {
        moving += room->is_moving[i];
    }
    if (moving == 1) {
        memset(room->is_moving, 0, room->count);
    }
}

FrStatus fr_clearance_new(const FrScene *scene, const uint8_t *is_moving, const FrContext *context,
                          FrClearance **room) {
    FrClearance *made = g_new0(FrClearance, 1);
    made->count = scene->plants->len;
    made->moving = g_new0(FrStems *, made->count + 1u);
    made->is_moving = g_memdup2(is_moving, made->count + 1u);
    forget_single(made);
    FrSolids solids = fr_solids_new();
    const vec3s nowhere[2] = {0};
    FrStatus status = fr_solids_add_surroundings(&solids, scene, NULL, nowhere, context);
    for (guint i = 0; i < fr_scene_stand_count(scene) && status == FR_OK; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const FrPlant *plant = plant_of(scene, stand);
        if (plant != NULL && !is_moving[stand->plant]) {
            status = fr_solids_add_wood(&solids, plant, stand, context);
        }
    }
    if (status == FR_OK) {
        status = join(&solids, context, &made->still);
    }
    fr_solids_clear(&solids);
    if (status != FR_OK) {
        fr_clearance_free(made);
        made = NULL;
    }
    *room = made;
    return status;
}

// ---- plants that move -------------------------------------------------------------------------

static void stand_point(const FrStand *stand, vec3s at, double world[3]) {
    double sine = sin(stand->turn), cosine = cos(stand->turn);
    double x = (double)at.x * stand->scale, y = (double)at.y * stand->scale;
    world[0] = stand->at[0] + cosine * x - sine * y;
    world[1] = stand->at[1] + sine * x + cosine * y;
    world[2] = stand->at[2] + (double)at.z * stand->scale;
}

uint32_t fr_clearance_stems(const FrPlant *plant, const FrStand *stand, FrStem *stems) {
    const uint16_t unseen = FR_SHED | FR_HIDDEN;
    const FrNodes *nodes = &plant->nodes;
    uint32_t count = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t axis = nodes->axis[i], parent = nodes->parent[i];
        if (((nodes->flags[i] | plant->axes.flags[axis]) & unseen) != 0 || nodes->length[i] <= 0) {
            continue;
        }
        bool is_first = plant->axes.first[axis] == i;
        vec3s base = is_first ? fr_plant_axis_origin(plant, axis) : nodes->position[parent];
        float radius = is_first ? plant->axes.base_radius[axis] : nodes->radius[parent];
        FrStem *stem = &stems[count++];
        stand_point(stand, base, stem->from);
        stand_point(stand, nodes->position[i], stem->to);
        stem->radius[0] = (double)radius * stand->scale;
        stem->radius[1] = (double)nodes->radius[i] * stand->scale;
    }
    return count;
}

FrStatus fr_clearance_update(FrClearance *room, const FrScene *scene, const FrContext *context) {
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const FrPlant *plant = plant_of(scene, stand);
        if (!room->is_moving[stand->plant]) {
            continue;
        }
        g_clear_pointer(&room->moving[stand->plant], fr_stems_free);
        uint64_t count = plant == NULL ? 0 : plant->nodes.count;
        FrStatus status = fr_limit_check(
            fr_count_add(fr_stems_bytes(count), fr_count_multiply(count, sizeof(FrStem))),
            context->limits.bytes, "bytes", "the room of plants", (FrSpan){0}, context->diags);
        if (status != FR_OK) {
            return status;
        }
        FrStem *stems = g_new(FrStem, count + 1);
        uint32_t seen = plant == NULL ? 0 : fr_clearance_stems(plant, stand, stems);
        room->moving[stand->plant] = fr_stems_new(stems, seen);
        g_free(stems);
    }
    return FR_OK;
}

// ---- asking -----------------------------------------------------------------------------------

double fr_clearance_around(const FrClearance *room, const double at[3], uint32_t own) {
    double nearest = FR_CLEARANCE_FREE, outward[3];
    if (room->still != NULL) {
        nearest = fmin(nearest, fr_distance_within(room->still, at, nearest, outward));
    }
    for (uint32_t i = 0; i < room->count && nearest > 0; i++) {
        if (i != own) {
            nearest = fmin(nearest, fr_stems_near(room->moving[i], at, nearest, 0).distance);
        }
    }
    return fmax(nearest, 0);
}

double fr_clearance_ahead(const FrClearance *room, const double at[3], const double along[3],
                          uint32_t own) {
    enum { MOST_STEPS = 256 };
    const double touching = 0.001;
    double way = 0;
    for (int step = 0; step < MOST_STEPS && way < FR_CLEARANCE_FREE; step++) {
        double there[3];
        for (int axis = 0; axis < 3; axis++) {
            there[axis] = at[axis] + way * along[axis];
        }
        double around = fr_clearance_around(room, there, own);
        if (around < touching) {
            return way;
        }
        way += around;
    }
    return fmin(way, FR_CLEARANCE_FREE);
}
