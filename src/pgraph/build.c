// A p-graph to a plant: checked, unrolled, prepared, expanded; anew or after a change.
// After: Lintermann, Deussen. Interactive Modeling of Plants. IEEE Computer Graphics and
// Applications 19 (1), 1999.
#include "pgraph/edit.h"
#include "pgraph/expand.h"
#include "pgraph/global.h"
#include "pgraph/kept.h"
#include "pgraph/pipes.h"
#include "pgraph/ramp.h"
#include "pgraph/timing.h"

#include <string.h>

// Expands the graph, or takes all of the last build's rows.
static FrStatus expand_or_share(FrBuild *build) {
    FrPgraphBuild *made = build->made;
    FrTwins twins = {0};
    if (made == NULL) {
        return fr_build_expand(build);
    }
    fr_kept_begin(made, build, build->last, &twins);
    FrStatus status = FR_OK;
    if (twins.is_all) {
        fr_kept_share_rows(made, build->last);
        made->taken_over = build->last->counts.instances;
        build->counts->instances = build->last->counts.instances;
        // All that made something is where it was; what nothing leads to may have come or gone.
        guint components =
            MIN(fr_pgraph_count(build->expansion.graph), build->last->plant->components->len);
        memcpy(build->counts->by_component, build->last->counts.by_component,
               components * sizeof *build->counts->by_component);
    } else {
        build->levels = g_array_new(FALSE, FALSE, sizeof(FrLevel));
        build->expansion.twins = &twins;
        status = fr_build_expand(build);
        made->taken_over = build->taken_over;
        fr_kept_own_rows(made, build->levels);
        g_array_unref(build->levels);
    }
    fr_twins_clear(&twins);
    return status;
}

// Takes away what stems would have gone on with behind what they ended at, and all it bears. False
// if there is nothing to take away.
static bool drop_ended(FrPlant *plant) {
    uint16_t all = 0;
    for (uint32_t node = 0; node < plant->nodes.count; node++) {
        all = (uint16_t)(all | plant->nodes.flags[node]);
    }
    if ((all & FR_SHED) != 0) {
        fr_plant_compact(plant);
    }
    return (all & FR_SHED) != 0;
}

// What can only be done once all is there.
static void change_rows(FrBuild *build) {
    FrExpansion *expansion = &build->expansion;
    bool is_changed = expansion->fields->len > 0 && drop_ended(expansion->plant);
    if (fr_has_pipes(expansion)) {
        fr_pipes_apply(expansion);
        is_changed = true;
    }
    if (build->made != NULL) {
        build->made->is_changed = is_changed;
    }
}

static FrStatus prepare_and_expand(FrBuild *build, const FrRecursions *recursions) {
    FrExpansion *expansion = &build->expansion;
    const FrContext *context = build->context;
    int workers = fr_pool_threads(context->pool);
    expansion->faults = g_new(GHashTable *, workers);
    for (int worker = 0; worker < workers; worker++) {
        expansion->faults[worker] = fr_value_faults_new();
    }
    FrPrepared *prepared = NULL;
    FrStatus status = fr_prepare(&prepared, expansion->graph, recursions, expansion->plant,
                                 expansion->faults[0], context);
    expansion->prepared = prepared;
    expansion->ramps = fr_ramps_add(expansion->plant);
    FrEdits *edits = fr_edits_new(expansion->graph);
    expansion->edits = edits;
    build->has_place = g_new0(uint8_t, MAX(fr_pgraph_edit_count(expansion->graph), 1));
    bool is_timed = build->counts != NULL && build->counts->seconds != NULL;
    if (is_timed) {
        fr_timing_begin(expansion, workers);
    }
    status = status == FR_OK ? expand_or_share(build) : status;
    if (is_timed) {
        fr_timing_end(expansion, workers, build->counts->seconds);
    }
    if (status == FR_OK) {
        fr_ramps_drop_unused(expansion->plant, expansion->ramps);
    }
    if (status == FR_OK) {
        fr_build_finish_edits(build);
    }
    if (status == FR_OK) {
        change_rows(build);
    }
    g_free(build->has_place);
    g_free(expansion->places);
    fr_edits_free(edits);
    g_free(expansion->ramps);
    fr_build_report_faults(build, workers);
    for (int worker = 0; worker < workers; worker++) {
        g_hash_table_unref(expansion->faults[worker]);
    }
    g_free(expansion->faults);
    fr_prepared_free(prepared, fr_pgraph_count(expansion->graph));
    return status;
}

// The plant of build->expansion is there afterwards if the graph was right, finished or not.
static FrStatus run(FrBuild *build, FrUnrolled *unrolled) {
    const FrPgraph *graph = build->expansion.graph;
    FrRecursions recursions;
    fr_grafting_init(&build->grafting, build->graft);
    fr_build_begin_counts(build);
    fr_recursions_find(&recursions, graph);
    FrStatus status = fr_pgraph_check_all(graph, &recursions, build->context->diags, false);
    if (status == FR_OK) {
        build->expansion.plant = fr_plant_new(graph->name);
        if (build->made != NULL) {
            build->made->plant = build->expansion.plant;
        }
        build->expansion.fields = g_array_new(FALSE, TRUE, sizeof(FrField));
        build->expansion.unrolled = unrolled;
        status = fr_unroll(unrolled, graph, &recursions, build->context);
        status = status == FR_OK ? prepare_and_expand(build, &recursions) : status;
        g_array_unref(build->expansion.fields);
    }
    fr_recursions_clear(&recursions);
    fr_grafting_clear(&build->grafting);
    g_free(build->numbers);
    if (status == FR_OK) {
        fr_progress_report(build->context->progress, "build", 1);
    }
    return status;
}

FrStatus fr_pgraph_build(const FrPgraph *graph, const FrContext *context, FrPlant **plant,
                         FrPgraphCounts *counts) {
    return fr_pgraph_build_grafted(graph, NULL, context, plant, counts);
}

FrStatus fr_pgraph_build_grafted(const FrPgraph *graph, const FrGraft *graft,
                                 const FrContext *context, FrPlant **plant,
                                 FrPgraphCounts *counts) {
    FrBuild build = {.context = context,
                     .counts = counts,
                     .graft = graft,
                     .expansion = {.graph = graph, .progress = context->progress}};
    build.expansion.light = graft != NULL ? graft->light : NULL;
    FrUnrolled unrolled = {0};
    FrStatus status = run(&build, &unrolled);
    if (build.expansion.plant != NULL) {
        fr_unrolled_clear(&unrolled);
    }
    *plant = status == FR_OK ? build.expansion.plant : NULL;
    if (status != FR_OK) {
        fr_plant_free(build.expansion.plant);
    }
    return status;
}

FrStatus fr_pgraph_rebuild(const FrPgraph *graph, const FrPgraphBuild *last,
                           const FrContext *context, FrPgraphBuild **made) {
    FrPgraphBuild *kept = g_new0(FrPgraphBuild, 1);
    FrBuild build = {.context = context,
                     .counts = &kept->counts,
                     .made = kept,
                     .last = last != NULL && !last->is_changed ? last : NULL,
                     .expansion = {.graph = graph, .progress = context->progress}};
    FrStatus status = run(&build, &kept->unrolled);
    *made = status == FR_OK ? kept : NULL;
    if (status != FR_OK) {
        fr_pgraph_build_free(kept);
    }
    return status;
}
