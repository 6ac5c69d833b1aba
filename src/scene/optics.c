/// Materials in the terms of light. What counts of a picture is the mean of its pixels that are no
/// holes; a blade shares its colour between throwing back and letting through, as in pictures.
#include "scene/optics.h"

#include "frond/material.h"

#include <math.h>

typedef struct Entry {
    FrMaterial *material;
    const FrImage *picture; ///< of its material; NULL: none
    float cutoff;           ///< of alpha, in 0 … 255
    bool has_holes;
    float albedo;
} Entry;

struct FrOpticsTable {
    GArray *entries;    ///< Entry; masks are numbered from 1
    GHashTable *places; ///< FrMaterial * → place + 1
};

// What plain wood and plain leaves throw back and let through together.
#define PLAIN_WOOD 0.18F
#define PLAIN_LEAF 0.21F
#define PLAIN_TRANSLUCENCY 0.45F

static void clear_entry(void *entry) {
    fr_material_unref(((Entry *)entry)->material);
}

FrOpticsTable *fr_optics_new(void) {
    FrOpticsTable *table = g_new0(FrOpticsTable, 1);
    table->entries = g_array_new(FALSE, TRUE, sizeof(Entry));
    g_array_set_clear_func(table->entries, clear_entry);
    table->places = g_hash_table_new(NULL, NULL);
    return table;
}

void fr_optics_free(FrOpticsTable *table) {
    g_array_unref(table->entries);
    g_hash_table_unref(table->places);
    g_free(table);
}

/// Luminance of an sRGB colour.
static double luminance(const double colour[3]) {
    static const double weights[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double v = colour[c];
        sum += weights[c] * (v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
    return sum;
}

static double mean_luminance(const FrImage *picture, float cutoff) {
    double light = 0, count = 0;
    size_t pixels = (size_t)picture->width * picture->height;
    // A few thousand pixels tell the mean.
    size_t stride = pixels / 8192 + 1;
    for (size_t i = 0; i < pixels; i += stride) {
        const uint8_t *pixel = picture->pixels + i * picture->channels;
        bool is_grey = picture->channels < 3;
        if (picture->channels % 2 == 0 && (float)pixel[picture->channels - 1] < cutoff) {
            continue;
        }
        double colour[3];
        for (int c = 0; c < 3; c++) {
            colour[c] = pixel[is_grey ? 0 : c] / 255.0;
        }
        light += luminance(colour);
        count++;
    }
    return count > 0 ? light / count : 0;
}

static FrStatus add_entry(FrOpticsTable *table, FrMaterial *material, const FrContext *context,
                          const Entry **entry) {
    const FrMaterialParams *params = fr_material_params(material);
    vec3s tint = fr_material_tint(material);
    double colour[3] = {(double)tint.x, (double)tint.y, (double)tint.z};
    Entry added = {.material = fr_material_ref(material),
                   .cutoff = (float)params->alpha_cutoff * 255.0F,
                   .albedo = (float)luminance(colour)};
    FrStatus status = FR_OK;
    if (fr_material_has(material, FR_MAP_COLOUR)) {
        added.picture = fr_material_image(material, FR_MAP_COLOUR, context, &status);
    }
    if (added.picture != NULL) {
        added.albedo *= (float)mean_luminance(added.picture, added.cutoff);
        added.has_holes = added.picture->channels == 4 && fr_material_has_alpha(material);
    }
    g_array_append_val(table->entries, added);
    g_hash_table_insert(table->places, material, GUINT_TO_POINTER(table->entries->len));
    *entry = &g_array_index(table->entries, Entry, table->entries->len - 1);
    return status;
}

static FrLightMaterial surface(float albedo, float mirror, float clear, float translucency) {
    float straight = albedo * (1 - mirror) * clear;
    float matt = albedo * (1 - mirror) * (1 - clear);
    FrOptics side = {.diffuse = matt * (1 - translucency),
                     .specular = albedo * mirror,
                     .transmit_diffuse = matt * translucency,
                     .transmit_specular = straight};
    return (FrLightMaterial){.front = side, .back = side};
}

FrStatus fr_optics_of(FrOpticsTable *table, FrMaterial *material, bool is_foliage,
                      const FrContext *context, FrLightMaterial *optics) {
    if (material == NULL) {
        *optics = is_foliage ? surface(PLAIN_LEAF, 0, 0, PLAIN_TRANSLUCENCY)
                             : surface(PLAIN_WOOD, 0, 0, 0);
        return FR_OK;
    }
    uint32_t place = GPOINTER_TO_UINT(g_hash_table_lookup(table->places, material));
    const Entry *entry = place == 0 ? NULL : &g_array_index(table->entries, Entry, place - 1);
    FrStatus status = entry == NULL ? add_entry(table, material, context, &entry) : FR_OK;
    const FrMaterialParams *params = fr_material_params(material);
    float translucency = is_foliage ? (float)params->translucency : 0;
    // A little below 1, as rounding must not make more light than there was.
    *optics = surface(fminf(entry->albedo, 0.999999F), (float)params->mirror, (float)params->clear,
                      translucency);
    if (is_foliage && entry->has_holes) {
        optics->mask = (uint32_t)(entry - (const Entry *)(const void *)table->entries->data) + 1;
    }
    return status;
}

bool fr_optics_is_hole(void *user, uint32_t mask, float s, float t) {
    const FrOpticsTable *table = user;
    const Entry *entry = &g_array_index(table->entries, Entry, mask - 1);
    const FrImage *picture = entry->picture;
    float x = fminf(fmaxf(s * (float)picture->width, 0), (float)(picture->width - 1));
    float y = fminf(fmaxf(t * (float)picture->height, 0), (float)(picture->height - 1));
    size_t pixel = (size_t)y * picture->width + (size_t)x;
    return (float)picture->pixels[pixel * picture->channels + 3] < entry->cutoff;
}
