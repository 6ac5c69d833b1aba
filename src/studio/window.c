#include "studio/window_private.h"

#include "studio/accessible.h"
#include "studio/wind_menu.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

enum { AUTOSAVE_SECONDS = 4 };

G_DEFINE_TYPE(StudioWindow, studio_window, ADW_TYPE_APPLICATION_WINDOW)

// ---- what is shown -----------------------------------------------------------------------------

// Over the picture they leave the strip for time free.
static StudioMessages *messages_in_sight(StudioWindow *window) {
    const char *shown = gtk_stack_get_visible_child_name(GTK_STACK(window->stack));
    return g_strcmp0(shown, "document") == 0 ? window->over_picture : window->over_all;
}

void studio_window_say(StudioWindow *window, const char *format, ...) {
    va_list list;
    va_start(list, format);
    char *text = g_strdup_vprintf(format, list);
    va_end(list);
    studio_messages_say(messages_in_sight(window), text, false);
    g_free(text);
}

void studio_window_say_removed(StudioWindow *window, const char *text) {
    studio_messages_say(messages_in_sight(window), text, true);
}

void studio_window_on_said(GObject *panel, const char *text, StudioWindow *window) {
    (void)panel;
    studio_window_say(window, "%s", text);
}

uint32_t studio_window_selected(const StudioWindow *window) {
    return window->document == NULL
               ? FR_NONE
               : studio_place_find(studio_document_contents(window->document), window->selected);
}

uint32_t studio_window_plant(const StudioWindow *window) {
    return window->document == NULL
               ? FR_NONE
               : studio_place_find(studio_document_contents(window->document), window->plant);
}

// The graph shows the plant around what is selected, else the one it showed, else the first.
static void follow_plant(StudioWindow *window) {
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t plant = studio_place_plant(contents, studio_window_selected(window));
    if (plant == FR_NONE) {
        plant = studio_window_plant(window);
    }
    if (plant == FR_NONE && contents != NULL) {
        plant = fr_contents_child(contents, 0, "plant");
    }
    g_free(window->plant);
    window->plant = plant == FR_NONE ? NULL : studio_place_of(contents, plant);
}

static void update_panels(StudioWindow *window) {
    if (studio_document_contents(window->document) == NULL) {
        studio_time_strip_show(window->strip, window->document, FR_NONE, FR_NONE);
        return; // it was never well-formed: the text alone can be shown
    }
    follow_plant(window);
    uint32_t selected = studio_window_selected(window);
    studio_graph_panel_show(window->graph, window->document, studio_window_plant(window), selected);
    studio_things_panel_show(window->things, window->document, selected);
    studio_inspector_show(window->inspector, window->document, selected, window->diags);
    studio_levels_panel_show(window->levels, window->document, selected,
                             studio_window_plant(window));
    studio_time_strip_show(window->strip, window->document, studio_window_plant(window), selected);
    studio_light_mode_update(window->light);
    studio_scene_tool_update(window->scene);
    studio_patch_mode_update(window->patch);
}

void studio_window_select(StudioWindow *window, uint32_t element) {
    g_free(window->selected);
    window->selected = element == FR_NONE
                           ? NULL
                           : studio_place_of(studio_document_contents(window->document), element);
    studio_window_unpick(window);
    update_panels(window);
    studio_window_show_texts(window);
    studio_window_update_actions(window);
}

// A plant that is an L-system shows its text instead of a graph.
void studio_window_show_texts(StudioWindow *window) {
    studio_text_panel_show(window->text, window->document, FR_NONE, window->diags);
    const FrContents *contents = studio_document_contents(window->document);
    uint32_t plant = studio_window_plant(window);
    uint32_t lsystem = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "lsystem");
    bool has_graph = plant != FR_NONE && studio_graph_of(window->document, plant) != FR_NONE;
    GtkStack *side = GTK_STACK(window->side);
    gtk_stack_page_set_visible(
        gtk_stack_get_page(side, gtk_stack_get_child_by_name(side, "lsystem")), lsystem != FR_NONE);
    gtk_stack_page_set_visible(gtk_stack_get_page(side, GTK_WIDGET(window->graph)), has_graph);
    if (lsystem != FR_NONE) {
        studio_text_panel_show(window->lsystem, window->document, lsystem, window->diags);
    }
    studio_string_panel_update(window->string);
}

static void update_title(StudioWindow *window) {
    const char *name =
        window->document == NULL ? "Frond Studio" : studio_document_name(window->document);
    bool is_saved = window->document == NULL || studio_document_is_saved(window->document);
    char *title = g_strdup_printf("%s%s", is_saved ? "" : "• ", name);
    adw_window_title_set_title(window->title, title);
    const char *path = window->document == NULL ? NULL : studio_document_path(window->document);
    char *folder = path == NULL ? NULL : g_path_get_dirname(path);
    const char *home = g_get_home_dir();
    char *shown = folder != NULL && g_str_has_prefix(folder, home)
                      ? g_strconcat("~", folder + strlen(home), NULL)
                      : g_strdup(folder != NULL             ? folder
                                 : window->document != NULL ? "Not saved yet"
                                                            : "");
    adw_window_title_set_subtitle(window->title, shown);
    gtk_window_set_title(GTK_WINDOW(window), title);
    g_free(shown);
    g_free(folder);
    g_free(title);
}

// ---- what is wrong -----------------------------------------------------------------------------

void studio_window_update_problem(StudioWindow *window) {
    const FrDiag *worst = NULL;
    for (size_t i = 0; window->diags != NULL && i < fr_diags_count(window->diags); i++) {
        const FrDiag *diag = fr_diags_get(window->diags, i);
        if (diag->severity != FR_NOTE && (worst == NULL || diag->severity > worst->severity)) {
            worst = diag;
        }
    }
    studio_window_reveal(window->problem, worst != NULL);
    if (worst == NULL) {
        return;
    }
    char *text = g_strdup(worst->text);
    text[0] = g_ascii_toupper(text[0]);
    gtk_label_set_text(GTK_LABEL(window->problem_text), text);
    gtk_widget_set_tooltip_text(window->problem_text, text);
    if (worst->severity == FR_ERROR) {
        gtk_widget_add_css_class(window->problem, "error-bar");
    } else {
        gtk_widget_remove_css_class(window->problem, "error-bar");
    }
    g_free(text);
}

void studio_window_show_problem(StudioWindow *window) {
    const FrContents *contents =
        window->document == NULL ? NULL : studio_document_contents(window->document);
    if (window->diags == NULL || fr_diags_count(window->diags) == 0 || contents == NULL) {
        return;
    }
    FrSpan span = fr_diags_get(window->diags, 0)->span;
    char *attribute = NULL;
    uint32_t element =
        span.source == NULL ? FR_NONE : fr_contents_around(contents, span.begin, &attribute);
    if (element != FR_NONE && attribute != NULL) {
        studio_window_ask_pane(window, STUDIO_PANE_INSPECTOR);
        studio_window_select(window, element);
        studio_levels_panel_open(window->levels);
        studio_inspector_reveal(window->inspector, attribute);
    } else {
        studio_window_ask_pane(window, STUDIO_PANE_SIDE);
        gtk_stack_set_visible_child_name(GTK_STACK(window->side), "text");
        studio_text_panel_go(window->text, span.begin);
    }
    g_free(attribute);
}

// ---- documents ---------------------------------------------------------------------------------

static void on_document_changed(void *user) {
    StudioWindow *window = user;
    studio_messages_forget_undo(window->over_picture);
    studio_messages_forget_undo(window->over_all);
    update_title(window);
    update_panels(window);
    studio_window_show_texts(window);
    studio_window_update_actions(window);
    if (studio_window_is_sketching(window)) {
        studio_sketch_panel_follow(window->sketch);
    } else {
        studio_window_request(window);
    }
}

static gboolean on_autosave(gpointer data) {
    StudioWindow *window = data;
    if (window->recovery != NULL) {
        studio_recovery_update(window->recovery);
    }
    return G_SOURCE_CONTINUE;
}

static void drop_document(StudioWindow *window) {
    g_clear_pointer(&window->recovery, studio_recovery_free);
    if (window->document != NULL && window->settings != NULL) {
        studio_window_forget_sketch(window);
        studio_text_panel_forget(window->text);
        studio_text_panel_forget(window->lsystem);
    }
    if (window->document != NULL) {
        studio_document_unwatch(window->document, on_document_changed, window);
        g_clear_pointer(&window->document, studio_document_free);
    }
    g_clear_pointer(&window->diags, fr_diags_free);
    if (window->picked.lines != NULL) {
        studio_picked_clear(&window->picked);
        window->picked = (StudioPicked){0};
    }
}

void studio_window_take(StudioWindow *window, StudioDocument *document) {
    drop_document(window);
    window->document = document;
    window->moment = (StudioMoment){NAN, -1};
    studio_inspector_show(window->inspector, document, FR_NONE, NULL);
    studio_levels_panel_show(window->levels, document, FR_NONE, FR_NONE);
    studio_inspector_set_time(window->inspector, NAN);
    studio_time_strip_reset(window->strip);
    g_clear_pointer(&window->selected, g_free);
    g_clear_pointer(&window->plant, g_free);
    studio_document_watch(document, on_document_changed, window);
    char *folder = studio_recovery_folder();
    window->recovery = studio_recovery_new(folder, document);
    g_free(folder);
    if (studio_document_path(document) != NULL) {
        studio_settings_add_recent(window->settings, studio_document_path(document));
    }
    gtk_stack_set_visible_child_name(GTK_STACK(window->stack), "document");
    for (size_t i = 0; i < G_N_ELEMENTS(window->welcome_hidden); i++) {
        gtk_widget_set_visible(window->welcome_hidden[i], TRUE);
    }
    studio_viewport_forget(window->viewport);
    gtk_widget_set_visible(window->amount, FALSE);
    studio_describe(GTK_WIDGET(window->viewport), "");
    studio_scene_tool_reset(window->scene);
    studio_window_unpick(window);
    const FrContents *contents = studio_document_contents(document);
    uint32_t plant = contents == NULL ? FR_NONE : fr_contents_child(contents, 0, "plant");
    bool has_graph = plant != FR_NONE && studio_graph_of(document, plant) != FR_NONE;
    bool has_lsystem = plant != FR_NONE && fr_contents_child(contents, plant, "lsystem") != FR_NONE;
    const char *page = contents == NULL ? "text"
                       : has_graph      ? "graph"
                       : has_lsystem    ? "lsystem"
                                        : "things";
    studio_window_start_builder(window);
    on_document_changed(window);
    gtk_stack_set_visible_child_name(GTK_STACK(window->side), page);
    gtk_widget_grab_focus(GTK_WIDGET(window->viewport));
}

static void report(StudioWindow *window, const char *heading, const FrDiags *diags) {
    const char *text = fr_diags_count(diags) > 0 ? fr_diags_get(diags, 0)->text : "";
    GtkWidget *dialog = adw_message_dialog_new(GTK_WINDOW(window), heading, text);
    adw_message_dialog_add_response(ADW_MESSAGE_DIALOG(dialog), "close", "_Close");
    gtk_window_present(GTK_WINDOW(dialog));
}

bool studio_window_open(StudioWindow *window, const char *path) {
    FrDiags *diags = fr_diags_new();
    StudioDocument *document;
    FrStatus status = studio_document_open(path, diags, &document);
    if (status == FR_OK && window->document != NULL) {
        AdwApplication *application =
            ADW_APPLICATION(gtk_window_get_application(GTK_WINDOW(window)));
        StudioWindow *other = studio_window_new(application, window->settings);
        gtk_window_present(GTK_WINDOW(other));
        studio_window_take(other, document);
    } else if (status == FR_OK) {
        studio_window_take(window, document);
    } else {
        report(window, "This document cannot be opened", diags);
    }
    fr_diags_free(diags);
    return status == FR_OK;
}

StudioDocument *studio_window_document(StudioWindow *window) {
    return window->document;
}

static gboolean on_close(GtkWindow *self, gpointer data) {
    (void)data;
    StudioWindow *window = STUDIO_WINDOW(self);
    if (window->document == NULL || studio_document_is_saved(window->document) ||
        window->is_closing) {
        return FALSE;
    }
    studio_window_ask_and_close(window);
    return TRUE;
}

// ---- life --------------------------------------------------------------------------------------

static void remember_sizes(StudioWindow *window) {
    int width, height;
    gtk_window_get_default_size(GTK_WINDOW(window), &width, &height);
    studio_settings_set_int(window->settings, "width", width);
    studio_settings_set_int(window->settings, "height", height);
    studio_settings_set_bool(window->settings, "maximized",
                             gtk_window_is_maximized(GTK_WINDOW(window)));
    if (window->document != NULL) {
        int sketch[2];
        studio_sketch_panel_get_widths(window->sketch, sketch);
        studio_settings_set_int(window->settings, "sketch-width", sketch[0]);
        studio_settings_set_int(window->settings, "sketch-board-width", sketch[1]);
        studio_window_remember_panes(window);
    }
    studio_settings_save(window->settings);
}

static void studio_window_dispose(GObject *object) {
    StudioWindow *window = STUDIO_WINDOW(object);
    if (window->settings != NULL) {
        remember_sizes(window);
        window->settings = NULL;
    }
    g_clear_handle_id(&window->autosave, g_source_remove);
    g_clear_handle_id(&window->progress, g_source_remove);
    if (window->builder != NULL) {
        studio_swatches_set_builder(studio_inspector_swatches(window->inspector), NULL);
    }
    g_clear_pointer(&window->builder, studio_builder_free);
    while (g_idle_remove_by_data(window)) {
    }
    g_clear_pointer(&window->light, studio_light_mode_free);
    g_clear_pointer(&window->patch, studio_patch_mode_free);
    g_clear_pointer(&window->string, studio_string_panel_free);
    drop_document(window);
    g_clear_pointer(&window->over_picture, studio_messages_free);
    g_clear_pointer(&window->over_all, studio_messages_free);
    g_clear_pointer(&window->selected, g_free);
    g_clear_pointer(&window->plant, g_free);
    G_OBJECT_CLASS(studio_window_parent_class)->dispose(object);
}

// Its widgets, which hold on to the tools, have gone.
static void studio_window_finalize(GObject *object) {
    studio_scene_tool_free(STUDIO_WINDOW(object)->scene);
    G_OBJECT_CLASS(studio_window_parent_class)->finalize(object);
}

static void studio_window_class_init(StudioWindowClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_window_finalize;
    G_OBJECT_CLASS(class)->dispose = studio_window_dispose;
}

static void studio_window_init(StudioWindow *window) {
    window->moment = window->asked_moment = (StudioMoment){NAN, -1};
    g_signal_connect(window, "close-request", G_CALLBACK(on_close), NULL);
}

StudioWindow *studio_window_new(AdwApplication *application, StudioSettings *settings) {
    StudioWindow *window = g_object_new(STUDIO_TYPE_WINDOW, "application", application, NULL);
    window->settings = settings;
    window->stack = gtk_stack_new();
    window->over_all = studio_messages_new(window->stack);
    studio_window_add_actions(window);
    studio_window_add_preset_actions(window);
    studio_wind_add_actions(window);
    studio_window_add_cancel(window);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(box), studio_window_make_header(window));
    gtk_box_append(GTK_BOX(box), studio_messages_widget(window->over_all));
    gtk_stack_add_named(GTK_STACK(window->stack), studio_welcome_new(window), "welcome");
    gtk_stack_add_named(GTK_STACK(window->stack), studio_window_make_panes(window), "document");
    studio_window_add_sketch(window);
    adw_application_window_set_content(ADW_APPLICATION_WINDOW(window), box);
    gtk_window_set_default_size(GTK_WINDOW(window), studio_settings_int(settings, "width", 1440),
                                studio_settings_int(settings, "height", 900));
    if (studio_settings_bool(settings, "maximized", false)) {
        gtk_window_maximize(GTK_WINDOW(window));
    }
    window->autosave = g_timeout_add_seconds(AUTOSAVE_SECONDS, on_autosave, window);
    update_title(window);
    studio_window_update_actions(window);
    return window;
}
