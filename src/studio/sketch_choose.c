/// Choosing branches in the skeleton: painting over them, by the two ends of a path, by keys, or
/// all that a component made.
#include "studio/sketch_panel_private.h"

#include <math.h>
#include <string.h>

static const double grab = 9; // pixels that count as a branch

static const FrPlant *plant_of(StudioSketchPanel *panel) {
    return panel->base->plant;
}

// ---- the choice --------------------------------------------------------------------------------

// Brings the board to what is chosen, else to the plant, its plane just before it, so that all of
// it is seen.
static void bring_board(StudioSketchPanel *panel) {
    StudioBoard *board = studio_sketch_board_get(panel->board);
    uint32_t first = studio_sketch_first(plant_of(panel), panel->states);
    bool is_path = panel->kind == STUDIO_CHOSEN_PAINTED && first != FR_NONE;
    GArray *lines = g_array_new(FALSE, FALSE, sizeof(StudioLine));
    studio_sketch_add_chosen(lines, plant_of(panel), is_path ? panel->states : NULL);
    double width = gtk_widget_get_width(GTK_WIDGET(panel->board));
    double height = gtk_widget_get_height(GTK_WIDGET(panel->board));
    board->azimuth = studio_sketch_view_camera(panel->skeleton)->azimuth;
    studio_board_frame(board, (const StudioLine *)(const void *)lines->data, lines->len,
                       width > 0 && height > 0 ? width / height : 1);
    double nearest = -board->reach;
    for (guint i = 0; i < 2 * lines->len; i++) {
        const StudioLine *line = &g_array_index(lines, StudioLine, i / 2);
        const float *end = i % 2 == 0 ? line->from : line->to;
        double at[3] = {(double)end[0], (double)end[1], (double)end[2]};
        nearest = fmax(nearest, studio_board_height_of(board, at));
    }
    studio_board_raise(board, nearest + 0.005 * board->size);
    g_array_unref(lines);
    studio_sketch_board_update(panel->board);
    studio_sketch_show_height(panel);
}

void studio_sketch_chosen(StudioSketchPanel *panel) {
    studio_sketch_states(plant_of(panel), panel->selection, panel->kind, panel->component,
                         panel->states);
    studio_sketch_show_skeleton(panel);
}

static void settle(StudioSketchPanel *panel) {
    studio_sketch_chosen(panel);
    bring_board(panel);
}

char *studio_sketch_choice(StudioSketchPanel *panel) {
    if (panel->base == NULL) {
        return NULL;
    }
    switch (panel->kind) {
    case STUDIO_CHOSEN_ALL:
        return g_strdup("");
    case STUDIO_CHOSEN_COMPONENT:
        return g_strdup(
            g_array_index(plant_of(panel)->components, FrComponent, panel->component).id);
    default:
        break;
    }
    char *choice = fr_selection_choice(panel->selection);
    if (*choice == '\0') {
        g_clear_pointer(&choice, g_free);
    }
    return choice;
}

void studio_sketch_clear(StudioSketchPanel *panel) {
    panel->path_end = FR_NONE;
    if (panel->base != NULL) {
        fr_selection_clear(panel->selection);
        panel->kind = STUDIO_CHOSEN_PAINTED;
        panel->is_showing = true;
        gtk_drop_down_set_selected(GTK_DROP_DOWN(panel->branches), 0);
        panel->is_showing = false;
        settle(panel);
    }
}

// ---- by component ------------------------------------------------------------------------------

// The components that have branches, as they stand in the list behind its first two items.
static GArray *components_of(const FrPlant *plant) {
    GArray *found = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    guint8 *is_there = g_new0(guint8, plant->components->len + 1);
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (plant->axes.component[a] < plant->components->len) {
            is_there[plant->axes.component[a]] = 1;
        }
    }
    for (uint32_t c = 0; c < plant->components->len; c++) {
        if (is_there[c] != 0) {
            g_array_append_val(found, c);
        }
    }
    g_free(is_there);
    return found;
}

static void fill_branches(StudioSketchPanel *panel) {
    GtkStringList *names = gtk_string_list_new(NULL);
    gtk_string_list_append(names, "Painted");
    gtk_string_list_append(names, "All");
    GArray *components = components_of(plant_of(panel));
    for (guint i = 0; i < components->len; i++) {
        uint32_t c = g_array_index(components, uint32_t, i);
        gtk_string_list_append(names,
                               g_array_index(plant_of(panel)->components, FrComponent, c).id);
    }
    gtk_drop_down_set_model(GTK_DROP_DOWN(panel->branches), G_LIST_MODEL(names));
    g_array_unref(components);
    g_object_unref(names);
}

void studio_sketch_choose_kind(StudioSketchPanel *panel, guint item) {
    if (panel->base == NULL || panel->is_showing) {
        return;
    }
    GArray *components = components_of(plant_of(panel));
    StudioChosen kind = item == 0   ? STUDIO_CHOSEN_PAINTED
                        : item == 1 ? STUDIO_CHOSEN_ALL
                                    : STUDIO_CHOSEN_COMPONENT;
    if (kind != STUDIO_CHOSEN_COMPONENT || item - 2 < components->len) {
        panel->component = kind == STUDIO_CHOSEN_COMPONENT
                               ? g_array_index(components, uint32_t, item - 2)
                               : FR_NONE;
        panel->kind = kind;
        settle(panel);
    }
    g_array_unref(components);
}

void studio_sketch_take_base(StudioSketchPanel *panel, StudioBase *base) {
    bool is_first = panel->base == NULL;
    g_clear_pointer(&panel->selection, fr_selection_free);
    g_clear_pointer(&panel->seen, fr_id_buffer_free);
    g_clear_pointer(&panel->states, g_free);
    StudioBase *old = panel->base;
    panel->base = studio_base_ref(base);
    studio_base_unref(old);
    panel->selection = fr_selection_new(plant_of(panel));
    panel->states = g_new0(uint8_t, plant_of(panel)->axes.count + 1);
    panel->is_showing = true;
    fill_branches(panel);
    panel->is_showing = false;
    studio_sketch_clear(panel);
    if (is_first) {
        studio_sketch_view_frame(panel->skeleton);
    }
}

// ---- with the pen ------------------------------------------------------------------------------

static bool begin_painting(StudioSketchPanel *panel, GtkWidget *view) {
    g_clear_pointer(&panel->seen, fr_id_buffer_free);
    StudioLens lens = studio_sketch_view_lens(panel->skeleton);
    FrContext context = fr_context_default();
    uint32_t width = (uint32_t)MAX(1, gtk_widget_get_width(view));
    uint32_t height = (uint32_t)MAX(1, gtk_widget_get_height(view));
    return fr_id_buffer_draw(plant_of(panel), lens.project, width, height, grab, &context,
                             &panel->seen) == FR_OK;
}

static void pick_end(StudioSketchPanel *panel, double x, double y) {
    uint32_t branch = FR_NONE;
    if (x >= 0 && y >= 0 && x < panel->seen->width && y < panel->seen->height) {
        branch = panel->seen->branch[(size_t)y * panel->seen->width + (size_t)x];
    }
    if (branch == FR_NONE) {
        return;
    }
    if (panel->path_end == FR_NONE) {
        panel->path_end = branch;
        fr_selection_clear(panel->selection);
        fr_selection_touch(panel->selection, branch);
        studio_sketch_say(panel, "Now click the other end of the path");
    } else {
        if (!fr_selection_between(panel->selection, panel->path_end, branch)) {
            studio_sketch_say(panel, "No path leads there: neither of the two bears the other");
        }
        panel->path_end = FR_NONE;
    }
}

static void use_painted(StudioSketchPanel *panel) {
    if (panel->kind != STUDIO_CHOSEN_PAINTED) {
        panel->kind = STUDIO_CHOSEN_PAINTED;
        panel->is_showing = true;
        gtk_drop_down_set_selected(GTK_DROP_DOWN(panel->branches), 0);
        panel->is_showing = false;
    }
}

void studio_sketch_on_pen(StudioSketchView *view, int phase, double x, double y,
                          StudioSketchPanel *panel) {
    if (panel->base == NULL ||
        (phase == STUDIO_PEN_DOWN && !begin_painting(panel, GTK_WIDGET(view))) ||
        panel->seen == NULL) {
        return;
    }
    use_painted(panel);
    if (panel->tool == TOOL_PATH) {
        if (phase == STUDIO_PEN_UP) {
            pick_end(panel, x, y);
            settle(panel);
        }
    } else {
        if (phase == STUDIO_PEN_DOWN) {
            fr_selection_clear(panel->selection);
        }
        fr_selection_move(panel->selection, panel->seen, x, y);
        if (phase == STUDIO_PEN_UP) {
            fr_selection_end(panel->selection,
                             panel->keeps_path ? FR_END_KEEPS_PATH : FR_END_PUBLISHED);
            settle(panel);
        } else {
            studio_sketch_chosen(panel);
        }
    }
    if (phase == STUDIO_PEN_UP) {
        g_clear_pointer(&panel->seen, fr_id_buffer_free);
    }
}

// ---- with keys ---------------------------------------------------------------------------------

static uint32_t bearer_of(const FrPlant *plant, uint32_t axis) {
    uint32_t node = plant->axes.bearer[axis];
    return node == FR_NONE ? FR_NONE : plant->nodes.axis[node];
}

// The next axis (or the one before) of the same bearer; FR_NONE.
static uint32_t sibling_of(const FrPlant *plant, uint32_t axis, int step) {
    uint32_t bearer = bearer_of(plant, axis);
    for (uint32_t a = axis + (uint32_t)step; a < plant->axes.count; a += (uint32_t)step) {
        if (bearer_of(plant, a) == bearer) {
            return a;
        }
    }
    return FR_NONE;
}

static uint32_t child_of(const FrPlant *plant, uint32_t axis) {
    for (uint32_t a = axis + 1; a < plant->axes.count; a++) {
        if (bearer_of(plant, a) == axis) {
            return a;
        }
    }
    return FR_NONE;
}

gboolean studio_sketch_on_key(StudioSketchView *view, guint key, gboolean *is_taken,
                              StudioSketchPanel *panel) {
    (void)view;
    if (panel->base == NULL || plant_of(panel)->axes.count == 0) {
        return FALSE;
    }
    const FrPlant *plant = plant_of(panel);
    uint32_t now =
        panel->kind == STUDIO_CHOSEN_PAINTED ? studio_sketch_first(plant, panel->states) : FR_NONE;
    uint32_t next = FR_NONE;
    if (key == GDK_KEY_Escape) {
        studio_sketch_clear(panel);
        *is_taken = TRUE;
        return TRUE;
    }
    if (key == GDK_KEY_Home || (now == FR_NONE && key == GDK_KEY_Page_Down)) {
        next = 0;
    } else if (now != FR_NONE) {
        next = key == GDK_KEY_Page_Down ? child_of(plant, now)
               : key == GDK_KEY_Page_Up ? bearer_of(plant, now)
               : key == GDK_KEY_n       ? sibling_of(plant, now, 1)
               : key == GDK_KEY_p       ? sibling_of(plant, now, -1)
                                        : FR_NONE;
    }
    if (next != FR_NONE) {
        use_painted(panel);
        fr_selection_clear(panel->selection);
        fr_selection_touch(panel->selection, next);
        settle(panel);
        *is_taken = TRUE;
    }
    return *is_taken;
}
