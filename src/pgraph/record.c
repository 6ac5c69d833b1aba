// What a build tells of itself: instances, the i-tree, and which edits have a place.
#include "pgraph/edit.h"
#include "pgraph/expand.h"
#include "pgraph/kept.h"

#include <string.h>

void fr_build_begin_counts(FrBuild *build) {
    FrPgraphCounts *counts = build->counts;
    uint32_t components = fr_pgraph_count(build->expansion.graph);
    if (counts == NULL) {
        return;
    }
    bool wants_tree = counts->parent != NULL;
    bool wants_times = counts->seconds != NULL || build->made != NULL;
    *counts = (FrPgraphCounts){.by_component = g_new0(uint64_t, MAX(components, 1))};
    if (wants_times) {
        counts->seconds = g_new(double, MAX(components, 1));
        for (uint32_t c = 0; c < components; c++) {
            counts->seconds[c] = fr_kept_seconds(build->last, build->expansion.graph, c);
        }
    }
    if (wants_tree) {
        counts->parent = g_new(uint32_t, 1);
        counts->component = g_new(uint32_t, 1);
        counts->place = g_new(uint64_t, 1);
    }
}

// The i-tree's rows of the level, which begin at `first`: of what is there.
static void record_tree(FrBuild *build, uint64_t first) {
    const FrLevel *level = &build->expansion.level;
    FrPgraphCounts *counts = build->counts;
    counts->parent = g_renew(uint32_t, counts->parent, build->instances);
    counts->component = g_renew(uint32_t, counts->component, build->instances);
    counts->place = g_renew(uint64_t, counts->place, build->instances);
    uint32_t *numbers = g_new(uint32_t, MAX(level->count, 1));
    for (uint32_t row = 0; row < level->count; row++) {
        if (level->is_absent[row]) {
            continue;
        }
        uint32_t parent = level->parent[row];
        counts->parent[first] = parent != FR_NONE ? build->numbers[parent] : FR_NONE;
        counts->component[first] = fr_instance_stage(&build->expansion, row)->component;
        counts->place[first] = build->expansion.places != NULL ? build->expansion.places[row] : 0;
        numbers[row] = (uint32_t)first++;
    }
    g_free(build->numbers);
    build->numbers = numbers;
}

// Which edits have a place. What is not there has one if it was pruned.
static void note_edits(FrBuild *build) {
    const FrExpansion *expansion = &build->expansion;
    const FrLevel *level = &expansion->level;
    for (uint32_t row = 0; row < level->count && expansion->edits != NULL; row++) {
        FrEditState state = level->edit[row];
        uint32_t edit = state != FR_EDIT_NOWHERE ? fr_edits_at(expansion->edits, state) : FR_NONE;
        if (edit != FR_NONE) {
            build->has_place[edit] |= level->clock[row] >= 0;
        }
    }
}

void fr_build_record_level(FrBuild *build) {
    const FrLevel *level = &build->expansion.level;
    uint64_t first = build->instances;
    for (uint32_t row = 0; row < level->count; row++) {
        build->instances += !level->is_absent[row];
        build->taken_over += !level->is_absent[row] && level->twin[row] != FR_NONE;
    }
    note_edits(build);
    FrPgraphCounts *counts = build->counts;
    if (counts == NULL) {
        return;
    }
    counts->instances = build->instances;
    for (uint32_t row = 0; row < level->count; row++) {
        counts->by_component[fr_instance_stage(&build->expansion, row)->component] +=
            !level->is_absent[row];
    }
    if (counts->parent != NULL) {
        record_tree(build, first);
    }
}

// Warns of edits without a place, and hands on which have one. Rows that are shared were looked at
// by the build that made them.
void fr_build_finish_edits(FrBuild *build) {
    const FrPgraph *graph = build->expansion.graph;
    uint32_t count = fr_pgraph_edit_count(graph);
    if (count == 0) {
        return;
    }
    if (build->made != NULL && build->last != NULL && build->last->rows == build->made->rows) {
        memcpy(build->has_place, build->last->counts.edits, count);
    }
    fr_edits_report(graph, build->has_place, build->context->diags);
    if (build->counts != NULL) {
        build->counts->edits = g_memdup2(build->has_place, count);
    }
}
