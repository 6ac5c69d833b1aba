#include "io/surfaces.h"

#include "io/output.h"
#include "io/replace_file.h"

#include <math.h>
#include <string.h>

static void surface_clear(gpointer data) {
    FrSurface *surface = data;
    if (surface->material != NULL) {
        fr_material_unref(surface->material);
    }
    g_free(surface->name);
}

static void picture_clear(gpointer data) {
    FrPicture *picture = data;
    g_bytes_unref(picture->bytes);
    g_free(picture->name);
}

void fr_surfaces_init(FrSurfaces *surfaces, const char *prefix) {
    *surfaces = (FrSurfaces){
        .surfaces = g_array_new(FALSE, FALSE, sizeof(FrSurface)),
        .pictures = g_array_new(FALSE, FALSE, sizeof(FrPicture)),
        .prefix = g_strdup(prefix),
        .names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL),
    };
    g_array_set_clear_func(surfaces->surfaces, surface_clear);
    g_array_set_clear_func(surfaces->pictures, picture_clear);
}

void fr_surfaces_clear(FrSurfaces *surfaces) {
    g_array_unref(surfaces->surfaces);
    g_array_unref(surfaces->pictures);
    g_hash_table_unref(surfaces->names);
    g_free(surfaces->prefix);
}

const FrSurface *fr_surfaces_get(const FrSurfaces *surfaces, uint32_t index) {
    return &g_array_index(surfaces->surfaces, FrSurface, index);
}

const FrPicture *fr_surfaces_picture(const FrSurfaces *surfaces, uint32_t index) {
    return &g_array_index(surfaces->pictures, FrPicture, index);
}

/// `name`, or with a number behind it if that is taken.
static char *unique(FrSurfaces *surfaces, const char *name) {
    char *free_name = g_strdup(name);
    for (int k = 2; g_hash_table_contains(surfaces->names, free_name); k++) {
        g_free(free_name);
        free_name = g_strdup_printf("%s-%d", name, k);
    }
    g_hash_table_add(surfaces->names, g_strdup(free_name));
    return free_name;
}

/// Only characters that every file system and every reader of .mtl files takes.
static char *plain_name(const char *name) {
    char *plain = g_strdup(name);
    for (char *c = plain; *c != '\0'; c++) {
        if (!g_ascii_isalnum(*c) && strchr("-_.", *c) == NULL) {
            *c = '_';
        }
    }
    return plain;
}

static uint32_t picture_find(FrSurfaces *surfaces, GBytes *bytes) {
    for (guint i = 0; i < surfaces->pictures->len; i++) {
        if (g_bytes_equal(g_array_index(surfaces->pictures, FrPicture, i).bytes, bytes)) {
            return i;
        }
    }
    return FR_NONE;
}

static FrStatus picture_add(FrSurfaces *surfaces, FrSurface *surface, FrMap map,
                            const FrContext *context) {
    static const char *const words[FR_MAP_COUNT] = {"colour", "normal", "roughness"};
    const char *media_type = NULL;
    FrStatus status = FR_OK;
    GBytes *bytes = fr_material_image_file(surface->material, map, context, &media_type, &status);
    if (bytes == NULL) {
        return status;
    }
    uint32_t index = picture_find(surfaces, bytes);
    if (index == FR_NONE) {
        bool is_jpeg = g_strcmp0(media_type, "image/jpeg") == 0;
        char *material = plain_name(surface->name);
        char *base = g_strdup_printf("%s-%s-%s", surfaces->prefix, material, words[map]);
        FrPicture picture = {
            .name = g_strconcat(base, is_jpeg ? ".jpg" : ".png", NULL),
            .media_type = is_jpeg ? "image/jpeg" : "image/png",
            .bytes = g_bytes_ref(bytes),
        };
        index = surfaces->pictures->len;
        g_array_append_val(surfaces->pictures, picture);
        g_free(material);
        g_free(base);
    }
    g_bytes_unref(bytes);
    surface->picture[map] = index;
    return FR_OK;
}

static FrStatus surface_add(FrSurfaces *surfaces, FrMaterial *material, bool is_foliage,
                            const FrContext *context) {
    const char *name = material != NULL ? fr_material_name(material) : NULL;
    char *plain = plain_name(name != NULL && *name != '\0' ? name : is_foliage ? "leaf" : "wood");
    FrSurface surface = {
        .material = material != NULL ? fr_material_ref(material) : NULL,
        .is_foliage = is_foliage,
        .name = unique(surfaces, plain),
    };
    g_free(plain);
    FrStatus status = FR_OK;
    for (FrMap map = 0; map < FR_MAP_COUNT; map++) {
        surface.picture[map] = FR_NONE;
        if (status == FR_OK && material != NULL && fr_material_has(material, map)) {
            status = picture_add(surfaces, &surface, map, context);
        }
    }
    if (material != NULL && status == FR_OK) {
        int texture = fr_material_params(material)->texture;
        // Wood is whole, also where it is painted with a picture cut to the form of a leaf.
        surface.has_holes = is_foliage && fr_material_has_alpha(material);
        surface.clamps = is_foliage || texture == FR_TEXTURE_LEAF || texture == FR_TEXTURE_PETAL;
    }
    g_array_append_val(surfaces->surfaces, surface);
    return status;
}

FrStatus fr_surfaces_find(FrSurfaces *surfaces, const FrPlant *plant, uint32_t material,
                          bool is_foliage, const FrContext *context, uint32_t *index) {
    FrMaterial *wanted = material == FR_NONE ? NULL : g_ptr_array_index(plant->materials, material);
    for (guint i = 0; i < surfaces->surfaces->len; i++) {
        const FrSurface *surface = fr_surfaces_get(surfaces, i);
        if (surface->material == wanted && surface->is_foliage == is_foliage) {
            *index = i;
            return FR_OK;
        }
    }
    *index = surfaces->surfaces->len;
    return surface_add(surfaces, wanted, is_foliage, context);
}

FrMaterialParams fr_surface_params(const FrSurface *surface) {
    if (surface->material != NULL) {
        return *fr_material_params(surface->material);
    }
    return (FrMaterialParams){
        .colour = {{1, 1, 1}}, .roughness = 0.8, .alpha_cutoff = 0.5, .texture = FR_TEXTURE_NONE};
}

void fr_surface_tint(const FrSurface *surface, double linear[3]) {
    vec3s tint =
        surface->material != NULL ? fr_material_tint(surface->material) : (vec3s){{1, 1, 1}};
    for (int k = 0; k < 3; k++) {
        double s = (double)tint.raw[k];
        double value = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
        linear[k] = round(CLAMP(value, 0.0, 1.0) * 1e6) / 1e6;
    }
}

char *fr_io_stem(const char *path) {
    char *name = g_path_get_basename(path);
    char *dot = strrchr(name, '.');
    if (dot != NULL && dot != name) {
        *dot = '\0';
    }
    return name;
}

char *fr_io_beside(const char *path, const char *name) {
    char *folder = g_path_get_dirname(path);
    char *beside = strcmp(folder, ".") == 0 && path[0] != '.'
                       ? g_strdup(name)
                       : g_build_filename(folder, name, NULL);
    g_free(folder);
    return beside;
}

static bool write_bytes(void *user, int descriptor) {
    gsize size;
    const void *data = g_bytes_get_data(user, &size);
    FrChunk chunk = {data, size};
    return fr_write_chunks(descriptor, &chunk, 1, NULL);
}

FrStatus fr_surfaces_write(const FrSurfaces *surfaces, const char *path, GArray *files,
                           const FrContext *context, uint64_t *bytes) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < surfaces->pictures->len && status == FR_OK; i++) {
        const FrPicture *picture = fr_surfaces_picture(surfaces, i);
        char *beside = fr_io_beside(path, picture->name);
        status = fr_replacements_write(files, beside, write_bytes, picture->bytes, context->diags);
        *bytes += g_bytes_get_size(picture->bytes);
        g_free(beside);
    }
    return status;
}
