// Where the light of a scene is asked for: on a grid, or at organs and tips.
#include "frond/render.h"

#include <cglm/struct.h>
#include <math.h>

// Radius and longest line of a ball, of the distance between the points of a grid …
#define GRID_RADIUS 0.11F
#define GRID_LINE 0.8F
// … and at organs, of the size of the scene.
#define ORGAN_RADIUS 0.004F
#define ORGAN_LINE 0.03F

static float size_of(const double min[3], const double max[3]) {
    double size = 0;
    for (int c = 0; c < 3; c++) {
        size = fmax(size, max[c] - min[c]);
    }
    return size > 0 ? (float)size : 1;
}

static void place_grid(const FrScene *scene, uint32_t count, FrLightPlaces *places) {
    double min[3], max[3];
    uint32_t cells[3];
    fr_scene_bounds(scene, min, max);
    float spacing = size_of(min, max) / (float)count;
    for (int c = 0; c < 3; c++) {
        double size = fmax(max[c] - min[c], 0);
        cells[c] = (uint32_t)fmax(round(size / (double)spacing), 1);
        min[c] = 0.5 * (min[c] + max[c]) - 0.5 * (cells[c] - 1.0) * (double)spacing;
    }
    for (uint32_t i = 0; min[0] <= max[0] && i < cells[0] * cells[1] * cells[2]; i++) {
        uint32_t step[3] = {i % cells[0], i / cells[0] % cells[1], i / cells[0] / cells[1]};
        vec3s at;
        for (int c = 0; c < 3; c++) {
            at.raw[c] = (float)(min[c] + step[c] * (double)spacing);
        }
        g_array_append_val(places->at, at);
    }
    places->radius = GRID_RADIUS * spacing;
    places->line = GRID_LINE * spacing;
}

static void add_local(const FrStand *stand, vec3s local, GArray *points) {
    vec3s at = glms_vec3_rotate(glms_vec3_scale(local, (float)stand->scale), (float)stand->turn,
                                (vec3s){{0, 0, 1}});
    for (int c = 0; c < 3; c++) {
        at.raw[c] = (float)((double)at.raw[c] + stand->at[c]);
    }
    g_array_append_val(points, at);
}

static bool is_tip(const FrPlant *plant, uint32_t node) {
    uint32_t axis = plant->nodes.axis[node];
    return node + 1 >= plant->nodes.count || plant->nodes.axis[node + 1] != axis ||
           plant->nodes.parent[node + 1] != node;
}

static void place_at_organs(const FrScene *scene, FrLightPlaces *places) {
    double min[3], max[3];
    fr_scene_bounds(scene, min, max);
    for (guint s = 0; s < fr_scene_stand_count(scene); s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        for (uint32_t i = 0; i < plant->organs.count; i++) {
            vec3s at;
            versors rotation;
            if ((plant->organs.flags[i] & (FR_SHED | FR_HIDDEN)) == 0) {
                fr_plant_organ_pose(plant, i, &at, &rotation);
                add_local(stand, at, places->at);
            }
        }
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            if (is_tip(plant, i) && (plant->nodes.flags[i] & (FR_SHED | FR_HIDDEN)) == 0) {
                add_local(stand, plant->nodes.position[i], places->at);
            }
        }
    }
    places->radius = ORGAN_RADIUS * size_of(min, max);
    places->line = ORGAN_LINE * size_of(min, max);
}

/// Refuses more than memory is allowed for, before it is taken.
static FrStatus count_organs(const FrScene *scene, const FrContext *context) {
    uint64_t count = 0;
    for (guint s = 0; s < scene->stands->len; s++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, s);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        count = fr_count_add(count, (uint64_t)plant->organs.count + plant->nodes.count);
    }
    return fr_limit_check(fr_count_multiply(count, sizeof(vec3s) + sizeof(FrLightAnswer)),
                          context->limits.bytes, "bytes", "the picture of light", (FrSpan){0},
                          context->diags);
}

FrStatus fr_light_places(const FrScene *scene, FrLightAt where, uint32_t count,
                         const FrContext *context, FrLightPlaces *places) {
    *places = (FrLightPlaces){0};
    FR_ASSERT(count >= 1 && count <= 128);
    FrStatus status = where == FR_LIGHT_AT_ORGANS ? count_organs(scene, context) : FR_OK;
    if (status == FR_OK) {
        places->at = g_array_new(FALSE, FALSE, sizeof(vec3s));
        if (where == FR_LIGHT_AT_GRID) {
            place_grid(scene, count, places);
        } else {
            place_at_organs(scene, places);
        }
    }
    return status;
}
