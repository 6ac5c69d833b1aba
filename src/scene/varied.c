/// Varied plants of a document.
#include "scene/varied.h"

#include "scene/find.h"

#include <math.h>

FrStatus fr_varied_new(const FrDocument *document, const FrPlantDef *definition, double time,
                       const FrContext *context, FrVaried **varied) {
    *varied = NULL;
    FrVaried *made = g_new0(FrVaried, 1);
    const FrPlantDef *base = definition;
    const FrVary *vary = definition->vary;
    if (vary != NULL) {
        base = fr_scene_find_plant(document, fr_vary_params(definition->vary)->base);
        FR_ASSERT(base != NULL && base->kind != FR_PLANT_VARIED);
    } else {
        FrVaryParams params;
        fr_params_init(fr_vary_table(), &params);
        vary = made->plain = fr_vary_new(&params);
        fr_params_clear(fr_vary_table(), &params);
    }
    FrScenePlant built;
    FrStatus status = fr_scene_grow(document, base, -1, time, context, &built, NULL);
    made->base = built.plant;
    made->instances = built.instances;
    made->by_component = built.by_component;
    made->modules = built.modules;
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
    return (FrScenePlant){instance, varied->instances, g_memdup2(varied->by_component, size),
                          varied->modules};
}

FrScenePlant fr_varied_instance(const FrVaried *varied, uint64_t seed) {
    return fr_varied_counts(varied, fr_vary_instance(varied->plan, seed));
}
