#include "studio/picture.h"

gboolean studio_picture_save(GtkWidget *widget, const char *path) {
    GtkNative *native = gtk_widget_get_native(widget);
    GskRenderer *renderer = native == NULL ? NULL : gtk_native_get_renderer(native);
    int width = gtk_widget_get_width(widget), height = gtk_widget_get_height(widget);
    if (renderer == NULL || width == 0 || height == 0) {
        return FALSE;
    }
    GdkPaintable *paintable = gtk_widget_paintable_new(widget);
    GtkSnapshot *snapshot = gtk_snapshot_new();
    gdk_paintable_snapshot(paintable, GDK_SNAPSHOT(snapshot), width, height);
    GskRenderNode *node = gtk_snapshot_free_to_node(snapshot);
    gboolean is_saved = FALSE;
    if (node != NULL) {
        graphene_rect_t bounds = GRAPHENE_RECT_INIT(0, 0, (float)width, (float)height);
        GdkTexture *texture = gsk_renderer_render_texture(renderer, node, &bounds);
        is_saved = gdk_texture_save_to_png(texture, path);
        g_object_unref(texture);
        gsk_render_node_unref(node);
    }
    g_object_unref(paintable);
    return is_saved;
}
