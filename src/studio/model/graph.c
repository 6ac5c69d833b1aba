#include "studio/model/graph.h"

#include <math.h>
#include <string.h>

StudioLoad studio_load_of(uint64_t instances, double seconds, const StudioBudget *budget) {
    bool is_many = budget->instances > 0 && instances > budget->instances;
    bool is_slow = budget->seconds > 0 && seconds > budget->seconds; // no NAN is
    return instances == 0       ? STUDIO_LOAD_NOTHING
           : is_many || is_slow ? STUDIO_LOAD_HEAVY
                                : STUDIO_LOAD_FINE;
}

char *studio_time_text(double seconds) {
    return !(seconds >= 0.001) ? g_strdup("")
           : seconds < 0.9995  ? g_strdup_printf("%.0f ms", seconds * 1000)
           : seconds < 9.95    ? g_strdup_printf("%.1f s", seconds)
                               : g_strdup_printf("%.0f s", seconds);
}

const StudioBox *studio_graph_box(const StudioGraph *graph, uint32_t box) {
    return &g_array_index(graph->boxes, StudioBox, box);
}

const StudioWire *studio_graph_wire(const StudioGraph *graph, uint32_t wire) {
    return &g_array_index(graph->wires, StudioWire, wire);
}

const StudioRepeat *studio_graph_repeat(const StudioGraph *graph, uint32_t repeat) {
    return &g_array_index(graph->repeats, StudioRepeat, repeat);
}

char *studio_repeat_words(const StudioRepeat *repeat) {
    return repeat->depth == 0 ? g_strdup("again")
                              : g_strdup_printf("again, %u deep", repeat->depth);
}

static StudioBox *box_at(StudioGraph *graph, uint32_t box) {
    return &g_array_index(graph->boxes, StudioBox, box);
}

uint32_t studio_graph_find(const StudioGraph *graph, const char *id) {
    for (guint i = 0; id != NULL && i < graph->boxes->len; i++) {
        if (strcmp(studio_graph_box(graph, i)->id, id) == 0) {
            return i;
        }
    }
    return FR_NONE;
}

static void box_clear(gpointer box) {
    g_free(((StudioBox *)box)->id);
}

// A whole number, or 0 if the text is anything else.
static uint32_t plain_number(const char *text) {
    guint64 number;
    return g_ascii_string_to_unsigned(text, 10, 1, UINT32_MAX, &number, NULL) ? (uint32_t)number
                                                                              : 0;
}

// A depth that is a number or the name of a slider; 0 if it is anything else.
static uint32_t read_depth(const FrContents *contents, uint32_t plant, uint32_t element) {
    char *text = fr_contents_get(contents, element, "depth");
    if (text == NULL) {
        return 0;
    }
    g_strstrip(text);
    uint32_t depth = plain_number(text);
    if (text[0] == '=') {
        const char *name = g_strchug(text + 1);
        for (uint32_t i = fr_contents_child(contents, plant, "slider"); i != FR_NONE;
             i = fr_contents_sibling(contents, i)) {
            if (g_strcmp0(fr_contents_at(contents, i)->id, name) == 0) {
                char *initial = fr_contents_get(contents, i, "initial");
                depth = initial == NULL ? 0 : plain_number(g_strstrip(initial));
                g_free(initial);
            }
        }
    }
    g_free(text);
    return depth;
}

static void read_box(StudioGraph *graph, const FrContents *contents, uint32_t plant,
                     uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    char *enabled = fr_contents_get(contents, element, "enabled");
    StudioBox box = {.element = element,
                     .id = g_strdup(at->id == NULL ? "" : at->id),
                     .kind = (FrComponentKind)at->component,
                     .is_enabled = g_strcmp0(enabled, "no") != 0,
                     .is_reached = at->component == FR_COMPONENT_CAMERA,
                     .depth = read_depth(contents, plant, element)};
    g_array_append_val(graph->boxes, box);
    g_free(enabled);
}

static void read_wire(StudioGraph *graph, const FrContents *contents, uint32_t element) {
    char *from = fr_contents_get(contents, element, "from");
    char *to = fr_contents_get(contents, element, "to");
    char *kind = fr_contents_get(contents, element, "kind");
    char *symbol = fr_contents_get(contents, element, "symbol");
    StudioWire wire = {.element = element,
                       .from = studio_graph_find(graph, from),
                       .to = studio_graph_find(graph, to),
                       .again = FR_NONE,
                       .kind = symbol != NULL                   ? FR_LINK_SYMBOL
                               : g_strcmp0(kind, "branch") == 0 ? FR_LINK_BRANCH
                               : g_strcmp0(kind, "leaf") == 0   ? FR_LINK_LEAF
                                                                : FR_LINK_CHILD};
    if (wire.from != FR_NONE && wire.to != FR_NONE) {
        box_at(graph, wire.to)->is_reached = true;
        g_array_append_val(graph->wires, wire);
    }
    g_free(symbol);
    g_free(kind);
    g_free(to);
    g_free(from);
}

// ---- layout ------------------------------------------------------------------------------------

// A walk over the tree of first ways to each box. Each subtree takes columns of its own. A link
// that leads back to where the walk came by ends at a repeat instead, a leaf of the tree.
typedef struct Walk {
    StudioGraph *graph;
    bool *is_placed;
    bool *is_above;    // on the way to the box that is placed now, or that itself
    uint32_t *came_by; // the wire to a box in the tree
    double column;     // the next that is free
    uint32_t line;
} Walk;

// From the end of a recursion back up to its first.
static void close_recursion(Walk *walk, StudioWire *wire, double row) {
    StudioGraph *graph = walk->graph;
    StudioRepeat repeat = {
        .box = wire->to, .column = walk->column++, .row = row, .line = walk->line++};
    wire->again = graph->repeats->len;
    wire->is_tree = wire->is_repeated = true;
    for (uint32_t box = wire->from;;) {
        StudioBox *member = box_at(graph, box);
        member->is_recursive = true;
        bool is_less = repeat.depth == 0 || member->depth < repeat.depth;
        repeat.depth = member->depth > 0 && is_less ? member->depth : repeat.depth;
        if (box == wire->to) {
            break;
        }
        StudioWire *above = &g_array_index(graph->wires, StudioWire, walk->came_by[box]);
        above->is_repeated = true;
        box = above->from;
    }
    graph->rows = fmax(graph->rows, row + 1);
    g_array_append_val(graph->repeats, repeat);
}

static void place(Walk *walk, uint32_t box, uint32_t row) {
    StudioGraph *graph = walk->graph;
    walk->is_placed[box] = walk->is_above[box] = true;
    uint32_t line = walk->line++;
    double first = NAN, last = NAN;
    for (guint w = 0; w < graph->wires->len; w++) {
        StudioWire *wire = &g_array_index(graph->wires, StudioWire, w);
        if (wire->from != box || (walk->is_placed[wire->to] && !walk->is_above[wire->to])) {
            continue;
        }
        if (walk->is_above[wire->to]) {
            close_recursion(walk, wire, row + 1);
            last = studio_graph_repeat(graph, wire->again)->column;
        } else {
            wire->is_tree = true;
            walk->came_by[wire->to] = w;
            place(walk, wire->to, row + 1);
            last = box_at(graph, wire->to)->column;
        }
        first = isnan(first) ? last : first;
    }
    StudioBox *at = box_at(graph, box);
    at->row = row;
    at->line = line;
    at->column = isnan(first) ? walk->column++ : 0.5 * (first + last);
    graph->rows = fmax(graph->rows, row + 1);
    graph->columns = walk->column;
    walk->is_above[box] = false;
}

static bool is_root(const StudioGraph *graph, uint32_t box) {
    for (guint w = 0; w < graph->wires->len; w++) {
        const StudioWire *wire = studio_graph_wire(graph, w);
        if (wire->to == box && wire->from != box) {
            return false;
        }
    }
    return true;
}

// Roots first; what is in a circle that nothing leads to begins at its first.
static void lay_out(StudioGraph *graph) {
    guint room = graph->boxes->len + 1;
    Walk walk = {graph, g_new0(bool, room), g_new0(bool, room), g_new0(uint32_t, room), 0, 0};
    for (int pass = 0; pass < 2; pass++) {
        for (guint i = 0; i < graph->boxes->len; i++) {
            if (!walk.is_placed[i] && (pass == 1 || is_root(graph, i))) {
                place(&walk, i, 0);
            }
        }
    }
    g_free(walk.is_placed);
    g_free(walk.is_above);
    g_free(walk.came_by);
}

StudioGraph *studio_graph_empty(void) {
    StudioGraph *graph = g_new0(StudioGraph, 1);
    graph->boxes = g_array_new(FALSE, FALSE, sizeof(StudioBox));
    graph->wires = g_array_new(FALSE, FALSE, sizeof(StudioWire));
    graph->repeats = g_array_new(FALSE, FALSE, sizeof(StudioRepeat));
    g_array_set_clear_func(graph->boxes, box_clear);
    return graph;
}

StudioGraph *studio_graph_new(const FrContents *contents, uint32_t plant) {
    StudioGraph *graph = studio_graph_empty();
    uint32_t root = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "pgraph");
    if (root == FR_NONE) {
        return graph;
    }
    for (uint32_t i = fr_contents_at(contents, root)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        if (fr_contents_at(contents, i)->component >= 0) {
            read_box(graph, contents, plant, i);
        }
    }
    for (uint32_t i = fr_contents_child(contents, root, "link"); i != FR_NONE;
         i = fr_contents_sibling(contents, i)) {
        read_wire(graph, contents, i);
    }
    lay_out(graph);
    return graph;
}

void studio_graph_free(StudioGraph *graph) {
    if (graph != NULL) {
        g_array_unref(graph->boxes);
        g_array_unref(graph->wires);
        g_array_unref(graph->repeats);
        g_free(graph);
    }
}
