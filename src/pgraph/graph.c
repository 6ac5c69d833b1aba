#include "pgraph/edit.h"

#include <string.h>

static void span_hold(FrSpan span) {
    if (span.source != NULL) {
        fr_source_ref(span.source);
    }
}

static void span_drop(FrSpan span) {
    if (span.source != NULL) {
        fr_source_unref(span.source);
    }
}

static void define_clear(gpointer data) {
    FrGraftDefine *define = data;
    g_free(define->name);
    fr_number_clear(&define->number);
}

static void prototype_clear(gpointer data) {
    FrPrototype *prototype = data;
    g_clear_pointer(&prototype->defines, g_array_unref);
    fr_params_clear(fr_pgraph_table(prototype->kind), prototype->params);
    g_free(prototype->params);
    g_free(prototype->id);
    span_drop(prototype->span);
}

static void link_clear(gpointer data) {
    span_drop(((FrPgraphLink *)data)->span);
}

static void material_unref(gpointer data) {
    fr_material_unref(data);
}

FrPgraph *fr_pgraph_new(const char *name, uint64_t seed) {
    FrPgraph *graph = g_new0(FrPgraph, 1);
    graph->name = g_strdup(name != NULL ? name : "");
    graph->seed = seed;
    graph->state.health = 1;
    graph->prototypes = g_array_new(FALSE, FALSE, sizeof(FrPrototype));
    g_array_set_clear_func(graph->prototypes, prototype_clear);
    graph->links = g_array_new(FALSE, FALSE, sizeof(FrPgraphLink));
    g_array_set_clear_func(graph->links, link_clear);
    graph->materials = g_ptr_array_new_with_free_func(material_unref);
    graph->edits = g_array_new(FALSE, FALSE, sizeof(FrGraphEdit));
    g_array_set_clear_func(graph->edits, fr_graph_edit_clear);
    graph->by_id = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    graph->material_names = g_hash_table_new(g_str_hash, g_str_equal);
    graph->link_keys = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    return graph;
}

void fr_pgraph_set_state(FrPgraph *graph, const FrPgraphState *state) {
    graph->state = *state;
}

void fr_pgraph_set_folder(FrPgraph *graph, const char *folder) {
    g_free(graph->folder);
    graph->folder = g_strdup(folder);
}

void fr_pgraph_free(FrPgraph *graph) {
    if (graph == NULL) {
        return;
    }
    g_hash_table_unref(graph->link_keys);
    g_hash_table_unref(graph->material_names);
    g_hash_table_unref(graph->by_id);
    g_ptr_array_unref(graph->materials);
    g_array_unref(graph->links);
    g_array_unref(graph->edits);
    g_array_unref(graph->prototypes);
    g_free(graph->folder);
    g_free(graph->name);
    g_free(graph);
}

uint32_t fr_pgraph_add(FrPgraph *graph, FrComponentKind kind, const char *id, FrSpan span,
                       FrDiags *diags) {
    if (fr_pgraph_find(graph, id) != FR_NONE) {
        fr_diags_add(diags, FR_ERROR, "duplicate-id", span, "there is already a component '%s'",
                     id);
        return FR_NONE;
    }
    const FrParamTable *table = fr_pgraph_table(kind);
    FrPrototype prototype = {
        .kind = kind,
        .id = g_strdup(id),
        .span = span,
        .params = g_malloc0(table->struct_size),
    };
    fr_params_init(table, prototype.params);
    if (kind == FR_COMPONENT_GRAFT) {
        prototype.defines = g_array_new(FALSE, FALSE, sizeof(FrGraftDefine));
        g_array_set_clear_func(prototype.defines, define_clear);
    }
    span_hold(span);
    g_array_append_val(graph->prototypes, prototype);
    uint32_t component = graph->prototypes->len - 1;
    g_hash_table_insert(graph->by_id, g_strdup(id), GUINT_TO_POINTER(component + 1));
    return component;
}

uint32_t fr_pgraph_count(const FrPgraph *graph) {
    return graph->prototypes->len;
}

uint32_t fr_pgraph_find(const FrPgraph *graph, const char *id) {
    guint found = GPOINTER_TO_UINT(g_hash_table_lookup(graph->by_id, id));
    return found != 0 ? found - 1 : FR_NONE;
}

FrComponentKind fr_pgraph_kind(const FrPgraph *graph, uint32_t component) {
    return fr_pgraph_prototype(graph, component)->kind;
}

const char *fr_pgraph_id(const FrPgraph *graph, uint32_t component) {
    return fr_pgraph_prototype(graph, component)->id;
}

void *fr_pgraph_params(FrPgraph *graph, uint32_t component) {
    return fr_pgraph_prototype(graph, component)->params;
}

static FrStatus add_link(FrPgraph *graph, uint32_t from, uint32_t to, FrLinkKind kind, char symbol,
                         FrSpan span, FrDiags *diags) {
    FR_ASSERT(from < fr_pgraph_count(graph) && to < fr_pgraph_count(graph));
    if (fr_pgraph_kind(graph, to) == FR_COMPONENT_CAMERA) {
        fr_diags_add(diags, FR_ERROR, "link-to-camera", span,
                     "'%s' is a camera: it is the root and follows on nothing",
                     fr_pgraph_id(graph, to));
        return FR_ERR_DOCUMENT;
    }
    gint64 key = ((gint64)from << 32 | (gint64)to) * 3 + (gint64)kind;
    if (kind == FR_LINK_SYMBOL) {
        key = -1 - (((gint64)from << 27 | (gint64)to) << 7 | (gint64)symbol);
    }
    if (g_hash_table_contains(graph->link_keys, &key)) {
        fr_diags_add(diags, FR_ERROR, "duplicate-link", span,
                     "'%s' is already linked to '%s' in this way", fr_pgraph_id(graph, from),
                     fr_pgraph_id(graph, to));
        return FR_ERR_DOCUMENT;
    }
    g_hash_table_add(graph->link_keys, g_memdup2(&key, sizeof key));
    FrPgraphLink link = {.from = from, .to = to, .kind = kind, .symbol = symbol, .span = span};
    span_hold(span);
    g_array_append_val(graph->links, link);
    return FR_OK;
}

FrStatus fr_pgraph_link(FrPgraph *graph, uint32_t from, uint32_t to, FrLinkKind kind, FrSpan span,
                        FrDiags *diags) {
    FR_ASSERT(kind != FR_LINK_SYMBOL);
    return add_link(graph, from, to, kind, '\0', span, diags);
}

FrStatus fr_pgraph_link_symbol(FrPgraph *graph, uint32_t from, uint32_t to, char symbol,
                               FrSpan span, FrDiags *diags) {
    if (fr_pgraph_kind(graph, from) != FR_COMPONENT_GRAFT) {
        fr_diags_add(diags, FR_ERROR, "wrong-symbol", span, "'%s' is no graft, it has no symbols",
                     fr_pgraph_id(graph, from));
        return FR_ERR_DOCUMENT;
    }
    // What the turtle moves, turns and branches by cannot stand for something else.
    if (!g_ascii_isalnum(symbol) || strchr("FfGg", symbol) != NULL) {
        fr_diags_add(diags, FR_ERROR, "wrong-symbol", span,
                     "a symbol that places something is a letter or digit, none of F, f, G, g");
        return FR_ERR_DOCUMENT;
    }
    return add_link(graph, from, to, FR_LINK_SYMBOL, symbol, span, diags);
}

bool fr_pgraph_define(FrPgraph *graph, uint32_t graft, const char *name, const FrNumber *number) {
    GArray *defines = fr_pgraph_prototype(graph, graft)->defines;
    FR_ASSERT(defines != NULL);
    for (guint k = 0; k < defines->len; k++) {
        if (strcmp(g_array_index(defines, FrGraftDefine, k).name, name) == 0) {
            return false;
        }
    }
    FrGraftDefine define = {g_strdup(name), fr_number_copy(number)};
    g_array_append_val(defines, define);
    return true;
}

void fr_pgraph_add_material(FrPgraph *graph, FrMaterial *material) {
    g_ptr_array_add(graph->materials, fr_material_ref(material));
    gpointer name = (gpointer)fr_material_name(material);
    if (!g_hash_table_contains(graph->material_names, name)) {
        g_hash_table_insert(graph->material_names, name, GUINT_TO_POINTER(graph->materials->len));
    }
}
