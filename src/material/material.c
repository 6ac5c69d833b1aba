#include "frond/material.h"

#include <pthread.h>

#include "material/codec.h"
#include "material/ramp.h"
#include "material/texture.h"

#define FR_PARAM_STRUCT FrMaterialParams
static const FrParam rows[] = {FR_MATERIAL_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable table = {
    .element = "material",
    .meaning = "the look of bark, leaves or petals",
    .rows = rows,
    .count = G_N_ELEMENTS(rows),
    .struct_size = sizeof(FrMaterialParams),
};

const FrParamTable *fr_material_table(void) {
    return &table;
}

/// One map: the file's bytes and the pixels, each fetched when first asked for.
typedef struct Slot {
    GBytes *file;
    FrImage *image;
} Slot;

struct FrMaterial {
    gatomicrefcount references;
    char *name;
    char *folder;
    FrSpan span;
    FrSpan places[FR_MAP_COUNT]; ///< of the files' names
    FrMaterialParams params;
    FrRamp ramp;
    FrMaterial *steps[FR_RAMP_STEPS + 1]; ///< owned; NULL: not yet made
    pthread_mutex_t
        lock; ///< guards slots and steps; not GMutex: thread sanitizers see through this
    Slot slots[FR_MAP_COUNT];
};

FrMaterial *fr_material_new(const char *name, const FrMaterialParams *params, const char *folder,
                            FrSpan span) {
    FrMaterial *material = g_new0(FrMaterial, 1);
    g_atomic_ref_count_init(&material->references);
    pthread_mutex_init(&material->lock, NULL);
    material->name = g_strdup(name);
    material->folder = g_strdup(folder);
    material->span = span;
    if (span.source != NULL) {
        fr_source_ref(span.source);
    }
    fr_params_copy(&table, &material->params, params);
    fr_ramp_read(&material->ramp, params->ramp, span, NULL);
    return material;
}

void fr_material_set_place(FrMaterial *material, FrMap map, FrSpan place) {
    fr_source_ref(place.source);
    fr_source_unref(material->places[map].source);
    material->places[map] = place;
}

void fr_material_set_file(FrMaterial *material, FrMap map, GBytes *bytes) {
    g_bytes_ref(bytes);
    g_clear_pointer(&material->slots[map].file, g_bytes_unref);
    material->slots[map].file = bytes;
}

FrMaterial *fr_material_ref(FrMaterial *material) {
    g_atomic_ref_count_inc(&material->references);
    return material;
}

void fr_material_unref(FrMaterial *material) {
    if (material == NULL || !g_atomic_ref_count_dec(&material->references)) {
        return;
    }
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        g_clear_pointer(&material->slots[map].file, g_bytes_unref);
        g_clear_pointer(&material->slots[map].image, fr_image_unref);
        fr_source_unref(material->places[map].source);
    }
    for (uint32_t step = 0; step <= FR_RAMP_STEPS; step++) {
        fr_material_unref(material->steps[step]);
    }
    fr_params_clear(&table, &material->params);
    if (material->span.source != NULL) {
        fr_source_unref(material->span.source);
    }
    pthread_mutex_destroy(&material->lock);
    g_free(material->folder);
    g_free(material->name);
    g_free(material);
}

const char *fr_material_name(const FrMaterial *material) {
    return material->name;
}

const FrMaterialParams *fr_material_params(const FrMaterial *material) {
    return &material->params;
}

bool fr_material_has_ramp(const FrMaterial *material) {
    return material->ramp.count > 0;
}

bool fr_material_check_ramp(const char *text, FrSpan span, FrDiags *diags) {
    FrRamp ramp;
    return fr_ramp_read(&ramp, text, span, diags);
}

static FrMaterial *make_step(const FrMaterial *material, uint32_t step) {
    FrMaterialParams params;
    fr_params_copy(&table, &params, &material->params);
    g_clear_pointer(&params.ramp, g_free);
    params.colour = fr_ramp_at(&material->ramp, (double)step / FR_RAMP_STEPS);
    char *name = g_strdup_printf("%s-%02u", material->name, step);
    FrMaterial *made = fr_material_new(name, &params, material->folder, material->span);
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        if (material->places[map].source != NULL) {
            fr_material_set_place(made, (FrMap)map, material->places[map]);
        }
    }
    g_free(name);
    fr_params_clear(&table, &params);
    return made;
}

FrMaterial *fr_material_at(FrMaterial *material, uint32_t step) {
    FR_ASSERT(step <= FR_RAMP_STEPS);
    if (material->ramp.count == 0) {
        return material;
    }
    pthread_mutex_lock(&material->lock);
    if (material->steps[step] == NULL) {
        material->steps[step] = make_step(material, step);
    }
    FrMaterial *made = material->steps[step];
    pthread_mutex_unlock(&material->lock);
    return made;
}

/// The user's file for that map, or NULL.
static const char *file_name(const FrMaterial *material, FrMap map) {
    const char *const names[FR_MAP_COUNT] = {
        [FR_MAP_COLOUR] = material->params.picture,
        [FR_MAP_NORMAL] = material->params.normal_map,
        [FR_MAP_ROUGHNESS] = material->params.roughness_map,
    };
    return names[map] != NULL && names[map][0] != '\0' ? names[map] : NULL;
}

static FrSpan place_of(const FrMaterial *material, FrMap map) {
    return material->places[map].source != NULL ? material->places[map] : material->span;
}

static bool is_made(const FrMaterial *material, FrMap map) {
    return file_name(material, map) == NULL && material->params.texture != FR_TEXTURE_NONE;
}

bool fr_material_has(const FrMaterial *material, FrMap map) {
    return file_name(material, map) != NULL || material->params.texture != FR_TEXTURE_NONE;
}

vec3s fr_material_tint(const FrMaterial *material) {
    return is_made(material, FR_MAP_COLOUR) ? (vec3s){{1, 1, 1}} : material->params.colour;
}

// ---- fetching, under the lock -------------------------------------------------------------------

static char *file_path(const FrMaterial *material, const char *name) {
    bool is_whole = material->folder == NULL || g_path_is_absolute(name);
    return is_whole ? g_strdup(name) : g_build_filename(material->folder, name, NULL);
}

static FrStatus fetch_bytes(FrMaterial *material, FrMap map, const FrContext *context) {
    Slot *slot = &material->slots[map];
    if (slot->file != NULL) {
        return FR_OK;
    }
    char *path = file_path(material, file_name(material, map));
    FrStatus status = fr_picture_read_file(path, place_of(material, map), context, &slot->file);
    g_free(path);
    return status;
}

static FrStatus fetch_file(FrMaterial *material, FrMap map, const FrContext *context) {
    Slot *slot = &material->slots[map];
    FrStatus status = fetch_bytes(material, map, context);
    if (status != FR_OK) {
        return status;
    }
    gsize size = 0;
    const void *data = g_bytes_get_data(slot->file, &size);
    slot->image = fr_image_from_bytes(data, size, file_name(material, map), place_of(material, map),
                                      context, &status);
    if (slot->image == NULL) {
        g_clear_pointer(&slot->file, g_bytes_unref); // a repaired file is read afresh
    }
    return status;
}

/// All maps that are made come from one field of heights and colours, so they are made together.
static FrStatus make_all(FrMaterial *material, const FrContext *context) {
    FrImage *maps[FR_MAP_COUNT] = {NULL};
    FrStatus status =
        fr_texture_make(&material->params, material->name, material->span, context, maps);
    for (int map = 0; map < FR_MAP_COUNT; map++) {
        if (maps[map] == NULL) {
            continue;
        }
        if (is_made(material, (FrMap)map) && material->slots[map].image == NULL) {
            material->slots[map].image = maps[map];
        } else {
            fr_image_unref(maps[map]);
        }
    }
    return status;
}

static FrStatus fetch(FrMaterial *material, FrMap map, const FrContext *context) {
    if (material->slots[map].image != NULL) {
        return FR_OK;
    }
    return is_made(material, map) ? make_all(material, context)
                                  : fetch_file(material, map, context);
}

const FrImage *fr_material_image(FrMaterial *material, FrMap map, const FrContext *context,
                                 FrStatus *status) {
    if (!fr_material_has(material, map)) {
        return NULL;
    }
    pthread_mutex_lock(&material->lock);
    FrStatus outcome = fetch(material, map, context);
    const FrImage *image = material->slots[map].image;
    pthread_mutex_unlock(&material->lock);
    if (outcome != FR_OK && status != NULL) {
        *status = outcome;
    }
    return image;
}

static void encode_maps(void *data, size_t begin, size_t end, int worker) {
    Slot *slots = data;
    (void)worker;
    for (size_t map = begin; map < end; map++) {
        if (slots[map].image != NULL && slots[map].file == NULL) {
            slots[map].file = fr_image_to_png(slots[map].image);
        }
    }
}

GBytes *fr_material_image_file(FrMaterial *material, FrMap map, const FrContext *context,
                               const char **media_type, FrStatus *status) {
    // Reading the pixels first finds out whether a file is whole before anyone embeds it.
    const FrImage *image = fr_material_image(material, map, context, status);
    if (image == NULL) {
        return NULL;
    }
    *media_type = "image/png";
    pthread_mutex_lock(&material->lock);
    Slot *slot = &material->slots[map];
    if (slot->file == NULL) {
        // Whoever wants one of what was made together mostly wants all.
        fr_parallel_for(context->pool, FR_MAP_COUNT, 1, encode_maps, material->slots, NULL);
    }
    GBytes *file = g_bytes_ref(slot->file);
    pthread_mutex_unlock(&material->lock);
    gsize size = 0;
    const void *data = g_bytes_get_data(file, &size);
    if (fr_picture_format(data, size) == FR_PICTURE_JPEG) {
        *media_type = "image/jpeg";
    }
    return file;
}

bool fr_material_has_alpha(const FrMaterial *material) {
    if (file_name(material, FR_MAP_COLOUR) == NULL) {
        int texture = material->params.texture;
        return texture == FR_TEXTURE_LEAF || texture == FR_TEXTURE_PETAL;
    }
    // The file's bytes are a cache, so fetching them does not change the material.
    FrMaterial *cache = (FrMaterial *)material;
    FrContext context = fr_context_default();
    pthread_mutex_lock(&cache->lock);
    bool has_alpha = false;
    if (fetch_bytes(cache, FR_MAP_COLOUR, &context) == FR_OK) {
        gsize size = 0;
        const void *data = g_bytes_get_data(cache->slots[FR_MAP_COLOUR].file, &size);
        has_alpha =
            fr_picture_format(data, size) == FR_PICTURE_PNG && fr_png_declares_alpha(data, size);
    }
    pthread_mutex_unlock(&cache->lock);
    return has_alpha;
}
