#include "studio/swatches.h"

#include "studio/model/materials.h"

enum { THUMBNAIL = 176 };

struct StudioSwatches {
    void (*changed)(void *user);
    void *user;
    StudioBuilder *builder; // borrowed; NULL: nobody makes pictures
    GHashTable *pictures;   // digest → FrImage, small; those without a picture are not there
};

StudioSwatches *studio_swatches_new(void (*changed)(void *user), void *user) {
    StudioSwatches *swatches = g_new0(StudioSwatches, 1);
    swatches->changed = changed;
    swatches->user = user;
    swatches->pictures =
        g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, (GDestroyNotify)fr_image_unref);
    return swatches;
}

void studio_swatches_free(StudioSwatches *swatches) {
    g_hash_table_unref(swatches->pictures);
    g_free(swatches);
}

void studio_swatches_set_builder(StudioSwatches *swatches, StudioBuilder *builder) {
    swatches->builder = builder;
}

void studio_swatches_add(StudioSwatches *swatches, const StudioPicture *picture) {
    if (picture->map != FR_MAP_COLOUR || picture->image == NULL) {
        return;
    }
    gint64 key = (gint64)picture->digest;
    g_hash_table_insert(swatches->pictures, g_memdup2(&key, sizeof key),
                        studio_thumbnail(picture->image, THUMBNAIL, THUMBNAIL));
    swatches->changed(swatches->user);
}

GdkTexture *studio_texture_of(const FrImage *image) {
    FrImage *four =
        image->channels == 4 ? NULL : studio_thumbnail(image, image->width, image->height);
    const FrImage *from = four != NULL ? four : image;
    size_t row = (size_t)from->width * 4;
    GBytes *bytes = g_bytes_new(from->pixels, row * from->height);
    GdkTexture *texture = gdk_memory_texture_new((int)from->width, (int)from->height,
                                                 GDK_MEMORY_R8G8B8A8, bytes, row);
    g_bytes_unref(bytes);
    fr_image_unref(four);
    return texture;
}

static void ask_for_picture(const StudioSwatches *swatches, const StudioDocument *document,
                            const FrMaterialParams *params) {
    FrMaterial *material =
        fr_material_new("swatch", params, studio_document_folder(document), (FrSpan){0});
    if (swatches->builder != NULL && fr_material_has(material, FR_MAP_COLOUR)) {
        studio_builder_paint(swatches->builder, material);
    }
    fr_material_unref(material);
}

GdkTexture *studio_swatches_get(StudioSwatches *swatches, const StudioDocument *document,
                                uint32_t material, uint32_t size) {
    FrMaterialParams params;
    studio_material_read(document, material, &params);
    gint64 key = (gint64)studio_look_digest(&params);
    const FrImage *colours = g_hash_table_lookup(swatches->pictures, &key);
    if (colours == NULL) {
        ask_for_picture(swatches, document, &params);
    }
    FrImage *image = studio_swatch(&params, colours, size);
    GdkTexture *texture = studio_texture_of(image);
    fr_image_unref(image);
    fr_params_clear(fr_material_table(), &params);
    return texture;
}
