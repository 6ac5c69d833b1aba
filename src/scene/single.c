/// A scene of one plant that no document describes.
#include "frond/scene.h"

static void clear_plant(void *data) {
    FrScenePlant *plant = data;
    fr_plant_free(plant->plant);
    g_free(plant->by_component);
}

FrScene *fr_scene_of_plant(FrPlant *plant, uint64_t instances, const FrDocument *document,
                           uint64_t seed) {
    FrScene *scene = g_new0(FrScene, 1);
    FrScenePlant made = {plant, instances, g_new0(uint64_t, plant->components->len + 1)};
    for (uint32_t i = 0; i < plant->axes.count; i++) {
        if (plant->axes.component[i] < plant->components->len) {
            made.by_component[plant->axes.component[i]]++;
        }
    }
    FrStand stand = {.scale = 1};
    scene->name = g_strdup(plant->name);
    scene->plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    g_array_set_clear_func(scene->plants, clear_plant);
    g_array_append_val(scene->plants, made);
    scene->stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    g_array_append_val(scene->stands, stand);
    scene->views = g_ptr_array_new();
    scene->params = fr_document_scene(document);
    scene->seed = seed;
    return scene;
}
