#include "io/organ_groups.h"

#include "frond/digest.h"

#include <math.h>
#include <string.h>

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

/// What the organs of a group have in common.
typedef struct Kind {
    uint32_t shape, material;
    float enlarged;
} Kind;

static guint kind_hash(gconstpointer key) {
    return (guint)fr_digest(0, key, sizeof(Kind));
}

static gboolean kind_equal(gconstpointer a, gconstpointer b) {
    return memcmp(a, b, sizeof(Kind)) == 0;
}

static void add_organ(GArray *groups, GHashTable *index, const FrPlant *plant, uint32_t organ,
                      float enlarged) {
    Kind kind = {plant->organs.shape[organ], plant->organs.material[organ], enlarged};
    gpointer at;
    if (!g_hash_table_lookup_extended(index, &kind, NULL, &at)) {
        FrOrganGroup group = {
            .shape = kind.shape,
            .material = kind.material,
            .word = group_word(plant, organ),
            .enlarged = enlarged,
            .organs = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
        };
        at = GUINT_TO_POINTER(groups->len);
        g_hash_table_insert(index, g_memdup2(&kind, sizeof kind), at);
        g_array_append_val(groups, group);
    }
    g_array_append_val(g_array_index(groups, FrOrganGroup, GPOINTER_TO_UINT(at)).organs, organ);
}

FrStatus fr_organ_groups_new(const FrPlant *plant, const FrSkinParams *skin,
                             const FrContext *context, GArray **groups) {
    *groups = g_array_new(FALSE, FALSE, sizeof(FrOrganGroup));
    g_array_set_clear_func(*groups, group_clear);
    GHashTable *index = g_hash_table_new_full(kind_hash, kind_equal, g_free, NULL);
    float *factors = g_new(float, MAX(plant->organs.count, 1));
    FrStatus status = fr_skin_organ_factors(plant, skin, context, factors);
    for (uint32_t o = 0; status == FR_OK && o < plant->organs.count; o++) {
        if (factors[o] > 0.0f) {
            add_organ(*groups, index, plant, o, factors[o]);
        }
    }
    g_hash_table_unref(index);
    g_free(factors);
    return status;
}

void fr_organ_group_pose(const FrPlant *plant, const FrOrganGroup *group, uint32_t organ,
                         double at[3], double rotation[4], double *scale) {
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
    *scale = (double)(plant->organs.scale[organ] * group->enlarged);
}
