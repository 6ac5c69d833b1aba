/// The page of a window without a document: presets, recent documents, and what a crash has left.
#include "studio/accessible.h"
#include "studio/preset_cards.h"
#include "studio/window_private.h"

#include <string.h>

static const char key_path[] = "studio-path";

static GtkWidget *heading(const char *text) {
    GtkWidget *label = gtk_label_new(text);
    gtk_widget_add_css_class(label, "heading");
    gtk_label_set_xalign(GTK_LABEL(label), 0);
    return label;
}

// ---- presets -----------------------------------------------------------------------------------

static void begin_preset(GtkWidget *cards, const char *name, StudioWindow *window) {
    (void)cards;
    char *file = studio_preset_file(name, ".frond"), *text = NULL;
    gsize size;
    if (file != NULL && g_file_get_contents(file, &text, &size, NULL)) {
        char *folder = g_path_get_dirname(file);
        studio_window_take(window, studio_document_new(text, size, name, folder));
        g_free(folder);
    } else {
        studio_window_say(window, "The preset %s cannot be read", name);
    }
    g_free(text);
    g_free(file);
}

// ---- recent documents --------------------------------------------------------------------------

static void on_recent(GtkListBox *list, GtkListBoxRow *row, StudioWindow *window) {
    (void)list;
    const char *path = g_object_get_data(G_OBJECT(row), key_path);
    if (path != NULL) {
        studio_window_open(window, path);
    } else {
        gtk_widget_activate_action(GTK_WIDGET(window), "win.open", NULL);
    }
}

static GtkWidget *make_row(const char *title, const char *subtitle, const char *icon) {
    GtkWidget *row = adw_action_row_new();
    char *safe_title = g_markup_escape_text(title, -1);
    char *safe_subtitle = g_markup_escape_text(subtitle, -1);
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), safe_title);
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row), safe_subtitle);
    adw_action_row_set_title_lines(ADW_ACTION_ROW(row), 1);
    adw_action_row_set_subtitle_lines(ADW_ACTION_ROW(row), 1);
    adw_action_row_add_prefix(ADW_ACTION_ROW(row), gtk_image_new_from_icon_name(icon));
    gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), TRUE);
    g_free(safe_title);
    g_free(safe_subtitle);
    return row;
}

static GtkWidget *make_list(const char *name) {
    GtkWidget *list = gtk_list_box_new();
    gtk_list_box_set_selection_mode(GTK_LIST_BOX(list), GTK_SELECTION_NONE);
    gtk_widget_add_css_class(list, "boxed-list");
    studio_name(list, name);
    return list;
}

static GtkWidget *make_recent(StudioWindow *window) {
    GtkWidget *list = make_list("Documents");
    gtk_list_box_append(GTK_LIST_BOX(list),
                        make_row("Open a document…", "A .frond file", "document-open-symbolic"));
    char **paths = studio_settings_recent(window->settings);
    for (char **path = paths; *path != NULL; path++) {
        char *name = g_path_get_basename(*path), *folder = g_path_get_dirname(*path);
        GtkWidget *row = make_row(name, folder, "document-open-recent-symbolic");
        g_object_set_data_full(G_OBJECT(row), key_path, g_strdup(*path), g_free);
        gtk_list_box_append(GTK_LIST_BOX(list), row);
        g_free(name);
        g_free(folder);
    }
    g_strfreev(paths);
    g_signal_connect(list, "row-activated", G_CALLBACK(on_recent), window);
    return list;
}

// ---- what was left -----------------------------------------------------------------------------

typedef struct Left {
    StudioWindow *window;
    GPtrArray *list;
    guint index;
    GtkWidget *row;
} Left;

static void left_free(gpointer data, GClosure *closure) {
    (void)closure;
    g_ptr_array_unref(((Left *)data)->list);
    g_free(data);
}

static void on_restore(GtkButton *button, Left *left) {
    (void)button;
    const StudioLeft *what = g_ptr_array_index(left->list, left->index);
    FrDiags *diags = fr_diags_new();
    StudioDocument *document = studio_recovery_restore(what, diags);
    if (document != NULL) {
        StudioWindow *window = left->window;
        studio_window_take(window, document);
        studio_recovery_update(window->recovery); // the new copy first
        studio_recovery_discard(what);
        studio_window_say(window, "Recovered. Save it to keep it");
    } else {
        studio_window_say(left->window, "%s", fr_diags_get(diags, 0)->text);
    }
    fr_diags_free(diags);
}

static void on_discard(GtkButton *button, Left *left) {
    (void)button;
    studio_recovery_discard(g_ptr_array_index(left->list, left->index));
    gtk_widget_set_visible(left->row, FALSE);
}

static void add_left_button(GtkWidget *row, const char *text, GCallback callback, Left from) {
    Left *left = g_new(Left, 1);
    *left = from;
    g_ptr_array_ref(left->list);
    GtkWidget *button = gtk_button_new_with_label(text);
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    g_signal_connect_data(button, "clicked", callback, left, left_free, 0);
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), button);
}

static GtkWidget *make_left(StudioWindow *window) {
    char *folder = studio_recovery_folder();
    GPtrArray *left = studio_recovery_list(folder);
    g_free(folder);
    if (left->len == 0) {
        g_ptr_array_unref(left);
        return NULL;
    }
    GtkWidget *list = make_list("What was not saved");
    for (guint i = 0; i < left->len; i++) {
        const StudioLeft *what = g_ptr_array_index(left, i);
        GtkWidget *row = make_row(what->name != NULL ? what->name : "A plant",
                                  "Not saved when the studio ended", "document-revert-symbolic");
        gtk_list_box_row_set_activatable(GTK_LIST_BOX_ROW(row), FALSE);
        Left from = {window, left, i, row};
        add_left_button(row, "Recover", G_CALLBACK(on_restore), from);
        add_left_button(row, "Discard", G_CALLBACK(on_discard), from);
        gtk_list_box_append(GTK_LIST_BOX(list), row);
    }
    g_ptr_array_unref(left);
    return list;
}

// ---- the page ----------------------------------------------------------------------------------

GtkWidget *studio_welcome_new(StudioWindow *window) {
    GtkWidget *side = gtk_box_new(GTK_ORIENTATION_VERTICAL, 12);
    gtk_widget_set_size_request(side, 300, -1);
    GtkWidget *left = make_left(window);
    if (left != NULL) {
        gtk_box_append(GTK_BOX(side), heading("Unsaved work"));
        gtk_box_append(GTK_BOX(side), left);
    }
    gtk_box_append(GTK_BOX(side), heading("Go on with"));
    gtk_box_append(GTK_BOX(side), make_recent(window));
    GtkWidget *main = gtk_box_new(GTK_ORIENTATION_VERTICAL, 12);
    gtk_widget_set_hexpand(main, TRUE);
    GtkWidget *presets = studio_preset_cards_new();
    g_signal_connect(presets, "chosen", G_CALLBACK(begin_preset), window);
    gtk_box_append(GTK_BOX(main), presets);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 32);
    gtk_widget_add_css_class(box, "welcome");
    gtk_box_append(GTK_BOX(box), side);
    gtk_box_append(GTK_BOX(box), main);
    GtkWidget *clamp = adw_clamp_new();
    adw_clamp_set_maximum_size(ADW_CLAMP(clamp), 1400);
    adw_clamp_set_child(ADW_CLAMP(clamp), box);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), clamp);
    gtk_widget_set_vexpand(scrolled, TRUE);
    return scrolled;
}
