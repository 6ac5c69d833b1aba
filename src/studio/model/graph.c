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

static void read_box(StudioGraph *graph, const FrContents *contents, uint32_t element) {
    const FrContentsElement *at = fr_contents_at(contents, element);
    char *enabled = fr_contents_get(contents, element, "enabled");
    StudioBox box = {.element = element,
                     .id = g_strdup(at->id == NULL ? "" : at->id),
                     .kind = (FrComponentKind)at->component,
                     .is_enabled = g_strcmp0(enabled, "no") != 0,
                     .is_reached = at->component == FR_COMPONENT_CAMERA};
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
                       .kind = symbol != NULL                   ? FR_LINK_SYMBOL
                               : g_strcmp0(kind, "branch") == 0 ? FR_LINK_BRANCH
                               : g_strcmp0(kind, "leaf") == 0   ? FR_LINK_LEAF
                                                                : FR_LINK_CHILD};
    if (wire.from != FR_NONE && wire.to != FR_NONE) {
        StudioBox *end = box_at(graph, wire.to);
        end->is_reached = true;
        end->is_recursive = end->is_recursive || wire.from == wire.to;
        g_array_append_val(graph->wires, wire);
    }
    g_free(symbol);
    g_free(kind);
    g_free(to);
    g_free(from);
}

// ---- layout ------------------------------------------------------------------------------------

// A walk over the tree of first ways to each box. Each subtree takes columns of its own.
typedef struct Walk {
    StudioGraph *graph;
    bool *is_placed;
    double column; // the next that is free
} Walk;

static void place(Walk *walk, uint32_t box, uint32_t row) {
    StudioGraph *graph = walk->graph;
    walk->is_placed[box] = true;
    double first = NAN, last = NAN;
    for (guint w = 0; w < graph->wires->len; w++) {
        StudioWire *wire = &g_array_index(graph->wires, StudioWire, w);
        if (wire->from != box || walk->is_placed[wire->to]) {
            continue;
        }
        wire->is_tree = true;
        place(walk, wire->to, row + 1);
        last = box_at(graph, wire->to)->column;
        first = isnan(first) ? last : first;
    }
    StudioBox *at = box_at(graph, box);
    at->row = row;
    at->column = isnan(first) ? walk->column++ : 0.5 * (first + last);
    graph->rows = fmax(graph->rows, row + 1);
    graph->columns = walk->column;
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
    Walk walk = {graph, g_new0(bool, graph->boxes->len + 1), 0};
    for (int pass = 0; pass < 2; pass++) {
        for (guint i = 0; i < graph->boxes->len; i++) {
            if (!walk.is_placed[i] && (pass == 1 || is_root(graph, i))) {
                place(&walk, i, 0);
            }
        }
    }
    g_free(walk.is_placed);
}

StudioGraph *studio_graph_new(const FrContents *contents, uint32_t plant) {
    StudioGraph *graph = g_new0(StudioGraph, 1);
    graph->boxes = g_array_new(FALSE, FALSE, sizeof(StudioBox));
    graph->wires = g_array_new(FALSE, FALSE, sizeof(StudioWire));
    g_array_set_clear_func(graph->boxes, box_clear);
    uint32_t root = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "pgraph");
    if (root == FR_NONE) {
        return graph;
    }
    for (uint32_t i = fr_contents_at(contents, root)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        if (fr_contents_at(contents, i)->component >= 0) {
            read_box(graph, contents, i);
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
        g_free(graph);
    }
}
