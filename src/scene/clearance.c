/// Free space, asked by plants that know no voxels: distances to surfaces of wood and obstacles.
/// Ways ahead are walked in steps that are as long as nothing is nearer (Hart 1996, Sphere
/// Tracing).
#include "scene/clearance.h"

#include "growth/obstacles.h"
#include "scene/solids.h"

#include <math.h>
#include <string.h>

struct FrClearance {
    FrDistance *still;   ///< obstacles and finished plants; NULL: none
    FrDistance **moving; ///< by plant of the scene, of its stand; NULL: nothing there yet
    uint8_t *is_moving;  ///< by plant of the scene
    uint32_t count;
};

void fr_clearance_free(FrClearance *room) {
    if (room == NULL) {
        return;
    }
    fr_distance_free(room->still);
    for (uint32_t i = 0; i < room->count; i++) {
        fr_distance_free(room->moving[i]);
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
    made->moving = g_new0(FrDistance *, made->count + 1u);
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

FrStatus fr_clearance_update(FrClearance *room, const FrScene *scene, const FrContext *context) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < scene->stands->len && status == FR_OK; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const FrPlant *plant = plant_of(scene, stand);
        if (!room->is_moving[stand->plant]) {
            continue;
        }
        g_clear_pointer(&room->moving[stand->plant], fr_distance_free);
        FrSolids solids = fr_solids_new();
        if (plant != NULL) {
            status = fr_solids_add_wood(&solids, plant, stand, context);
        }
        if (status == FR_OK) {
            status = join(&solids, context, &room->moving[stand->plant]);
        }
        fr_solids_clear(&solids);
    }
    return status;
}

double fr_clearance_around(const FrClearance *room, const double at[3], uint32_t own) {
    double nearest = FR_CLEARANCE_FREE, outward[3];
    if (room->still != NULL) {
        nearest = fmin(nearest, fr_distance_within(room->still, at, nearest, outward));
    }
    for (uint32_t i = 0; i < room->count && nearest > 0; i++) {
        if (i != own && room->moving[i] != NULL) {
            nearest = fmin(nearest, fr_distance_within(room->moving[i], at, nearest, outward));
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
