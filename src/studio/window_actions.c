/// What a window does when told to: every command is an action, so that menus, keys and tests use
/// the same way.
#include "studio/model/removal.h"
#include "studio/model/scene_edit.h"
#include "studio/views_menu.h"
#include "studio/widgets.h"
#include "studio/window_private.h"

#include <math.h>
#include <string.h>

// ---- files -------------------------------------------------------------------------------------

static GtkFileFilter *document_filter(void) {
    GtkFileFilter *filter = gtk_file_filter_new();
    gtk_file_filter_set_name(filter, "Plants (.frond, .l)");
    gtk_file_filter_add_pattern(filter, "*.frond");
    gtk_file_filter_add_pattern(filter, "*.l");
    return filter;
}

static void on_open_response(GtkNativeDialog *dialog, int response, StudioWindow *window) {
    char *path = studio_chosen_path(dialog, response);
    if (path != NULL) {
        studio_window_open(window, path);
    }
    g_free(path);
    g_object_unref(dialog);
}

static void do_open(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(
        "Open a Plant", GTK_WINDOW(window), GTK_FILE_CHOOSER_ACTION_OPEN, "_Open", "_Cancel");
    GtkFileFilter *filter = document_filter();
    gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(dialog), filter);
    g_object_unref(filter);
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    g_signal_connect(dialog, "response", G_CALLBACK(on_open_response), window);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}

static bool save_to(StudioWindow *window, const char *path) {
    FrDiags *diags = fr_diags_new();
    FrStatus status = studio_recovery_save(window->recovery, path, diags);
    if (status == FR_OK) {
        studio_settings_add_recent(window->settings, studio_document_path(window->document));
        bool is_whole = fr_diags_count(diags) == 0;
        studio_window_say(window, "Saved %s%s%s", studio_document_name(window->document),
                          is_whole ? "" : ", but ", is_whole ? "" : fr_diags_get(diags, 0)->text);
    } else {
        studio_window_say(window, "%s", fr_diags_get(diags, 0)->text);
    }
    fr_diags_free(diags);
    return status == FR_OK;
}

static void on_save_response(GtkNativeDialog *dialog, int response, StudioWindow *window) {
    char *path = studio_chosen_path(dialog, response);
    if (path != NULL) {
        char *whole =
            g_str_has_suffix(path, ".frond") ? g_strdup(path) : g_strconcat(path, ".frond", NULL);
        save_to(window, whole);
        g_free(whole);
    }
    g_free(path);
    g_object_unref(dialog);
}

static void do_save_as(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioWindow *window = data;
    if (parameter != NULL && *g_variant_get_string(parameter, NULL) != '\0') {
        save_to(window, g_variant_get_string(parameter, NULL));
        return;
    }
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(
        "Save the Plant", GTK_WINDOW(window), GTK_FILE_CHOOSER_ACTION_SAVE, "_Save", "_Cancel");
    const char *name = studio_document_name(window->document);
    char *whole =
        g_str_has_suffix(name, ".frond") ? g_strdup(name) : g_strconcat(name, ".frond", NULL);
    gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(dialog), whole);
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    g_signal_connect(dialog, "response", G_CALLBACK(on_save_response), window);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
    g_free(whole);
}

static void do_save(GSimpleAction *action, GVariant *parameter, gpointer data) {
    StudioWindow *window = data;
    (void)parameter;
    if (studio_document_path(window->document) == NULL) {
        do_save_as(action, NULL, data);
    } else {
        save_to(window, NULL);
    }
}

static void do_new(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    AdwApplication *application = ADW_APPLICATION(gtk_window_get_application(GTK_WINDOW(window)));
    gtk_window_present(GTK_WINDOW(studio_window_new(application, window->settings)));
}

static void do_screenshot(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_ask_picture(data);
}

// ---- edits -------------------------------------------------------------------------------------

static void do_undo(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_document_undo(((StudioWindow *)data)->document);
}

static void do_redo(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_document_redo(((StudioWindow *)data)->document);
}

const char *studio_window_component(StudioWindow *window) {
    uint32_t element = studio_window_selected(window);
    const FrContents *contents = studio_document_contents(window->document);
    return element != FR_NONE && fr_contents_at(contents, element)->component >= 0
               ? fr_contents_at(contents, element)->id
               : NULL;
}

void studio_window_select_component(StudioWindow *window, const char *id) {
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t graph = studio_graph_of(window->document, studio_window_plant(window));
    studio_window_select(
        window, graph == FR_NONE || id == NULL ? FR_NONE : fr_contents_find(contents, graph, id));
}

static void do_add(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioWindow *window = data;
    const char *name = g_variant_get_string(parameter, NULL);
    for (int kind = 0; kind < FR_COMPONENT_COUNT; kind++) {
        char *id = NULL;
        char *on = g_strdup(studio_window_component(window));
        if (strcmp(fr_pgraph_table((FrComponentKind)kind)->element, name) == 0 &&
            studio_add_component(window->document, studio_window_plant(window),
                                 (FrComponentKind)kind, on, &id)) {
            studio_window_select_component(window, id);
        }
        g_free(on);
        g_free(id);
    }
}

static void do_remove(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    uint32_t element = studio_window_selected(window);
    if (element == FR_NONE || element == 0) {
        return;
    }
    char *id = g_strdup(studio_window_component(window));
    char *words = studio_removal_words(window->document, element);
    studio_window_select(window, FR_NONE); // else what follows it would take its number
    if (id != NULL ? studio_remove_component(window->document, studio_window_plant(window), id)
                   : studio_take_out(window->document, &element, 1, NULL)) {
        studio_window_say_removed(window, words);
    }
    g_free(words);
    g_free(id);
}

static void do_duplicate(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    char *id = g_strdup(studio_window_component(window)), *copy = NULL;
    if (id != NULL && studio_duplicate_component(window->document, studio_window_plant(window), id,
                                                 true, &copy)) {
        studio_window_select_component(window, copy);
    }
    g_free(copy);
    g_free(id);
}

static void do_toggle_enabled(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    char *id = g_strdup(studio_window_component(window));
    if (id != NULL) {
        const FrContents *contents = studio_document_contents(window->document);
        char *enabled = fr_contents_get(contents, studio_window_selected(window), "enabled");
        studio_enable_component(window->document, studio_window_plant(window), id,
                                g_strcmp0(enabled, "no") == 0);
        g_free(enabled);
    }
    g_free(id);
}

static void do_roll(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    uint32_t plant = studio_window_plant(window);
    if (plant != FR_NONE) {
        char seed[16];
        g_snprintf(seed, sizeof seed, "%u", g_random_int_range(1, 1000000));
        studio_set(window->document, plant, "seed", seed, false);
    }
}

static void do_prune(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_edit_picked(data, "prune", "Prune %s");
}

static void do_hide(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_edit_picked(data, "hide", "Hide %s");
}

// An element by its place, or the first that is called so; FR_NONE.
static uint32_t find_element(StudioWindow *window, const char *name) {
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t element = studio_place_find(contents, name);
    return element != FR_NONE ? element : fr_contents_find(contents, 0, name);
}

// `element.attribute=value`: for tests and scripts.
static void do_set(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioWindow *window = data;
    char **parts = g_strsplit(g_variant_get_string(parameter, NULL), "=", 2);
    char *dot = parts[0] == NULL ? NULL : strrchr(parts[0], '.');
    if (dot != NULL && parts[1] != NULL) {
        *dot = '\0';
        uint32_t element = find_element(window, parts[0]);
        if (element != FR_NONE) {
            studio_set(window->document, element, dot + 1, parts[1], false);
        }
    }
    g_strfreev(parts);
}

// The keyboard goes on in the inspector.
static void do_inspect(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    studio_window_ask_pane(window, STUDIO_PANE_INSPECTOR);
    gtk_widget_child_focus(gtk_widget_get_parent(GTK_WIDGET(window->inspector)),
                           GTK_DIR_TAB_FORWARD);
}

static void do_select(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioWindow *window = data;
    studio_window_select(window, find_element(window, g_variant_get_string(parameter, NULL)));
}

// ---- the view ----------------------------------------------------------------------------------

static void do_frame(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    if (!studio_frame_selected(window)) {
        studio_viewport_frame_all(window->viewport);
    }
}

static void do_zoom(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    studio_viewport_move(((StudioWindow *)data)->viewport, 0, 0, g_variant_get_double(parameter));
}

static void do_mode(GSimpleAction *action, GVariant *state, gpointer data) {
    static const char *const modes[] = {"shaded", "wireframe", "skeleton"};
    StudioWindow *window = data;
    for (int i = 0; i < 3; i++) {
        if (strcmp(g_variant_get_string(state, NULL), modes[i]) == 0) {
            studio_viewport_display(window->viewport)->mode = (StudioMode)i;
            studio_viewport_update(window->viewport);
            g_simple_action_set_state(action, state);
        }
    }
}

static void do_display(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioWindow *window = data;
    StudioDisplay *display = studio_viewport_display(window->viewport);
    const char *name = g_action_get_name(G_ACTION(action));
    bool is_on = g_variant_get_boolean(state);
    *(strcmp(name, "grid") == 0     ? &display->has_grid
      : strcmp(name, "shadow") == 0 ? &display->has_shadow
                                    : &display->has_occlusion) = is_on;
    studio_settings_set_bool(window->settings, name, is_on);
    studio_viewport_update(window->viewport);
    g_simple_action_set_state(action, state);
}

static void do_side(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioWindow *window = data;
    studio_window_ask_pane(window, STUDIO_PANE_SIDE);
    gtk_stack_set_visible_child_name(GTK_STACK(window->side),
                                     g_variant_get_string(parameter, NULL));
}

// ---- the rest ----------------------------------------------------------------------------------

static void do_export(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_export(data, NULL);
}

static void do_export_to(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    studio_window_export_to(data, NULL, g_variant_get_string(parameter, NULL));
}

static void do_preferences(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_show_preferences(data);
}

static void do_shortcuts(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_show_shortcuts(data);
}

static void do_about(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_show_about(data);
}

static void do_help(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioWindow *window = data;
    char *page = studio_manual_page("studio.md");
    char *uri = page == NULL ? NULL : g_filename_to_uri(page, NULL, NULL);
    if (uri != NULL) {
        gtk_show_uri(GTK_WINDOW(window), uri, GDK_CURRENT_TIME);
    } else {
        studio_window_say(window, "The manual is not installed");
    }
    g_free(uri);
    g_free(page);
}

static void do_problem(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_window_show_problem(data);
}

void studio_window_add_actions(StudioWindow *window) {
    static const GActionEntry entries[] = {
        {.name = "open", .activate = do_open},
        {.name = "new", .activate = do_new},
        {.name = "save", .activate = do_save},
        {.name = "save-as", .activate = do_save_as},
        {.name = "save-to", .activate = do_save_as, .parameter_type = "s"},
        {.name = "export", .activate = do_export},
        {.name = "export-to", .activate = do_export_to, .parameter_type = "s"},
        {.name = "screenshot", .activate = do_screenshot},
        {.name = "undo", .activate = do_undo},
        {.name = "redo", .activate = do_redo},
        {.name = "add", .activate = do_add, .parameter_type = "s"},
        {.name = "remove", .activate = do_remove},
        {.name = "duplicate", .activate = do_duplicate},
        {.name = "toggle-enabled", .activate = do_toggle_enabled},
        {.name = "roll", .activate = do_roll},
        {.name = "prune", .activate = do_prune},
        {.name = "hide", .activate = do_hide},
        {.name = "set", .activate = do_set, .parameter_type = "s"},
        {.name = "select", .activate = do_select, .parameter_type = "s"},
        {.name = "inspect", .activate = do_inspect},
        {.name = "frame", .activate = do_frame},
        {.name = "zoom", .activate = do_zoom, .parameter_type = "d"},
        {.name = "mode", .parameter_type = "s", .state = "'shaded'", .change_state = do_mode},
        {.name = "grid", .state = "true", .change_state = do_display},
        {.name = "shadow", .state = "true", .change_state = do_display},
        {.name = "occlusion", .state = "true", .change_state = do_display},
        {.name = "side", .activate = do_side, .parameter_type = "s"},
        {.name = "problem", .activate = do_problem},
        {.name = "preferences", .activate = do_preferences},
        {.name = "shortcuts", .activate = do_shortcuts},
        {.name = "help", .activate = do_help},
        {.name = "about", .activate = do_about},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);
}

static void enable(StudioWindow *window, const char *name, bool is_enabled) {
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), name);
    g_simple_action_set_enabled(G_SIMPLE_ACTION(action), is_enabled);
}

static void set_tip(GtkWidget *button, const char *verb, const char *step) {
    char *tip = step == NULL ? g_strdup(verb) : g_strdup_printf("%s: %s", verb, step);
    gtk_widget_set_tooltip_text(button, tip);
    g_free(tip);
}

void studio_window_update_actions(StudioWindow *window) {
    static const char *const always[] = {
        "save-as",   "save-to", "export", "export-to",  "screenshot",   "prune", "hide",
        "set",       "select",  "frame",  "zoom",       "mode",         "grid",  "shadow",
        "occlusion", "side",    "sketch", "export-one", "export-one-to"};
    StudioDocument *document = window->document;
    bool is_there = document != NULL;
    for (size_t i = 0; i < G_N_ELEMENTS(always); i++) {
        enable(window, always[i], is_there);
    }
    const char *undo = is_there ? studio_document_undo_name(document) : NULL;
    const char *redo = is_there ? studio_document_redo_name(document) : NULL;
    enable(window, "undo", undo != NULL);
    enable(window, "redo", redo != NULL);
    set_tip(window->undo, "Undo", undo);
    set_tip(window->redo, "Redo", redo);
    enable(window, "save",
           is_there &&
               (!studio_document_is_saved(document) || studio_document_path(document) == NULL));
    bool has_panes = is_there && !studio_window_is_sketching(window);
    enable(window, "show-panel", has_panes);
    enable(window, "show-inspector", has_panes);
    bool is_whole = is_there && !studio_document_is_broken(document) &&
                    studio_document_contents(document) != NULL;
    uint32_t plant = is_whole ? studio_window_plant(window) : FR_NONE;
    enable(window, "roll", plant != FR_NONE);
    bool has_graph = plant != FR_NONE && studio_graph_of(document, plant) != FR_NONE;
    static const char *const adding[] = {"add", "insert-preset", "insert-preset-on",
                                         "insert-preset-named", "paste-part"};
    for (size_t i = 0; i < G_N_ELEMENTS(adding); i++) {
        enable(window, adding[i], has_graph);
    }
    bool has_component = is_whole && studio_window_component(window) != NULL;
    enable(window, "save-preset", has_component);
    enable(window, "save-preset-as", has_component);
    enable(window, "copy-part", has_component);
    enable(window, "duplicate", has_component);
    enable(window, "toggle-enabled", has_component);
    enable(window, "remove", is_there && studio_window_selected(window) != FR_NONE);
}
