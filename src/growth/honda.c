// Apices that compete (Honda, Tomlinson, Fisher 1981, Computer Simulation of Branch Interaction and
// Regulation by Unequal Flow Rates in Botanical Trees): an apex rests if another of at least its
// vigour is nearer than a distance, here one that lies ahead of it, so that branches of one fork do
// not stop each other. Equals are told apart by their keys: one of the two goes on.
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

/// A growing apex in its cell.
typedef struct Apex {
    uint64_t cell;
    uint32_t bud; ///< index into the gathered buds
} Apex;

static int compare(const void *a, const void *b) {
    const Apex *one = a, *other = b;
    if (one->cell != other->cell) {
        return one->cell < other->cell ? -1 : 1;
    }
    return one->bud < other->bud ? -1 : one->bud > other->bud;
}

static uint64_t cell_code(const int64_t at[3]) {
    return (((uint64_t)at[0] & 0x1fffff) << 42) | (((uint64_t)at[1] & 0x1fffff) << 21) |
           ((uint64_t)at[2] & 0x1fffff);
}

static void cell_at(vec3s world, double width, int64_t at[3]) {
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = (int64_t)floor((double)world.raw[axis] / width);
    }
}

static bool is_stronger(const FrLiveBud *a, const FrLiveBud *b, bool by_vigour) {
    float one = by_vigour ? a->vigour : a->light, other = by_vigour ? b->vigour : b->light;
    return one != other ? one > other : a->key < b->key;
}

static bool rests_for(const FrLiveBudAt *own, const FrLiveBudAt *other) {
    vec3s towards = glms_vec3_sub(other->world, own->world);
    double distance = (double)glms_vec3_norm(towards);
    bool by_vigour = own->params->fate == FR_FATE_FLUX || own->params->fate == FR_FATE_PRIORITY;
    return own->bud != other->bud && distance <= own->params->apex_distance &&
           glms_vec3_dot(towards, own->bud->direction) > 0 &&
           is_stronger(other->bud, own->bud, by_vigour);
}

/// Looks at the apices of one cell.
static bool cell_stops(const FrLiveBudAt *buds, const Apex *apices, uint32_t count, uint64_t cell,
                       const FrLiveBudAt *own) {
    uint32_t low = 0, high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (apices[middle].cell < cell) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (; low < count && apices[low].cell == cell; low++) {
        if (rests_for(own, &buds[apices[low].bud])) {
            return true;
        }
    }
    return false;
}

static bool is_stopped(const FrLiveBudAt *buds, const Apex *apices, uint32_t count, double width,
                       const FrLiveBudAt *own) {
    int64_t at[3], near[3];
    cell_at(own->world, width, at);
    for (int i = 0; i < 27; i++) {
        near[0] = at[0] + i % 3 - 1;
        near[1] = at[1] + i / 3 % 3 - 1;
        near[2] = at[2] + i / 9 - 1;
        if (cell_stops(buds, apices, count, cell_code(near), own)) {
            return true;
        }
    }
    return false;
}

typedef struct Competing {
    const FrLiveBudAt *buds;
    const Apex *apices;
    uint32_t count;
    double width;
} Competing;

static void compete_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Competing *all = data;
    for (size_t i = begin; i < end; i++) {
        const FrLiveBudAt *own = &all->buds[i];
        own->bud->is_resting = own->params->apex_distance > 0 &&
                               is_stopped(all->buds, all->apices, all->count, all->width, own);
    }
}

FrStatus fr_growth_compete(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                           const FrContext *context) {
    enum { GRAIN = 64 };
    double width = 0;
    for (uint32_t i = 0; i < growth->species_count; i++) {
        width = MAX(width, growth->species[i].params.apex_distance);
    }
    if (width <= 0) {
        return FR_OK;
    }
    Apex *apices = g_new(Apex, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        int64_t at[3];
        cell_at(buds[i].world, width, at);
        apices[i] = (Apex){cell_code(at), i};
    }
    qsort(apices, count, sizeof *apices, compare);
    Competing competing = {buds, apices, count, width};
    fr_parallel_for(context->pool, count, GRAIN, compete_range, &competing, context->progress);
    g_free(apices);
    return fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : FR_OK;
}
