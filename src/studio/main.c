/// frond-studio: starts the program, its windows and its keys.
#include "studio/drive.h"
#include "studio/window.h"

#include <gtksourceview/gtksource.h>
#include <stdio.h>

typedef struct Studio {
    StudioSettings *settings;
    bool is_driven;
} Studio;

static void add_keys(GtkApplication *application) {
    static const struct {
        const char *action, *keys[3];
    } keys[] = {
        {"win.new", {"<Control>n"}},
        {"win.open", {"<Control>o"}},
        {"win.save", {"<Control>s"}},
        {"win.save-as", {"<Control><Shift>s"}},
        {"win.export", {"<Control>e"}},
        {"win.export-one", {"<Control><Shift>e"}},
        {"win.screenshot", {"<Control><Shift>p"}},
        {"win.undo", {"<Control>z"}},
        {"win.redo", {"<Control><Shift>z", "<Control>y"}},
        {"win.duplicate", {"<Control>d"}},
        {"win.toggle-enabled", {"<Control>k"}},
        {"win.roll", {"<Control>r"}},
        {"win.problem", {"F8"}},
        {"win.sketch", {"<Control>t"}},
        {"win.zoom(0.8)", {"<Control>plus", "<Control>equal"}},
        {"win.zoom(1.25)", {"<Control>minus"}},
        {"win.side('graph')", {"<Alt>1"}},
        {"win.side('things')", {"<Alt>2"}},
        {"win.side('text')", {"<Alt>3"}},
        {"win.side('light')", {"<Alt>4"}},
        {"win.show-panel", {"F9"}},
        {"win.show-inspector", {"<Shift>F9"}},
        {"win.preferences", {"<Control>comma"}},
        {"win.shortcuts", {"<Control>question"}},
        {"win.help", {"F1"}},
        {"window.close", {"<Control>w"}},
        {"app.quit", {"<Control>q"}},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
        const char *const accels[] = {keys[i].keys[0], keys[i].keys[1], NULL};
        gtk_application_set_accels_for_action(application, keys[i].action, accels);
    }
}

static void on_quit(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    // Each window is asked, as if it were closed by hand.
    GList *windows = g_list_copy(gtk_application_get_windows(GTK_APPLICATION(data)));
    for (GList *at = windows; at != NULL; at = at->next) {
        gtk_window_close(GTK_WINDOW(at->data));
    }
    g_list_free(windows);
}

static void on_startup(GApplication *application, Studio *studio) {
    gtk_source_init();
    gtk_source_language_manager_append_search_path(gtk_source_language_manager_get_default(),
                                                   "resource:///org/frond/Studio/languages");
    studio->settings = NULL;
    char *file = studio_settings_file();
    studio->settings = studio_settings_new(file);
    g_free(file);
    GtkCssProvider *style = gtk_css_provider_new();
    gtk_css_provider_load_from_resource(style, "/org/frond/Studio/style.css");
    gtk_style_context_add_provider_for_display(gdk_display_get_default(), GTK_STYLE_PROVIDER(style),
                                               GTK_STYLE_PROVIDER_PRIORITY_APPLICATION);
    g_object_unref(style);
    gtk_icon_theme_add_resource_path(gtk_icon_theme_get_for_display(gdk_display_get_default()),
                                     "/org/frond/Studio/icons");
    gtk_window_set_default_icon_name("org.frond.Studio");
    adw_style_manager_set_color_scheme(adw_style_manager_get_default(),
                                       studio_settings_bool(studio->settings, "dark", true)
                                           ? ADW_COLOR_SCHEME_FORCE_DARK
                                           : ADW_COLOR_SCHEME_FORCE_LIGHT);
    static const GActionEntry entries[] = {{.name = "quit", .activate = on_quit}};
    g_action_map_add_action_entries(G_ACTION_MAP(application), entries, 1, application);
    add_keys(GTK_APPLICATION(application));
}

static StudioWindow *new_window(GApplication *application, Studio *studio) {
    StudioWindow *window = studio_window_new(ADW_APPLICATION(application), studio->settings);
    gtk_window_present(GTK_WINDOW(window));
    if (studio->is_driven) {
        studio->is_driven = false;
        studio_drive(window);
    }
    return window;
}

static void on_activate(GApplication *application, Studio *studio) {
    new_window(application, studio);
}

static void on_open(GApplication *application, GFile **files, int count, const char *hint,
                    Studio *studio) {
    (void)hint;
    for (int i = 0; i < count; i++) {
        StudioWindow *window = new_window(application, studio);
        char *path = g_file_get_path(files[i]);
        if (path != NULL) {
            studio_window_open(window, path);
        }
        g_free(path);
    }
}

static void on_shutdown(GApplication *application, Studio *studio) {
    (void)application;
    g_clear_pointer(&studio->settings, studio_settings_free);
}

static int on_options(GApplication *application, GVariantDict *options, Studio *studio) {
    (void)application;
    if (g_variant_dict_contains(options, "version")) {
        printf("frond-studio %s\n", FROND_VERSION);
        return 0;
    }
    studio->is_driven = g_variant_dict_contains(options, "drive");
    if (!gtk_init_check()) {
        fprintf(stderr, "frond-studio: there is no display to show windows on; 'frond' works "
                        "without one\n");
        return 4;
    }
    return -1;
}

int main(int argc, char **argv) {
    Studio studio = {0};
    AdwApplication *application = adw_application_new(
        "org.frond.Studio", G_APPLICATION_HANDLES_OPEN | (g_getenv("FROND_STUDIO_ALONE") != NULL
                                                              ? G_APPLICATION_NON_UNIQUE
                                                              : G_APPLICATION_DEFAULT_FLAGS));
    GApplication *base = G_APPLICATION(application);
    g_application_add_main_option(base, "drive", 0, G_OPTION_FLAG_NONE, G_OPTION_ARG_NONE,
                                  "Do what standard input says, a command a line", NULL);
    g_application_add_main_option(base, "version", 0, G_OPTION_FLAG_NONE, G_OPTION_ARG_NONE,
                                  "Print the version", NULL);
    g_application_set_option_context_parameter_string(base, "[FILE…]");
    g_signal_connect(application, "startup", G_CALLBACK(on_startup), &studio);
    g_signal_connect(application, "activate", G_CALLBACK(on_activate), &studio);
    g_signal_connect(application, "open", G_CALLBACK(on_open), &studio);
    g_signal_connect(application, "shutdown", G_CALLBACK(on_shutdown), &studio);
    g_signal_connect(application, "handle-local-options", G_CALLBACK(on_options), &studio);
    int status = g_application_run(base, argc, argv);
    g_object_unref(application);
    return status;
}
