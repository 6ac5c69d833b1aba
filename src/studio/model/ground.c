#include "studio/model/ground.h"

#include <math.h>

enum { MARCH_STEPS = 400, HALVINGS = 24 };

static const double farthest_ground = 1e5; // m

struct StudioGround {
    gatomicrefcount references;
    FrHills *hills;  // NULL: level
    GArray *origins; // uint32_t, by organ of the plant that obstacles and ground are in a scene
};

StudioGround *studio_ground_new(const FrDocument *document, const FrContext *context) {
    StudioGround *ground = g_new0(StudioGround, 1);
    g_atomic_ref_count_init(&ground->references);
    ground->origins = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    const FrSurroundings *around = fr_document_surroundings(document);
    for (guint i = 0; i < around->obstacles->len; i++) {
        const FrObstacle *obstacle = g_ptr_array_index(around->obstacles, i);
        uint32_t pieces = obstacle->mesh == NULL ? 1 : obstacle->mesh->part_count;
        uint32_t origin = fr_span_outermost(obstacle->span).begin;
        for (uint32_t piece = 0; obstacle->visible && piece < pieces; piece++) {
            g_array_append_val(ground->origins, origin);
        }
    }
    FrContext silent = *context; // whoever builds the scene has told what is wrong
    silent.diags = NULL;
    if (fr_hills_new(around->terrain, &silent, &ground->hills) != FR_OK) {
        ground->hills = NULL;
    }
    return ground;
}

StudioGround *studio_ground_ref(StudioGround *ground) {
    if (ground != NULL) {
        g_atomic_ref_count_inc(&ground->references);
    }
    return ground;
}

void studio_ground_unref(StudioGround *ground) {
    if (ground != NULL && g_atomic_ref_count_dec(&ground->references)) {
        fr_hills_free(ground->hills);
        g_array_unref(ground->origins);
        g_free(ground);
    }
}

double studio_ground_height(const StudioGround *ground, double x, double y) {
    double height;
    return ground != NULL && ground->hills != NULL && fr_hills_height(ground->hills, x, y, &height)
               ? height
               : 0;
}

// How high a point of a ray is above the ground.
static double above(const StudioGround *ground, const double origin[3], const double direction[3],
                    double t) {
    double x = origin[0] + t * direction[0], y = origin[1] + t * direction[1];
    return origin[2] + t * direction[2] - studio_ground_height(ground, x, y);
}

bool studio_ground_meet(const StudioGround *ground, const double origin[3],
                        const double direction[3], double farthest, double at[3]) {
    double level = direction[2] != 0 ? -origin[2] / direction[2] : INFINITY;
    double t = level > 0 && level <= farthest ? level : INFINITY;
    if (ground != NULL && ground->hills != NULL) {
        // Far steps are long: what is far away is small.
        double before = 0, step = fmin(farthest, 1000) / MARCH_STEPS;
        t = INFINITY;
        for (int i = 0; i < MARCH_STEPS; i++) {
            double after = before + step * (0.05 + 1.9 * i / MARCH_STEPS);
            if (above(ground, origin, direction, before) >= 0 &&
                above(ground, origin, direction, after) < 0) {
                double low = before, high = after;
                for (int k = 0; k < HALVINGS; k++) {
                    double middle = 0.5 * (low + high);
                    bool is_above = above(ground, origin, direction, middle) >= 0;
                    low = is_above ? middle : low;
                    high = is_above ? high : middle;
                }
                t = high;
                break;
            }
            before = after;
        }
    }
    for (int k = 0; k < 3; k++) {
        at[k] = isfinite(t) ? origin[k] + t * direction[k] : 0;
    }
    return isfinite(t);
}

static double distance_to(const double origin[3], const double at[3]) {
    return sqrt((at[0] - origin[0]) * (at[0] - origin[0]) +
                (at[1] - origin[1]) * (at[1] - origin[1]) +
                (at[2] - origin[2]) * (at[2] - origin[2]));
}

static void follow_pick(const StudioGround *ground, const FrScene *scene, const FrPick *pick,
                        StudioHit *hit) {
    const FrStand *stand = &g_array_index(scene->stands, FrStand, pick->stand);
    if (pick->stand < fr_scene_stand_count(scene)) {
        hit->kind = STUDIO_HIT_PLANT;
        hit->origin = stand->origin;
        hit->number = stand->number;
        for (int k = 0; k < 3; k++) {
            hit->foot[k] = stand->at[k];
        }
    } else if (ground != NULL && pick->organ < ground->origins->len) {
        hit->kind = STUDIO_HIT_OBSTACLE;
        hit->origin = g_array_index(ground->origins, uint32_t, pick->organ);
    } else {
        hit->kind = STUDIO_HIT_GROUND;
    }
}

StudioHit studio_ground_hit(const StudioGround *ground, const FrScene *scene,
                            const double origin[3], const double direction[3], double spread) {
    StudioHit hit = {.kind = STUDIO_HIT_NOTHING};
    double nearest = INFINITY;
    if (studio_ground_meet(ground, origin, direction, farthest_ground, hit.at)) {
        hit.kind = STUDIO_HIT_GROUND;
        nearest = distance_to(origin, hit.at);
    }
    for (int k = 0; k < 3; k++) {
        hit.foot[k] = hit.at[k];
    }
    FrPick pick;
    if (scene == NULL || !fr_scene_pick(scene, origin, direction, spread, &pick) ||
        pick.distance >= nearest) {
        return hit;
    }
    for (int k = 0; k < 3; k++) {
        hit.at[k] = hit.foot[k] = origin[k] + pick.distance * direction[k];
    }
    follow_pick(ground, scene, &pick, &hit);
    return hit;
}

static void grow_box(const FrScene *scene, const FrStand *stand, double min[3], double max[3]) {
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
    double c = cos(stand->turn), s = sin(stand->turn);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        const float *at = plant->nodes.position[i].raw;
        const double local[3] = {c * (double)at[0] - s * (double)at[1],
                                 s * (double)at[0] + c * (double)at[1], (double)at[2]};
        for (int k = 0; k < 3; k++) {
            double point = stand->at[k] + stand->scale * local[k];
            min[k] = fmin(min[k], point);
            max[k] = fmax(max[k], point);
        }
    }
}

double studio_ground_reach(double distance, const double min[3], const double max[3]) {
    bool is_empty = max[0] < min[0];
    return 2 * (distance + (is_empty ? 0 : hypot(max[0] - min[0], max[1] - min[1])));
}

bool studio_ground_bounds(const FrScene *scene, uint32_t origin, double min[3], double max[3]) {
    for (int k = 0; k < 3; k++) {
        min[k] = INFINITY;
        max[k] = -INFINITY;
    }
    for (uint32_t i = 0; scene != NULL && i < fr_scene_stand_count(scene); i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        if (stand->origin == origin) {
            grow_box(scene, stand, min, max);
        }
    }
    return max[0] >= min[0];
}
