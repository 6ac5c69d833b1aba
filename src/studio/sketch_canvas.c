#include "studio/sketch_canvas.h"

void studio_canvas_clear(StudioCanvas *canvas) {
    g_clear_pointer(&canvas->raster.pixels, g_free);
    g_clear_pointer(&canvas->raster.depth, g_free);
    canvas->raster = (StudioRaster){0};
}

void studio_canvas_draw(StudioCanvas *canvas, GtkWidget *widget, GtkSnapshot *snapshot,
                        const graphene_rect_t *area, const StudioLens *lens, GArray *const *layers,
                        size_t count) {
    StudioRaster *raster = &canvas->raster;
    int scale = gtk_widget_get_scale_factor(widget);
    uint32_t width = (uint32_t)MAX(1, (int)area->size.width * scale);
    uint32_t height = (uint32_t)MAX(1, (int)area->size.height * scale);
    if (raster->pixels == NULL || raster->width != width || raster->height != height) {
        studio_raster_reset(raster, width, height);
    } else {
        studio_raster_clear(raster);
    }
    for (size_t i = 0; i < count; i++) {
        if (layers[i] != NULL) {
            studio_raster_draw(raster, lens, (const StudioLine *)(const void *)layers[i]->data,
                               layers[i]->len, scale);
        }
    }
    size_t size = (size_t)raster->width * raster->height * sizeof *raster->pixels;
    GBytes *bytes = g_bytes_new(raster->pixels, size);
    GdkTexture *texture =
        gdk_memory_texture_new((int)raster->width, (int)raster->height, GDK_MEMORY_DEFAULT, bytes,
                               raster->width * sizeof *raster->pixels);
    gtk_snapshot_append_texture(snapshot, texture, area);
    g_object_unref(texture);
    g_bytes_unref(bytes);
}
