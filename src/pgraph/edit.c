#include "pgraph/edit.h"

#include "pgraph/global.h"

#include <string.h>

// The state of something that is no part of paths: that of what it follows on, and how.
#define NODE_BITS 0xffffu
#define IS_MULTIPLIED (1u << 16)
#define ARMS_SHIFT 17
#define ARMS_BITS 0x3fffu

typedef struct Node {
    bool leads_on;
    uint32_t edit; // FR_NONE
} Node;

// The way from a node to the next.
typedef struct Way {
    uint32_t node, component, iteration, how;
} Way;

struct FrEdits {
    GArray *nodes;    // Node; the first is before all roots
    GHashTable *ways; // Way → the node it leads to
};

static guint way_hash(gconstpointer way) {
    return (guint)fr_digest(0, way, sizeof(Way));
}

static gboolean way_equal(gconstpointer a, gconstpointer b) {
    return memcmp(a, b, sizeof(Way)) == 0;
}

static Node *node_at(const FrEdits *edits, uint32_t node) {
    return &g_array_index(edits->nodes, Node, node);
}

static Way way_of(uint32_t node, const FrStep *step) {
    return (Way){node, step->component, step->is_multiplied ? step->iteration : 0,
                 (uint32_t)step->arms << 1 | step->is_multiplied};
}

static uint32_t find(const FrEdits *edits, uint32_t node, const FrStep *step) {
    if (!node_at(edits, node)->leads_on) {
        return FR_EDIT_NOWHERE;
    }
    Way way = way_of(node, step);
    gpointer found;
    bool is_known = g_hash_table_lookup_extended(edits->ways, &way, NULL, &found);
    return is_known ? GPOINTER_TO_UINT(found) : FR_EDIT_NOWHERE;
}

static uint32_t find_or_add(FrEdits *edits, uint32_t node, const FrStep *step) {
    uint32_t found = find(edits, node, step);
    if (found == FR_EDIT_NOWHERE && edits->nodes->len < NODE_BITS) {
        Way way = way_of(node, step);
        Node made = {.edit = FR_NONE};
        found = edits->nodes->len;
        node_at(edits, node)->leads_on = true;
        g_array_append_val(edits->nodes, made);
        g_hash_table_insert(edits->ways, g_memdup2(&way, sizeof way), GUINT_TO_POINTER(found));
    }
    return found;
}

static void add_edit(FrEdits *edits, const FrPgraph *graph, uint32_t edit) {
    GArray *steps = g_array_new(FALSE, FALSE, sizeof(FrPathStep));
    uint32_t node = 0;
    uint16_t arms = 0;
    bool is_right = fr_edit_path_read(fr_graph_edit(graph, edit)->params.at, steps);
    for (guint k = 0; k < steps->len && is_right && node != FR_EDIT_NOWHERE; k++) {
        const FrPathStep *read = &g_array_index(steps, FrPathStep, k);
        uint32_t component = fr_pgraph_find(graph, read->id);
        if (component == FR_NONE) {
            node = FR_EDIT_NOWHERE;
        } else if (k > 0 || fr_pgraph_kind(graph, component) != FR_COMPONENT_CAMERA) {
            FrStep step = {component, read->iteration, read->is_multiplied, false, arms};
            node = find_or_add(edits, node, &step);
        }
        arms = read->arms;
    }
    if (is_right && node != FR_EDIT_NOWHERE && node > 0) {
        node_at(edits, node)->edit = edit; // the last of one place counts
    }
    g_array_unref(steps);
}

FrEdits *fr_edits_new(const FrPgraph *graph) {
    if (graph->edits->len == 0) {
        return NULL;
    }
    FrEdits *edits = g_new(FrEdits, 1);
    edits->nodes = g_array_new(FALSE, FALSE, sizeof(Node));
    edits->ways = g_hash_table_new_full(way_hash, way_equal, g_free, NULL);
    Node before = {.edit = FR_NONE};
    g_array_append_val(edits->nodes, before);
    for (uint32_t k = 0; k < graph->edits->len; k++) {
        add_edit(edits, graph, k);
    }
    return edits;
}

void fr_edits_free(FrEdits *edits) {
    if (edits != NULL) {
        g_array_unref(edits->nodes);
        g_hash_table_unref(edits->ways);
        g_free(edits);
    }
}

FrEditState fr_edits_begin(const FrEdits *edits, uint32_t root, bool is_camera) {
    FrStep step = {.component = root};
    return edits == NULL ? FR_EDIT_NOWHERE : is_camera ? 0 : find(edits, 0, &step);
}

FrEditState fr_edits_step(const FrEdits *edits, FrEditState state, bool parent_is_global,
                          uint32_t iteration, const FrStep *step) {
    FrStep own = *step;
    uint32_t node = state & NODE_BITS;
    if (parent_is_global) {
        own.is_multiplied = (state & IS_MULTIPLIED) != 0;
        own.iteration = iteration;
        own.arms = (uint16_t)(state >> ARMS_SHIFT & ARMS_BITS);
    }
    if (step->is_global) {
        return node | (own.is_multiplied ? IS_MULTIPLIED : 0) |
               (uint32_t)(own.arms & ARMS_BITS) << ARMS_SHIFT;
    }
    return find(edits, node, &own);
}

uint32_t fr_edits_at(const FrEdits *edits, FrEditState state) {
    return state <= NODE_BITS ? node_at(edits, state)->edit : FR_NONE;
}

// ---- of the graph ------------------------------------------------------------------------------

#define FR_PARAM_STRUCT FrEditParams
static const FrParam rows[] = {FR_EDIT_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable table = {
    .element = "edit",
    .meaning = "a change of a single instance, by hand",
    .rows = rows,
    .count = G_N_ELEMENTS(rows),
    .struct_size = sizeof(FrEditParams),
};

const FrParamTable *fr_edit_table(void) {
    return &table;
}

void fr_graph_edit_clear(gpointer data) {
    FrGraphEdit *edit = data;
    fr_params_clear(&table, &edit->params);
    fr_source_unref(edit->span.source);
    g_clear_pointer(&edit->axis, g_array_unref);
}

static FrStatus wrong(FrGraphEdit *edit, FrDiags *diags, const char *code, const char *format,
                      const char *name) {
    fr_diags_add(diags, FR_ERROR, code, edit->span, format, name);
    fr_graph_edit_clear(edit);
    return FR_ERR_DOCUMENT;
}

FrStatus fr_pgraph_edit(FrPgraph *graph, const FrEditParams *params, FrSpan span, FrDiags *diags) {
    FrGraphEdit edit = {.span = span, .replacement = FR_NONE};
    if (span.source != NULL) {
        fr_source_ref(span.source);
    }
    fr_params_copy(&table, &edit.params, params);
    if (!fr_edit_path_read(params->at, NULL)) {
        return wrong(&edit, diags, "wrong-path",
                     "'%.64s' is no path of an instance, like trunk/branch[3]/twig[2]",
                     params->at != NULL ? params->at : "");
    }
    if (params->replace != NULL && *params->replace != '\0') {
        edit.replacement = fr_pgraph_find(graph, params->replace);
        if (edit.replacement == FR_NONE ||
            fr_pgraph_kind(graph, edit.replacement) == FR_COMPONENT_CAMERA) {
            return wrong(&edit, diags, "unknown-component",
                         "there is no component '%.64s' to replace it", params->replace);
        }
    }
    if (params->axis != NULL && *params->axis != '\0') {
        edit.axis = fr_drawn_axis(params->axis);
        if (edit.axis == NULL) {
            return wrong(&edit, diags, "wrong-path",
                         "the axis of '%.64s' must be two to 1000 points written x,y,z x,y,z",
                         params->at);
        }
    }
    g_array_append_val(graph->edits, edit);
    return FR_OK;
}

uint32_t fr_pgraph_edit_count(const FrPgraph *graph) {
    return graph->edits->len;
}

const FrEditParams *fr_pgraph_edit_at(const FrPgraph *graph, uint32_t edit) {
    return &fr_graph_edit(graph, edit)->params;
}

FrDigest fr_edits_digest(FrDigest digest, const FrPgraph *graph) {
    for (uint32_t k = 0; k < graph->edits->len; k++) {
        for (size_t row = 0; row < table.count; row++) {
            digest = fr_param_digest(digest, &rows[row], &fr_graph_edit(graph, k)->params);
        }
    }
    return digest;
}

// The last edit of each path.
static GHashTable *last_edits(const FrPgraph *graph) {
    GHashTable *last = g_hash_table_new(g_str_hash, g_str_equal);
    for (uint32_t k = 0; k < graph->edits->len; k++) {
        g_hash_table_insert(last, fr_graph_edit(graph, k)->params.at, GUINT_TO_POINTER(k));
    }
    return last;
}

// What stands at the end of an edit's path, or takes its place.
static uint32_t edited_component(const FrPgraph *graph, const FrGraphEdit *edit) {
    if (edit->replacement != FR_NONE) {
        return edit->replacement;
    }
    GArray *steps = g_array_new(FALSE, FALSE, sizeof(FrPathStep));
    uint32_t component = FR_NONE;
    if (fr_edit_path_read(edit->params.at, steps) && steps->len > 0) {
        component = fr_pgraph_find(graph, g_array_index(steps, FrPathStep, steps->len - 1).id);
    }
    g_array_unref(steps);
    return component;
}

// An axis is drawn for a stem.
static void check_axis(const FrPgraph *graph, const FrGraphEdit *edit, FrDiags *diags) {
    uint32_t component = edited_component(graph, edit);
    if (edit->axis == NULL || component == FR_NONE) {
        return;
    }
    FrComponentKind kind = fr_pgraph_kind(graph, component);
    if (kind != FR_COMPONENT_HORN && kind != FR_COMPONENT_TREE) {
        fr_diags_add(diags, FR_WARNING, "without-effect", edit->span,
                     "the axis drawn for '%.64s' has no effect: '%s' is a %s, not a stem",
                     edit->params.at, fr_pgraph_id(graph, component),
                     fr_pgraph_table(kind)->element);
    }
}

void fr_edits_report(const FrPgraph *graph, uint8_t *places, FrDiags *diags) {
    GHashTable *last = last_edits(graph);
    for (uint32_t k = 0; k < graph->edits->len; k++) {
        const FrGraphEdit *edit = fr_graph_edit(graph, k);
        check_axis(graph, edit, diags);
        if (GPOINTER_TO_UINT(g_hash_table_lookup(last, edit->params.at)) != k) {
            places[k] = FR_EDIT_OVERRULED;
            fr_diags_add(diags, FR_WARNING, "duplicate-edit", edit->span,
                         "a later edit of '%.64s' takes the place of this one; write both as one",
                         edit->params.at);
        } else if (places[k] == FR_EDIT_WAITS) {
            fr_diags_add(diags, FR_WARNING, "edit-without-place", edit->span,
                         "there is no '%.64s' now, so this edit waits until there is",
                         edit->params.at);
        }
    }
    g_hash_table_unref(last);
}
