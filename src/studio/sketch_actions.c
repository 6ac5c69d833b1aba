/// What the sketch panel does when told to. Its commands are actions of the window, so that
/// buttons, menus, keys and tests use the same way.
#include "studio/sketch_panel_private.h"

#include "studio/model/commands.h"
#include "studio/widgets.h"

#include <string.h>

static const char *const tools[] = {"paint", "path", "turn", NULL};
static const char *const pens[] = {"stroke", "wind", "sun", "rain", NULL};
static const char *const applies[] = {"selected", "descendants", "both", NULL};
static const char *const pages[] = {"strokes", "sheet", NULL};
static const char *const boards[] = {"upright", "level", NULL};

// Which of some names a state is; the number of names: none.
static guint index_of(const char *const *names, GVariant *state) {
    guint i = 0;
    while (names[i] != NULL && strcmp(names[i], g_variant_get_string(state, NULL)) != 0) {
        i++;
    }
    return i;
}

// ---- the pen -----------------------------------------------------------------------------------

void studio_sketch_on_drawn(StudioSketchBoard *widget, StudioSketchPanel *panel) {
    const GArray *events = studio_sketch_board_events(widget);
    const StudioBoard *board = studio_sketch_board_get(widget);
    const FrPenEvent *first = (const FrPenEvent *)(const void *)events->data;
    if (panel->document == NULL || panel->base == NULL) {
        return;
    }
    if (studio_document_is_broken(panel->document)) {
        studio_sketch_say(panel, "The text of the document has to be mended first");
        return;
    }
    char *choice = studio_sketch_choice(panel);
    vec3s vector;
    FrStroke *stroke = NULL;
    if (panel->pen != STUDIO_PEN_STROKE) {
        if (studio_board_vector(board, first, events->len, &vector)) {
            studio_sketch_add_indicator(panel->document, &panel->of, panel->pen, vector, choice,
                                        choice == NULL ? FR_APPLY_BOTH : panel->apply);
        }
    } else if (choice == NULL) {
        studio_sketch_say(panel, "Paint over a branch in the skeleton first");
    } else if ((stroke = studio_board_stroke(board, first, events->len)) != NULL) {
        studio_sketch_add_stroke(panel->document, &panel->of, stroke, choice, panel->apply);
        fr_stroke_unref(stroke);
    }
    g_free(choice);
}

static void on_device(void *user, const FrPenEvent *event) {
    StudioSketchPanel *panel = user;
    if (event != NULL) {
        studio_sketch_board_feed(panel->board, event);
        return;
    }
    g_clear_pointer(&panel->device, studio_device_close);
    gtk_widget_remove_css_class(panel->device_button, "suggested-action");
    studio_sketch_say(panel, "The device has ended");
}

static void listen(StudioSketchPanel *panel, const char *path) {
    GError *error = NULL;
    g_clear_pointer(&panel->device, studio_device_close);
    panel->device = studio_device_open(path, on_device, panel, &error);
    if (panel->device == NULL) {
        studio_sketch_say(panel, error->message);
        g_error_free(error);
    } else {
        gtk_widget_add_css_class(panel->device_button, "suggested-action");
    }
}

static void on_device_response(GtkNativeDialog *dialog, int response, StudioSketchPanel *panel) {
    char *path = studio_chosen_path(dialog, response);
    if (path != NULL) {
        listen(panel, path);
    }
    g_free(path);
    g_object_unref(dialog);
}

static void do_device(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioSketchPanel *panel = data;
    if (panel->device != NULL) {
        on_device(panel, NULL);
        return;
    }
    GtkFileChooserNative *dialog = gtk_file_chooser_native_new(
        "Listen to a Device", GTK_WINDOW(gtk_widget_get_root(GTK_WIDGET(panel))),
        GTK_FILE_CHOOSER_ACTION_OPEN, "_Listen", "_Cancel");
    gtk_native_dialog_set_modal(GTK_NATIVE_DIALOG(dialog), TRUE);
    g_signal_connect(dialog, "response", G_CALLBACK(on_device_response), panel);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(dialog));
}

static void do_listen(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    listen(data, g_variant_get_string(parameter, NULL));
}

// ---- states ------------------------------------------------------------------------------------

static void set_tool(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    guint tool = index_of(tools, state);
    if (tools[tool] != NULL) {
        panel->tool = (SketchTool)tool;
        panel->path_end = FR_NONE;
        studio_sketch_view_set_painting(panel->skeleton, panel->tool != TOOL_TURN);
        g_simple_action_set_state(action, state);
    }
}

static void set_pen(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    guint pen = index_of(pens, state);
    if (pens[pen] != NULL) {
        panel->pen = (StudioPen)pen;
        g_simple_action_set_state(action, state);
        if (panel->base != NULL) {
            studio_sketch_show_skeleton(panel);
        }
    }
}

static void set_apply(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    guint apply = index_of(applies, state);
    if (applies[apply] != NULL) {
        panel->apply = (FrApply)apply;
        g_simple_action_set_state(action, state);
    }
}

static void set_page(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    guint page = index_of(pages, state);
    if (pages[page] != NULL) {
        panel->is_sheet = page == 1;
        g_simple_action_set_state(action, state);
        studio_viewport_forget(panel->viewport);
        studio_sketch_show_page(panel);
        studio_sketch_ask(panel);
    }
}

static void set_whole(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    panel->is_whole = g_variant_get_boolean(state);
    g_simple_action_set_state(action, state);
    studio_viewport_forget(panel->viewport);
    studio_sketch_show_page(panel);
    studio_sketch_ask(panel);
}

static void set_board(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    guint board = index_of(boards, state);
    if (boards[board] != NULL) {
        studio_sketch_board_get(panel->board)->is_level = board == 1;
        g_simple_action_set_state(action, state);
        studio_sketch_board_update(panel->board);
    }
}

static void set_tilt(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    studio_sketch_board_set_tilting(panel->board, g_variant_get_boolean(state));
    g_simple_action_set_state(action, state);
}

static void set_keeps_path(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioSketchPanel *panel = data;
    panel->keeps_path = g_variant_get_boolean(state);
    g_simple_action_set_state(action, state);
}

// ---- commands ----------------------------------------------------------------------------------

static void do_clear(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    studio_sketch_clear(data);
}

// 0: what is painted, 1: all, then the components in their order.
static void do_branches(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    StudioSketchPanel *panel = data;
    gtk_drop_down_set_selected(GTK_DROP_DOWN(panel->branches), g_variant_get_uint32(parameter));
}

static void do_play(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioSketchPanel *panel = data;
    if (panel->of.varied == NULL) {
        studio_sketch_say(panel, "Draw wind, sun or rain first");
        return;
    }
    panel->is_playing = true;
    panel->strength = 0;
    studio_sketch_ask(panel);
}

static void do_dice(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioSketchPanel *panel = data;
    const FrContents *contents = studio_sketch_contents(panel);
    uint32_t vary = contents == NULL ? FR_NONE : studio_sketch_vary(contents, panel->of.varied);
    if (vary == FR_NONE) {
        studio_sketch_say(panel, "Draw a stroke first: instances are those of a variation");
        return;
    }
    char seed[16];
    g_snprintf(seed, sizeof seed, "%d", g_random_int_range(1, 1000000));
    studio_set(panel->document, fr_contents_at(contents, vary)->parent, "seed", seed, false);
}

static void do_count(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(((StudioSketchPanel *)data)->instances),
                              g_variant_get_uint32(parameter));
}

static void do_place(GSimpleAction *action, GVariant *parameter, gpointer data) {
    (void)action;
    (void)parameter;
    StudioSketchPanel *panel = data;
    if (panel->document == NULL || panel->of.varied == NULL) {
        studio_sketch_say(panel, "Draw a stroke first: instances are those of a variation");
        return;
    }
    guint first = panel->seed + (panel->is_sheet ? 0 : panel->chosen);
    guint count = panel->is_sheet ? panel->count : 1;
    if (studio_sketch_place(panel->document, &panel->of, first, count, studio_sketch_step(panel))) {
        char *text = count == 1 ? g_strdup("It stands in the scene")
                                : g_strdup_printf("%u stand in the scene", count);
        studio_sketch_say(panel, text);
        g_free(text);
    }
}

void studio_sketch_add_actions(StudioSketchPanel *panel) {
    static const GActionEntry entries[] = {
        {.name = "sketch-tool",
         .parameter_type = "s",
         .state = "'paint'",
         .change_state = set_tool},
        {.name = "sketch-pen", .parameter_type = "s", .state = "'stroke'", .change_state = set_pen},
        {.name = "sketch-apply",
         .parameter_type = "s",
         .state = "'selected'",
         .change_state = set_apply},
        {.name = "sketch-page",
         .parameter_type = "s",
         .state = "'strokes'",
         .change_state = set_page},
        {.name = "sketch-whole", .state = "false", .change_state = set_whole},
        {.name = "sketch-board",
         .parameter_type = "s",
         .state = "'upright'",
         .change_state = set_board},
        {.name = "sketch-tilt", .state = "false", .change_state = set_tilt},
        {.name = "sketch-keeps-path", .state = "true", .change_state = set_keeps_path},
        {.name = "sketch-device", .activate = do_device},
        {.name = "sketch-listen", .activate = do_listen, .parameter_type = "s"},
        {.name = "sketch-clear", .activate = do_clear},
        {.name = "sketch-branches", .activate = do_branches, .parameter_type = "u"},
        {.name = "sketch-play", .activate = do_play},
        {.name = "sketch-dice", .activate = do_dice},
        {.name = "sketch-count", .activate = do_count, .parameter_type = "u"},
        {.name = "sketch-place", .activate = do_place},
    };
    g_action_map_add_action_entries(panel->actions, entries, G_N_ELEMENTS(entries), panel);
}
