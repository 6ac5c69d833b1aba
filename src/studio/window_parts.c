/// What a window is made of.
#include "studio/accessible.h"
#include "studio/model/graph.h"
#include "studio/scale_bar.h"
#include "studio/views_menu.h"
#include "studio/widgets.h"
#include "studio/wind_menu.h"
#include "studio/window_private.h"

#include <string.h>

// ---- signals -----------------------------------------------------------------------------------

static void on_selected(GObject *panel, guint element, StudioWindow *window) {
    (void)panel;
    studio_window_select(window, element);
}

static void on_time(StudioTimeStrip *strip, double time, StudioWindow *window) {
    (void)strip;
    window->moment.time = time;
    studio_inspector_set_time(window->inspector, time);
    studio_window_request(window);
}

static void on_step(StudioTimeStrip *strip, gint64 step, StudioWindow *window) {
    (void)strip;
    window->moment.step = step;
    studio_window_request(window);
}

static void on_clicked(StudioViewport *viewport, double x, double y, StudioWindow *window) {
    (void)viewport;
    if (window->document != NULL && !studio_scene_tool_click(window->scene, x, y)) {
        studio_window_pick(window, x, y);
    }
}

static void on_ready(StudioViewport *viewport, StudioWindow *window) {
    (void)viewport;
    studio_window_collect(window);
}

static void on_cancel(GtkButton *button, StudioWindow *window) {
    (void)button;
    studio_builder_cancel(window->builder);
    studio_window_say(window, "Stopped: the picture is that of before");
}

static void on_show_problem(GtkButton *button, StudioWindow *window) {
    (void)button;
    studio_window_show_problem(window);
}

StudioBudget studio_window_budget(StudioWindow *window) {
    int instances = studio_settings_int(window->settings, "budget", STUDIO_USUAL_BUDGET);
    int milliseconds =
        studio_settings_int(window->settings, "budget-time", STUDIO_USUAL_MILLISECONDS);
    return (StudioBudget){(uint64_t)MAX(instances, 0), MAX(milliseconds, 0) / 1000.0};
}

// ---- parts -------------------------------------------------------------------------------------

// One that fades keeps its room while it is hidden.
void studio_window_reveal(GtkWidget *revealer, bool is_shown) {
    gtk_revealer_set_reveal_child(GTK_REVEALER(revealer), is_shown);
    gtk_widget_set_can_target(revealer, is_shown);
}

static GMenu *menu_of(const char *const (*items)[2], size_t count) {
    GMenu *menu = g_menu_new();
    for (size_t i = 0; i < count; i++) {
        g_menu_append(menu, items[i][0], items[i][1]);
    }
    return menu;
}

static GtkWidget *make_menu_button(void) {
    static const char *const file[][2] = {{"_New…", "win.new"},
                                          {"_Open…", "win.open"},
                                          {"Save _As…", "win.save-as"},
                                          {"_Export…", "win.export"},
                                          {"Export T_his Plant…", "win.export-one"},
                                          {"Save _Picture…", "win.screenshot"}};
    static const char *const help[][2] = {{"_Preferences", "win.preferences"},
                                          {"_Keyboard Shortcuts", "win.shortcuts"},
                                          {"_Help", "win.help"},
                                          {"_About Frond Studio", "win.about"}};
    GMenu *menu = g_menu_new();
    GMenu *first = menu_of(file, G_N_ELEMENTS(file)), *second = menu_of(help, G_N_ELEMENTS(help));
    g_menu_append_section(menu, NULL, G_MENU_MODEL(first));
    g_menu_append_section(menu, NULL, G_MENU_MODEL(second));
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "open-menu-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
    gtk_menu_button_set_primary(GTK_MENU_BUTTON(button), TRUE);
    studio_tell(button, "Main menu");
    g_object_unref(first);
    g_object_unref(second);
    g_object_unref(menu);
    return button;
}

static GtkWidget *pane_button(const char *icon, const char *action, const char *tip) {
    GtkWidget *button = gtk_toggle_button_new();
    gtk_button_set_icon_name(GTK_BUTTON(button), icon);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    studio_tell(button, tip);
    gtk_widget_set_name(button, action);
    return button;
}

GtkWidget *studio_window_make_header(StudioWindow *window) {
    GtkWidget *header = adw_header_bar_new();
    window->title = ADW_WINDOW_TITLE(adw_window_title_new("Frond Studio", ""));
    adw_header_bar_set_title_widget(ADW_HEADER_BAR(header), GTK_WIDGET(window->title));
    AdwHeaderBar *bar = ADW_HEADER_BAR(header);
    adw_header_bar_pack_start(bar,
                              studio_action_button("document-open-symbolic", "win.open", "Open"));
    window->undo = studio_action_button("edit-undo-symbolic", "win.undo", "Undo");
    window->redo = studio_action_button("edit-redo-symbolic", "win.redo", "Redo");
    adw_header_bar_pack_start(bar, window->undo);
    adw_header_bar_pack_start(bar, window->redo);
    adw_header_bar_pack_end(bar, make_menu_button());
    window->save_button = gtk_button_new_with_label("Save");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(window->save_button), "win.save");
    adw_header_bar_pack_end(bar, window->save_button);
    GtkWidget *export = gtk_button_new_with_label("Export…");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(export), "win.export");
    adw_header_bar_pack_end(bar, export);
    GtkWidget *sketch = gtk_toggle_button_new_with_label("Sketch");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(sketch), "win.sketch");
    gtk_widget_set_tooltip_text(sketch, "Draw the shape of branches (Ctrl+T)");
    adw_header_bar_pack_start(bar, sketch);
    GtkWidget *side = pane_button("sidebar-show-symbolic", "win.show-panel",
                                  "Graph, contents, light and text (F9)");
    GtkWidget *inspector =
        pane_button("sidebar-show-right-symbolic", "win.show-inspector", "Inspector (Shift+F9)");
    adw_header_bar_pack_start(bar, side);
    adw_header_bar_pack_end(bar, inspector);
    GtkWidget *hidden[] = {window->undo, window->redo, window->save_button, export, sketch,
                           side,         inspector};
    memcpy(window->welcome_hidden, hidden, sizeof hidden);
    for (size_t i = 0; i < G_N_ELEMENTS(hidden); i++) {
        gtk_widget_set_visible(hidden[i], FALSE);
    }
    return header;
}

// All kinds of components, for those who do not drag.
static GtkWidget *make_add(void) {
    GMenu *menu = g_menu_new();
    for (int kind = 1; kind < FR_COMPONENT_COUNT; kind++) {
        const char *element = fr_pgraph_table((FrComponentKind)kind)->element;
        char *label = g_strdup(element), *action = g_strdup_printf("win.add::%s", element);
        label[0] = g_ascii_toupper(label[0]);
        g_menu_append(menu, label, action);
        g_free(action);
        g_free(label);
    }
    g_menu_append(menu, "Preset…", "win.insert-preset");
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "list-add-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
    gtk_widget_set_tooltip_text(button, "Add a component to the selected one");
    studio_name(button, "Add a component");
    g_object_unref(menu);
    return button;
}

static void on_side(GtkStack *stack, GParamSpec *spec, StudioWindow *window) {
    (void)stack;
    (void)spec;
    studio_string_panel_update(window->string);
}

// The text above, the string below.
static GtkWidget *make_lsystem(StudioWindow *window) {
    window->string = studio_string_panel_new(window);
    GtkWidget *paned = gtk_paned_new(GTK_ORIENTATION_VERTICAL);
    gtk_widget_set_size_request(GTK_WIDGET(window->lsystem), -1, 120);
    gtk_widget_set_size_request(studio_string_panel_widget(window->string), -1, 120);
    gtk_paned_set_start_child(GTK_PANED(paned), GTK_WIDGET(window->lsystem));
    gtk_paned_set_end_child(GTK_PANED(paned), studio_string_panel_widget(window->string));
    gtk_paned_set_shrink_start_child(GTK_PANED(paned), FALSE);
    gtk_paned_set_shrink_end_child(GTK_PANED(paned), FALSE);
    gtk_paned_set_position(GTK_PANED(paned), 460);
    return paned;
}

static GtkWidget *make_side(StudioWindow *window) {
    window->side = gtk_stack_new();
    window->graph = STUDIO_GRAPH_PANEL(studio_graph_panel_new());
    studio_graph_panel_set_budget(window->graph, studio_window_budget(window));
    window->things = STUDIO_THINGS_PANEL(studio_things_panel_new());
    window->lsystem = STUDIO_TEXT_PANEL(studio_text_panel_new("frond-lsystem"));
    window->text = STUDIO_TEXT_PANEL(studio_text_panel_new("xml"));
    GtkStack *stack = GTK_STACK(window->side);
    gtk_stack_add_titled(stack, GTK_WIDGET(window->graph), "graph", "Graph");
    gtk_stack_add_titled(stack, make_lsystem(window), "lsystem", "L-system");
    gtk_stack_add_titled(stack, GTK_WIDGET(window->things), "things", "Contents");
    window->light = studio_light_mode_new(window);
    gtk_stack_add_titled(stack, studio_light_mode_panel(window->light), "light", "Light");
    gtk_stack_add_titled(stack, GTK_WIDGET(window->text), "text", "Text");
    gtk_widget_set_vexpand(window->side, TRUE);
    g_signal_connect(stack, "notify::visible-child", G_CALLBACK(on_side), window);
    g_signal_connect(window->graph, "selected", G_CALLBACK(on_selected), window);
    g_signal_connect(window->things, "selected", G_CALLBACK(on_selected), window);
    GtkWidget *switcher = gtk_stack_switcher_new();
    gtk_stack_switcher_set_stack(GTK_STACK_SWITCHER(switcher), stack);
    gtk_widget_set_hexpand(switcher, TRUE);
    GtkWidget *top = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
    gtk_widget_add_css_class(top, "side-top");
    gtk_box_append(GTK_BOX(top), switcher);
    gtk_box_append(GTK_BOX(top), make_add());
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(box), top);
    gtk_box_append(GTK_BOX(box), window->side);
    gtk_widget_set_size_request(box, 240, -1);
    gtk_widget_add_css_class(box, "view");
    return box;
}

static const char *const modes[][3] = {
    {"Shaded", "shaded", "Surfaces in sun and shade (1)"},
    {"Wireframe", "wireframe", "The edges of all triangles (2)"},
    {"Skeleton", "skeleton", "The axes of stems and branches (3)"},
};

static GtkWidget *make_mode_buttons(void) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    gtk_widget_add_css_class(box, "linked");
    for (size_t i = 0; i < G_N_ELEMENTS(modes); i++) {
        GtkWidget *button = gtk_toggle_button_new_with_label(modes[i][0]);
        gtk_actionable_set_action_name(GTK_ACTIONABLE(button), "win.mode");
        gtk_actionable_set_action_target(GTK_ACTIONABLE(button), "s", modes[i][1]);
        gtk_widget_set_tooltip_text(button, modes[i][2]);
        gtk_box_append(GTK_BOX(box), button);
    }
    return box;
}

// The same in the room of one.
static GtkWidget *make_mode_menu(void) {
    GMenu *menu = g_menu_new();
    for (size_t i = 0; i < G_N_ELEMENTS(modes); i++) {
        char *action = g_strdup_printf("win.mode::%s", modes[i][1]);
        g_menu_append(menu, modes[i][0], action);
        g_free(action);
    }
    GtkWidget *button = gtk_menu_button_new();
    gtk_menu_button_set_label(GTK_MENU_BUTTON(button), "Look");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), G_MENU_MODEL(menu));
    gtk_widget_set_tooltip_text(button, "Surfaces, edges or axes (1, 2, 3)");
    gtk_widget_set_name(button, "modes");
    gtk_widget_set_halign(button, GTK_ALIGN_END);
    g_object_unref(menu);
    return button;
}

static GtkWidget *make_tools(StudioWindow *window) {
    GtkWidget *squeezer = adw_squeezer_new();
    adw_squeezer_set_homogeneous(ADW_SQUEEZER(squeezer), FALSE);
    adw_squeezer_set_xalign(ADW_SQUEEZER(squeezer), 1);
    adw_squeezer_add(ADW_SQUEEZER(squeezer), make_mode_buttons());
    adw_squeezer_add(ADW_SQUEEZER(squeezer), make_mode_menu());
    GtkWidget *tools = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
    gtk_widget_add_css_class(tools, "viewport-tools");
    gtk_box_append(GTK_BOX(tools), squeezer);
    gtk_box_append(GTK_BOX(tools), studio_wind_button_new(window));
    gtk_box_append(GTK_BOX(tools), studio_action_button("zoom-fit-best-symbolic", "win.frame",
                                                        "Show what is selected, or all (F)"));
    gtk_box_append(GTK_BOX(tools), studio_views_button_new(window));
    gtk_widget_set_halign(tools, GTK_ALIGN_END);
    gtk_widget_set_valign(tools, GTK_ALIGN_START);
    return tools;
}

static GtkWidget *make_problem(StudioWindow *window) {
    window->problem = gtk_revealer_new();
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_widget_add_css_class(box, "problem");
    gtk_box_append(GTK_BOX(box), gtk_image_new_from_icon_name("dialog-warning-symbolic"));
    window->problem_text = gtk_label_new("");
    gtk_label_set_wrap(GTK_LABEL(window->problem_text), TRUE);
    gtk_label_set_wrap_mode(GTK_LABEL(window->problem_text), PANGO_WRAP_WORD_CHAR);
    gtk_label_set_xalign(GTK_LABEL(window->problem_text), 0);
    gtk_widget_set_hexpand(window->problem_text, TRUE);
    gtk_box_append(GTK_BOX(box), window->problem_text);
    GtkWidget *button = gtk_button_new_with_label("Show");
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    g_signal_connect(button, "clicked", G_CALLBACK(on_show_problem), window);
    gtk_box_append(GTK_BOX(box), button);
    gtk_revealer_set_child(GTK_REVEALER(window->problem), box);
    gtk_widget_set_valign(window->problem, GTK_ALIGN_END);
    studio_window_reveal(window->problem, false);
    return window->problem;
}

static GtkWidget *text_button(const char *text, const char *action, const char *tip) {
    GtkWidget *button = gtk_button_new_with_label(text);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    gtk_widget_set_tooltip_text(button, tip);
    return button;
}

// What can be done to the one branch or leaf that was clicked.
static GtkWidget *make_picked(StudioWindow *window) {
    window->picked_bar = gtk_revealer_new();
    gtk_revealer_set_transition_type(GTK_REVEALER(window->picked_bar),
                                     GTK_REVEALER_TRANSITION_TYPE_CROSSFADE);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_widget_add_css_class(box, "busy");
    window->picked_text = gtk_label_new("");
    gtk_box_append(GTK_BOX(box), window->picked_text);
    gtk_box_append(GTK_BOX(box),
                   text_button("Prune", "win.prune", "Cut it off, with all that follows on it"));
    gtk_box_append(GTK_BOX(box),
                   text_button("Hide", "win.hide", "Hide it; what follows on it stays"));
    gtk_revealer_set_child(GTK_REVEALER(window->picked_bar), box);
    gtk_widget_set_halign(window->picked_bar, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(window->picked_bar, GTK_ALIGN_END);
    studio_window_reveal(window->picked_bar, false);
    return window->picked_bar;
}

static GtkWidget *make_busy(StudioWindow *window) {
    window->busy = gtk_revealer_new();
    gtk_revealer_set_transition_type(GTK_REVEALER(window->busy),
                                     GTK_REVEALER_TRANSITION_TYPE_CROSSFADE);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 10);
    gtk_widget_add_css_class(box, "busy");
    window->busy_bar = gtk_progress_bar_new();
    gtk_widget_set_valign(window->busy_bar, GTK_ALIGN_CENTER);
    gtk_widget_set_size_request(window->busy_bar, 140, -1);
    window->busy_text = gtk_label_new("Building");
    gtk_box_append(GTK_BOX(box), window->busy_text);
    gtk_box_append(GTK_BOX(box), window->busy_bar);
    GtkWidget *cancel = gtk_button_new_with_label("Cancel");
    g_signal_connect(cancel, "clicked", G_CALLBACK(on_cancel), window);
    gtk_box_append(GTK_BOX(box), cancel);
    gtk_revealer_set_child(GTK_REVEALER(window->busy), box);
    gtk_widget_set_halign(window->busy, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(window->busy, GTK_ALIGN_START);
    studio_window_reveal(window->busy, false);
    return window->busy;
}

static GtkWidget *make_middle(StudioWindow *window) {
    window->viewport = STUDIO_VIEWPORT(studio_viewport_new());
    gtk_widget_set_name(GTK_WIDGET(window->viewport), "viewport");
    g_signal_connect(window->viewport, "clicked", G_CALLBACK(on_clicked), window);
    g_signal_connect(window->viewport, "ready", G_CALLBACK(on_ready), window);
    gtk_widget_set_hexpand(GTK_WIDGET(window->viewport), TRUE);
    gtk_widget_set_vexpand(GTK_WIDGET(window->viewport), TRUE);
    GtkOverlay *overlay = GTK_OVERLAY(gtk_overlay_new());
    gtk_overlay_set_child(overlay, GTK_WIDGET(window->viewport));
    studio_scale_bar_add(overlay, window->viewport); // below all bars
    window->scene = studio_scene_tool_new(window, overlay);
    window->patch = studio_patch_mode_new(window, overlay);
    window->amount = gtk_label_new("");
    gtk_widget_add_css_class(window->amount, "amount");
    gtk_widget_set_halign(window->amount, GTK_ALIGN_END); // below the modes: beside is no room
    gtk_widget_set_valign(window->amount, GTK_ALIGN_START);
    gtk_widget_set_can_target(window->amount, FALSE);
    gtk_widget_set_visible(window->amount, FALSE); // until there is something to count
    gtk_overlay_add_overlay(overlay, window->amount);
    gtk_overlay_add_overlay(overlay, make_tools(window));
    gtk_overlay_add_overlay(overlay, make_picked(window));
    gtk_overlay_add_overlay(overlay, make_problem(window));
    gtk_overlay_add_overlay(overlay, make_busy(window));
    window->strip = STUDIO_TIME_STRIP(studio_time_strip_new());
    g_signal_connect(window->strip, "time", G_CALLBACK(on_time), window);
    g_signal_connect(window->strip, "step", G_CALLBACK(on_step), window);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    window->over_picture = studio_messages_new(GTK_WIDGET(overlay));
    gtk_widget_add_css_class(studio_messages_widget(window->over_picture), "over-picture");
    gtk_box_append(GTK_BOX(box), studio_messages_widget(window->over_picture));
    gtk_box_append(GTK_BOX(box), GTK_WIDGET(window->strip));
    gtk_widget_set_size_request(box, 320, 240);
    return box;
}

GtkWidget *studio_window_make_panes(StudioWindow *window) {
    window->inspector = STUDIO_INSPECTOR(studio_inspector_new());
    g_signal_connect(window->inspector, "selected", G_CALLBACK(on_selected), window);
    g_signal_connect(window->inspector, "said", G_CALLBACK(studio_window_on_said), window);
    window->levels = STUDIO_LEVELS_PANEL(
        studio_levels_panel_new(window->settings, GTK_WIDGET(window->inspector)));
    GtkWidget *column = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_widget_set_vexpand(GTK_WIDGET(window->inspector), TRUE);
    gtk_box_append(GTK_BOX(column), GTK_WIDGET(window->levels));
    gtk_box_append(GTK_BOX(column), GTK_WIDGET(window->inspector));
    gtk_widget_set_size_request(column, 280, -1);
    gtk_widget_add_css_class(column, "inspector");
    return studio_window_fold_panes(window, make_side(window), make_middle(window), column);
}
