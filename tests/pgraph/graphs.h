/// @file graphs.h
/// P-graphs for tests, written as text.
///
///     graph_read("tree trunk number=5\nleaf leaf length=.1\ntrunk = leaf")
///
/// Lines are components (kind, id, attributes) or links: `a - b` child, `a = b` branch, `a . b`
/// leaf link. Attributes are separated by semicolons.
#pragma once

#include "frond/pgraph.h"

#include <glib.h>
#include <string.h>

static inline FrComponentKind graph_kind(const char *word) {
    for (int kind = 0; kind < FR_COMPONENT_COUNT; kind++) {
        if (strcmp(fr_pgraph_table((FrComponentKind)kind)->element, word) == 0) {
            return (FrComponentKind)kind;
        }
    }
    g_error("no component kind %s", word);
}

static inline void graph_set(FrPgraph *graph, const char *id, const char *name, const char *value) {
    uint32_t component = fr_pgraph_find(graph, id);
    g_assert_cmpuint(component, !=, FR_NONE);
    const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, component));
    const FrParam *row = fr_params_find(table, name);
    if (row == NULL) {
        g_error("%s has no %s", id, name);
    }
    FrDiags *diags = fr_diags_new();
    FrStatus status = fr_params_set(table, fr_pgraph_params(graph, component), row, value,
                                    (FrSpan){0}, NULL, diags);
    if (status != FR_OK) {
        GString *text = g_string_new("");
        fr_diags_print(diags, text);
        g_error("%s.%s=%s: %s", id, name, value, text->str);
    }
    fr_diags_free(diags);
}

static inline void graph_read_line(FrPgraph *graph, char *line) {
    char **words = g_strsplit(g_strstrip(line), " ", 3);
    static const char kinds[] = "-=.";
    if (words[0] != NULL && words[1] != NULL && strchr(kinds, words[1][0]) != NULL) {
        const char *kind = strchr(kinds, words[1][0]);
        g_assert_cmpint(fr_pgraph_link(graph, fr_pgraph_find(graph, words[0]),
                                       fr_pgraph_find(graph, words[2]), (FrLinkKind)(kind - kinds),
                                       (FrSpan){0}, NULL),
                        ==, FR_OK);
    } else if (words[0] != NULL && words[1] != NULL) {
        fr_pgraph_add(graph, graph_kind(words[0]), words[1], (FrSpan){0}, NULL);
        char **pairs = g_strsplit(words[2] != NULL ? words[2] : "", ";", -1);
        for (char **pair = pairs; *pair != NULL; pair++) {
            char *equals = strchr(*pair, '=');
            if (equals != NULL) {
                *equals = '\0';
                graph_set(graph, words[1], g_strstrip(*pair), equals + 1);
            }
        }
        g_strfreev(pairs);
    }
    g_strfreev(words);
}

static inline FrPgraph *graph_read(const char *text) {
    FrPgraph *graph = fr_pgraph_new("test", 1);
    char **lines = g_strsplit(text, "\n", -1);
    for (char **line = lines; *line != NULL; line++) {
        graph_read_line(graph, *line);
    }
    g_strfreev(lines);
    return graph;
}

/// A plant that has been built, with its i-tree.
typedef struct Built {
    FrPgraph *graph;
    FrPlant *plant;
    FrPgraphCounts counts;
    FrDiags *diags;
    FrStatus status;
} Built;

static inline Built build_graph(FrPgraph *graph, FrPool *pool) {
    Built built = {.graph = graph, .diags = fr_diags_new()};
    FrContext context = fr_context_default();
    context.diags = built.diags;
    context.pool = pool;
    uint32_t wanted;
    built.counts.parent = &wanted;
    built.status = fr_pgraph_build(graph, &context, &built.plant, &built.counts);
    return built;
}

static inline void assert_sound(const FrPlant *plant) {
    char *why = NULL;
    if (!fr_plant_is_valid(plant, &why)) {
        g_error("%s", why);
    }
    g_free(why);
}

/// Builds a graph that is right.
static inline Built build(const char *text) {
    Built built = build_graph(graph_read(text), NULL);
    if (built.status != FR_OK) {
        GString *errors = g_string_new("");
        fr_diags_print(built.diags, errors);
        g_error("%s", errors->str);
    }
    assert_sound(built.plant);
    return built;
}

static inline void built_free(Built built) {
    fr_plant_free(built.plant);
    fr_pgraph_free(built.graph);
    fr_diags_free(built.diags);
    fr_pgraph_counts_clear(&built.counts);
}

static inline uint64_t built_count(const Built *built, const char *id) {
    return built->counts.by_component[fr_pgraph_find(built->graph, id)];
}

/// The i-tree as text: id(children …).
static inline void built_tree_below(const Built *built, uint32_t instance, GString *text) {
    g_string_append(text, fr_pgraph_id(built->graph, built->counts.component[instance]));
    bool has_children = false;
    for (uint32_t k = instance + 1; k < built->counts.instances; k++) {
        if (built->counts.parent[k] == instance) {
            g_string_append_c(text, has_children ? ' ' : '(');
            built_tree_below(built, k, text);
            has_children = true;
        }
    }
    if (has_children) {
        g_string_append_c(text, ')');
    }
}

static inline char *built_tree(const Built *built) {
    GString *text = g_string_new("");
    built_tree_below(built, 0, text);
    return g_string_free(text, FALSE);
}

static inline void assert_tree(const Built *built, const char *expected) {
    char *text = built_tree(built);
    g_assert_cmpstr(text, ==, expected);
    g_free(text);
}

/// The first axis, or organ, that a component made.
static inline uint32_t built_axis(const Built *built, const char *id) {
    uint32_t component = fr_pgraph_find(built->graph, id);
    uint32_t axis = 0;
    while (axis < built->plant->axes.count && built->plant->axes.component[axis] != component) {
        axis++;
    }
    g_assert_cmpuint(axis, <, built->plant->axes.count);
    return axis;
}

static inline uint32_t built_organ(const Built *built, const char *id) {
    uint32_t component = fr_pgraph_find(built->graph, id);
    uint32_t organ = 0;
    while (organ < built->plant->organs.count &&
           built->plant->organs.component[organ] != component) {
        organ++;
    }
    g_assert_cmpuint(organ, <, built->plant->organs.count);
    return organ;
}

static inline bool built_has(const Built *built, const char *code) {
    for (size_t k = 0; k < fr_diags_count(built->diags); k++) {
        if (strcmp(fr_diags_get(built->diags, k)->code, code) == 0) {
            return true;
        }
    }
    return false;
}
