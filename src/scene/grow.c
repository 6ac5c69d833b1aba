/// One plant built by the engine of its definition.
#include "scene/grow.h"

#include "scene/ecosystem.h"
#include "scene/graft.h"

#include <math.h>

uint64_t *fr_scene_count_made(const FrPlant *plant) {
    uint64_t *made = g_new0(uint64_t, plant->components->len + 1);
    for (uint32_t node = 0; node < plant->nodes.count; node++) {
        made[plant->axes.component[plant->nodes.axis[node]]]++;
    }
    for (uint32_t organ = 0; organ < plant->organs.count; organ++) {
        made[plant->organs.component[organ]]++;
    }
    return made;
}

static FrStatus grow_lsystem(const FrPlantDef *definition, int64_t seed, const FrContext *context,
                             FrScenePlant *made) {
    FrLsettings settings = fr_lmodel_settings(definition->lsystem);
    settings.seed = seed >= 0 ? seed : definition->has_seed ? (int64_t)definition->seed : -1;
    FrStatus status = fr_lmodel_grow(definition->lsystem, &settings, context, &made->plant,
                                     &made->modules, &made->drawn);
    if (status == FR_OK) {
        g_free(made->plant->name);
        made->plant->name = g_strdup(definition->id);
        made->by_component = fr_scene_count_made(made->plant);
    }
    return status;
}

static FrStatus grow_pgraph(const FrDocument *document, const FrPlantDef *definition, int64_t seed,
                            double time, const FrLightField *light, const FrContext *context,
                            FrScenePlant *made, FrPgraphCounts *counts) {
    uint64_t own_seed = seed < 0 ? definition->seed : (uint64_t)seed;
    FrPgraph *reseeded = own_seed == definition->seed && isnan(time)
                             ? NULL
                             : fr_document_reseed(document, definition, own_seed, time);
    const FrPgraph *graph = reseeded == NULL ? definition->pgraph : reseeded;
    FrGrafter grafter;
    FrStatus status = fr_grafter_init(&grafter, document, graph, time, context);
    if (status == FR_OK) {
        FrGraft graft = fr_grafter_graft(&grafter, light);
        status = fr_pgraph_build_grafted(graph, &graft, context, &made->plant, counts);
    }
    fr_grafter_clear(&grafter);
    if (status == FR_OK) {
        guint components = made->plant->components->len;
        made->instances = counts->instances;
        made->by_component = g_new0(uint64_t, components + 1);
        for (guint i = 0; i < MIN(components, fr_pgraph_count(graph)); i++) {
            made->by_component[i] = counts->by_component[i];
        }
    }
    fr_pgraph_free(reseeded);
    return status;
}

/// A skeleton, or a tree of forks.
static FrStatus grow_lines(const FrPlantDef *definition, int64_t seed, const FrContext *context,
                           FrScenePlant *made) {
    uint64_t own_seed = seed < 0 ? definition->seed : (uint64_t)seed;
    FrStatus status =
        definition->kind == FR_PLANT_SKELETON
            ? fr_skeleton_grow(definition->skeleton, definition->id, context, &made->plant)
            : fr_ramified_grow(definition->ramified, definition->id, own_seed, context,
                               &made->plant);
    if (status == FR_OK) {
        made->by_component = g_new0(uint64_t, made->plant->components->len + 1);
    }
    return status;
}

/// As it grows where nothing else stands.
static FrStatus grow_species(const FrDocument *document, const FrPlantDef *definition, int64_t seed,
                             const FrContext *context, FrScenePlant *made) {
    uint64_t own_seed = seed < 0 ? definition->seed : (uint64_t)seed;
    FrStatus status =
        fr_ecosystem_grow_alone(document, definition, own_seed, context, &made->plant);
    if (status == FR_OK) {
        made->by_component = fr_scene_count_made(made->plant);
    }
    return status;
}

FrStatus fr_scene_grow(const FrDocument *document, const FrPlantDef *definition, int64_t seed,
                       double time, const FrContext *context, FrScenePlant *plant,
                       FrPgraphCounts *counts) {
    return fr_scene_grow_in_light(document, definition, seed, time, NULL, context, plant, counts);
}

FrStatus fr_scene_grow_in_light(const FrDocument *document, const FrPlantDef *definition,
                                int64_t seed, double time, const FrLightField *light,
                                const FrContext *context, FrScenePlant *plant,
                                FrPgraphCounts *counts) {
    FR_ASSERT(definition->kind != FR_PLANT_VARIED);
    *plant = (FrScenePlant){0};
    if (counts != NULL && definition->kind != FR_PLANT_PGRAPH) {
        *counts = (FrPgraphCounts){0};
    }
    if (definition->kind == FR_PLANT_LSYSTEM) {
        return grow_lsystem(definition, seed, context, plant);
    }
    if (definition->kind == FR_PLANT_SKELETON || definition->kind == FR_PLANT_RAMIFIED) {
        return grow_lines(definition, seed, context, plant);
    }
    if (definition->kind == FR_PLANT_SPECIES) {
        return grow_species(document, definition, seed, context, plant);
    }
    FrPgraphCounts own = {0};
    FrStatus status = grow_pgraph(document, definition, seed, time, light, context, plant,
                                  counts == NULL ? &own : counts);
    fr_pgraph_counts_clear(&own);
    return status;
}
