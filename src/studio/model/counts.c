#include "studio/model/counts.h"

#include <math.h>

static void count_clear(gpointer data) {
    StudioCount *count = data;
    g_free(count->plant);
    g_free(count->component);
}

// Leaves are placed for the picture, not skinned one by one: each takes the same.
static void add_leaves(const StudioPlant *shown, double *seconds) {
    const FrPlant *plant = shown->plant;
    double each = shown->leaf_seconds / MAX(plant->organs.count, 1);
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        if (plant->organs.component[i] < plant->components->len) {
            seconds[plant->organs.component[i]] += each;
        }
    }
}

// What a thread takes for the picture of each component. Free with g_free().
static double *skin_seconds(const StudioPlant *shown) {
    double *seconds = g_new0(double, (gsize)shown->plant->components->len + 1);
    if (!shown->is_rational) {
        fr_skin_seconds(shown->wood, shown->plant, seconds);
        add_leaves(shown, seconds);
    }
    return seconds;
}

GArray *studio_counts_of(const StudioView *view) {
    GArray *counts = g_array_new(FALSE, FALSE, sizeof(StudioCount));
    g_array_set_clear_func(counts, count_clear);
    for (guint p = 0; p < view->plants->len; p++) {
        const FrScenePlant *plant = &g_array_index(view->scene->plants, FrScenePlant, p);
        double *skin = skin_seconds(g_ptr_array_index(view->plants, p));
        for (guint c = 0; plant->by_component != NULL && c < plant->plant->components->len; c++) {
            const FrComponent *component = &g_array_index(plant->plant->components, FrComponent, c);
            uint64_t instances = plant->by_component[c];
            double each = plant->seconds == NULL ? NAN : plant->seconds[c];
            double making = instances == 0 ? 0 : each * (double)instances;
            StudioCount count = {g_strdup(plant->plant->name), g_strdup(component->id), instances,
                                 making + skin[c], skin[c]};
            g_array_append_val(counts, count);
        }
        g_free(skin);
    }
    return counts;
}

// ---- plants ------------------------------------------------------------------------------------

static void load_clear(gpointer data) {
    g_free(((StudioPlantLoad *)data)->plant);
}

// What is known of a plant of the document.
typedef struct Sum {
    uint64_t stands, nodes;
    double seconds, skin;
} Sum;

static Sum *sum_of(GHashTable *sums, const char *plant) {
    Sum *sum = g_hash_table_lookup(sums, plant);
    if (sum == NULL) {
        sum = g_new0(Sum, 1);
        g_hash_table_insert(sums, g_strdup(plant), sum);
    }
    return sum;
}

static double growth_seconds(const FrScene *scene) {
    double seconds = 0;
    for (guint i = 0; scene->steps != NULL && i < scene->steps->len; i++) {
        seconds += g_array_index(scene->steps, FrSceneStep, i).seconds;
    }
    return seconds;
}

// By the plants' ids.
static GHashTable *sum_up(const StudioView *view, const GArray *counts) {
    GHashTable *sums = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    const FrScene *scene = view->scene;
    uint64_t *stands = g_new0(uint64_t, (gsize)scene->plants->len + 1);
    for (uint32_t i = 0; i < fr_scene_stand_count(scene); i++) {
        stands[g_array_index(scene->stands, FrStand, i).plant]++;
    }
    for (uint32_t p = 0; p < fr_scene_plant_count(scene); p++) {
        const FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, p);
        Sum *sum = sum_of(sums, plant->plant->name);
        sum->stands += stands[p];
        sum->nodes += plant->plant->nodes.count;
        sum->seconds += plant->by_component == NULL ? (double)NAN : 0;
    }
    g_free(stands);
    for (guint i = 0; i < counts->len; i++) {
        const StudioCount *count = &g_array_index(counts, StudioCount, i);
        Sum *sum = g_hash_table_lookup(sums, count->plant);
        if (sum != NULL) { // else of an obstacle
            sum->seconds += count->seconds;
            sum->skin += count->skin_seconds;
        }
    }
    return sums;
}

static bool grows(const StudioGrower *grower, const char *plant) {
    return grower != NULL && studio_grower_grows(grower, plant);
}

GArray *studio_plant_loads(const StudioView *view, const GArray *counts,
                           const StudioGrower *grower) {
    GArray *loads = g_array_new(FALSE, FALSE, sizeof(StudioPlantLoad));
    g_array_set_clear_func(loads, load_clear);
    GHashTable *sums = sum_up(view, counts);
    GHashTableIter all;
    gpointer plant, value;
    uint64_t growing = 0;
    g_hash_table_iter_init(&all, sums);
    while (g_hash_table_iter_next(&all, &plant, &value)) {
        growing += grows(grower, plant) ? ((Sum *)value)->nodes : 0;
    }
    double growth = growth_seconds(view->scene) / (double)MAX(growing, 1);
    g_hash_table_iter_init(&all, sums);
    while (g_hash_table_iter_next(&all, &plant, &value)) {
        const Sum *sum = value;
        double seconds =
            grows(grower, plant) ? growth * (double)sum->nodes + sum->skin : sum->seconds;
        StudioPlantLoad load = {g_strdup(plant), sum->stands, seconds};
        g_array_append_val(loads, load);
    }
    g_hash_table_unref(sums);
    return loads;
}
