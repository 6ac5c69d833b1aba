#include "studio/model/hand.h"

#include "frond/scene.h"

#include <math.h>
#include <string.h>

// How many other instances of a component were made before that of a key: rows of plants stand in
// the order of instances. FR_NONE if it is not there, or if not every instance has made a row.
static uint32_t rank_of(const FrPlant *plant, const char *component, FrKey key, uint64_t wanted) {
    GHashTable *seen = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    uint32_t rank = FR_NONE;
    for (int pass = 0; pass < 2 && g_hash_table_size(seen) == 0; pass++) {
        uint32_t count = pass == 0 ? plant->axes.count : plant->organs.count;
        const uint32_t *components = pass == 0 ? plant->axes.component : plant->organs.component;
        const FrKey *paths = pass == 0 ? plant->axes.path : plant->organs.path;
        for (uint32_t i = 0; i < count; i++) {
            if (components[i] >= plant->components->len ||
                strcmp(g_array_index(plant->components, FrComponent, components[i]).id,
                       component) != 0) {
                continue;
            }
            gint64 path = (gint64)paths[i];
            if (!g_hash_table_contains(seen, &path)) {
                rank = paths[i] == key ? g_hash_table_size(seen) : rank;
                g_hash_table_add(seen, g_memdup2(&path, sizeof path));
            }
        }
    }
    rank = g_hash_table_size(seen) == wanted ? rank : FR_NONE;
    g_hash_table_unref(seen);
    return rank;
}

static char *path_of(const FrPgraph *graph, const FrPgraphCounts *counts, const FrPlant *plant,
                     const char *component, FrKey key) {
    uint32_t kind = fr_pgraph_find(graph, component);
    if (kind == FR_NONE || counts->component == NULL) {
        return NULL;
    }
    uint32_t rank = rank_of(plant, component, key, counts->by_component[kind]);
    for (uint64_t i = 0; rank != FR_NONE && i < counts->instances; i++) {
        if (counts->component[i] == kind && rank-- == 0) {
            return fr_pgraph_path(graph, counts, (uint32_t)i);
        }
    }
    return NULL;
}

char *studio_hand_path(FrSource *source, const char *folder, const char *plant,
                       const char *component, FrKey key) {
    FrContext context = fr_context_default();
    FrDocument *document;
    char *path = NULL;
    FrStatus status = fr_document_parse(source, folder, &context, &document);
    const GPtrArray *plants = status == FR_OK ? fr_document_plants(document) : NULL;
    for (guint i = 0; plants != NULL && path == NULL && i < plants->len; i++) {
        const FrPlantDef *definition = g_ptr_array_index(plants, i);
        if (strcmp(definition->id, plant) != 0 || definition->kind != FR_PLANT_PGRAPH) {
            continue;
        }
        uint32_t wanted = 0;
        FrPgraphCounts counts = {.parent = &wanted};
        FrScenePlant grown = {0};
        if (fr_scene_grow(document, definition, -1, NAN, &context, &grown, &counts) == FR_OK) {
            path = path_of(definition->pgraph, &counts, grown.plant, component, key);
        }
        if (counts.parent == &wanted) {
            counts.parent = NULL;
        }
        fr_pgraph_counts_clear(&counts);
        fr_plant_free(grown.plant);
        g_free(grown.by_component);
    }
    fr_document_free(document);
    return path;
}
