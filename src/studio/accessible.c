#include "studio/accessible.h"

double studio_letter_scale(GtkWidget *widget) {
    int resolution; // 1024 × dots an inch
    g_object_get(gtk_widget_get_settings(widget), "gtk-xft-dpi", &resolution, NULL);
    return resolution <= 0 ? 1 : CLAMP(resolution / (96.0 * 1024), 0.75, 3);
}

static void set_label(GtkWidget *widget, const char *name) {
    gtk_accessible_update_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_LABEL, name, -1);
}

// The first button inside: GTK makes it and gives it no name.
static GtkWidget *button_inside(GtkWidget *widget) {
    GtkWidget *child = gtk_widget_get_first_child(widget);
    while (child != NULL && !GTK_IS_BUTTON(child)) {
        child = gtk_widget_get_next_sibling(child);
    }
    return child;
}

static void on_chosen(GtkDropDown *list, GParamSpec *spec, gpointer data) {
    (void)spec;
    (void)data;
    const char *name = g_object_get_data(G_OBJECT(list), "studio-name");
    GtkWidget *button = button_inside(GTK_WIDGET(list));
    GObject *item = gtk_drop_down_get_selected_item(list);
    if (button != NULL && GTK_IS_STRING_OBJECT(item)) {
        char *text =
            g_strdup_printf("%s: %s", name, gtk_string_object_get_string(GTK_STRING_OBJECT(item)));
        set_label(button, text);
        g_free(text);
    } else if (button != NULL) {
        set_label(button, name);
    }
}

void studio_name_inside(GtkWidget *widget, const char *name) {
    if (GTK_IS_DROP_DOWN(widget)) {
        g_object_set_data_full(G_OBJECT(widget), "studio-name", g_strdup(name), g_free);
        g_signal_connect(widget, "notify::selected-item", G_CALLBACK(on_chosen), NULL);
        on_chosen(GTK_DROP_DOWN(widget), NULL, NULL);
    } else if (GTK_IS_MENU_BUTTON(widget) || GTK_IS_COLOR_BUTTON(widget)) {
        set_label(button_inside(widget), name);
    }
}

void studio_name(GtkWidget *widget, const char *name) {
    set_label(widget, name);
    studio_name_inside(widget, name);
}

void studio_tell(GtkWidget *widget, const char *tip) {
    gtk_widget_set_tooltip_text(widget, tip);
    studio_name(widget, tip);
}

void studio_describe(GtkWidget *widget, const char *words) {
    gtk_accessible_update_property(GTK_ACCESSIBLE(widget), GTK_ACCESSIBLE_PROPERTY_DESCRIPTION,
                                   words, -1);
}
