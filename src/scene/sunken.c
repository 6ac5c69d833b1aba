/// Only the first internode of a plant passes the ground, so a seed must not lie deeper than that
/// is long.
#include "scene/sunken.h"

#include "base/span.h"

#include <math.h>

/// How long a first internode becomes in the dark, chance apart; infinite where nothing collides.
static double reach_of(const FrSpeciesParams *species) {
    double longest = fmin(1 + species->search, species->max_length);
    return species->collide ? species->step * fmax(longest, 1) : INFINITY;
}

static bool is_sunken(const FrSeed *seed, const FrPlantDef *plant, const FrScene *scene,
                      const FrHills *hills) {
    double ground = 0;
    bool has_ground = hills != NULL ? fr_hills_height(hills, seed->at[0], seed->at[1], &ground)
                                    : scene->params->ground;
    return has_ground && ground - seed->at[2] > reach_of(&plant->species->params);
}

/// What is told of the seeds of one element.
typedef struct Sunken {
    FrSpan span;
    uint32_t seeds, count; ///< that it has placed; that are too deep
    const FrSeed *first;   ///< of them
} Sunken;

static void tell(const Sunken *sunken, const FrContext *context) {
    if (sunken->count > 0) {
        const double *at = sunken->first->at;
        fr_diags_add(context->diags, FR_WARNING, "seed-depth", sunken->span,
                     "%u of %u seeds lie deeper below the ground than a first internode is long "
                     "and do not come out of it, the first of them at %g,%g,%g",
                     sunken->count, sunken->seeds, at[0], at[1], at[2]);
    }
}

void fr_sunken_tell(const FrSeed *seeds, uint32_t count, const GPtrArray *definitions,
                    const FrScene *scene, const FrHills *hills, const FrContext *context) {
    Sunken sunken = {0};
    for (uint32_t i = 0; i < count; i++) {
        const FrPlantDef *plant = g_ptr_array_index(definitions, seeds[i].species);
        if (sunken.seeds == 0 || !fr_span_is_same(seeds[i].span, sunken.span)) {
            tell(&sunken, context);
            sunken = (Sunken){.span = seeds[i].span};
        }
        sunken.seeds++;
        if (is_sunken(&seeds[i], plant, scene, hills)) {
            sunken.first = sunken.count++ == 0 ? &seeds[i] : sunken.first;
        }
    }
    tell(&sunken, context);
}
