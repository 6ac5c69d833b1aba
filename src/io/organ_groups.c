#include "io/organ_groups.h"

#include <math.h>

static void group_clear(gpointer data) {
    FrOrganGroup *group = data;
    g_array_unref(group->organs);
}

static const char *group_word(const FrPlant *plant, uint32_t organ) {
    uint32_t component = plant->organs.component[organ];
    if (component != FR_NONE) {
        return g_array_index(plant->components, FrComponent, component).id;
    }
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    return shape->kind == FR_SHAPE_BLADE ? "leaf" : "organ";
}

/// Which nodes are shed or borne by something shed: skin leaves those out, and so must we.
static bool *gone_nodes(const FrPlant *plant) {
    const FrNodes *nodes = &plant->nodes;
    bool *gone = g_new(bool, nodes->count);
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        gone[i] = ((nodes->flags[i] | plant->axes.flags[nodes->axis[i]]) & FR_SHED) != 0 ||
                  (parent != FR_NONE && gone[parent]);
    }
    return gone;
}

static bool is_seen(const FrPlant *plant, const bool *gone, uint32_t organ) {
    uint32_t node = plant->organs.node[organ];
    return (plant->organs.flags[organ] & (FR_SHED | FR_HIDDEN)) == 0 &&
           (node == FR_NONE || !gone[node]);
}

GArray *fr_organ_groups_new(const FrPlant *plant) {
    GArray *groups = g_array_new(FALSE, FALSE, sizeof(FrOrganGroup));
    g_array_set_clear_func(groups, group_clear);
    GHashTable *index = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    bool *gone = gone_nodes(plant);
    for (uint32_t o = 0; o < plant->organs.count; o++) {
        if (!is_seen(plant, gone, o)) {
            continue;
        }
        uint64_t key = (uint64_t)plant->organs.shape[o] << 32 | plant->organs.material[o];
        gpointer at;
        if (!g_hash_table_lookup_extended(index, &key, NULL, &at)) {
            FrOrganGroup group = {
                .shape = plant->organs.shape[o],
                .material = plant->organs.material[o],
                .word = group_word(plant, o),
                .organs = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
            };
            at = GUINT_TO_POINTER(groups->len);
            g_hash_table_insert(index, g_memdup2(&key, sizeof key), at);
            g_array_append_val(groups, group);
        }
        g_array_append_val(g_array_index(groups, FrOrganGroup, GPOINTER_TO_UINT(at)).organs, o);
    }
    g_hash_table_unref(index);
    g_free(gone);
    return groups;
}

void fr_organ_group_pose(const FrPlant *plant, uint32_t organ, double at[3], double rotation[4],
                         double *scale) {
    vec3s position;
    versors q;
    fr_plant_organ_pose(plant, organ, &position, &q);
    // The first-order normalization of frames is not quite exact enough for strict readers.
    double norm = sqrt((double)q.x * (double)q.x + (double)q.y * (double)q.y +
                       (double)q.z * (double)q.z + (double)q.w * (double)q.w);
    for (int k = 0; k < 3; k++) {
        at[k] = (double)position.raw[k];
    }
    for (int k = 0; k < 4; k++) {
        rotation[k] = (double)q.raw[k] / norm;
    }
    *scale = (double)plant->organs.scale[organ];
}
