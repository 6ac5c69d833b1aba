#include "studio/views_menu.h"

#include "studio/accessible.h"
#include "studio/model/lamp_private.h"
#include "studio/model/removal.h"
#include "studio/model/scene_edit.h"
#include "studio/model/standing.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

#include <math.h>
#include <string.h>

enum { HIGHEST_LIST = 320 }; // pixels

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
    bool is_new = window->document != NULL && studio_find_view(window->document, name) == FR_NONE;
    if (window->document == NULL || *name == '\0') {
        studio_window_say(window, "Give the view a name");
    } else if (studio_save_view(window->document, name, studio_viewport_camera(window->viewport))) {
        studio_window_say(window, is_new ? "Saved the view %s" : "The view %s is this one now",
                          name);
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
    const char *name = g_object_get_data(G_OBJECT(button), name_key);
    uint32_t view = studio_find_view(window->document, name);
    if (view != FR_NONE) {
        char *words = studio_removal_words(window->document, view);
        studio_window_select(window, FR_NONE);
        if (studio_take_out(window->document, &view, 1, NULL)) {
            studio_window_say_removed(window, words);
        }
        g_free(words);
    }
    close_list(button);
}

static void on_save(GtkWidget *widget, GtkEditable *entry) {
    save(window_of(widget), gtk_editable_get_text(entry));
    close_list(widget);
}

// ---- another name ------------------------------------------------------------------------------

static const char showing[] = "name", asking[] = "entry"; // pages of a row

static void on_rename(GtkWidget *button, GtkStack *row) {
    (void)button;
    GtkWidget *entry = gtk_stack_get_child_by_name(row, asking);
    gtk_stack_set_visible_child(row, entry);
    gtk_widget_grab_focus(entry);
}

static void on_renamed(GtkWidget *entry, GtkStack *row) {
    StudioWindow *window = window_of(entry);
    const char *name = g_object_get_data(G_OBJECT(entry), name_key);
    char *to = g_strdup(gtk_editable_get_text(GTK_EDITABLE(entry)));
    if (strcmp(name, to) == 0) {
        gtk_stack_set_visible_child_name(row, showing);
    } else if (studio_rename_view(window->document, name, to)) {
        studio_window_say(window, "The view is called %s now", to);
        close_list(entry);
    } else {
        gtk_widget_add_css_class(entry, "error");
        gtk_widget_set_tooltip_text(entry, *to == '\0' ? "Give the view a name"
                                                       : "Another view is called so");
        studio_window_say(window,
                          *to == '\0' ? "Give the view a name" : "Another view is called %s", to);
    }
    g_free(to);
}

static gboolean on_entry_key(GtkEventControllerKey *keys, guint key, guint code,
                             GdkModifierType state, GtkStack *row) {
    (void)code;
    (void)state;
    GtkWidget *entry = gtk_event_controller_get_widget(GTK_EVENT_CONTROLLER(keys));
    if (key != GDK_KEY_Escape) {
        return FALSE;
    }
    gtk_editable_set_text(GTK_EDITABLE(entry), g_object_get_data(G_OBJECT(entry), name_key));
    gtk_widget_remove_css_class(entry, "error");
    gtk_stack_set_visible_child_name(row, showing);
    gtk_widget_grab_focus(gtk_stack_get_child_by_name(row, showing));
    return TRUE;
}

static void name_part(GtkWidget *part, const char *what, const char *name) {
    char *called = g_strdup_printf("%s:%s", what, name);
    gtk_widget_set_name(part, called);
    g_object_set_data_full(G_OBJECT(part), name_key, g_strdup(name), g_free);
    g_free(called);
}

// The name, or what changes it.
static GtkWidget *make_name(const char *name) {
    GtkWidget *stack = gtk_stack_new(), *entry = gtk_entry_new();
    GtkWidget *go = gtk_button_new_with_label(name);
    gtk_widget_add_css_class(go, "flat");
    gtk_widget_set_halign(gtk_button_get_child(GTK_BUTTON(go)), GTK_ALIGN_START);
    gtk_widget_set_tooltip_text(go, "See it like this");
    gtk_editable_set_text(GTK_EDITABLE(entry), name);
    studio_name(entry, "What the view is called");
    gtk_stack_add_named(GTK_STACK(stack), go, showing);
    gtk_stack_add_named(GTK_STACK(stack), entry, asking);
    gtk_widget_set_hexpand(stack, TRUE);
    name_part(go, "view", name);
    name_part(entry, "name-of-view", name);
    GtkEventController *keys = gtk_event_controller_key_new();
    gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_entry_key), stack);
    gtk_widget_add_controller(entry, keys);
    g_signal_connect(go, "clicked", G_CALLBACK(on_go), NULL);
    g_signal_connect(entry, "activate", G_CALLBACK(on_renamed), stack);
    return stack;
}

static GtkWidget *make_row(const char *name) {
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4), *stack = make_name(name);
    GtkWidget *rename = studio_flat_button("document-edit-symbolic", "Rename the view");
    GtkWidget *away = studio_flat_button("user-trash-symbolic", "Remove the view");
    name_part(rename, "rename-view", name);
    name_part(away, "remove-view", name);
    g_signal_connect(rename, "clicked", G_CALLBACK(on_rename), stack);
    g_signal_connect(away, "clicked", G_CALLBACK(on_remove), NULL);
    gtk_box_append(GTK_BOX(row), stack);
    gtk_box_append(GTK_BOX(row), rename);
    gtk_box_append(GTK_BOX(row), away);
    return row;
}

static GtkWidget *make_entry(const StudioDocument *document) {
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
    GtkWidget *entry = gtk_entry_new(), *button = gtk_button_new_with_label("Save View");
    char *name = document == NULL ? g_strdup("") : studio_free_view(document);
    gtk_editable_set_text(GTK_EDITABLE(entry), name);
    g_free(name);
    gtk_widget_set_name(entry, "new-view");
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
    GtkWidget *rows = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4), *all = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(all), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(all), TRUE);
    gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(all), HIGHEST_LIST);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(all), rows);
    gtk_box_append(GTK_BOX(box), all);
    g_object_set_data(G_OBJECT(popover), window_key, window);
    const FrContents *contents =
        window->document == NULL ? NULL : studio_document_contents(window->document);
    uint32_t view = contents == NULL ? FR_NONE : studio_find_in_scene(window->document, "view");
    for (; view != FR_NONE; view = fr_contents_sibling(contents, view)) {
        char *name = fr_contents_get(contents, view, "name");
        gtk_box_append(GTK_BOX(rows), make_row(name == NULL ? "" : name));
        g_free(name);
    }
    gtk_box_append(GTK_BOX(box), make_entry(contents == NULL ? NULL : window->document));
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
