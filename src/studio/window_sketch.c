/// Between the window and its sketch mode.
#include "studio/window_private.h"

bool studio_window_is_sketching(StudioWindow *window) {
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), "sketch");
    GVariant *state = g_action_get_state(action);
    bool is_sketching = g_variant_get_boolean(state);
    g_variant_unref(state);
    return is_sketching;
}

static void leave(StudioWindow *window) {
    studio_sketch_panel_end(window->sketch);
    gtk_stack_set_visible_child_name(GTK_STACK(window->stack), "document");
    studio_window_request(window);
    gtk_widget_grab_focus(GTK_WIDGET(window->viewport));
}

static void do_sketch(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioWindow *window = data;
    bool is_wanted = g_variant_get_boolean(state);
    if (window->document == NULL || is_wanted == studio_window_is_sketching(window)) {
        return;
    }
    if (is_wanted && studio_window_plant(window) == FR_NONE) {
        studio_window_say(window, "There is no plant to sketch over");
        return;
    }
    g_simple_action_set_state(action, state);
    if (is_wanted) {
        studio_sketch_panel_begin(window->sketch, window->document, studio_window_plant(window));
        gtk_stack_set_visible_child_name(GTK_STACK(window->stack), "sketch");
    } else {
        leave(window);
    }
    studio_window_update_actions(window);
}

void studio_window_forget_sketch(StudioWindow *window) {
    if (studio_window_is_sketching(window)) {
        GAction *action = g_action_map_lookup_action(G_ACTION_MAP(window), "sketch");
        g_simple_action_set_state(G_SIMPLE_ACTION(action), g_variant_new_boolean(FALSE));
        studio_sketch_panel_end(window->sketch);
    }
}

void studio_window_add_sketch(StudioWindow *window) {
    static const GActionEntry entries[] = {
        {.name = "sketch", .state = "false", .change_state = do_sketch}};
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);
    window->sketch = STUDIO_SKETCH_PANEL(studio_sketch_panel_new(G_ACTION_MAP(window)));
    const int widths[2] = {studio_settings_int(window->settings, "sketch-width", 430),
                           studio_settings_int(window->settings, "sketch-board-width", 500)};
    studio_sketch_panel_set_widths(window->sketch, widths);
    g_signal_connect(window->sketch, "said", G_CALLBACK(studio_window_on_said), window);
    gtk_stack_add_named(GTK_STACK(window->stack), GTK_WIDGET(window->sketch), "sketch");
}
