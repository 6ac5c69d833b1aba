/// Preferences, shortcuts, about, and the question before something is lost.
#include "studio/accessible.h"
#include "studio/model/graph.h"
#include "studio/window_private.h"

#include <string.h>

// ---- preferences -------------------------------------------------------------------------------

static void on_dark(GObject *toggle, GParamSpec *spec, StudioWindow *window) {
    (void)spec;
    bool is_dark = gtk_switch_get_active(GTK_SWITCH(toggle));
    studio_settings_set_bool(window->settings, "dark", is_dark);
    adw_style_manager_set_color_scheme(adw_style_manager_get_default(),
                                       is_dark ? ADW_COLOR_SCHEME_FORCE_DARK
                                               : ADW_COLOR_SCHEME_FORCE_LIGHT);
    studio_viewport_display(window->viewport)->is_dark = is_dark;
    studio_viewport_update(window->viewport);
}

static GtkWidget *switch_row(const char *title, const char *subtitle, GtkWidget **toggle) {
    GtkWidget *row = adw_action_row_new();
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row), subtitle);
    *toggle = gtk_switch_new();
    gtk_widget_set_valign(*toggle, GTK_ALIGN_CENTER);
    studio_name(*toggle, title);
    studio_describe(*toggle, subtitle);
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), *toggle);
    adw_action_row_set_activatable_widget(ADW_ACTION_ROW(row), *toggle);
    return row;
}

static GtkWidget *display_row(const char *title, const char *subtitle, const char *action) {
    GtkWidget *toggle;
    GtkWidget *row = switch_row(title, subtitle, &toggle);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(toggle), action);
    return row;
}

static void on_budget(GtkSpinButton *button, StudioWindow *window) {
    const char *name = gtk_widget_get_name(GTK_WIDGET(button)); // that of the setting
    studio_settings_set_int(window->settings, name, gtk_spin_button_get_value_as_int(button));
    studio_graph_panel_set_budget(window->graph, studio_window_budget(window));
}

static GtkWidget *budget_row(StudioWindow *window, const char *setting, const char *title,
                             const char *subtitle, int usual, double step) {
    GtkWidget *row = adw_action_row_new(), *button = gtk_spin_button_new_with_range(0, 1e9, step);
    adw_preferences_row_set_title(ADW_PREFERENCES_ROW(row), title);
    adw_action_row_set_subtitle(ADW_ACTION_ROW(row), subtitle);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(button),
                              studio_settings_int(window->settings, setting, usual));
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    gtk_widget_set_name(button, setting);
    studio_name(button, title);
    adw_action_row_add_suffix(ADW_ACTION_ROW(row), button);
    adw_action_row_set_activatable_widget(ADW_ACTION_ROW(row), button);
    g_signal_connect(button, "value-changed", G_CALLBACK(on_budget), window);
    return row;
}

void studio_window_show_preferences(StudioWindow *window) {
    GtkWidget *dialog = adw_preferences_window_new();
    GtkWidget *page = adw_preferences_page_new();
    adw_preferences_page_set_title(ADW_PREFERENCES_PAGE(page), "Preferences");
    adw_preferences_page_set_icon_name(ADW_PREFERENCES_PAGE(page), "preferences-system-symbolic");
    adw_preferences_window_set_search_enabled(ADW_PREFERENCES_WINDOW(dialog), FALSE);
    GtkWidget *look = adw_preferences_group_new(), *picture = adw_preferences_group_new();
    adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(look), "Appearance");
    adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(picture), "Picture");
    GtkWidget *dark;
    adw_preferences_group_add(ADW_PREFERENCES_GROUP(look),
                              switch_row("Dark", "Plants stand out on a dark ground", &dark));
    gtk_switch_set_active(GTK_SWITCH(dark), studio_settings_bool(window->settings, "dark", true));
    g_signal_connect(dark, "notify::active", G_CALLBACK(on_dark), window);
    gtk_widget_set_visible(picture, window->document != NULL);
    GtkWidget *graph = adw_preferences_group_new();
    adw_preferences_group_set_title(ADW_PREFERENCES_GROUP(graph), "Graph");
    adw_preferences_group_add(ADW_PREFERENCES_GROUP(graph),
                              budget_row(window, "budget", "Budget",
                                         "Components with more instances are amber; 0: none is",
                                         STUDIO_USUAL_BUDGET, 50000));
    adw_preferences_group_add(ADW_PREFERENCES_GROUP(graph),
                              budget_row(window, "budget-time", "Time budget",
                                         "So are those that take more milliseconds; 0: none is",
                                         STUDIO_USUAL_MILLISECONDS, 10));
    if (window->document != NULL) {
        gtk_widget_insert_action_group(dialog, "win", G_ACTION_GROUP(window));
        adw_preferences_group_add(
            ADW_PREFERENCES_GROUP(picture),
            display_row("Grid", "A floor with lines a step apart", "win.grid"));
        adw_preferences_group_add(
            ADW_PREFERENCES_GROUP(picture),
            display_row("Shadows", "The sun's, as the scene has it", "win.shadow"));
        adw_preferences_group_add(
            ADW_PREFERENCES_GROUP(picture),
            display_row("Ambient occlusion", "Darker where much is near", "win.occlusion"));
    }
    adw_preferences_page_add(ADW_PREFERENCES_PAGE(page), ADW_PREFERENCES_GROUP(look));
    adw_preferences_page_add(ADW_PREFERENCES_PAGE(page), ADW_PREFERENCES_GROUP(picture));
    adw_preferences_page_add(ADW_PREFERENCES_PAGE(page), ADW_PREFERENCES_GROUP(graph));
    adw_preferences_window_add(ADW_PREFERENCES_WINDOW(dialog), ADW_PREFERENCES_PAGE(page));
    gtk_window_set_transient_for(GTK_WINDOW(dialog), GTK_WINDOW(window));
    gtk_window_set_modal(GTK_WINDOW(dialog), TRUE);
    gtk_window_present(GTK_WINDOW(dialog));
}

// ---- shortcuts ---------------------------------------------------------------------------------

static const char shortcuts[] =
    "<interface><object class='GtkShortcutsWindow' id='window'><property name='modal'>1</property>"
    "<child><object class='GtkShortcutsSection'><property name='section-name'>all</property>"
    "%s</object></child></object></interface>";

typedef struct Shortcut {
    const char *group, *keys, *title; ///< `group` NULL: as before; `keys`, or the action they do
} Shortcut;

static const Shortcut rows[] = {
    {"Document", "win.new", "New window"},
    {NULL, "win.open", "Open"},
    {NULL, "win.save", "Save"},
    {NULL, "win.save-as", "Save as"},
    {NULL, "win.export", "Export"},
    {NULL, "win.export-one", "Export the plant that is chosen"},
    {NULL, "win.screenshot", "Save the picture"},
    {NULL, "win.undo", "Undo"},
    {NULL, "win.redo", "Redo"},
    {NULL, "win.problem", "Go to the first problem"},
    {NULL, "window.close", "Close the window"},
    {NULL, "app.quit", "Quit"},
    {"Components", "win.duplicate", "Duplicate"},
    {NULL, "<Control>c", "Copy with all beneath it"},
    {NULL, "<Control>v", "Paste onto the selected one"},
    {NULL, "Delete", "Remove"},
    {NULL, "win.toggle-enabled", "Enable or disable"},
    {NULL, "win.roll", "Roll another seed"},
    {"Scene", "m", "Move, turn and size what stands"},
    {NULL, "p", "Plant"},
    {NULL, "b", "Paint plants"},
    {NULL, "x", "Take plants out"},
    {NULL, "o", "Add an obstacle"},
    {NULL, "r", "Draw a road"},
    {NULL, "e", "Draw an envelope"},
    {NULL, "Return", "Do it where the pointer is"},
    {NULL, "Escape", "Choose branches and leaves"},
    {"View", "f", "Show what is selected, or all"},
    {NULL, "a", "Show all"},
    {NULL, "1", "Shaded"},
    {NULL, "2", "Wireframe"},
    {NULL, "3", "Skeleton"},
    {NULL, "w", "Wind"},
    {NULL, "Left Right Up Down", "Turn; with Shift, move"},
    {NULL, "win.zoom(0.8)", "Nearer"},
    {NULL, "win.zoom(1.25)", "Farther"},
    {NULL, "win.sketch", "Sketch: draw the shape of branches"},
    {"Panels", "win.side('graph')", "Graph"},
    {NULL, "win.side('things')", "Contents"},
    {NULL, "win.side('text')", "Text"},
    {NULL, "win.side('light')", "Light"},
    {NULL, "win.show-panel", "Show or fold the panel at the left"},
    {NULL, "win.show-inspector", "Show or fold the inspector"},
    {NULL, "<Shift>F8", "Go to the dividers"},
    {NULL, "win.preferences", "Preferences"},
    {NULL, "win.shortcuts", "Keyboard shortcuts"},
    {NULL, "win.help", "Help"},
};

// The keys of a row: of an action those that the program has for it. Free with g_free().
static char *keys_of(StudioWindow *window, const char *keys) {
    if (strchr(keys, '.') == NULL) {
        return g_strdup(keys);
    }
    char **all =
        gtk_application_get_accels_for_action(gtk_window_get_application(GTK_WINDOW(window)), keys);
    char *first = g_strdup(all[0] == NULL ? "" : all[0]);
    g_strfreev(all);
    return first;
}

void studio_window_show_shortcuts(StudioWindow *window) {
    GString *groups = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        if (rows[i].group != NULL) {
            g_string_append_printf(groups,
                                   "%s<child><object class='GtkShortcutsGroup'>"
                                   "<property name='title'>%s</property>",
                                   i == 0 ? "" : "</object></child>", rows[i].group);
        }
        char *keys = keys_of(window, rows[i].keys);
        char *row = g_markup_printf_escaped(
            "<child><object class='GtkShortcutsShortcut'><property name='accelerator'>%s</property>"
            "<property name='title'>%s</property></object></child>",
            keys, rows[i].title);
        g_string_append(groups, row);
        g_free(row);
        g_free(keys);
    }
    g_string_append(groups, "</object></child>");
    char *text = g_strdup_printf(shortcuts, groups->str);
    GtkBuilder *builder = gtk_builder_new_from_string(text, -1);
    GtkWindow *dialog = GTK_WINDOW(gtk_builder_get_object(builder, "window"));
    gtk_window_set_transient_for(dialog, GTK_WINDOW(window));
    gtk_window_present(dialog);
    g_object_unref(builder);
    g_free(text);
    g_string_free(groups, TRUE);
}

void studio_window_show_about(StudioWindow *window) {
    adw_show_about_window(GTK_WINDOW(window), "application-name", "Frond Studio",
                          "application-icon", "org.frond.Studio", "version", FROND_VERSION,
                          "license-type", GTK_LICENSE_MIT_X11, "comments",
                          "Shape plants with your hands", NULL);
}

// ---- before something is lost ------------------------------------------------------------------

static void on_answer(AdwMessageDialog *dialog, const char *response, StudioWindow *window) {
    (void)dialog;
    if (strcmp(response, "discard") == 0) {
        window->is_closing = true;
        gtk_window_close(GTK_WINDOW(window));
    } else if (strcmp(response, "save") == 0) {
        gtk_widget_activate_action(GTK_WIDGET(window), "win.save", NULL);
        if (studio_document_is_saved(window->document)) {
            gtk_window_close(GTK_WINDOW(window));
        }
    }
}

void studio_window_ask_and_close(StudioWindow *window) {
    GtkWidget *dialog = adw_message_dialog_new(
        GTK_WINDOW(window), "Save Changes?",
        "Changes that are not saved will be lost for good when the window is closed.");
    AdwMessageDialog *message = ADW_MESSAGE_DIALOG(dialog);
    adw_message_dialog_add_responses(message, "cancel", "_Cancel", "discard", "_Discard", "save",
                                     "_Save", NULL);
    adw_message_dialog_set_response_appearance(message, "discard", ADW_RESPONSE_DESTRUCTIVE);
    adw_message_dialog_set_response_appearance(message, "save", ADW_RESPONSE_SUGGESTED);
    adw_message_dialog_set_default_response(message, "save");
    adw_message_dialog_set_close_response(message, "cancel");
    g_signal_connect(dialog, "response", G_CALLBACK(on_answer), window);
    gtk_window_present(GTK_WINDOW(dialog));
}
