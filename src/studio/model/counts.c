#include "studio/model/counts.h"

#include <math.h>

static void count_clear(gpointer data) {
    StudioCount *count = data;
    g_free(count->plant);
    g_free(count->component);
}

GArray *studio_counts_of(const FrScene *scene) {
    GArray *counts = g_array_new(FALSE, FALSE, sizeof(StudioCount));
    g_array_set_clear_func(counts, count_clear);
    for (guint p = 0; p < scene->plants->len; p++) {
        const FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, p);
        for (guint c = 0; plant->by_component != NULL && c < plant->plant->components->len; c++) {
            const FrComponent *component = &g_array_index(plant->plant->components, FrComponent, c);
            uint64_t instances = plant->by_component[c];
            double each = plant->seconds == NULL ? NAN : plant->seconds[c];
            StudioCount count = {g_strdup(plant->plant->name), g_strdup(component->id), instances,
                                 each * (double)instances};
            g_array_append_val(counts, count);
        }
    }
    return counts;
}
