/// A seed may stand on the ground, on hills, or on whatever else is solid. One that is near nothing
/// grows in the air all the same, and is told.
#include "scene/floating.h"

#include "base/span.h"
#include "growth/obstacles.h"

#include <string.h>

/// What seeds may stand on besides the ground, put into order when one is asked for.
typedef struct Support {
    const FrGrowthSetup *setup;
    const FrContext *context;
    FrDistance *surface; ///< NULL: none, or it takes too much memory
    bool is_tried, is_known;
} Support;

static bool is_solid(const FrGrowthObstacle *obstacle) {
    return !obstacle->is_ground;
}

/// True if nothing solid is so near. What cannot be known is no reason to warn.
static bool is_free(Support *support, const double at[3], double reach) {
    if (!support->is_tried) {
        FrContext silent = *support->context;
        silent.diags = NULL;
        support->is_tried = true;
        support->is_known =
            fr_obstacles_join(support->setup->obstacles, support->setup->obstacle_count, is_solid,
                              "the obstacles", &silent, &support->surface) == FR_OK;
    }
    double outward[3];
    return support->is_known &&
           (support->surface == NULL || fr_distance_at(support->surface, at, outward) > reach);
}

/// How high a seed is above the ground; 0 where there is none.
static double height_of(const FrSeed *seed, const FrScene *scene, const FrHills *hills) {
    double ground = 0;
    bool has_ground = hills != NULL ? fr_hills_height(hills, seed->at[0], seed->at[1], &ground)
                                    : scene->params->ground;
    return has_ground ? seed->at[2] - ground : 0;
}

static bool is_floating(const FrSeed *seed, const FrPlantDef *plant, double height,
                        Support *support) {
    const FrSpeciesParams *params = &plant->species->params;
    return params->climb <= 0 && height > params->step && is_free(support, seed->at, params->step);
}

/// What is told of the seeds of one element.
typedef struct Floating {
    FrSpan span;
    uint32_t seeds, count; ///< that it has placed; that float
    double at[3], height;  ///< of the first of them
} Floating;

static void tell(const Floating *floating, const FrContext *context) {
    if (floating->count > 0) {
        fr_diags_add(context->diags, FR_WARNING, "seed-height", floating->span,
                     "%u of %u seeds stand in the air, the first of them at %g,%g,%g: %.3g m above "
                     "the ground, and on no obstacle",
                     floating->count, floating->seeds, floating->at[0], floating->at[1],
                     floating->at[2], floating->height);
    }
}

void fr_floating_tell(const FrSeed *seeds, uint32_t count, const GPtrArray *definitions,
                      const FrScene *scene, const FrHills *hills, const FrGrowthSetup *setup,
                      const FrContext *context) {
    const vec3s fall = setup->params.gravity;
    if (fall.x != 0 || fall.y != 0 || !(fall.z < 0)) {
        return;
    }
    Support support = {.setup = setup, .context = context};
    Floating floating = {0};
    for (uint32_t i = 0; i < count; i++) {
        const FrSeed *seed = &seeds[i];
        if (floating.seeds == 0 || !fr_span_is_same(seed->span, floating.span)) {
            tell(&floating, context);
            floating = (Floating){.span = seed->span};
        }
        floating.seeds++;
        double height = height_of(seed, scene, hills);
        if (!is_floating(seed, g_ptr_array_index(definitions, seed->species), height, &support)) {
            continue;
        }
        if (floating.count++ == 0) {
            floating.height = height;
            memcpy(floating.at, seed->at, sizeof floating.at);
        }
    }
    tell(&floating, context);
    fr_distance_free(support.surface);
}
