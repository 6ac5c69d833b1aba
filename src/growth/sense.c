// What buds learn in a step before any plant changes. It is the part that can be cancelled: what
// they knew before is kept, and put back.
#include "growth/engine.h"

#include <string.h>

/// What one bud knew.
typedef struct Known {
    vec3s brightest, attraction;
    float light, slope;
    uint8_t is_resting, is_reached;
} Known;

typedef struct Before {
    const FrGrowth *growth;
    Known *buds;      ///< by place in growth->live
    uint8_t *is_dead; ///< by particle
    uint32_t dead_count;
} Before;

static void keep_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Before *before = data;
    for (size_t i = begin; i < end; i++) {
        const FrLiveBud *bud = before->growth->live[i].bud;
        before->buds[i] = (Known){bud->brightest, bud->attraction, bud->light,
                                  bud->slope,     bud->is_resting, bud->is_reached};
    }
}

static Before keep(FrGrowth *growth, uint32_t count, const FrContext *context) {
    enum { GRAIN = 4096 };
    Before before = {.growth = growth};
    before.buds = fr_scratch_take(&growth->known_memory, (count + 1u) * sizeof(Known));
    fr_parallel_for(context->pool, count, GRAIN, keep_range, &before, NULL);
    if (growth->particles != NULL) {
        before.is_dead = g_memdup2(growth->particles->is_dead, growth->particles->count);
        before.dead_count = growth->particles->dead_count;
    }
    return before;
}

static void put_back(FrGrowth *growth, uint32_t count, const Before *before) {
    for (uint32_t i = 0; i < count; i++) {
        FrLiveBud *bud = growth->live[i].bud;
        const Known *known = &before->buds[i];
        bud->brightest = known->brightest;
        bud->attraction = known->attraction;
        bud->light = known->light;
        bud->slope = known->slope;
        bud->is_resting = known->is_resting;
        bud->is_reached = known->is_reached;
    }
    if (before->is_dead != NULL) {
        memcpy(growth->particles->is_dead, before->is_dead, growth->particles->count);
        growth->particles->dead_count = before->dead_count;
    }
}

static FrStatus learn(FrGrowth *growth, uint32_t count, uint32_t growing,
                      const FrContext *context) {
    gint64 begin = g_get_monotonic_time();
    FrStatus status = fr_growth_light(growth, growth->live, count, context);
    growth->light_seconds = (double)(g_get_monotonic_time() - begin) * 1e-6;
    if (status == FR_OK) {
        status = fr_growth_attract(growth, growth->live, growing, context);
    }
    return status == FR_OK ? fr_growth_compete(growth, growth->live, growing, context) : status;
}

FrStatus fr_growth_sense(FrGrowth *growth, const FrContext *context) {
    bool has_colonizers;
    FrStatus status = fr_growth_colonize(growth, context, &has_colonizers);
    if (status != FR_OK) {
        return status;
    }
    FrContext rest = *context;
    if (has_colonizers) {
        rest.progress = NULL; // they have changed
    }
    uint32_t count, growing = fr_growth_gather_live(growth, &count, context);
    Before before = keep(growth, count, context);
    status = learn(growth, count, growing, &rest);
    if (status != FR_OK) {
        put_back(growth, count, &before);
    }
    g_free(before.is_dead);
    return status;
}
