/// @file edits.h
/// Plants of the shipped documents, and every way to change one parameter of theirs.
#pragma once

#include "frond/scene.h"

#include "../document/documents.h"

#include <math.h>

/// A document and the definition of its first p-graph plant.
typedef struct Shipped {
    FrDocument *document;
    const FrPlantDef *plant;
} Shipped;

static inline Shipped shipped_load(const char *path) {
    FrContext context = fr_context_default();
    Shipped shipped = {0};
    FrStatus status = fr_document_load(path, &context, &shipped.document);
    g_assert_cmpint(status, ==, FR_OK);
    const GPtrArray *plants = fr_document_plants(shipped.document);
    for (guint i = 0; i < plants->len && shipped.plant == NULL; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        bool is_whole = plant->kind == FR_PLANT_PGRAPH;
        for (uint32_t c = 0; c < fr_pgraph_count(plant->pgraph) && is_whole; c++) {
            is_whole = fr_pgraph_kind(plant->pgraph, c) != FR_COMPONENT_GRAFT;
        }
        shipped.plant = is_whole ? plant : NULL;
    }
    return shipped;
}

static inline void *field_at(FrPgraph *graph, uint32_t component, size_t row) {
    const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, component));
    return (char *)fr_pgraph_params(graph, component) + table->rows[row].offset;
}

static inline size_t rows_of(FrPgraph *graph, uint32_t component) {
    return fr_pgraph_table(fr_pgraph_kind(graph, component))->count;
}

/// Multiplies the numbers of children.
static inline void thin_out(FrPgraph *graph, double factor) {
    for (uint32_t c = 0; c < fr_pgraph_count(graph); c++) {
        const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, c));
        for (size_t row = 0; row < table->count; row++) {
            const char *name = table->rows[row].name;
            if (strcmp(name, "number") == 0 || strcmp(name, "density") == 0) {
                FrNumber *number = field_at(graph, c, row);
                number->from *= factor;
                number->to *= factor;
                number->constant *= factor;
            }
        }
    }
}

/// The plant's graph, with fewer children if it had more than some hundred instances.
static inline FrPgraph *small_graph(const Shipped *shipped) {
    FrPgraph *graph = NULL;
    uint64_t instances = UINT64_MAX;
    for (double factor = 1; instances > 250 && factor > 0.003; factor *= 0.4) {
        fr_pgraph_free(graph);
        graph = fr_document_reseed(shipped->document, shipped->plant, shipped->plant->seed, NAN);
        thin_out(graph, factor);
        FrContext context = fr_context_default();
        FrPgraphCounts counts = {0};
        FrPlant *plant = NULL;
        if (fr_pgraph_build(graph, &context, &plant, &counts) == FR_OK) {
            instances = counts.instances;
        }
        fr_pgraph_counts_clear(&counts);
        fr_plant_free(plant);
    }
    return graph;
}

static inline double nudged(double value, double min, double max) {
    double by = 0.13 * fabs(value) + 0.017 * fmin(max - min, 10);
    return value + by <= max ? value + by : fmax(value - by, min);
}

static inline void nudge_number(FrNumber *number) {
    double before = number->from;
    number->from = nudged(number->from, number->min, number->max);
    number->to += number->from - before;
    number->constant += (number->from - before) * number->scale;
}

static inline void set_text(FrPgraph *graph, uint32_t component, const FrParam *row,
                            const char *text) {
    FrStatus status =
        fr_params_set(fr_pgraph_table(fr_pgraph_kind(graph, component)),
                      fr_pgraph_params(graph, component), row, text, (FrSpan){0}, NULL, NULL);
    g_assert_cmpint(status, ==, FR_OK);
}

static inline const char *other_text(const FrParam *row) {
    static const char *const texts[][2] = {
        {"only", "odd"},
        {"material", ""},
        {"path", "0,0,0 0,0.1,0.5 0.1,0,1"},
        {"points", "0,0,0:0.1,0,0.05"},
        {"weights", "3"},
        {"section", "1,0 0.2,0.9 -1,0 0,-1"},
        {"outline", "0.06,0 0.09,0.1 0,0.2"},
        {"outline_points", "0,0 0.4,0.3 1,0"},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        if (strcmp(row->name, texts[k][0]) == 0) {
            return texts[k][1];
        }
    }
    return row->default_text;
}

/// Changes one parameter to another sensible value.
static inline void nudge(FrPgraph *graph, uint32_t component, size_t index) {
    const FrParam *row = &fr_pgraph_table(fr_pgraph_kind(graph, component))->rows[index];
    void *field = field_at(graph, component, index);
    switch (row->kind) {
    case FR_PARAM_NUMBER:
        nudge_number(field);
        break;
    case FR_PARAM_REAL: {
        double *real = field;
        *real = nudged(*real, row->min, row->max); // within the range in radians too
        break;
    }
    case FR_PARAM_INTEGER:
        *(int64_t *)field += (double)*(int64_t *)field < row->max ? 1 : -1;
        break;
    case FR_PARAM_SWITCH:
        *(bool *)field = !*(bool *)field;
        break;
    case FR_PARAM_CHOICE: {
        char **choices = g_strsplit(row->choices, " ", -1);
        *(int *)field = (*(int *)field + 1) % (int)g_strv_length(choices);
        g_strfreev(choices);
        break;
    }
    case FR_PARAM_VECTOR:
    case FR_PARAM_COLOUR:
        ((vec3s *)field)->y = (float)nudged((double)((vec3s *)field)->y, row->min, row->max);
        break;
    case FR_PARAM_CURVE:
        set_text(graph, component, row, *(FrCurve **)field != NULL ? "" : "dome");
        break;
    case FR_PARAM_FORMULA:
        set_text(graph, component, row, "0.9*x + 0.3*z + 0.1");
        break;
    case FR_PARAM_TEXT:
    case FR_PARAM_POINTS:
        set_text(graph, component, row, other_text(row));
        break;
    }
}

/// A component's parameters put aside, to come back later.
static inline void *aside(FrPgraph *graph, uint32_t component) {
    const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, component));
    void *copy = g_malloc(table->struct_size);
    fr_params_copy(table, copy, fr_pgraph_params(graph, component));
    return copy;
}

static inline void put_back(FrPgraph *graph, uint32_t component, void *copy) {
    const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, component));
    void *params = fr_pgraph_params(graph, component);
    fr_params_clear(table, params);
    memcpy(params, copy, table->struct_size);
    g_free(copy);
}
