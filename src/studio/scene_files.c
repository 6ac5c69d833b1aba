/// Meshes and height maps that a scene takes from files, and the actions of its tools.
#include "studio/scene_tool_private.h"
#include "studio/widgets.h"

#include <math.h>
#include <string.h>

// The file beside the document, where documents look for what they name: copied there if it lies
// elsewhere. NULL after a message. Free with g_free().
static char *beside_document(StudioSceneTool *tool, const char *path) {
    StudioWindow *window = tool->window;
    if (studio_document_path(window->document) == NULL) {
        studio_window_say(window, "Save the document first: the file is kept beside it");
        return NULL;
    }
    char *name = studio_file_name(window->document, path);
    if (!g_path_is_absolute(name)) {
        g_free(name);
        return g_strdup(path);
    }
    g_free(name);
    char *base = g_path_get_basename(path);
    char *to = g_build_filename(studio_document_folder(window->document), base, NULL);
    GFile *source = g_file_new_for_path(path), *target = g_file_new_for_path(to);
    GError *error = NULL;
    if (g_file_copy(source, target, G_FILE_COPY_NONE, NULL, NULL, NULL, &error)) {
        studio_window_say(window, "Copied %s beside the document", base);
    } else {
        studio_window_say(window, "%s", error->message);
        g_clear_pointer(&to, g_free);
        g_error_free(error);
    }
    g_object_unref(source);
    g_object_unref(target);
    g_free(base);
    return to;
}

// ---- the ground --------------------------------------------------------------------------------

// Hills of a size that suits what is seen: as wide as two pictures, a tenth as high.
static void set_terrain(StudioSceneTool *tool, const char *path) {
    StudioDocument *document = tool->window->document;
    if (*path == '\0') {
        if (!studio_set_terrain(document, NULL, NULL)) {
            studio_window_say(tool->window, "The ground is level already");
        }
        return;
    }
    char *file = beside_document(tool, path);
    if (file != NULL) {
        bool is_map = g_str_has_suffix(file, ".png");
        double wide = 20 * studio_camera_step(studio_viewport_camera(tool->window->viewport), 0.1);
        const double size[3] = {is_map ? wide : 1, is_map ? wide : 1, is_map ? 0.1 * wide : 1};
        if (studio_set_terrain(document, file, size)) {
            studio_window_select(tool->window, studio_scene_last(document, "terrain"));
        }
    }
    g_free(file);
}

static void add_mesh(StudioSceneTool *tool, const char *path, const double at[3]) {
    static const double size[3] = {1, 1, 1};
    StudioDocument *document = tool->window->document;
    char *file = beside_document(tool, path);
    if (file != NULL && studio_add_obstacle(document, "mesh", at, size, file)) {
        studio_window_select(tool->window, studio_scene_last(document, "obstacle"));
    }
    g_free(file);
}

// ---- dialogs -----------------------------------------------------------------------------------

typedef struct Asked {
    StudioSceneTool *tool;
    bool is_ground;
    double at[3];
} Asked;

static void on_response(GtkNativeDialog *dialog, int response, Asked *asked) {
    char *path = studio_chosen_path(dialog, response);
    bool is_wanted = path != NULL && asked->tool->window->document != NULL;
    if (is_wanted && asked->is_ground) {
        set_terrain(asked->tool, path);
    } else if (is_wanted) {
        add_mesh(asked->tool, path, asked->at);
    }
    g_free(path);
    g_object_unref(dialog);
    g_free(asked);
}

static void ask(Asked *asked, const char *title) {
    static const char *const meshes[] = {"*.obj", "*.stl", "*.gltf", "*.glb"};
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(
        title, GTK_WINDOW(asked->tool->window), GTK_FILE_CHOOSER_ACTION_OPEN, "_Open", "_Cancel");
    GtkFileFilter *filter = gtk_file_filter_new();
    gtk_file_filter_set_name(filter, asked->is_ground ? "Height maps (.png) and meshes" : "Meshes");
    for (size_t i = 0; i < G_N_ELEMENTS(meshes); i++) {
        gtk_file_filter_add_pattern(filter, meshes[i]);
    }
    if (asked->is_ground) {
        gtk_file_filter_add_pattern(filter, "*.png");
    }
    gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(dialog), filter);
    g_object_unref(filter);
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    g_signal_connect(dialog, "response", G_CALLBACK(on_response), asked);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}

void studio_scene_ask_mesh(StudioSceneTool *tool, const double at[3]) {
    Asked *asked = g_new0(Asked, 1);
    asked->tool = tool;
    memcpy(asked->at, at, sizeof asked->at);
    ask(asked, "An Obstacle from a File");
}

// ---- actions -----------------------------------------------------------------------------------

static void do_tool(GSimpleAction *action, GVariant *state, gpointer data) {
    (void)action;
    StudioSceneTool *tool = data;
    for (int i = 0; i < SCENE_TOOL_COUNT; i++) {
        if (strcmp(studio_scene_kind((SceneTool)i)->name, g_variant_get_string(state, NULL)) == 0) {
            studio_scene_choose(tool, (SceneTool)i);
            gtk_widget_grab_focus(GTK_WIDGET(tool->window->viewport));
        }
    }
}

static void do_terrain(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    Asked *asked = g_new0(Asked, 1);
    asked->tool = data;
    asked->is_ground = true;
    ask(asked, "The Ground from a File");
}

static void do_terrain_from(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    set_terrain(data, g_variant_get_string(parameter, NULL));
}

static void do_obstacle_from(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    const double at[3] = {0, 0, 0};
    add_mesh(data, g_variant_get_string(parameter, NULL), at);
}

void studio_scene_add_actions(StudioSceneTool *tool) {
    static const GActionEntry entries[] = {
        {.name = "scene-tool", .parameter_type = "s", .state = "'select'", .change_state = do_tool},
        {.name = "terrain", .activate = do_terrain},
        {.name = "terrain-from", .activate = do_terrain_from, .parameter_type = "s"},
        {.name = "obstacle-from", .activate = do_obstacle_from, .parameter_type = "s"},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(tool->window), entries, G_N_ELEMENTS(entries),
                                    tool);
}
