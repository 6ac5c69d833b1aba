// Shapes, profiles, materials and components: the small tables that rows refer to. Equal shapes
// and equal profiles are kept once, so that leaves of equal parameters share their geometry.
#include "plant/shapes.h"

#include <string.h>

// Shapes are hashed and compared as bytes: every byte of them must be one that was set.
_Static_assert(sizeof(FrShape) == 6 * 4 + 37 * 4 + 2 * 2, "FrShape has padding");

static guint shape_hash(gconstpointer shape) {
    return (guint)fr_digest(0, shape, sizeof(FrShape));
}

static gboolean shape_equal(gconstpointer a, gconstpointer b) {
    return memcmp(a, b, sizeof(FrShape)) == 0;
}

static guint profile_hash(gconstpointer key) {
    const FrProfile *profile = key;
    return (guint)fr_digest(profile->is_closed, profile->points,
                            profile->count * sizeof *profile->points);
}

static gboolean profile_equal(gconstpointer a, gconstpointer b) {
    const FrProfile *p = a;
    const FrProfile *q = b;
    return p->count == q->count && p->is_closed == q->is_closed &&
           (p->count == 0 || memcmp(p->points, q->points, p->count * sizeof *p->points) == 0);
}

static void profile_free(gpointer key) {
    FrProfile *profile = key;
    g_free(profile->points);
    g_free(profile);
}

GHashTable *fr_shape_index_new(void) {
    return g_hash_table_new_full(shape_hash, shape_equal, g_free, NULL);
}

GHashTable *fr_profile_index_new(void) {
    return g_hash_table_new_full(profile_hash, profile_equal, profile_free, NULL);
}

uint32_t fr_plant_add_shape(FrPlant *plant, const FrShape *shape) {
    // Parameters that the kind does not use must not tell two shapes apart.
    FrShape key = *shape;
    bool has_outline = shape->kind == FR_SHAPE_REVOLUTION || shape->kind == FR_SHAPE_FILE;
    key.outline = has_outline ? shape->outline : 0;
    if (shape->kind == FR_SHAPE_BLADE) {
        key.size = (vec3s){{0, 0, 0}};
        key.detail = 0;
    } else {
        memset(&key.blade, 0, sizeof key.blade);
    }
    gpointer index;
    if (g_hash_table_lookup_extended(plant->shape_index, &key, NULL, &index)) {
        return GPOINTER_TO_UINT(index);
    }
    g_array_append_val(plant->shapes, key);
    g_hash_table_insert(plant->shape_index, g_memdup2(&key, sizeof key),
                        GUINT_TO_POINTER(plant->shapes->len - 1));
    return plant->shapes->len - 1;
}

static FrProfile profile_copy(const FrProfile *profile) {
    return (FrProfile){
        .points = g_memdup2(profile->points, profile->count * sizeof *profile->points),
        .count = profile->count,
        .is_closed = profile->is_closed,
    };
}

uint32_t fr_plant_add_profile(FrPlant *plant, const double (*points)[2], uint32_t count,
                              bool is_closed) {
    FrProfile wanted = {.points = (double(*)[2])points, .count = count, .is_closed = is_closed};
    gpointer index;
    if (g_hash_table_lookup_extended(plant->profile_index, &wanted, NULL, &index)) {
        return GPOINTER_TO_UINT(index);
    }
    FrProfile profile = profile_copy(&wanted);
    FrProfile *key = g_new(FrProfile, 1);
    *key = profile_copy(&wanted);
    g_array_append_val(plant->profiles, profile);
    g_hash_table_insert(plant->profile_index, key, GUINT_TO_POINTER(plant->profiles->len - 1));
    return plant->profiles->len - 1;
}

uint32_t fr_plant_add_finish(FrPlant *plant, const FrFinish *finish) {
    g_array_append_vals(plant->finishes, finish, 1);
    return plant->finishes->len - 1;
}

uint32_t fr_plant_add_material(FrPlant *plant, FrMaterial *material) {
    guint index;
    if (!g_ptr_array_find(plant->materials, material, &index)) {
        index = plant->materials->len;
        g_ptr_array_add(plant->materials, fr_material_ref(material));
    }
    return index;
}

uint32_t fr_plant_add_file(FrPlant *plant, FrMeshFile *file) {
    guint index;
    if (!g_ptr_array_find(plant->files, file, &index)) {
        index = plant->files->len;
        g_ptr_array_add(plant->files, fr_mesh_file_ref(file));
    }
    return index;
}

uint32_t fr_plant_add_component(FrPlant *plant, const char *id, FrSpan span) {
    FrComponent component = {.id = g_strdup(id), .span = span};
    if (span.source != NULL) {
        fr_source_ref(span.source);
    }
    g_array_append_val(plant->components, component);
    return plant->components->len - 1;
}

uint32_t fr_plant_add_deformation(FrPlant *plant, const FrDeformation *deformation) {
    FrDeformation own = *deformation;
    for (int axis = 0; axis < 3; axis++) {
        own.map[axis] = own.map[axis] != NULL ? fr_expr_ref(own.map[axis]) : NULL;
    }
    g_array_append_val(plant->deformations, own);
    return plant->deformations->len - 1;
}

uint32_t fr_plant_append_deformers(FrPlant *plant, uint32_t count) {
    uint32_t first = plant->deformers->len;
    FrDeformer fresh;
    memset(&fresh, 0, sizeof fresh);
    fresh.outer = fresh.deformation = fresh.node = FR_NONE;
    fresh.rotation = (versors){{0, 0, 0, 1}};
    fresh.scale = fresh.strength = 1;
    g_array_set_size(plant->deformers, first + count);
    for (uint32_t i = first; i < first + count; i++) {
        g_array_index(plant->deformers, FrDeformer, i) = fresh;
    }
    return first;
}
