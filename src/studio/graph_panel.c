#include "studio/graph_panel_private.h"

#include "studio/accessible.h"
#include "studio/model/builder.h"
#include "studio/model/values.h"
#include "studio/widgets.h"

#include <math.h>
#include <string.h>

static guint selected_signal;

G_DEFINE_TYPE(StudioGraphPanel, studio_graph_panel, GTK_TYPE_WIDGET)

// ---- what a drop would do ----------------------------------------------------------------------

void studio_graph_drop(StudioGraphPanel *panel) {
    const StudioBox *on =
        panel->over == FR_NONE ? NULL : studio_graph_box(panel->graph, panel->over);
    char *target = on == NULL ? NULL : g_strdup(on->id);
    char *made = NULL;
    bool is_tool = panel->drag == DRAG_TOOL && (on != NULL || studio_graph_is_beside_boxes(panel));
    if (is_tool && panel->held == TOOL_PRESET) {
        gtk_widget_activate_action(GTK_WIDGET(panel), "win.insert-preset-on", "s",
                                   target == NULL ? "" : target);
    } else if (is_tool) {
        studio_add_component(panel->document, panel->plant, (FrComponentKind)panel->held, target,
                             &made);
    } else if (panel->drag == DRAG_BOX && on != NULL) {
        const StudioBox *held = studio_graph_box(panel->graph, panel->held);
        made = g_strdup(held->id);
        studio_add_link(panel->document, panel->plant, target, made,
                        studio_likely_link(on->kind, held->kind));
    }
    uint32_t box = made == NULL ? FR_NONE : studio_graph_find(panel->graph, made);
    if (box != FR_NONE) {
        g_signal_emit(panel, selected_signal, 0, studio_graph_box(panel->graph, box)->element);
    }
    g_free(made);
    g_free(target);
}

// ---- pointer -----------------------------------------------------------------------------------

static void on_begin(GtkGestureDrag *gesture, double x, double y, StudioGraphPanel *panel) {
    (void)gesture;
    gtk_widget_grab_focus(GTK_WIDGET(panel));
    panel->x = x;
    panel->y = y;
    panel->is_dragged = panel->is_carried = false;
    panel->held = studio_graph_box_under(panel, x, y);
    panel->drag = panel->held != FR_NONE ? DRAG_BOX : DRAG_CANVAS;
    if (panel->held == FR_NONE && y > studio_graph_tools_top(panel)) {
        panel->held = studio_graph_tool_under(panel, x, y);
        panel->drag = panel->held != FR_NONE ? DRAG_TOOL : DRAG_NOTHING;
    }
}

static void on_drag(GtkGestureDrag *gesture, double dx, double dy, StudioGraphPanel *panel) {
    if (panel->drag == DRAG_NOTHING) { // put down by Escape
        return;
    }
    double x0, y0;
    gtk_gesture_drag_get_start_point(gesture, &x0, &y0);
    panel->is_dragged = panel->is_dragged || hypot(dx, dy) > CLICK;
    if (panel->drag == DRAG_CANVAS && panel->is_dragged) {
        panel->shift_x += x0 + dx - panel->x;
        panel->shift_y += y0 + dy - panel->y;
    }
    panel->x = x0 + dx;
    panel->y = y0 + dy;
    panel->over = studio_graph_box_under(panel, panel->x, panel->y);
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

static void click(StudioGraphPanel *panel) {
    uint32_t element = FR_NONE;
    if (panel->drag == DRAG_BOX) {
        element = studio_graph_box(panel->graph, panel->held)->element;
    } else if (panel->drag == DRAG_TOOL && panel->held == TOOL_PRESET) {
        gtk_widget_activate_action(GTK_WIDGET(panel), "win.insert-preset", NULL);
        return;
    } else if (panel->drag == DRAG_TOOL) {
        // A click is the short way: on what is selected.
        gtk_widget_activate_action(GTK_WIDGET(panel), "win.add", "s",
                                   fr_pgraph_table((FrComponentKind)panel->held)->element);
        return;
    } else {
        uint32_t wire = studio_graph_wire_under(panel, panel->x, panel->y);
        element = wire == FR_NONE ? FR_NONE : studio_graph_wire(panel->graph, wire)->element;
    }
    g_signal_emit(panel, selected_signal, 0, element);
}

static void on_end(GtkGestureDrag *gesture, double dx, double dy, StudioGraphPanel *panel) {
    (void)gesture;
    (void)dx;
    (void)dy;
    DragKind drag = panel->drag;
    if (panel->document == NULL || drag == DRAG_NOTHING) {
        return;
    }
    if (!panel->is_dragged) {
        click(panel);
    } else if (drag != DRAG_CANVAS) {
        studio_graph_drop(panel);
    }
    panel->drag = DRAG_NOTHING;
    panel->over = FR_NONE;
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

void studio_graph_popup(StudioGraphPanel *panel, double x, double y) {
    GdkRectangle at = {(int)x, (int)y, 1, 1};
    gtk_popover_set_pointing_to(GTK_POPOVER(panel->menu), &at);
    gtk_popover_popup(GTK_POPOVER(panel->menu));
}

static void on_menu(GtkGestureClick *gesture, int count, double x, double y,
                    StudioGraphPanel *panel) {
    (void)gesture;
    (void)count;
    uint32_t box = studio_graph_box_under(panel, x, y);
    if (box != FR_NONE) {
        g_signal_emit(panel, selected_signal, 0, studio_graph_box(panel->graph, box)->element);
        studio_graph_popup(panel, x, y);
    }
}

// ---- showing -----------------------------------------------------------------------------------

static void studio_graph_panel_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    studio_graph_draw(STUDIO_GRAPH_PANEL(widget), snapshot);
}

static void on_motion(GtkEventControllerMotion *motion, double x, double y,
                      StudioGraphPanel *panel) {
    (void)motion;
    if (panel->drag == DRAG_NOTHING) {
        panel->x = x;
        panel->y = y;
    }
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

void studio_graph_panel_show(StudioGraphPanel *panel, StudioDocument *document, uint32_t plant,
                             uint32_t selected) {
    if (panel->document != document) {
        g_clear_pointer(&panel->counts, g_hash_table_unref);
        panel->shift_x = panel->shift_y = 0;
    }
    panel->document = document;
    bool is_new = panel->selected != selected;
    panel->plant = plant;
    panel->selected = selected;
    studio_graph_free(panel->graph);
    panel->graph = studio_graph_new(studio_document_contents(document), plant);
    if (is_new) {
        studio_graph_reveal(panel, selected);
    }
    panel->drag = DRAG_NOTHING; // what was held may be gone
    panel->over = FR_NONE;
    studio_graph_say(panel);
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

void studio_graph_panel_set_counts(StudioGraphPanel *panel, const GArray *counts) {
    const FrContents *contents = studio_document_contents(panel->document);
    const char *plant = panel->plant == FR_NONE ? NULL : fr_contents_at(contents, panel->plant)->id;
    g_clear_pointer(&panel->counts, g_hash_table_unref);
    panel->counts = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    for (guint i = 0; i < counts->len; i++) {
        const StudioCount *count = &g_array_index(counts, StudioCount, i);
        if (g_strcmp0(count->plant, plant) == 0) {
            Load load = {count->instances, count->seconds, count->skin_seconds};
            g_hash_table_insert(panel->counts, g_strdup(count->component),
                                g_memdup2(&load, sizeof load));
        }
    }
    studio_graph_say(panel);
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

void studio_graph_panel_set_budget(StudioGraphPanel *panel, StudioBudget budget) {
    panel->budget = budget;
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

gboolean studio_graph_panel_where(StudioGraphPanel *panel, const char *name, graphene_rect_t *box) {
    if (g_str_has_prefix(name, "box:")) {
        uint32_t found = studio_graph_find(panel->graph, name + strlen("box:"));
        *box = found == FR_NONE ? *box : studio_graph_box_rect(panel, found);
        return found != FR_NONE;
    }
    for (guint i = 0; g_str_has_prefix(name, "again:") && i < panel->graph->repeats->len; i++) {
        uint32_t first = studio_graph_repeat(panel->graph, i)->box;
        if (strcmp(studio_graph_box(panel->graph, first)->id, name + strlen("again:")) == 0) {
            *box = studio_graph_repeat_rect(panel, i);
            return TRUE;
        }
    }
    for (guint tool = 1; g_str_has_prefix(name, "tool:") && tool < TOOL_END; tool++) {
        if (strcmp(studio_graph_tool_name(tool), name + strlen("tool:")) == 0) {
            *box = studio_graph_tool_rect(panel, tool);
            return TRUE;
        }
    }
    return FALSE;
}

// The whole of what a box has no room for.
static gboolean on_tip(GtkWidget *widget, int x, int y, gboolean is_keyboard, GtkTooltip *tip,
                       gpointer data) {
    (void)is_keyboard;
    (void)data;
    StudioGraphPanel *panel = STUDIO_GRAPH_PANEL(widget);
    uint32_t index = studio_graph_box_under(panel, x, y);
    const StudioBox *box = index == FR_NONE ? NULL : studio_graph_box(panel->graph, index);
    const Load *load = box == NULL ? NULL : studio_graph_load(panel, box);
    if (load == NULL || panel->drag != DRAG_NOTHING) {
        return FALSE;
    }
    char *count = studio_count_words(load->instances, "instance", "instances");
    char *time = isnan(load->seconds)
                     ? g_strdup("")
                     : g_strdup_printf(", %.3g ms on one thread, %.3g ms of it for skin",
                                       1000 * load->seconds, 1000 * load->skin_seconds);
    char *text = g_strdup_printf("%s: %s%s", box->id, count, time);
    gtk_tooltip_set_text(tip, text);
    g_free(text);
    g_free(time);
    g_free(count);
    return TRUE;
}

// ---- life --------------------------------------------------------------------------------------

static void studio_graph_panel_dispose(GObject *object) {
    StudioGraphPanel *panel = STUDIO_GRAPH_PANEL(object);
    g_clear_pointer(&panel->menu, gtk_widget_unparent);
    g_clear_pointer(&panel->graph, studio_graph_free);
    g_clear_pointer(&panel->counts, g_hash_table_unref);
    G_OBJECT_CLASS(studio_graph_panel_parent_class)->dispose(object);
}

static void studio_graph_panel_allocate(GtkWidget *widget, int width, int height, int baseline) {
    (void)width;
    (void)height;
    (void)baseline;
    gtk_popover_present(GTK_POPOVER(STUDIO_GRAPH_PANEL(widget)->menu));
}

static void studio_graph_panel_class_init(StudioGraphPanelClass *class) {
    GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);
    G_OBJECT_CLASS(class)->dispose = studio_graph_panel_dispose;
    widget->snapshot = studio_graph_panel_snapshot;
    widget->size_allocate = studio_graph_panel_allocate;
    gtk_widget_class_set_css_name(widget, "graphpanel");
    gtk_widget_class_set_accessible_role(widget, GTK_ACCESSIBLE_ROLE_GROUP);
    selected_signal = g_signal_new("selected", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
                                   NULL, NULL, G_TYPE_NONE, 1, G_TYPE_UINT);
}

static gboolean on_scroll(GtkEventControllerScroll *scroll, double dx, double dy,
                          StudioGraphPanel *panel) {
    (void)scroll;
    studio_graph_scroll(panel, dx, dy);
    gtk_widget_queue_draw(GTK_WIDGET(panel));
    return TRUE;
}

static void add_controllers(StudioGraphPanel *panel) {
    GtkWidget *widget = GTK_WIDGET(panel);
    studio_listen_to_drags(widget, G_CALLBACK(on_begin), G_CALLBACK(on_drag), G_CALLBACK(on_end),
                           panel);
    studio_listen_for_menu(widget, G_CALLBACK(on_menu), panel);
    studio_graph_add_keys(panel);
    GtkEventController *motion = gtk_event_controller_motion_new();
    g_signal_connect(motion, "motion", G_CALLBACK(on_motion), panel);
    gtk_widget_add_controller(widget, motion);
    GtkEventController *scroll =
        gtk_event_controller_scroll_new(GTK_EVENT_CONTROLLER_SCROLL_BOTH_AXES);
    g_signal_connect(scroll, "scroll", G_CALLBACK(on_scroll), panel);
    gtk_widget_add_controller(widget, scroll);
}

static void studio_graph_panel_init(StudioGraphPanel *panel) {
    static const char *const items[][2] = {{"Copy", "win.copy-part"},
                                           {"Paste", "win.paste-part"},
                                           {"Duplicate", "win.duplicate"},
                                           {"Enable or Disable", "win.toggle-enabled"},
                                           {"Keep as a Preset…", "win.save-preset"},
                                           {"Insert a Preset…", "win.insert-preset"},
                                           {"Remove", "win.remove"}};
    GtkWidget *widget = GTK_WIDGET(panel);
    panel->plant = panel->selected = panel->over = FR_NONE;
    panel->graph = studio_graph_empty();
    GMenu *menu = g_menu_new();
    for (size_t i = 0; i < G_N_ELEMENTS(items); i++) {
        g_menu_append(menu, items[i][0], items[i][1]);
    }
    panel->menu = gtk_popover_menu_new_from_model(G_MENU_MODEL(menu));
    gtk_popover_set_has_arrow(GTK_POPOVER(panel->menu), FALSE);
    gtk_widget_set_parent(panel->menu, widget);
    g_object_unref(menu);
    gtk_widget_set_focusable(widget, TRUE);
    gtk_widget_set_has_tooltip(widget, TRUE);
    g_signal_connect(widget, "query-tooltip", G_CALLBACK(on_tip), NULL);
    gtk_widget_set_hexpand(widget, TRUE);
    gtk_widget_set_vexpand(widget, TRUE);
    studio_name(GTK_WIDGET(panel), "Graph of components");
    add_controllers(panel);
}

GtkWidget *studio_graph_panel_new(void) {
    return g_object_new(STUDIO_TYPE_GRAPH_PANEL, NULL);
}
