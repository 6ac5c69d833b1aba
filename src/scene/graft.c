/// Grafts: a plant of the document for each instance, of any engine. Bases of variations are built
/// beforehand, because many threads ask for grafts at once.
#include "scene/graft.h"

#include "scene/ecosystem.h"
#include "scene/find.h"
#include "scene/varied.h"

static void varied_free(void *varied) {
    fr_varied_free(varied);
}

static FrStatus prepare(FrGrafter *grafter, const FrPgraph *graph, const FrContext *context);

static FrStatus prepare_plant(FrGrafter *grafter, const FrPlantDef *definition,
                              const FrContext *context) {
    if (g_hash_table_contains(grafter->varied, definition)) {
        return FR_OK;
    }
    FrVaried *varied = NULL;
    FrStatus status =
        definition->kind == FR_PLANT_PGRAPH ? prepare(grafter, definition->pgraph, context)
        : definition->kind == FR_PLANT_VARIED
            ? fr_varied_new(grafter->document, definition, grafter->time, context, &varied)
            : FR_OK;
    if (status == FR_OK) {
        g_hash_table_insert(grafter->varied, (void *)definition, varied);
    }
    return status;
}

static FrStatus prepare(FrGrafter *grafter, const FrPgraph *graph, const FrContext *context) {
    FrStatus status = FR_OK;
    for (uint32_t c = 0; c < fr_pgraph_count(graph) && status == FR_OK; c++) {
        if (fr_pgraph_kind(graph, c) == FR_COMPONENT_GRAFT) {
            const char *plant = fr_pgraph_grafted(graph, c);
            status = prepare_plant(grafter, fr_scene_find_plant(grafter->document, plant), context);
        }
    }
    return status;
}

FrStatus fr_grafter_init(FrGrafter *grafter, const FrDocument *document, const FrPgraph *graph,
                         double time, const FrContext *context) {
    *grafter = (FrGrafter){document, time, g_hash_table_new_full(NULL, NULL, NULL, varied_free)};
    return prepare(grafter, graph, context);
}

void fr_grafter_clear(FrGrafter *grafter) {
    g_hash_table_unref(grafter->varied);
}

// ---- growing ----------------------------------------------------------------------------------

static FrStatus grow_lsystem(const FrLmodel *model, const FrGraftWish *wish,
                             const FrContext *context, FrPlant **plant) {
    double *values = g_new(double, fr_lmodel_value_count(model) + 1);
    fr_lmodel_evaluate(model, wish->key, values);
    for (size_t i = 0; i < wish->count; i++) {
        uint32_t value = fr_lmodel_find_value(model, wish->names[i]);
        FR_ASSERT(value != FR_NONE);
        values[value] = wish->values[i];
    }
    FrLsettings settings = fr_lmodel_settings(model);
    settings.seed = (int64_t)(wish->key & INT64_MAX);
    settings.steps = wish->steps < 0 ? settings.steps : wish->steps;
    settings.values = values;
    settings.sites = wish->symbols;
    settings.inherits = true;
    FrStatus status = fr_lmodel_grow(model, &settings, context, plant, NULL, NULL);
    g_free(values);
    return status;
}

static FrStatus grow(void *data, const FrGraftWish *wish, const FrContext *context,
                     FrPlant **plant);

static FrStatus grow_pgraph(FrGrafter *grafter, const FrPlantDef *definition,
                            const FrGraftWish *wish, const FrContext *context, FrPlant **plant) {
    FrPgraph *graph = fr_document_reseed(grafter->document, definition, wish->key, grafter->time);
    FrGraft nested = {grafter, grow, NULL};
    FrStatus status = fr_pgraph_build_grafted(graph, &nested, context, plant, NULL);
    fr_pgraph_free(graph);
    return status;
}

static FrStatus grow_varied(const FrVaried *varied, const FrPlantDef *definition,
                            const FrGraftWish *wish, const FrContext *context, FrPlant **plant) {
    const FrPlant *base = fr_vary_plan_base(varied->plan);
    FrStatus status = fr_limit_check(base->nodes.count, context->limits.nodes, "nodes",
                                     definition->id, definition->span, context->diags);
    if (status == FR_OK) {
        status = fr_limit_check(base->organs.count, context->limits.organs, "organs",
                                definition->id, definition->span, context->diags);
    }
    if (status == FR_OK) {
        *plant = fr_vary_instance(varied->plan, wish->key);
    }
    return status;
}

static FrStatus grow(void *data, const FrGraftWish *wish, const FrContext *context,
                     FrPlant **plant) {
    FrGrafter *grafter = data;
    const FrPlantDef *definition = fr_scene_find_plant(grafter->document, wish->plant);
    FR_ASSERT(definition != NULL);
    *plant = NULL;
    switch (definition->kind) {
    case FR_PLANT_LSYSTEM:
        return grow_lsystem(definition->lsystem, wish, context, plant);
    case FR_PLANT_SKELETON:
        return fr_skeleton_grow(definition->skeleton, definition->id, context, plant);
    case FR_PLANT_SPECIES:
        return fr_ecosystem_grow_alone(grafter->document, definition, wish->key, context, plant);
    case FR_PLANT_RAMIFIED:
        return fr_ramified_grow(definition->ramified, definition->id, wish->key, context, plant);
    case FR_PLANT_VARIED:
        return grow_varied(g_hash_table_lookup(grafter->varied, definition), definition, wish,
                           context, plant);
    default:
        return grow_pgraph(grafter, definition, wish, context, plant);
    }
}

FrGraft fr_grafter_graft(FrGrafter *grafter, const FrLightField *light) {
    return (FrGraft){grafter, grow, light};
}
