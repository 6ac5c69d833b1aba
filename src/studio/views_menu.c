#include "studio/views_menu.h"

#include "studio/accessible.h"
#include "studio/model/lamp_private.h"
#include "studio/model/scene_edit.h"
#include "studio/model/standing.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

#include <math.h>
#include <string.h>

static const char window_key[] = "studio-window", name_key[] = "studio-view";

// ---- views -------------------------------------------------------------------------------------

static void go_to(StudioWindow *window, const char *name) {
    uint32_t view = window->document == NULL ? FR_NONE : studio_find_view(window->document, name);
    if (view == FR_NONE || !studio_viewport_is_ready(window->viewport)) {
        studio_window_say(window, "There is no view called %s", name);
        return;
    }
    FrViewParams params;
    studio_read_params(window->document, view, fr_view_table(), &params);
    studio_viewport_see(window->viewport, &params);
    fr_params_clear(fr_view_table(), &params);
}

static void save(StudioWindow *window, const char *name) {
    if (window->document == NULL || *name == '\0') {
        studio_window_say(window, "Give the view a name");
    } else if (studio_save_view(window->document, name, studio_viewport_camera(window->viewport))) {
        studio_window_say(window, "Saved the view %s", name);
    } else {
        studio_window_say(window, "The view is as it was, or the text is not right");
    }
}

// ---- the list ----------------------------------------------------------------------------------

static StudioWindow *window_of(GtkWidget *widget) {
    GtkWidget *popover = gtk_widget_get_ancestor(widget, GTK_TYPE_POPOVER);
    return g_object_get_data(G_OBJECT(popover), window_key);
}

static void close_list(GtkWidget *widget) {
    gtk_popover_popdown(GTK_POPOVER(gtk_widget_get_ancestor(widget, GTK_TYPE_POPOVER)));
}

static void on_go(GtkWidget *button, gpointer data) {
    (void)data;
    go_to(window_of(button), g_object_get_data(G_OBJECT(button), name_key));
    close_list(button);
}

static void on_remove(GtkWidget *button, gpointer data) {
    (void)data;
    StudioWindow *window = window_of(button);
    uint32_t view =
        studio_find_view(window->document, g_object_get_data(G_OBJECT(button), name_key));
    if (view != FR_NONE) {
        studio_window_select(window, FR_NONE);
        studio_take_out(window->document, &view, 1, NULL);
    }
    close_list(button);
}

static void on_save(GtkWidget *widget, GtkEditable *entry) {
    save(window_of(widget), gtk_editable_get_text(entry));
    close_list(widget);
}

static GtkWidget *make_row(const char *name) {
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    GtkWidget *go = gtk_button_new_with_label(name);
    GtkWidget *away = studio_flat_button("user-trash-symbolic", "Remove the view");
    gtk_widget_add_css_class(go, "flat");
    gtk_widget_set_hexpand(go, TRUE);
    gtk_widget_set_halign(gtk_button_get_child(GTK_BUTTON(go)), GTK_ALIGN_START);
    gtk_widget_set_tooltip_text(go, "See it like this");
    g_signal_connect(go, "clicked", G_CALLBACK(on_go), NULL);
    g_signal_connect(away, "clicked", G_CALLBACK(on_remove), NULL);
    GtkWidget *const buttons[] = {go, away};
    for (size_t i = 0; i < G_N_ELEMENTS(buttons); i++) {
        g_object_set_data_full(G_OBJECT(buttons[i]), name_key, g_strdup(name), g_free);
        gtk_box_append(GTK_BOX(row), buttons[i]);
    }
    return row;
}

static GtkWidget *make_entry(guint count) {
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    GtkWidget *entry = gtk_entry_new(), *button = gtk_button_new_with_label("Save View");
    char *name = g_strdup_printf("view %u", count + 1);
    gtk_editable_set_text(GTK_EDITABLE(entry), name);
    g_free(name);
    studio_tell(entry, "What the view is called");
    g_signal_connect(entry, "activate", G_CALLBACK(on_save), entry);
    g_signal_connect(button, "clicked", G_CALLBACK(on_save), entry);
    gtk_box_append(GTK_BOX(row), entry);
    gtk_box_append(GTK_BOX(row), button);
    return row;
}

// Made anew whenever it is opened.
static void make_list(GtkMenuButton *button, gpointer data) {
    StudioWindow *window = data;
    GtkWidget *popover = gtk_popover_new(), *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    g_object_set_data(G_OBJECT(popover), window_key, window);
    const FrContents *contents =
        window->document == NULL ? NULL : studio_document_contents(window->document);
    uint32_t view = contents == NULL ? FR_NONE : studio_find_in_scene(window->document, "view");
    guint count = 0;
    for (; view != FR_NONE; view = fr_contents_sibling(contents, view)) {
        char *name = fr_contents_get(contents, view, "name");
        gtk_box_append(GTK_BOX(box), make_row(name == NULL ? "" : name));
        g_free(name);
        count++;
    }
    gtk_box_append(GTK_BOX(box), make_entry(count));
    gtk_popover_set_child(GTK_POPOVER(popover), box);
    gtk_menu_button_set_popover(button, popover);
}

// ---- what is selected --------------------------------------------------------------------------

static bool frame_lines(StudioWindow *window) {
    const GArray *lines = window->picked.lines;
    double min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (guint i = 0; lines != NULL && i < lines->len; i++) {
        const float *at = &g_array_index(lines, float, 3 * i);
        for (int k = 0; k < 3; k++) {
            min[k] = fmin(min[k], (double)at[k]);
            max[k] = fmax(max[k], (double)at[k]);
        }
    }
    if (max[0] >= min[0]) {
        studio_viewport_frame(window->viewport, min, max);
    }
    return max[0] >= min[0];
}

bool studio_frame_selected(StudioWindow *window) {
    if (frame_lines(window)) {
        return true;
    }
    uint32_t element = studio_window_selected(window);
    const FrContents *contents = studio_document_contents(window->document);
    double min[3], max[3];
    StudioStanding standing;
    if (element == FR_NONE || contents == NULL || window->builder == NULL ||
        !studio_standing_read(window->document, element, &standing)) {
        return false;
    }
    // What stands knows the name of its element, which begins behind the bracket.
    if (!studio_builder_bounds(window->builder, fr_contents_at(contents, element)->begin + 1, min,
                               max)) {
        double reach = 0.15 * studio_viewport_camera(window->viewport)->distance;
        for (int k = 0; k < 3; k++) {
            min[k] = standing.at[k] - reach;
            max[k] = standing.at[k] + reach;
        }
    }
    studio_viewport_frame(window->viewport, min, max);
    return true;
}

// ---- actions -----------------------------------------------------------------------------------

static void do_save_view(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    save(data, g_variant_get_string(parameter, NULL));
}

static void do_go_view(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    go_to(data, g_variant_get_string(parameter, NULL));
}

static void do_frame_all(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_viewport_frame_all(((StudioWindow *)data)->viewport);
}

GtkWidget *studio_views_button_new(StudioWindow *window) {
    static const GActionEntry entries[] = {
        {.name = "save-view", .activate = do_save_view, .parameter_type = "s"},
        {.name = "go-view", .activate = do_go_view, .parameter_type = "s"},
        {.name = "frame-all", .activate = do_frame_all},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "camera-photo-symbolic");
    gtk_menu_button_set_create_popup_func(GTK_MENU_BUTTON(button), make_list, window, NULL);
    studio_tell(button, "Views of this document");
    gtk_widget_set_name(button, "views");
    return button;
}
