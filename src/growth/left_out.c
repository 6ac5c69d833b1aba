// Why a seed has no place to stand, told once for each element that has placed such seeds.
#include "base/span.h"
#include "growth/engine.h"

/// True if one seed has no place beside one obstacle, or none if NULL.
static bool is_left_out(const FrSowing *sowing, const FrSeed *seed,
                        const FrGrowthObstacle *obstacle) {
    const FrGrowthSetup some = {.params = sowing->setup->params,
                                .obstacles = obstacle,
                                .obstacle_count = obstacle == NULL ? 0 : 1};
    bool *found = fr_seeds_find_left_out(&some, sowing->origin, sowing->width, sowing->up, seed, 1);
    bool is_found = *found;
    g_free(found);
    return is_found;
}

static char *reason_of_obstacle(const FrSpan *span) {
    if (span->source == NULL) {
        return g_strdup("it is in what stands there already");
    }
    uint32_t line, column;
    fr_source_position(span->source, span->begin, &line, &column);
    return g_strdup_printf("it is in the obstacle of line %u, or too close beside it", line);
}

/// Free with g_free().
static char *reason_of(const FrSowing *sowing, const FrSeed *seed) {
    const FrGrowthSetup *setup = sowing->setup;
    if (!fr_seed_is_in_arena(&setup->params, seed)) {
        return g_strdup("it is outside the arena, `min` to `max` of <growth>");
    }
    if (!fr_seed_can_rise(&setup->params, sowing->up, sowing->width, seed)) {
        return g_strdup_printf("the arena ends right ahead of it, as plants rise against `gravity` "
                               "of <growth>, here towards %g,%g,%g",
                               (double)sowing->up.x + 0.0, (double)sowing->up.y + 0.0,
                               (double)sowing->up.z + 0.0);
    }
    if (is_left_out(sowing, seed, NULL)) {
        return g_strdup("the arena has become larger since growth began, its cells have not");
    }
    for (uint32_t i = 0; i < setup->obstacle_count; i++) {
        const FrGrowthObstacle *obstacle = &setup->obstacles[i];
        if (!obstacle->is_ground && is_left_out(sowing, seed, obstacle)) {
            return reason_of_obstacle(&obstacle->span);
        }
    }
    return g_strdup("obstacles take all the room about it");
}

/// What is told of the seeds of one element.
typedef struct LeftOut {
    FrSpan span;
    uint32_t seeds, count; ///< that it has placed; that have no place
    const FrSeed *first;   ///< of them
} LeftOut;

static void tell(const FrSowing *sowing, const LeftOut *left_out, bool is_all,
                 const FrContext *context) {
    if (left_out->count > 0) {
        const double *at = left_out->first->at;
        char *reason = reason_of(sowing, left_out->first);
        fr_diags_add(context->diags, FR_WARNING, "seed-place", left_out->span,
                     "%u of %u seeds have no place to stand, the first of them at %g,%g,%g: %s%s",
                     left_out->count, left_out->seeds, at[0], at[1], at[2], reason,
                     is_all ? "; nothing grows" : "");
        g_free(reason);
    }
}

void fr_seeds_tell_left_out(const FrSowing *sowing, const FrSeed *seeds, uint32_t count,
                            const bool *has_none, bool is_all, const FrContext *context) {
    LeftOut left_out = {0};
    for (uint32_t i = 0; i < count; i++) {
        if (left_out.seeds == 0 || !fr_span_is_same(seeds[i].span, left_out.span)) {
            tell(sowing, &left_out, is_all, context);
            left_out = (LeftOut){.span = seeds[i].span};
        }
        left_out.seeds++;
        if (has_none[i]) {
            left_out.first = left_out.count++ == 0 ? &seeds[i] : left_out.first;
        }
    }
    tell(sowing, &left_out, is_all, context);
}
