/// The graph panel without a pointer: all that dragging does, by keys.
#include "studio/graph_panel_private.h"

#include "studio/accessible.h"

#include <math.h>

static void select_element(StudioGraphPanel *panel, uint32_t element) {
    g_signal_emit_by_name(panel, "selected", element);
}

static uint32_t selected_box(StudioGraphPanel *panel) {
    for (guint i = 0; i < panel->graph->boxes->len; i++) {
        if (studio_graph_box(panel->graph, i)->element == panel->selected) {
            return i;
        }
    }
    return FR_NONE;
}

static uint32_t selected_wire(StudioGraphPanel *panel) {
    for (guint i = 0; i < panel->graph->wires->len; i++) {
        if (studio_graph_wire(panel->graph, i)->element == panel->selected) {
            return i;
        }
    }
    return FR_NONE;
}

// ---- words -------------------------------------------------------------------------------------

static char *words_of_box(StudioGraphPanel *panel, uint32_t index) {
    const StudioBox *box = studio_graph_box(panel->graph, index);
    const Load *load = studio_graph_load(panel, box);
    GString *words = g_string_new(box->id);
    g_string_append_printf(words, ", %s", fr_pgraph_table(box->kind)->element);
    if (!box->is_enabled) {
        g_string_append(words, ", off");
    } else if (load != NULL) {
        g_string_append_printf(words, ", %" G_GUINT64_FORMAT " in the plant", load->instances);
    }
    g_string_append(words, box->is_recursive ? ", repeated" : "");
    return g_string_free(words, FALSE);
}

static char *words_of_wire(StudioGraphPanel *panel, uint32_t index) {
    const StudioWire *wire = studio_graph_wire(panel->graph, index);
    const StudioBox *from = studio_graph_box(panel->graph, wire->from);
    char *again = wire->again == FR_NONE
                      ? g_strdup("")
                      : studio_repeat_words(studio_graph_repeat(panel->graph, wire->again));
    char *words = g_strdup_printf(
        "Link: %s%s%s, %s of %s", studio_graph_box(panel->graph, wire->to)->id,
        again[0] == '\0' ? "" : " ", again, studio_link_words(wire->kind, from->kind), from->id);
    g_free(again);
    return words;
}

void studio_graph_say(StudioGraphPanel *panel) {
    bool is_refused;
    uint32_t box = selected_box(panel), wire = selected_wire(panel);
    char *words = panel->drag == DRAG_BOX && panel->is_dragged
                      ? studio_graph_words_of_drop(panel, &is_refused)
                  : box != FR_NONE  ? words_of_box(panel, box)
                  : wire != FR_NONE ? words_of_wire(panel, wire)
                                    : g_strdup_printf("%u components", panel->graph->boxes->len);
    studio_describe(GTK_WIDGET(panel), words == NULL ? "" : words);
    g_free(words);
}

// ---- where to ----------------------------------------------------------------------------------

// The nearest box in a direction.
static uint32_t neighbour(StudioGraphPanel *panel, uint32_t from, double dx, double dy) {
    uint32_t best = FR_NONE;
    double nearest = INFINITY, here[2];
    studio_graph_stand(panel, studio_graph_box(panel->graph, from), &here[0], &here[1]);
    for (guint i = 0; i < panel->graph->boxes->len; i++) {
        double x, y;
        studio_graph_stand(panel, studio_graph_box(panel->graph, i), &x, &y);
        x -= here[0], y -= here[1];
        double ahead = x * dx + y * dy, aside = fabs(x * dy) + fabs(y * dx);
        if (ahead > 0.1 && ahead + 2 * aside < nearest) {
            nearest = ahead + 2 * aside;
            best = i;
        }
    }
    return best;
}

// The next link from, or to, the selected box; of a selected link, one more at the same box.
static void select_wire(StudioGraphPanel *panel, bool is_from) {
    uint32_t box = selected_box(panel), wire = selected_wire(panel);
    guint count = panel->graph->wires->len;
    if (wire != FR_NONE) {
        const StudioWire *at = studio_graph_wire(panel->graph, wire);
        box = is_from ? at->from : at->to;
    }
    for (guint k = 0; box != FR_NONE && k < count; k++) {
        guint i = wire == FR_NONE ? k : (wire + 1 + k) % count;
        const StudioWire *at = studio_graph_wire(panel->graph, i);
        if ((is_from ? at->from : at->to) == box) {
            select_element(panel, at->element);
            return;
        }
    }
}

static void go(StudioGraphPanel *panel, double dx, double dy) {
    uint32_t from = selected_box(panel), wire = selected_wire(panel), to;
    if (from != FR_NONE) {
        to = neighbour(panel, from, dx, dy);
    } else if (wire != FR_NONE) {
        const StudioWire *at = studio_graph_wire(panel->graph, wire);
        to = dx + dy > 0 ? at->to : at->from;
    } else {
        to = 0;
    }
    if (to != FR_NONE) {
        select_element(panel, studio_graph_box(panel->graph, to)->element);
    }
}

// ---- carrying a box ----------------------------------------------------------------------------

static bool is_carrying(StudioGraphPanel *panel) {
    return panel->drag == DRAG_BOX && panel->is_carried;
}

static void middle_of(StudioGraphPanel *panel, uint32_t box, double *x, double *y) {
    graphene_rect_t rect = studio_graph_box_rect(panel, box);
    *x = rect.origin.x + 0.5 * rect.size.width;
    *y = rect.origin.y + 0.5 * rect.size.height;
}

static void carry_to(StudioGraphPanel *panel, uint32_t box) {
    panel->over = box;
    middle_of(panel, box, &panel->x, &panel->y);
    studio_graph_say(panel);
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

static void pick_up(StudioGraphPanel *panel) {
    uint32_t box = selected_box(panel);
    if (box != FR_NONE) {
        panel->drag = DRAG_BOX;
        panel->held = box;
        panel->is_dragged = panel->is_carried = true;
        carry_to(panel, box);
    }
}

static void put_down(StudioGraphPanel *panel, bool is_dropped) {
    if (is_dropped) {
        studio_graph_drop(panel);
    }
    panel->drag = DRAG_NOTHING;
    panel->is_carried = false;
    panel->over = FR_NONE;
    studio_graph_say(panel);
    gtk_widget_queue_draw(GTK_WIDGET(panel));
}

static gboolean carry(StudioGraphPanel *panel, guint key, double dx, double dy) {
    if (dx != 0 || dy != 0) {
        uint32_t to = neighbour(panel, panel->over, dx, dy);
        if (to != FR_NONE) {
            carry_to(panel, to);
        }
        return TRUE;
    }
    bool is_enter = key == GDK_KEY_Return || key == GDK_KEY_KP_Enter;
    if (is_enter || key == GDK_KEY_l) {
        put_down(panel, is_enter);
        return TRUE;
    }
    return FALSE;
}

// ---- keys --------------------------------------------------------------------------------------

static void popup(StudioGraphPanel *panel) {
    double x, y;
    uint32_t box = selected_box(panel);
    if (box != FR_NONE) {
        middle_of(panel, box, &x, &y);
        studio_graph_popup(panel, x, y);
    }
}

static gboolean on_key(GtkEventControllerKey *keys, guint key, guint code, GdkModifierType state,
                       StudioGraphPanel *panel) {
    (void)keys;
    (void)code;
    double dx = key == GDK_KEY_Right ? 1 : key == GDK_KEY_Left ? -1 : 0;
    double dy = key == GDK_KEY_Down ? 1 : key == GDK_KEY_Up ? -1 : 0;
    if (key == GDK_KEY_Escape && panel->drag != DRAG_NOTHING) {
        put_down(panel, false);
        return TRUE;
    }
    if (panel->graph->boxes->len == 0) {
        return FALSE;
    }
    if (is_carrying(panel)) {
        return carry(panel, key, dx, dy);
    }
    if (dx != 0 || dy != 0) {
        go(panel, dx, dy);
        return TRUE;
    }
    switch (key) {
    case GDK_KEY_Delete:
    case GDK_KEY_BackSpace:
        return gtk_widget_activate_action(GTK_WIDGET(panel), "win.remove", NULL);
    case GDK_KEY_Return:
    case GDK_KEY_KP_Enter:
        return gtk_widget_activate_action(GTK_WIDGET(panel), "win.inspect", NULL);
    case GDK_KEY_l:
        pick_up(panel);
        return TRUE;
    case GDK_KEY_c:
    case GDK_KEY_v:
        return (state & GDK_CONTROL_MASK) != 0 &&
               gtk_widget_activate_action(
                   GTK_WIDGET(panel), key == GDK_KEY_c ? "win.copy-part" : "win.paste-part", NULL);
    case GDK_KEY_Page_Up:
    case GDK_KEY_Page_Down:
        select_wire(panel, key == GDK_KEY_Page_Down);
        return TRUE;
    case GDK_KEY_Menu:
        popup(panel);
        return TRUE;
    case GDK_KEY_F10:
        if ((state & GDK_SHIFT_MASK) != 0) {
            popup(panel);
        }
        return (state & GDK_SHIFT_MASK) != 0;
    default:
        return FALSE;
    }
}

static void on_leave(GtkEventControllerFocus *focus, StudioGraphPanel *panel) {
    (void)focus;
    if (is_carrying(panel)) {
        put_down(panel, false);
    }
}

void studio_graph_add_keys(StudioGraphPanel *panel) {
    GtkWidget *widget = GTK_WIDGET(panel);
    GtkEventController *keys = gtk_event_controller_key_new();
    g_signal_connect(keys, "key-pressed", G_CALLBACK(on_key), panel);
    gtk_widget_add_controller(widget, keys);
    GtkEventController *focus = gtk_event_controller_focus_new();
    g_signal_connect(focus, "leave", G_CALLBACK(on_leave), panel);
    gtk_widget_add_controller(widget, focus);
}
