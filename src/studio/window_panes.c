/// The panes beside the picture, which fold.
#include "studio/window_private.h"

static const struct {
    const char *action, *setting, *width;
    int usual; // width in pixels
} panes[STUDIO_PANE_COUNT] = {
    [STUDIO_PANE_SIDE] = {"show-panel", "show-panel", "side-width", 380},
    [STUDIO_PANE_INSPECTOR] = {"show-inspector", "show-inspector", "inspector-width", 360},
};

void studio_window_ask_pane(StudioWindow *window, StudioPane pane) {
    if (!studio_fold_box_is_shown(window->panes, pane)) {
        studio_fold_box_want(window->panes, pane, true);
    }
}

static void do_show(GSimpleAction *action, GVariant *state, gpointer data) {
    StudioWindow *window = data;
    const char *name = g_action_get_name(G_ACTION(action));
    bool is_side = g_str_equal(name, panes[STUDIO_PANE_SIDE].action);
    GtkWidget *focus = gtk_window_get_focus(GTK_WINDOW(window));
    studio_fold_box_want(window->panes, is_side ? STUDIO_PANE_SIDE : STUDIO_PANE_INSPECTOR,
                         g_variant_get_boolean(state));
    if (focus != NULL && !gtk_widget_is_visible(focus)) {
        gtk_widget_grab_focus(GTK_WIDGET(window->viewport));
    }
}

static void on_folded(StudioFoldBox *box, StudioWindow *window) {
    for (int i = 0; i < STUDIO_PANE_COUNT; i++) {
        bool is_shown = studio_fold_box_is_shown(box, (StudioPane)i);
        g_simple_action_set_state(
            G_SIMPLE_ACTION(g_action_map_lookup_action(G_ACTION_MAP(window), panes[i].action)),
            g_variant_new_boolean(is_shown));
    }
}

GtkWidget *studio_window_fold_panes(StudioWindow *window, GtkWidget *side, GtkWidget *middle,
                                    GtkWidget *inspector) {
    static const GActionEntry entries[] = {
        {.name = "show-panel", .state = "false", .change_state = do_show},
        {.name = "show-inspector", .state = "false", .change_state = do_show},
    };
    g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), window);
    window->panes = STUDIO_FOLD_BOX(studio_fold_box_new(side, middle, inspector));
    gtk_widget_set_name(side, "side-pane");
    gtk_widget_set_name(middle, "picture-pane");
    gtk_widget_set_name(inspector, "inspector-pane");
    for (int i = STUDIO_PANE_COUNT - 1; i >= 0; i--) { // the panel stays where one alone has room
        studio_fold_box_set_width(
            window->panes, (StudioPane)i,
            studio_settings_int(window->settings, panes[i].width, panes[i].usual));
        studio_fold_box_want(window->panes, (StudioPane)i,
                             studio_settings_bool(window->settings, panes[i].setting, true));
    }
    g_signal_connect(window->panes, "folded", G_CALLBACK(on_folded), window);
    return GTK_WIDGET(window->panes);
}

void studio_window_remember_panes(StudioWindow *window) {
    for (int i = 0; i < STUDIO_PANE_COUNT; i++) {
        studio_settings_set_int(window->settings, panes[i].width,
                                studio_fold_box_width(window->panes, (StudioPane)i));
        studio_settings_set_bool(window->settings, panes[i].setting,
                                 studio_fold_box_is_wanted(window->panes, (StudioPane)i));
    }
}
