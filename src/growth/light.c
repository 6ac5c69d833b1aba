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

typedef struct Gathering {
    FrGrowth *growth;
    FrShades *shades;
} Gathering;

static void count_shades(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrGrowth *growth = ((const Gathering *)data)->growth;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        plant->shade_count = 0;
        bool has_shade = fr_species_of(growth, plant)->params.foliage > 0;
        for (uint32_t i = 0; has_shade && i < plant->nodes.count; i++) {
            plant->shade_count += fr_grown_is_leafy(growth, plant, i);
        }
    }
}

static void put_shades(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const FrGrowth *growth = ((const Gathering *)data)->growth;
    const FrShades *shades = ((const Gathering *)data)->shades;
    for (size_t p = begin; p < end; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        float side = sqrtf((float)fr_species_of(growth, plant)->params.foliage);
        uint32_t next = plant->first_shade;
        for (uint32_t i = 0; plant->shade_count > 0 && i < plant->nodes.count; i++) {
            if (fr_grown_is_leafy(growth, plant, i)) {
                vec3s at = fr_grown_tip(plant, i);
                shades->x[next] = at.x;
                shades->y[next] = at.y;
                shades->z[next] = at.z;
                shades->side[next] = side;
                shades->hash[next++] = hash_of(at);
            }
        }
    }
}

/// Leafy nodes of all plants.
static FrShades gather_shades(FrGrowth *growth, const FrContext *context) {
    FrShades shades = {0};
    Gathering gathering = {growth, &shades};
    fr_parallel_for(context->pool, growth->plant_count, 1, count_shades, &gathering, NULL);
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        growth->plants[p].first_shade = shades.count;
        shades.count += growth->plants[p].shade_count;
    }
    size_t count = shades.count;
    shades.x = fr_scratch_take(&growth->shade_memory, (count + 1) * 5 * sizeof(float));
    shades.y = shades.x + count;
    shades.z = shades.y + count;
    shades.side = shades.z + count;
    shades.hash = (uint32_t *)(void *)(shades.side + count);
    fr_parallel_for(context->pool, growth->plant_count, 1, put_shades, &gathering, NULL);
    return shades;
}

static void look_at_sky(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                        const FrContext *context) {
    FrShades shades = gather_shades(growth, context);
    FrSky sky = fr_sky_of(growth);
    fr_sky_look(growth, &sky, &shades, buds, count, context);
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
