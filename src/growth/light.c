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
                add_shade(shades, fr_grown_tip(plant, i), side);
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

// ---- shadows ----------------------------------------------------------------------------------

/// Voxels over the arena, with the shadow of every internode cast at its base.
static FrStatus make_shadows(FrGrowth *growth, const FrContext *context) {
    const FrGrowthParams *params = &growth->params;
    FrShadowSettings settings = {
        .form = params->shadow_form == FR_SHADOW_MINUS ? FR_SHADOWS_SUBTRACT : FR_SHADOWS_MULTIPLY,
        .a = params->shadow_strength,
        .b = params->shadow_fade,
        .full = 1,
        .depth = (int)params->shadow_depth,
        .spread = 1,
        .cell = params->shadow_cell,
        .jitter = params->shadow_jitter,
        .seed = (uint64_t)params->seed};
    for (int axis = 0; axis < 3; axis++) {
        double low = (double)params->min.raw[axis], high = (double)params->max.raw[axis];
        settings.origin[axis] = low;
        settings.cells[axis] = (int)MIN(ceil((high - low) / settings.cell), 1e6);
    }
    FrStatus status = fr_shadows_new(&settings, context, &growth->shadows);
    if (status != FR_OK) {
        return status;
    }
    GArray *bases = g_array_new(FALSE, FALSE, sizeof(vec3s));
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        for (uint32_t i = 0; i < growth->plants[p].nodes.count; i++) {
            vec3s at = fr_grown_base(&growth->plants[p], i);
            g_array_append_val(bases, at);
        }
    }
    fr_shadows_cast(growth->shadows, (const vec3s *)(void *)bases->data, bases->len, false,
                    context);
    g_array_free(bases, TRUE);
    return FR_OK;
}

void fr_growth_recast(FrGrowth *growth, const FrContext *context) {
    if (growth->shadows == NULL) {
        return;
    }
    for (int worker = 0; worker < growth->scratch_count; worker++) {
        GArray *fallen = growth->fallen[worker];
        fr_shadows_cast(growth->shadows, (const vec3s *)(void *)fallen->data, fallen->len, true,
                        context);
        g_array_set_size(fallen, 0);
    }
    GArray *bases = growth->fallen[0];
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            if (plant->nodes.birth[i] == MIN(growth->step, UINT16_MAX)) {
                vec3s at = fr_grown_base(plant, i);
                g_array_append_val(bases, at);
            }
        }
    }
    fr_shadows_cast(growth->shadows, (const vec3s *)(void *)bases->data, bases->len, false,
                    context);
    g_array_set_size(bases, 0);
}

void fr_growth_look_around(const FrGrowth *growth, const FrGrownPlant *plant, FrLiveBud *bud) {
    if (growth->shadows != NULL) {
        double reach = growth->params.shadow_reach;
        FrShadowSample sample = fr_shadows_at(
            growth->shadows,
            bud->node == FR_NONE ? fr_bud_world(plant, bud) : fr_grown_base(plant, bud->node),
            reach);
        bud->brightest = sample.direction;
        bud->slope = sample.slope * (float)(2 * reach);
    }
}

typedef struct Shading {
    const FrGrowth *growth;
    const FrLiveBudAt *buds;
} Shading;

static void light_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Shading *shading = data;
    const FrGrowth *growth = shading->growth;
    for (size_t i = begin; i < end; i++) {
        const FrLiveBudAt *at = &shading->buds[i];
        at->bud->light = fr_shadows_light(growth->shadows, at->world);
        bool is_lazy = at->params->fate == FR_FATE_FLUX || at->params->fate == FR_FATE_PRIORITY;
        if (!is_lazy && at->bud->state == FR_LIVE_GROWING) {
            FrShadowSample sample =
                fr_shadows_at(growth->shadows, at->world, growth->params.shadow_reach);
            at->bud->brightest = sample.direction;
            at->bud->slope = sample.slope * (float)(2 * growth->params.shadow_reach);
        }
    }
}

static FrStatus look_into_shadows(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                                  const FrContext *context) {
    enum { GRAIN = 1024 };
    if (growth->shadows == NULL) {
        FrStatus status = make_shadows(growth, context);
        if (status != FR_OK) {
            return status;
        }
    }
    fr_shadows_settle(growth->shadows, context);
    Shading shading = {growth, buds};
    fr_parallel_for(context->pool, count, GRAIN, light_range, &shading, context->progress);
    return FR_OK;
}

static void full_light(const FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        buds[i].bud->light = 1;
        buds[i].bud->brightest = growth->up;
        buds[i].bud->slope = 1;
    }
}

static FrStatus light_by(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                         const FrContext *context) {
    if (growth->light != NULL) {
        return fr_growth_ask_light(growth, buds, count, context);
    }
    switch (growth->params.light) {
    case FR_GROWTH_VIEWS:
        look_at_sky(growth, buds, count, context);
        return FR_OK;
    case FR_GROWTH_SHADOWS:
        return look_into_shadows(growth, buds, count, context);
    default:
        full_light(growth, buds, count);
        return FR_OK;
    }
}

FrStatus fr_growth_light(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                         const FrContext *context) {
    FrStatus status = light_by(growth, buds, count, context);
    bool is_cancelled = status == FR_OK && fr_progress_is_cancelled(context->progress);
    return is_cancelled ? FR_CANCELLED : status;
}
