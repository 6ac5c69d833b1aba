/// Varied plants of a document.
#include "scene/varied.h"

#include <string.h>

static const FrPlantDef *find_plant(const FrDocument *document, const char *id) {
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        if (strcmp(plant->id, id) == 0) {
            return plant;
        }
    }
    return NULL;
}

/// Builds the base and copies what was counted of it.
static FrStatus build_base(FrVaried *varied, const FrPlantDef *base, const FrContext *context) {
    FrPgraphCounts counts = {0};
    FrStatus status = fr_pgraph_build(base->pgraph, context, &varied->base, &counts);
    if (status == FR_OK) {
        guint components = varied->base->components->len;
        varied->instances = counts.instances;
        varied->by_component = g_new0(uint64_t, components + 1);
        for (guint i = 0; i < MIN(components, fr_pgraph_count(base->pgraph)); i++) {
            varied->by_component[i] = counts.by_component[i];
        }
    }
    g_free(counts.by_component);
    return status;
}

FrStatus fr_varied_new(const FrDocument *document, const FrPlantDef *definition,
                       const FrContext *context, FrVaried **varied) {
    *varied = NULL;
    FrVaried *made = g_new0(FrVaried, 1);
    const FrPlantDef *base = definition;
    const FrVary *vary = definition->vary;
    if (vary != NULL) {
        base = find_plant(document, fr_vary_params(definition->vary)->base);
        FR_ASSERT(base != NULL && base->kind == FR_PLANT_PGRAPH);
    } else {
        FrVaryParams params;
        fr_params_init(fr_vary_table(), &params);
        vary = made->plain = fr_vary_new(&params);
        fr_params_clear(fr_vary_table(), &params);
    }
    FrStatus status = build_base(made, base, context);
    if (status == FR_OK) {
        status = fr_vary_prepare(vary, made->base, context, &made->plan);
    }
    if (status != FR_OK) {
        fr_varied_free(made);
        return status;
    }
    *varied = made;
    return FR_OK;
}

void fr_varied_free(FrVaried *varied) {
    if (varied != NULL) {
        fr_vary_plan_free(varied->plan);
        fr_vary_free(varied->plain);
        fr_plant_free(varied->base);
        g_free(varied->by_component);
        g_free(varied);
    }
}

FrScenePlant fr_varied_counts(const FrVaried *varied, FrPlant *instance) {
    size_t size = (varied->base->components->len + 1) * sizeof *varied->by_component;
    return (FrScenePlant){instance, varied->instances, g_memdup2(varied->by_component, size)};
}

FrScenePlant fr_varied_instance(const FrVaried *varied, uint64_t seed) {
    return fr_varied_counts(varied, fr_vary_instance(varied->plan, seed));
}
