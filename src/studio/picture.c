#include "studio/picture.h"

#include "frond/image.h"

// A PNG without transparency: corners of windows become black.
static gboolean save_texture(GdkTexture *texture, const char *path) {
    uint32_t width = (uint32_t)gdk_texture_get_width(texture);
    uint32_t height = (uint32_t)gdk_texture_get_height(texture);
    uint32_t *pixels = g_new(uint32_t, (gsize)width * height);
    gdk_texture_download(texture, (guchar *)pixels, width * sizeof *pixels);
    FrImage *image = fr_image_new(width, height, 3);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        image->pixels[3 * i] = (uint8_t)(pixels[i] >> 16);
        image->pixels[3 * i + 1] = (uint8_t)(pixels[i] >> 8);
        image->pixels[3 * i + 2] = (uint8_t)pixels[i];
    }
    GBytes *png = fr_image_to_png(image);
    gsize size;
    const void *data = g_bytes_get_data(png, &size);
    gboolean is_saved = g_file_set_contents(path, data, (gssize)size, NULL);
    g_bytes_unref(png);
    fr_image_unref(image);
    g_free(pixels);
    return is_saved;
}

// How a widget looks now; NULL.
static GdkTexture *texture_of(GtkWidget *widget) {
    GtkNative *native = gtk_widget_get_native(widget);
    GskRenderer *renderer = native == NULL ? NULL : gtk_native_get_renderer(native);
    int width = gtk_widget_get_width(widget), height = gtk_widget_get_height(widget);
    if (renderer == NULL || width == 0 || height == 0) {
        return NULL;
    }
    GdkPaintable *paintable = gtk_widget_paintable_new(widget);
    GtkSnapshot *snapshot = gtk_snapshot_new();
    gdk_paintable_snapshot(paintable, GDK_SNAPSHOT(snapshot), width, height);
    GskRenderNode *node = gtk_snapshot_free_to_node(snapshot);
    GdkTexture *texture = NULL;
    if (node != NULL) {
        graphene_rect_t bounds = GRAPHENE_RECT_INIT(0, 0, (float)width, (float)height);
        texture = gsk_renderer_render_texture(renderer, node, &bounds);
        gsk_render_node_unref(node);
    }
    g_object_unref(paintable);
    return texture;
}

gboolean studio_picture_save(GtkWidget *widget, const char *path) {
    GdkTexture *texture = texture_of(widget);
    gboolean is_saved = texture != NULL && save_texture(texture, path);
    g_clear_object(&texture);
    return is_saved;
}

gboolean studio_picture_colour(GtkWidget *widget, int x, int y, uint8_t colour[3]) {
    GdkTexture *texture = texture_of(widget);
    int width = texture == NULL ? 0 : gdk_texture_get_width(texture);
    gboolean is_there = x >= 0 && y >= 0 && x < width && y < gdk_texture_get_height(texture);
    if (is_there) {
        uint32_t *pixels = g_new(uint32_t, (gsize)width * (gsize)gdk_texture_get_height(texture));
        gdk_texture_download(texture, (guchar *)pixels, (gsize)width * sizeof *pixels);
        uint32_t pixel = pixels[(gsize)y * (gsize)width + (gsize)x];
        colour[0] = (uint8_t)(pixel >> 16);
        colour[1] = (uint8_t)(pixel >> 8);
        colour[2] = (uint8_t)pixel;
        g_free(pixels);
    }
    g_clear_object(&texture);
    return is_there;
}
