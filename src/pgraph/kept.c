#include "pgraph/kept.h"

#include "pgraph/depend.h"

#include <math.h>
#include <string.h>

// ---- which stages are as they were -------------------------------------------------------------

static const FrStage *stage_of(const FrUnrolled *unrolled, uint32_t stage) {
    return &g_array_index(unrolled->stages, FrStage, stage);
}

static uint32_t target_of(const FrUnrolled *unrolled, uint32_t stage, uint32_t link) {
    uint32_t index = stage_of(unrolled, stage)->first_link + link;
    return g_array_index(unrolled->links, FrStageLink, index).stage;
}

// Lets a stage correspond to one of the last build. False if either has another partner already.
static bool pair(const FrPgraphBuild *made, FrTwins *twins, uint32_t stage, uint32_t before,
                 GArray *open) {
    if (twins->was[stage] == before) {
        return true;
    }
    if (twins->was[stage] != FR_NONE || twins->is_now[before] != FR_NONE) {
        return false;
    }
    twins->was[stage] = before;
    twins->is_now[before] = stage;
    twins->is_same[stage] = made->stages[stage] == twins->last->stages[before];
    if (twins->is_same[stage]) {
        g_array_append_val(open, stage);
    }
    return true;
}

// The root of the last build that is like this one, FR_NONE.
static uint32_t root_like(const FrPgraphBuild *last, FrDigest digest) {
    for (guint k = 0; k < last->unrolled.roots->len; k++) {
        uint32_t root = g_array_index(last->unrolled.roots, uint32_t, k);
        if (last->stages[root] == digest) {
            return root;
        }
    }
    return FR_NONE;
}

// From the roots along the links of stages that are the same, which correspond one by one.
static bool pair_all(const FrPgraphBuild *made, const FrUnrolled *unrolled, FrTwins *twins) {
    GArray *open = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    bool is_clear = true;
    for (guint k = 0; k < unrolled->roots->len; k++) {
        uint32_t root = g_array_index(unrolled->roots, uint32_t, k);
        uint32_t before = root_like(twins->last, made->stages[root]);
        is_clear = is_clear && (before == FR_NONE || pair(made, twins, root, before, open));
    }
    for (guint done = 0; done < open->len && is_clear; done++) {
        uint32_t stage = g_array_index(open, uint32_t, done), before = twins->was[stage];
        for (uint32_t k = 0; k < stage_of(unrolled, stage)->link_count; k++) {
            is_clear = is_clear && pair(made, twins, target_of(unrolled, stage, k),
                                        target_of(&twins->last->unrolled, before, k), open);
        }
    }
    g_array_unref(open);
    return is_clear;
}

static bool are_roots_in_place(const FrUnrolled *unrolled, const FrUnrolled *before) {
    size_t size = unrolled->roots->len * sizeof(uint32_t);
    return unrolled->roots->len == before->roots->len &&
           (size == 0 || memcmp(unrolled->roots->data, before->roots->data, size) == 0);
}

static bool are_all_in_place(const FrPgraphBuild *made, const FrUnrolled *unrolled,
                             const FrTwins *twins) {
    const FrPgraphBuild *last = twins->last;
    bool is_all = unrolled->stages->len == last->unrolled.stages->len &&
                  are_roots_in_place(unrolled, &last->unrolled) && made->tables == last->tables &&
                  memcmp(&made->limits, &last->limits, sizeof made->limits) == 0;
    for (guint s = 0; s < unrolled->stages->len && is_all; s++) {
        is_all = twins->was[s] == s && twins->is_same[s];
    }
    return is_all;
}

static uint32_t *none_of(guint count) {
    uint32_t *column = g_new(uint32_t, count + 1);
    memset(column, 0xff, (count + 1) * sizeof *column);
    return column;
}

static bool has_replacements(const FrUnrolled *unrolled) {
    for (guint k = 0; k < unrolled->replacements->len; k++) {
        if (g_array_index(unrolled->replacements, uint32_t, k) != FR_NONE) {
            return true;
        }
    }
    return false;
}

void fr_kept_begin(FrPgraphBuild *made, const FrBuild *build, const FrPgraphBuild *last,
                   FrTwins *twins) {
    const FrExpansion *expansion = &build->expansion;
    const FrUnrolled *unrolled = expansion->unrolled;
    guint count = unrolled->stages->len;
    made->limits = build->context->limits;
    made->inputs = fr_depend_inputs(expansion->graph);
    made->tables = fr_depend_tables(expansion);
    made->has_own_shapes = fr_depend_has_own_shapes(expansion);
    made->stages = fr_depend_stages(expansion);
    *twins = (FrTwins){.last = last};
    // Steps of ramps that nothing has are dropped, so that indices of materials do not last; and
    // what replaces an instance by hand stands where no link leads to it.
    if (last == NULL || last->has_faults || last->inputs != made->inputs ||
        expansion->ramps != NULL || has_replacements(unrolled)) {
        twins->last = NULL;
        return;
    }
    twins->was = none_of(count);
    twins->is_now = none_of(last->unrolled.stages->len);
    twins->is_same = g_new0(bool, count + 1);
    if (!pair_all(made, unrolled, twins)) {
        twins->last = NULL;
        return;
    }
    twins->is_all = are_all_in_place(made, unrolled, twins);
}

void fr_twins_clear(FrTwins *twins) {
    g_free(twins->was);
    g_free(twins->is_now);
    g_free(twins->is_same);
}

// ---- rows --------------------------------------------------------------------------------------

static void clear_level(gpointer level) {
    fr_level_clear(level);
}

// Puts rows into the plant that shows them, or takes them out with rows that hold nothing.
static void show_rows(FrPlant *plant, const FrRows *rows) {
    plant->nodes = rows->nodes;
    plant->axes = rows->axes;
    plant->organs = rows->organs;
    plant->buds = rows->buds;
}

static void rows_unref(FrRows *rows) {
    if (!g_atomic_ref_count_dec(&rows->references)) {
        return;
    }
    FrPlant *last = fr_plant_new("");
    show_rows(last, rows);
    fr_plant_free(last);
    g_array_unref(rows->deformers);
    g_array_unref(rows->levels);
    g_free(rows);
}

void fr_kept_own_rows(FrPgraphBuild *made, GArray *levels) {
    FrRows *rows = made->rows = g_new0(FrRows, 1);
    g_atomic_ref_count_init(&rows->references);
    rows->nodes = made->plant->nodes;
    rows->axes = made->plant->axes;
    rows->organs = made->plant->organs;
    rows->buds = made->plant->buds;
    rows->deformers = g_array_ref(made->plant->deformers);
    rows->levels = g_array_ref(levels);
    g_array_set_clear_func(levels, clear_level);
}

void fr_kept_share_rows(FrPgraphBuild *made, const FrPgraphBuild *last) {
    FrPlant *plant = made->plant;
    made->rows = last->rows;
    g_atomic_ref_count_inc(&made->rows->references);
    show_rows(plant, made->rows);
    g_array_unref(plant->deformers);
    plant->deformers = g_array_ref(made->rows->deformers);
    if (made->has_own_shapes) {
        g_array_unref(plant->shapes);
        g_array_unref(plant->profiles);
        g_hash_table_unref(plant->shape_index);
        g_hash_table_unref(plant->profile_index);
        plant->shapes = g_array_ref(last->plant->shapes);
        plant->profiles = g_array_ref(last->plant->profiles);
        plant->shape_index = g_hash_table_ref(last->plant->shape_index);
        plant->profile_index = g_hash_table_ref(last->plant->profile_index);
    }
}

void fr_pgraph_build_free(FrPgraphBuild *build) {
    if (build == NULL) {
        return;
    }
    if (build->rows != NULL) {
        static const FrRows nothing = {0};
        show_rows(build->plant, &nothing);
        rows_unref(build->rows);
    }
    if (build->plant != NULL) {
        fr_plant_free(build->plant);
        fr_unrolled_clear(&build->unrolled);
    }
    fr_pgraph_counts_clear(&build->counts);
    g_free(build->stages);
    g_free(build);
}

double fr_kept_seconds(const FrPgraphBuild *last, const FrPgraph *graph, uint32_t component) {
    const char *id = fr_pgraph_id(graph, component);
    if (last != NULL && last->counts.seconds != NULL) {
        const GArray *components = last->plant->components;
        for (guint k = 0; k < components->len; k++) { // mostly it is where it was
            guint at = (component + k) % components->len;
            if (strcmp(g_array_index(components, FrComponent, at).id, id) == 0) {
                return last->counts.seconds[at];
            }
        }
    }
    return NAN;
}

void fr_pgraph_counts_clear(FrPgraphCounts *counts) {
    g_free(counts->by_component);
    g_free(counts->parent);
    g_free(counts->component);
    g_free(counts->place);
    g_free(counts->edits);
    g_free(counts->seconds);
    *counts = (FrPgraphCounts){0};
}

const FrPlant *fr_pgraph_build_plant(const FrPgraphBuild *build) {
    return build->plant;
}

const FrPgraphCounts *fr_pgraph_build_counts(const FrPgraphBuild *build) {
    return &build->counts;
}

uint64_t fr_pgraph_build_taken_over(const FrPgraphBuild *build) {
    return build->taken_over;
}

bool fr_pgraph_build_shares(const FrPgraphBuild *build, const FrPgraphBuild *other) {
    return build->rows == other->rows;
}
