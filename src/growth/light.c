// The light of buds: by views of the sky, by shadow voxels, by another backend, or full.
#include "growth/sky.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

static uint32_t hash_of(vec3s at) {
    uint32_t bits[3];
    memcpy(bits, at.raw, sizeof bits);
    return (uint32_t)fr_mix64(bits[0] + ((uint64_t)bits[1] << 32) +
                              bits[2] * UINT64_C(0x9e3779b97f4a7c15));
}

static void add_shade(FrShades *shades, vec3s at, float side) {
    if (shades->count == shades->capacity) {
        shades->capacity = MAX(1024, shades->capacity * 2);
        shades->x = g_renew(float, shades->x, shades->capacity);
        shades->y = g_renew(float, shades->y, shades->capacity);
        shades->z = g_renew(float, shades->z, shades->capacity);
        shades->side = g_renew(float, shades->side, shades->capacity);
        shades->hash = g_renew(uint32_t, shades->hash, shades->capacity);
    }
    uint32_t i = shades->count++;
    shades->x[i] = at.x;
    shades->y[i] = at.y;
    shades->z[i] = at.z;
    shades->side[i] = side;
    shades->hash[i] = hash_of(at);
}

/// Leafy nodes of all plants.
static void gather_shades(const FrGrowth *growth, FrShades *shades) {
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        float side = sqrtf((float)fr_species_of(growth, plant)->params.foliage);
        for (uint32_t i = 0; side > 0 && i < plant->nodes.count; i++) {
            if (fr_grown_is_leafy(growth, plant, i)) {
                vec3s at = plant->nodes.at[i];
                for (int axis = 0; axis < 3; axis++) {
                    at.raw[axis] = (float)(plant->seed.at[axis] + (double)at.raw[axis]);
                }
                add_shade(shades, at, side);
            }
        }
    }
}

static void look_at_sky(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                        const FrContext *context) {
    FrShades shades = {0};
    gather_shades(growth, &shades);
    FrSky sky = fr_sky_of(growth);
    fr_sky_look(growth, &sky, &shades, buds, count, context);
    g_free(shades.x);
    g_free(shades.y);
    g_free(shades.z);
    g_free(shades.side);
    g_free(shades.hash);
}

static void full_light(const FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        buds[i].bud->light = 1;
        buds[i].bud->brightest = growth->up;
    }
}

FrStatus fr_growth_light(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                         const FrContext *context) {
    switch (growth->params.light) {
    case FR_GROWTH_VIEWS:
        look_at_sky(growth, buds, count, context);
        return FR_OK;
    default:
        full_light(growth, buds, count);
        return FR_OK;
    }
}
