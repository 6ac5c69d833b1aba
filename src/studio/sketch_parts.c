/// What the sketch panel is made of.
#include "studio/accessible.h"
#include "studio/param_row.h"
#include "studio/sketch_panel_private.h"
#include "studio/wrap_box.h"

#include "studio/model/commands.h"
#include "studio/widgets.h"

#include <string.h>

// ---- buttons -----------------------------------------------------------------------------------

typedef struct Button {
    const char *label, *target, *tip;
} Button;

// Buttons of which one is down: the values of an action.
static GtkWidget *choice_of(const char *action, const Button *buttons, size_t count) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    gtk_widget_add_css_class(box, "linked");
    for (size_t i = 0; i < count; i++) {
        GtkWidget *button = gtk_toggle_button_new_with_label(buttons[i].label);
        gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
        gtk_actionable_set_action_target(GTK_ACTIONABLE(button), "s", buttons[i].target);
        gtk_widget_set_tooltip_text(button, buttons[i].tip);
        gtk_box_append(GTK_BOX(box), button);
    }
    return box;
}

static GtkWidget *toggle(const char *label, const char *action, const char *tip) {
    GtkWidget *button = gtk_toggle_button_new_with_label(label);
    gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
    gtk_widget_set_tooltip_text(button, tip);
    return button;
}

// A pane: its title with tools in as many rows as they need, and what it shows.
static GtkWidget *pane_of(const char *title, GtkWidget *first, GtkWidget *second,
                          GtkWidget *content) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    GtkWidget *rows = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
    GtkWidget *heading = gtk_label_new(title);
    gtk_widget_add_css_class(heading, "heading");
    gtk_widget_set_size_request(heading, -1, 34); // as high as the buttons beside it
    gtk_widget_set_margin_end(heading, 6);
    gtk_widget_insert_after(heading, first, NULL);
    gtk_widget_add_css_class(rows, "sketch-tools");
    gtk_box_append(GTK_BOX(rows), first);
    gtk_box_append(GTK_BOX(rows), second);
    gtk_box_append(GTK_BOX(box), rows);
    gtk_box_append(GTK_BOX(box), content);
    gtk_widget_set_vexpand(content, TRUE);
    gtk_widget_set_size_request(box, 240, -1);
    return box;
}

static GtkWidget *tools_of(GtkWidget *const *parts, size_t count) {
    GtkWidget *box = studio_wrap_box_new(6);
    for (size_t i = 0; i < count; i++) {
        studio_wrap_box_append(STUDIO_WRAP_BOX(box), parts[i]);
    }
    return box;
}

static GtkWidget *row_of(GtkWidget *const *parts, size_t count) {
    GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
    for (size_t i = 0; i < count; i++) {
        gtk_widget_set_valign(parts[i], GTK_ALIGN_CENTER);
        gtk_box_append(GTK_BOX(row), parts[i]);
    }
    return row;
}

// ---- what was drawn ----------------------------------------------------------------------------

static void on_count(GtkSpinButton *spin, StudioSketchPanel *panel) {
    panel->count = (guint)gtk_spin_button_get_value_as_int(spin);
    panel->chosen = MIN(panel->chosen, panel->count - 1);
    if (panel->document != NULL) {
        studio_sketch_ask(panel);
    }
}

static void on_chosen(StudioSketchSheet *sheet, guint index, StudioSketchPanel *panel) {
    (void)sheet;
    panel->chosen = index;
}

static void on_opened(StudioSketchSheet *sheet, guint index, StudioSketchPanel *panel) {
    (void)sheet;
    panel->chosen = index;
    g_action_group_change_action_state(G_ACTION_GROUP(panel->actions), "sketch-page",
                                       g_variant_new_string("strokes"));
}

static void on_strokes_turned(StudioSketchView *view, StudioSketchPanel *panel) {
    studio_sketch_sheet_see(panel->sheet, studio_sketch_view_camera(view));
}

// The keys of this picture, which else would reach the one of the whole document.
static gboolean on_whole_key(GtkEventControllerKey *controller, guint key, guint code,
                             GdkModifierType state, StudioSketchPanel *panel) {
    (void)controller;
    (void)code;
    StudioDisplay *display = studio_viewport_display(panel->viewport);
    if ((state & (GDK_CONTROL_MASK | GDK_ALT_MASK)) != 0) {
        return FALSE;
    }
    if (key == GDK_KEY_f) {
        studio_viewport_frame_all(panel->viewport);
    } else if (key >= GDK_KEY_1 && key <= GDK_KEY_3) {
        display->mode = (StudioMode)(key - GDK_KEY_1);
    } else if (key == GDK_KEY_w) {
        display->has_wind = !display->has_wind;
    } else {
        return FALSE;
    }
    studio_viewport_update(panel->viewport);
    return TRUE;
}

static void listen_to_keys(StudioSketchPanel *panel) {
    GtkEventController *keys = gtk_event_controller_key_new();
    gtk_event_controller_set_propagation_phase(keys, GTK_PHASE_CAPTURE);
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_whole_key), panel);
    gtk_widget_add_controller(GTK_WIDGET(panel->viewport), keys);
}

static GtkWidget *make_strokes(StudioSketchPanel *panel) {
    static const Button pages[] = {
        {"Strokes", "strokes", "One instance with the strokes that shape it"},
        {"Sheet", "sheet", "Many instances side by side; click one twice to see it alone"}};
    panel->strokes = STUDIO_SKETCH_VIEW(studio_sketch_view_new("What the strokes make of it"));
    gtk_widget_set_name(GTK_WIDGET(panel->strokes), "sketch-strokes");
    studio_sketch_view_set_painting(panel->strokes, FALSE);
    panel->sheet = STUDIO_SKETCH_SHEET(studio_sketch_sheet_new());
    gtk_widget_set_name(GTK_WIDGET(panel->sheet), "sketch-sheet");
    panel->viewport = STUDIO_VIEWPORT(studio_viewport_new());
    gtk_widget_set_name(GTK_WIDGET(panel->viewport), "sketch-whole");
    listen_to_keys(panel);
    g_signal_connect(panel->strokes, "turned", G_CALLBACK(on_strokes_turned), panel);
    g_signal_connect(panel->sheet, "chosen", G_CALLBACK(on_chosen), panel);
    g_signal_connect(panel->sheet, "opened", G_CALLBACK(on_opened), panel);
    panel->pages = gtk_stack_new();
    gtk_stack_add_named(GTK_STACK(panel->pages), GTK_WIDGET(panel->strokes), "strokes");
    gtk_stack_add_named(GTK_STACK(panel->pages), GTK_WIDGET(panel->sheet), "sheet");
    gtk_stack_add_named(GTK_STACK(panel->pages), GTK_WIDGET(panel->viewport), "whole");
    panel->instances = gtk_spin_button_new_with_range(1, MOST_INSTANCES, 1);
    gtk_spin_button_set_value(GTK_SPIN_BUTTON(panel->instances), panel->count);
    studio_tell(panel->instances, "Number of instances on the sheet");
    g_signal_connect(panel->instances, "value-changed", G_CALLBACK(on_count), panel);
    GtkWidget *first[] = {
        choice_of("win.sketch-page", pages, G_N_ELEMENTS(pages)),
        toggle("Whole", "win.sketch-whole", "With bark and leaves, as it will stand there")};
    GtkWidget *place = gtk_button_new_with_label("Stand in Scene");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(place), "win.sketch-place");
    gtk_widget_set_tooltip_text(place, "Stand this instance, or all of the sheet, in the scene");
    GtkWidget *second[] = {panel->instances,
                           studio_action_button("studio-dice-symbolic", "win.sketch-dice",
                                                "Other instances: another seed"),
                           studio_action_button("media-playback-start-symbolic", "win.sketch-play",
                                                "Let wind, sun and rain come up"),
                           place};
    return pane_of("Drawn", tools_of(first, G_N_ELEMENTS(first)),
                   tools_of(second, G_N_ELEMENTS(second)), panel->pages);
}

// ---- the board ---------------------------------------------------------------------------------

static void on_height(GtkRange *range, StudioSketchPanel *panel) {
    if (!panel->is_showing) {
        // As a device does, so that a stroke that is being drawn goes along.
        FrPenEvent event = {.kind = FR_PEN_HEIGHT, .height = gtk_range_get_value(range)};
        studio_sketch_board_feed(panel->board, &event);
    }
}

static void on_raised(StudioSketchBoard *board, StudioSketchPanel *panel) {
    (void)board;
    studio_sketch_show_height(panel);
}

static GtkWidget *make_height(StudioSketchPanel *panel) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    panel->height = gtk_scale_new_with_range(GTK_ORIENTATION_VERTICAL, -1, 1, 0.01);
    gtk_range_set_inverted(GTK_RANGE(panel->height), TRUE);
    gtk_scale_set_draw_value(GTK_SCALE(panel->height), FALSE);
    gtk_scale_add_mark(GTK_SCALE(panel->height), 0, GTK_POS_RIGHT, NULL);
    gtk_widget_set_vexpand(panel->height, TRUE);
    gtk_widget_set_name(panel->height, "sketch-height");
    studio_tell(panel->height,
                "Height of the board; the wheel and Page Up, Page Down move it, too");
    g_signal_connect(panel->height, "value-changed", G_CALLBACK(on_height), panel);
    panel->height_text = gtk_label_new("");
    gtk_label_set_width_chars(GTK_LABEL(panel->height_text), 8);
    gtk_widget_add_css_class(panel->height_text, "numeric");
    gtk_widget_add_css_class(panel->height_text, "caption");
    gtk_box_append(GTK_BOX(box), panel->height);
    gtk_box_append(GTK_BOX(box), panel->height_text);
    gtk_widget_set_margin_bottom(box, 8);
    return box;
}

static GtkWidget *make_board(StudioSketchPanel *panel) {
    static const Button pens[] = {
        {"Stroke", "stroke", "Draw the shape of the chosen branches"},
        {"Wind", "wind", "Draw an arrow: branches lean that way"},
        {"Sun", "sun", "Draw an arrow upwards: branches rise"},
        {"Rain", "rain", "Draw an arrow downwards: branches are pressed down"}};
    static const Button boards[] = {
        {"Upright", "upright", "The board stands, as the skeleton is seen; height is nearness"},
        {"Level", "level", "The board lies, seen from above; height is height"}};
    panel->board = STUDIO_SKETCH_BOARD(studio_sketch_board_new());
    gtk_widget_set_name(GTK_WIDGET(panel->board), "sketch-board");
    g_signal_connect(panel->board, "raised", G_CALLBACK(on_raised), panel);
    g_signal_connect(panel->board, "drawn", G_CALLBACK(studio_sketch_on_drawn), panel);
    GtkWidget *content = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
    gtk_box_append(GTK_BOX(content), GTK_WIDGET(panel->board));
    gtk_box_append(GTK_BOX(content), make_height(panel));
    GtkWidget *first[] = {choice_of("win.sketch-pen", pens, G_N_ELEMENTS(pens))};
    panel->device_button = gtk_button_new_with_label("Device…");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(panel->device_button), "win.sketch-device");
    gtk_widget_set_tooltip_text(panel->device_button,
                                "Take height or strokes from a device that writes lines of text");
    GtkWidget *second[] = {choice_of("win.sketch-board", boards, G_N_ELEMENTS(boards)),
                           toggle("Tilt", "win.sketch-tilt", "The tilt of a pen moves the board"),
                           panel->device_button};
    return pane_of("Board", tools_of(first, G_N_ELEMENTS(first)),
                   tools_of(second, G_N_ELEMENTS(second)), content);
}

// ---- the skeleton ------------------------------------------------------------------------------

static void on_turned(StudioSketchView *view, StudioSketchPanel *panel) {
    studio_sketch_board_get(panel->board)->azimuth = studio_sketch_view_camera(view)->azimuth;
    studio_sketch_board_update(panel->board);
}

static void on_branches(GObject *list, GParamSpec *spec, StudioSketchPanel *panel) {
    (void)spec;
    studio_sketch_choose_kind(panel, gtk_drop_down_get_selected(GTK_DROP_DOWN(list)));
}

static GtkWidget *make_skeleton(StudioSketchPanel *panel) {
    static const Button tools[] = {
        {"Paint", "paint", "Paint along branches, from the stem outwards, to choose them"},
        {"Path", "path", "Click the two ends of a path: what lies between is chosen, too"},
        {"Turn", "turn", "Drag to turn the skeleton; the right button always does"}};
    static const Button applies[] = {
        {"Chosen", "selected", "A stroke is for the chosen branches alone"},
        {"Borne", "descendants", "A stroke is for all that the chosen branches bear"},
        {"Both", "both", "A stroke is for the chosen branches and all that they bear"}};
    panel->skeleton = STUDIO_SKETCH_VIEW(studio_sketch_view_new("Skeleton"));
    gtk_widget_set_name(GTK_WIDGET(panel->skeleton), "sketch-skeleton");
    studio_describe(
        GTK_WIDGET(panel->skeleton),
        "Home chooses the stem, Page Down a branch of it, N the next one, Page Up what bears it");
    studio_sketch_view_set_painting(panel->skeleton, TRUE);
    g_signal_connect(panel->skeleton, "pen", G_CALLBACK(studio_sketch_on_pen), panel);
    g_signal_connect(panel->skeleton, "key", G_CALLBACK(studio_sketch_on_key), panel);
    g_signal_connect(panel->skeleton, "turned", G_CALLBACK(on_turned), panel);
    panel->branches = gtk_drop_down_new_from_strings((const char *const[]){"Painted", "All", NULL});
    studio_tell(panel->branches, "Which branches: those painted, all, or all of a component");
    g_signal_connect(panel->branches, "notify::selected", G_CALLBACK(on_branches), panel);
    GtkWidget *first[] = {choice_of("win.sketch-tool", tools, G_N_ELEMENTS(tools)),
                          studio_action_button("edit-clear-symbolic", "win.sketch-clear",
                                               "Choose nothing (Escape in the skeleton)")};
    GtkWidget *second[] = {panel->branches,
                           choice_of("win.sketch-apply", applies, G_N_ELEMENTS(applies)),
                           toggle("One Path", "win.sketch-keeps-path",
                                  "When the pen is lifted, of branches that are not certain only "
                                  "the one most touched is chosen; else all of them")};
    return pane_of("Skeleton", tools_of(first, G_N_ELEMENTS(first)),
                   tools_of(second, G_N_ELEMENTS(second)), GTK_WIDGET(panel->skeleton));
}

// ---- the bar above -----------------------------------------------------------------------------

static void on_variation(GObject *list, GParamSpec *spec, StudioSketchPanel *panel) {
    (void)spec;
    const FrContents *contents = studio_sketch_contents(panel);
    if (panel->is_showing || contents == NULL) {
        return;
    }
    guint item = gtk_drop_down_get_selected(GTK_DROP_DOWN(list));
    GPtrArray *variations = studio_sketch_variations(contents, panel->of.base);
    panel->is_new = item >= variations->len;
    g_free(panel->of.varied);
    panel->of.varied = panel->is_new ? NULL : g_strdup(g_ptr_array_index(variations, item));
    g_ptr_array_unref(variations);
    panel->chosen = 0;
    studio_sketch_panel_follow(panel);
}

static uint32_t vary_now(StudioSketchPanel *panel) {
    const FrContents *contents = studio_sketch_contents(panel);
    return contents == NULL ? FR_NONE : studio_sketch_vary(contents, panel->of.varied);
}

static void on_set(StudioParamRow *row, const char *value, gboolean is_drag,
                   StudioSketchPanel *panel) {
    uint32_t vary = vary_now(panel);
    if (!panel->is_showing && vary != FR_NONE) {
        studio_set(panel->document, vary, studio_param_row_attribute(row), value, is_drag);
    }
}

static void on_sealed(StudioParamRow *row, StudioSketchPanel *panel) {
    (void)row;
    if (panel->document != NULL) {
        studio_document_seal(panel->document);
    }
}

static GtkWidget *scrolled(GtkWidget *content, int width) {
    GtkWidget *window = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(window), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(window), TRUE);
    gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(window), 520);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(window), content);
    gtk_widget_set_size_request(window, width, -1);
    return window;
}

static GtkWidget *popover_button(const char *label, const char *tip, GtkWidget *content,
                                 int width) {
    GtkWidget *button = gtk_menu_button_new();
    GtkWidget *popover = gtk_popover_new();
    gtk_popover_set_child(GTK_POPOVER(popover), scrolled(content, width));
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(button), popover);
    gtk_menu_button_set_label(GTK_MENU_BUTTON(button), label);
    studio_tell(button, tip);
    return button;
}

static GtkWidget *make_growth(StudioSketchPanel *panel) {
    panel->growth_rows = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    const FrParamTable *table = fr_vary_table();
    for (size_t i = 0; i < table->count; i++) {
        if (table->rows[i].kind != FR_PARAM_TEXT) {
            GtkWidget *row = studio_param_row_new(&table->rows[i]);
            g_signal_connect(row, "set", G_CALLBACK(on_set), panel);
            g_signal_connect(row, "sealed", G_CALLBACK(on_sealed), panel);
            gtk_box_append(GTK_BOX(panel->growth_rows), row);
        }
    }
    panel->growth =
        popover_button("Growth", "How growth follows what was drawn", panel->growth_rows, 380);
    return panel->growth;
}

static GtkWidget *make_bar(StudioSketchPanel *panel) {
    panel->variation = gtk_drop_down_new_from_strings((const char *const[]){"New variation", NULL});
    studio_tell(panel->variation, "The variation that strokes are added to");
    g_signal_connect(panel->variation, "notify::selected", G_CALLBACK(on_variation), panel);
    panel->marks = gtk_box_new(GTK_ORIENTATION_VERTICAL, 2);
    panel->drawn = popover_button("Drawn: 0", "Strokes and indicators, to look at and remove",
                                  panel->marks, 300);
    panel->hint = gtk_label_new("");
    gtk_label_set_ellipsize(GTK_LABEL(panel->hint), PANGO_ELLIPSIZE_END);
    gtk_label_set_xalign(GTK_LABEL(panel->hint), 0);
    gtk_widget_add_css_class(panel->hint, "dim-label");
    gtk_widget_set_hexpand(panel->hint, TRUE);
    GtkWidget *done = gtk_button_new_with_label("Done");
    gtk_actionable_set_action_name(GTK_ACTIONABLE(done), "win.sketch");
    gtk_widget_set_tooltip_text(done, "Back to the whole document (Ctrl+T)");
    GtkWidget *parts[] = {panel->variation, panel->drawn, make_growth(panel), panel->hint, done};
    GtkWidget *row = row_of(parts, G_N_ELEMENTS(parts));
    gtk_widget_add_css_class(row, "sketch-bar");
    return row;
}

static GtkWidget *make_problem(StudioSketchPanel *panel) {
    panel->problem = gtk_revealer_new();
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    gtk_widget_add_css_class(box, "problem");
    gtk_widget_add_css_class(panel->problem, "error-bar");
    gtk_box_append(GTK_BOX(box), gtk_image_new_from_icon_name("dialog-warning-symbolic"));
    panel->problem_text = gtk_label_new("");
    gtk_label_set_ellipsize(GTK_LABEL(panel->problem_text), PANGO_ELLIPSIZE_END);
    gtk_box_append(GTK_BOX(box), panel->problem_text);
    gtk_revealer_set_child(GTK_REVEALER(panel->problem), box);
    return panel->problem;
}

void studio_sketch_make(StudioSketchPanel *panel) {
    panel->outer = gtk_paned_new(GTK_ORIENTATION_HORIZONTAL);
    panel->inner = gtk_paned_new(GTK_ORIENTATION_HORIZONTAL);
    gtk_paned_set_start_child(GTK_PANED(panel->outer), make_strokes(panel));
    gtk_paned_set_end_child(GTK_PANED(panel->outer), panel->inner);
    gtk_paned_set_start_child(GTK_PANED(panel->inner), make_board(panel));
    gtk_paned_set_end_child(GTK_PANED(panel->inner), make_skeleton(panel));
    GtkWidget *panes[] = {panel->outer, panel->inner};
    for (size_t i = 0; i < G_N_ELEMENTS(panes); i++) {
        gtk_paned_set_shrink_start_child(GTK_PANED(panes[i]), FALSE);
        gtk_paned_set_shrink_end_child(GTK_PANED(panes[i]), FALSE);
        gtk_paned_set_wide_handle(GTK_PANED(panes[i]), FALSE);
    }
    studio_name(panel->outer, "Divider between result and board");
    studio_name(panel->inner, "Divider between board and skeleton");
    gtk_widget_set_vexpand(panel->outer, TRUE);
    gtk_box_append(GTK_BOX(panel), make_bar(panel));
    gtk_box_append(GTK_BOX(panel), panel->outer);
    gtk_box_append(GTK_BOX(panel), make_problem(panel));
}
