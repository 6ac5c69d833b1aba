#include "studio/scale_bar.h"

#include "studio/accessible.h"
#include "studio/model/values.h"

static const double longest = 120;                     // pixels
static const int place_width = 160, place_height = 44; // of the corner, with its margins

typedef struct ScaleBar {
    StudioViewport *viewport;
    GtkWidget *box, *label;
    guint idle;
} ScaleBar;

// ---- what it says ------------------------------------------------------------------------------

static gboolean on_idle(gpointer data) {
    ScaleBar *bar = data;
    int height = gtk_widget_get_height(GTK_WIDGET(bar->viewport));
    bar->idle = 0;
    if (height <= 0) {
        return G_SOURCE_REMOVE;
    }
    StudioScale scale = studio_camera_scale(studio_viewport_camera(bar->viewport), height, longest);
    char *text = studio_length_text(scale.length);
    char *name = g_strdup_printf("Scale: %s", text);
    gtk_label_set_text(GTK_LABEL(bar->label), text);
    gtk_widget_set_size_request(bar->label, (int)(scale.pixels + 0.5), -1);
    studio_name(bar->label, name);
    gtk_widget_set_visible(bar->box, TRUE);
    g_free(name);
    g_free(text);
    return G_SOURCE_REMOVE;
}

// A picture may be woken while it is laid out, when no size may change; so it is done soon, before
// that picture.
static void on_woken(StudioViewport *viewport, ScaleBar *bar) {
    (void)viewport;
    if (bar->idle == 0) {
        bar->idle = g_idle_add_full(GDK_PRIORITY_REDRAW - 1, on_idle, bar, NULL);
    }
}

// ---- where it is -------------------------------------------------------------------------------

// Whether another widget over a picture so large covers the place.
static bool covers(GtkWidget *other, int width, int height) {
    bool is_bar = GTK_IS_REVEALER(other);
    int natural;
    if (!gtk_widget_get_visible(other) ||
        (is_bar && !gtk_revealer_get_reveal_child(GTK_REVEALER(other)))) {
        return false;
    }
    if (is_bar && gtk_widget_get_valign(other) == GTK_ALIGN_END) {
        gtk_widget_measure(other, GTK_ORIENTATION_HORIZONTAL, -1, NULL, &natural, NULL, NULL);
        return gtk_widget_get_halign(other) != GTK_ALIGN_CENTER ||
               width - natural < 2 * place_width;
    }
    if (gtk_widget_get_halign(other) == GTK_ALIGN_START) { // a palette
        gtk_widget_measure(other, GTK_ORIENTATION_VERTICAL, -1, NULL, &natural, NULL, NULL);
        return height - natural < place_height;
    }
    return false;
}

// Asked for whenever something over the picture is laid out anew.
static gboolean on_position(GtkOverlay *overlay, GtkWidget *widget, GdkRectangle *rectangle,
                            ScaleBar *bar) {
    (void)rectangle;
    if (widget != bar->box) {
        return FALSE;
    }
    int width = gtk_widget_get_width(GTK_WIDGET(bar->viewport));
    int height = gtk_widget_get_height(GTK_WIDGET(bar->viewport));
    bool has_room = width >= 2 * place_width && height >= 2 * place_height;
    GtkWidget *other = gtk_widget_get_first_child(GTK_WIDGET(overlay));
    for (; other != NULL && has_room; other = gtk_widget_get_next_sibling(other)) {
        has_room = other == bar->box || other == GTK_WIDGET(bar->viewport) ||
                   !covers(other, width, height);
    }
    gtk_widget_set_child_visible(bar->box, has_room);
    return FALSE; // where its alignment says
}

// ---- life --------------------------------------------------------------------------------------

static void bar_free(gpointer data) {
    ScaleBar *bar = data;
    if (bar->idle != 0) {
        g_source_remove(bar->idle);
    }
    g_free(bar);
}

void studio_scale_bar_add(GtkOverlay *overlay, StudioViewport *viewport) {
    ScaleBar *bar = g_new0(ScaleBar, 1);
    bar->viewport = viewport;
    bar->box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    bar->label = gtk_label_new("");
    gtk_widget_set_name(bar->label, "scale-bar");
    gtk_widget_add_css_class(bar->box, "scale-bar");
    gtk_widget_set_halign(bar->box, GTK_ALIGN_START);
    gtk_widget_set_valign(bar->box, GTK_ALIGN_END);
    gtk_widget_set_can_target(bar->box, FALSE);
    gtk_widget_set_visible(bar->box, FALSE); // until there is a picture
    gtk_box_append(GTK_BOX(bar->box), bar->label);
    gtk_overlay_add_overlay(overlay, bar->box);
    g_object_set_data_full(G_OBJECT(viewport), "studio-scale-bar", bar, bar_free);
    g_signal_connect(viewport, "woken", G_CALLBACK(on_woken), bar);
    g_signal_connect(overlay, "get-child-position", G_CALLBACK(on_position), bar);
}
