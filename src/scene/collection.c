/// Collections: many instances of a varied plant side by side.
#include "scene/grow.h"
#include "scene/rational.h"
#include "scene/varied.h"

#include <math.h>

// Free ground between two plants, of the width of the widest.
#define GAP 0.15
enum { LONGEST_ROW = 8 };

static FrScene *empty_scene(const char *name, const FrSceneParams *params, uint64_t seed,
                            GDestroyNotify clear) {
    FrScene *scene = g_new0(FrScene, 1);
    scene->name = g_strdup(name);
    scene->plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    g_array_set_clear_func(scene->plants, clear);
    scene->stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    scene->views = g_ptr_array_new();
    scene->params = params;
    scene->seed = seed;
    return scene;
}

/// How far apart plants have to stand.
static double spacing(FrPlant *const *instances, uint32_t count) {
    double width = 0;
    for (uint32_t i = 0; i < count; i++) {
        vec3s min, max;
        fr_plant_bounds(instances[i], &min, &max);
        if (min.x <= max.x) {
            width = fmax(width, fmax((double)(max.x - min.x), (double)(max.y - min.y)));
        }
    }
    return width > 0 ? (1 + GAP) * width : 1;
}

static void place_all(FrScene *scene, const FrVaried *varied, FrPlant *const *instances,
                      uint32_t count) {
    uint32_t columns = count <= LONGEST_ROW ? count : (uint32_t)ceil(sqrt(1.5 * count));
    uint32_t rows = (count + columns - 1) / columns;
    double step = spacing(instances, count);
    for (uint32_t i = 0; i < count; i++) {
        FrScenePlant plant = fr_varied_counts(varied, instances[i]);
        g_array_append_val(scene->plants, plant);
        FrStand stand = {.plant = i,
                         .at = {step * (i % columns - 0.5 * (columns - 1)),
                                step * (0.5 * (rows - 1) - i / columns), 0},
                         .scale = 1};
        g_array_append_val(scene->stands, stand);
    }
}

static FrStatus make_all(const FrDocument *document, const FrVaried *varied, const char *id,
                         uint64_t seed, uint32_t count, const FrContext *context, FrScene **scene) {
    FrPlant **instances = g_new0(FrPlant *, (gsize)count + 1);
    FrStatus status = fr_vary_collection(varied->plan, seed, count, context, instances);
    if (status == FR_OK) {
        *scene = empty_scene(id, fr_document_scene(document), seed, fr_scene_plant_clear);
        place_all(*scene, varied, instances, count);
    }
    g_free(instances);
    return status;
}

FrStatus fr_scene_collect(const FrDocument *document, const FrPlantDef *definition, int64_t seed,
                          double time, uint32_t count, const FrContext *context, FrScene **scene) {
    *scene = NULL;
    FrStatus status = fr_limit_check(count, context->limits.plants, "plants", "the collection",
                                     definition->span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    FrVaried *varied;
    status = fr_varied_new(document, definition, time, context, &varied);
    if (status == FR_OK) {
        uint64_t first = seed < 0 ? definition->seed : (uint64_t)seed;
        status = make_all(document, varied, definition->id, first, count, context, scene);
        fr_varied_free(varied);
    }
    for (guint i = 0; status == FR_OK && i < (*scene)->plants->len; i++) {
        fr_rational_set(&g_array_index((*scene)->plants, FrScenePlant, i), definition, time);
    }
    return status;
}

FrScene *fr_scene_single(const FrScene *scene, uint32_t plant) {
    FrScene *single = empty_scene(scene->name, scene->params, scene->seed + plant, NULL);
    g_array_append_val(single->plants, g_array_index(scene->plants, FrScenePlant, plant));
    FrStand stand = {.scale = 1};
    g_array_append_val(single->stands, stand);
    return single;
}
