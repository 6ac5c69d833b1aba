// Expansion of a p-graph to its instances and of these to a plant, one generation at a time.
// After: Lintermann, Deussen. Interactive Modeling of Plants. IEEE Computer Graphics and
// Applications 19 (1), 1999.
//
// A level holds the instances of one generation in columns. Each level is measured in parallel,
// summed and checked against the limits; then rows for all it makes are appended at once and
// filled in parallel by index. So nothing depends on the number of threads, parents come before
// children, and too large a plant is refused before it has memory.
#include "pgraph/expand.h"

#include "pgraph/edit.h"
#include "pgraph/global.h"
#include "pgraph/kept.h"
#include "pgraph/ramp.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 256 };

// ---- loops over a level -----------------------------------------------------------------------

static void measure_range(void *data, size_t begin, size_t end, int worker) {
    const FrExpansion *expansion = data;
    FrEvaluator evaluator = {.faults = expansion->faults[worker]};
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        if (expansion->level.twin[row] != FR_NONE) {
            fr_twin_measure(expansion, row);
        } else {
            fr_instance_measure(expansion, row, &evaluator);
        }
    }
}

static void count_range(void *data, size_t begin, size_t end, int worker) {
    const FrExpansion *expansion = data;
    FrEvaluator evaluator = {.faults = expansion->faults[worker]};
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        expansion->level.child_count[row] = expansion->level.twin[row] != FR_NONE
                                                ? fr_twin_children(expansion, row)
                                                : fr_instance_children(expansion, row, &evaluator);
    }
}

static void make_range(void *data, size_t begin, size_t end, int worker) {
    const FrExpansion *expansion = data;
    FrEvaluator evaluator = {.faults = expansion->faults[worker]};
    FrEvaluator place = {.faults = expansion->faults[worker]};
    for (uint32_t row = (uint32_t)begin, run; row < end; row += MAX(run, 1)) {
        run = fr_twin_run(expansion, row, (uint32_t)end);
        if (run > 0) {
            fr_twin_copy(expansion, row, run, &evaluator);
            continue;
        }
        fr_instance_make(expansion, row, &evaluator, &place);
        if (expansion->level.twin[row] != FR_NONE) {
            fr_twin_pass_on(expansion, row);
        }
    }
}

static void for_level(FrBuild *build, FrRangeFn body) {
    fr_parallel_for(build->context->pool, build->expansion.level.count, GRAIN, body,
                    &build->expansion, build->context->progress);
}

// ---- one level --------------------------------------------------------------------------------

static uint64_t sum_children(const FrLevel *level) {
    uint64_t sum = 0;
    for (uint32_t row = 0; row < level->count; row++) {
        sum += level->child_count[row];
    }
    return sum;
}

static void counts_to_indices(uint32_t *column, uint32_t count, uint32_t first) {
    for (uint32_t row = 0; row < count; row++) {
        uint32_t size = column[row];
        column[row] = first;
        first += size;
    }
    column[count] = first;
}

// Scopes go to the plant, fields are done with when it is built.
static void append_globals(FrExpansion *expansion, const FrLevelSums *sums) {
    FrLevel *level = &expansion->level;
    uint32_t scope = fr_plant_append_deformers(expansion->plant, (uint32_t)sums->scopes);
    uint32_t field = expansion->fields->len;
    g_array_set_size(expansion->fields, field + (uint32_t)sums->fields);
    for (uint32_t row = 0; row < level->count; row++) {
        if (level->global_count[row] > 0) {
            bool is_scope = fr_is_scope(fr_stage_prepared(expansion, level->stage[row])->kind);
            level->global_count[row] = is_scope ? scope++ : field++;
        }
    }
}

// How deep scopes and fields lie within one another, once a level has been made.
static FrStatus check_scopes(const FrBuild *build) {
    const FrLevel *level = &build->expansion.level;
    uint32_t deepest = 0;
    for (uint32_t row = 0; row < level->count; row++) {
        deepest = level->scopes[row] > level->scopes[deepest] ? row : deepest;
    }
    return level->count == 0 ? FR_OK
                             : fr_build_check(build, level->scopes[deepest],
                                              build->context->limits.scopes, "scopes", deepest);
}

static void append_rows(FrExpansion *expansion, const FrLevelSums *sums, bool wants_places) {
    FrLevel *level = &expansion->level;
    FrPlant *plant = expansion->plant;
    uint32_t first_axis = fr_plant_append_axes(plant, (uint32_t)sums->axes);
    uint32_t first_node = fr_plant_append_nodes(plant, (uint32_t)sums->nodes);
    expansion->first_organ = fr_plant_append_organs(plant, (uint32_t)sums->organs);
    append_globals(expansion, sums);
    counts_to_indices(level->axis_count, level->count, first_axis);
    counts_to_indices(level->node_count, level->count, first_node);
    counts_to_indices(level->organ_count, level->count, expansion->first_organ);
    counts_to_indices(level->child_count, level->count, 0);
    fr_level_init(&expansion->next, (uint32_t)sums->children);
    expansion->next.first = level->first + level->count;
    g_free(expansion->places);
    expansion->places = wants_places ? g_new(uint64_t, MAX(sums->children, 1)) : NULL;
}

// Shapes that depend on where their leaf is, in the order of the leaves.
static FrStatus find_shapes(FrBuild *build) {
    FrExpansion *expansion = &build->expansion;
    FrPlant *plant = expansion->plant;
    if (expansion->blades == NULL) {
        return FR_OK;
    }
    FrEvaluator evaluator = {.faults = expansion->faults[0]};
    for (uint32_t row = 0; row < expansion->level.count; row++) {
        const FrPrepared *prepared = fr_stage_prepared(expansion, expansion->level.stage[row]);
        uint32_t organ = expansion->level.organ_count[row];
        if (expansion->level.is_absent[row] || prepared->kind != FR_COMPONENT_LEAF ||
            plant->organs.shape[organ] != FR_NONE) {
            continue;
        }
        FrShape *shape = &expansion->blades[organ - expansion->first_organ];
        if (prepared->is_along) {
            fr_instance_enter(expansion, row, &evaluator);
            fr_enter_leaf_shape(expansion, row, &evaluator);
            fr_leaf_along(&shape->blade, prepared->params, &evaluator, plant);
        }
        plant->organs.shape[organ] = fr_plant_add_shape(plant, shape);
        const FrPrototype *prototype =
            fr_pgraph_prototype(expansion->graph, plant->organs.component[organ]);
        if (plant->shapes->len > build->context->limits.shapes) {
            return fr_limit_check(plant->shapes->len, build->context->limits.shapes, "shapes",
                                  prototype->id, prototype->span, build->context->diags);
        }
    }
    return FR_OK;
}

static bool needs_blades(const FrExpansion *expansion) {
    const FrLevel *level = &expansion->level;
    for (uint32_t row = 0; row < level->count; row++) {
        const FrPrepared *prepared =
            &expansion->prepared[fr_instance_stage(expansion, row)->component];
        if (prepared->kind == FR_COMPONENT_LEAF && prepared->shape_choice == FR_SHAPE_EVALUATED) {
            return true;
        }
    }
    return false;
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

static void record_level(FrBuild *build) {
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

static FrStatus expand_level(FrBuild *build) {
    FrExpansion *expansion = &build->expansion;
    const FrContext *context = build->context;
    FrStatus status = fr_grafts_grow(&build->grafting, expansion, context);
    if (status != FR_OK) {
        return status;
    }
    for_level(build, measure_range);
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    record_level(build);
    FrLevelSums sums = fr_level_sum(expansion);
    status = fr_build_check_level(build, &sums);
    if (status != FR_OK) {
        return status;
    }
    build->considered += sums.considered;
    for_level(build, count_range);
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    sums.children = sum_children(&expansion->level);
    bool has_blades = needs_blades(expansion);
    append_rows(expansion, &sums, build->counts != NULL && build->counts->parent != NULL);
    expansion->blades = has_blades ? g_new(FrShape, sums.organs) : NULL;
    for_level(build, make_range);
    status = fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : find_shapes(build);
    g_clear_pointer(&expansion->blades, g_free);
    return status == FR_OK ? check_scopes(build) : status;
}

// ---- the whole --------------------------------------------------------------------------------

static void begin_level(FrBuild *build) {
    FrExpansion *expansion = &build->expansion;
    const FrUnrolled *unrolled = expansion->unrolled;
    FrLevel *level = &expansion->level;
    fr_level_init(level, unrolled->roots->len);
    for (uint32_t row = 0; row < level->count; row++) {
        uint32_t stage = g_array_index(unrolled->roots, uint32_t, row);
        FrKey root = fr_key_root(expansion->graph->seed);
        level->stage[row] = stage;
        level->parent[row] = level->bearer[row] = FR_NONE;
        level->offset[row] = (vec3s){{0, 0, 0}};
        level->rotation[row] = (versors){{0, 0, 0, 1}};
        level->scale[row] = 1;
        level->key[row] = fr_path_key(root, fr_stage_prepared(expansion, stage));
        level->i[row] = level->i1[row] = level->i2[row] = 0;
        level->n[row] = level->n1[row] = level->n2[row] = 1;
        level->generation[row] = level->order[row] = 0;
        level->joint[row] = FR_JOINT_NONE;
        level->x[row] = 0;
        level->parent_length[row] = -1;
        level->parent_radius[row] = 0;
        level->stretch[row] = 1;
        level->clock[row] = (float)(expansion->graph->state.age + expansion->graph->state.time);
        level->material[row] = level->axis[row] = FR_NONE;
        level->deformer[row] = level->field[row] = FR_NONE;
        level->scopes[row] = 0;
        level->step[row] = 0;
        bool is_camera = fr_stage_prepared(expansion, stage)->kind == FR_COMPONENT_CAMERA;
        uint32_t component = g_array_index(unrolled->stages, FrStage, stage).component;
        level->edit[row] = fr_edits_begin(expansion->edits, component, is_camera);
        uint32_t edit = level->edit[row] != FR_EDIT_NOWHERE
                            ? fr_edits_at(expansion->edits, level->edit[row])
                            : FR_NONE;
        if (edit != FR_NONE) {
            fr_edit_apply(expansion, level, row, edit);
        }
    }
    fr_twins_of_roots(expansion);
}

static gint compare_faults(gconstpointer a, gconstpointer b) {
    const FrValueFault *p = *(FrValueFault *const *)a;
    const FrValueFault *q = *(FrValueFault *const *)b;
    if (p->instance != q->instance) {
        return p->instance < q->instance ? -1 : 1;
    }
    return p->parameter < q->parameter ? -1 : p->parameter > q->parameter;
}

/// What a parameter is called in documents; behind those of the table come what a graft defines.
static char *parameter_name(const FrPrototype *prototype, uint32_t parameter) {
    const FrParamTable *table = fr_pgraph_table(prototype->kind);
    return parameter < table->count
               ? fr_param_attribute(&table->rows[parameter])
               : g_strdup(g_array_index(prototype->defines, FrGraftDefine, parameter - table->count)
                              .name);
}

// Each parameter that had no value somewhere is reported once, first instances first.
static void report_faults(const FrBuild *build, int workers) {
    const FrExpansion *expansion = &build->expansion;
    GHashTable *first = fr_value_faults_new();
    for (int worker = 0; worker < workers; worker++) {
        GHashTableIter iter;
        gpointer key;
        g_hash_table_iter_init(&iter, expansion->faults[worker]);
        while (g_hash_table_iter_next(&iter, &key, NULL)) {
            const FrValueFault *fault = key;
            const FrValueFault *known = g_hash_table_lookup(first, fault);
            if (known == NULL || fault->instance < known->instance) {
                g_hash_table_add(first, g_memdup2(fault, sizeof *fault));
            }
        }
    }
    GPtrArray *sorted = g_ptr_array_new();
    GHashTableIter iter;
    gpointer key;
    g_hash_table_iter_init(&iter, first);
    while (g_hash_table_iter_next(&iter, &key, NULL)) {
        g_ptr_array_add(sorted, key);
    }
    g_ptr_array_sort(sorted, compare_faults);
    for (guint k = 0; k < sorted->len; k++) {
        const FrValueFault *fault = g_ptr_array_index(sorted, k);
        const FrPrototype *prototype = fr_pgraph_prototype(expansion->graph, fault->component);
        char *attribute = parameter_name(prototype, fault->parameter);
        char *what = g_strdup_printf("%s of '%s'", attribute, prototype->id);
        fr_expr_report_fault(&fault->fault, what, build->context->diags);
        g_free(what);
        g_free(attribute);
    }
    if (build->made != NULL) {
        build->made->has_faults = sorted->len > 0;
    }
    g_ptr_array_unref(sorted);
    g_hash_table_unref(first);
}

// Keeps a level that has been made, or lets it go, and goes on with the next.
static void step_down(FrBuild *build) {
    FrExpansion *expansion = &build->expansion;
    if (build->levels != NULL) {
        g_array_append_val(build->levels, expansion->level);
    } else {
        fr_level_clear(&expansion->level);
    }
    expansion->level = expansion->next;
    expansion->next = (FrLevel){0};
    expansion->depth++;
    fr_progress_report(build->context->progress, "build", 1 - 1.0 / (1 + expansion->depth));
}

static FrStatus expand(FrBuild *build) {
    FrExpansion *expansion = &build->expansion;
    FrStatus status = fr_build_check_least(build);
    if (status == FR_OK) {
        begin_level(build);
    }
    while (status == FR_OK && expansion->level.count > 0) {
        status = expand_level(build);
        fr_grafts_drop(&build->grafting);
        step_down(build);
    }
    if (build->levels != NULL) { // where the children of the last would be
        g_array_append_val(build->levels, expansion->level);
    } else {
        fr_level_clear(&expansion->level);
    }
    return status;
}

// Expands the graph, or takes all of the last build's rows.
static FrStatus expand_or_share(FrBuild *build) {
    FrPgraphBuild *made = build->made;
    FrTwins twins = {0};
    if (made == NULL) {
        return expand(build);
    }
    fr_kept_begin(made, build, build->last, &twins);
    FrStatus status = FR_OK;
    if (twins.is_all) {
        fr_kept_share_rows(made, build->last);
        made->taken_over = build->last->counts.instances;
        build->counts->instances = build->last->counts.instances;
        memcpy(build->counts->by_component, build->last->counts.by_component,
               fr_pgraph_count(build->expansion.graph) * sizeof *build->counts->by_component);
    } else {
        build->levels = g_array_new(FALSE, FALSE, sizeof(FrLevel));
        build->expansion.twins = &twins;
        status = expand(build);
        made->taken_over = build->taken_over;
        fr_kept_own_rows(made, build->levels);
        g_array_unref(build->levels);
    }
    fr_twins_clear(&twins);
    return status;
}

// Warns of edits without a place, and hands on which have one. Rows that are shared were looked at
// by the build that made them.
static void finish_edits(FrBuild *build) {
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
    status = status == FR_OK ? expand_or_share(build) : status;
    if (status == FR_OK) {
        fr_ramps_drop_unused(expansion->plant, expansion->ramps);
    }
    if (status == FR_OK) {
        finish_edits(build);
    }
    g_free(build->has_place);
    g_free(expansion->places);
    fr_edits_free(edits);
    g_free(expansion->ramps);
    report_faults(build, workers);
    for (int worker = 0; worker < workers; worker++) {
        g_hash_table_unref(expansion->faults[worker]);
    }
    g_free(expansion->faults);
    fr_prepared_free(prepared, fr_pgraph_count(expansion->graph));
    return status;
}

static void begin_counts(FrPgraphCounts *counts, uint32_t components) {
    if (counts == NULL) {
        return;
    }
    bool wants_tree = counts->parent != NULL;
    *counts = (FrPgraphCounts){.by_component = g_new0(uint64_t, MAX(components, 1))};
    if (wants_tree) {
        counts->parent = g_new(uint32_t, 1);
        counts->component = g_new(uint32_t, 1);
        counts->place = g_new(uint64_t, 1);
    }
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

// The plant of build->expansion is there afterwards if the graph was right, finished or not.
static FrStatus run(FrBuild *build, FrUnrolled *unrolled) {
    const FrPgraph *graph = build->expansion.graph;
    FrRecursions recursions;
    fr_grafting_init(&build->grafting, build->graft);
    begin_counts(build->counts, fr_pgraph_count(graph));
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
        bool has_fields = build->expansion.fields->len > 0;
        bool is_cut = status == FR_OK && has_fields && drop_ended(build->expansion.plant);
        if (build->made != NULL) {
            build->made->is_cut = is_cut;
        }
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
                     .last = last != NULL && !last->is_cut ? last : NULL,
                     .expansion = {.graph = graph, .progress = context->progress}};
    FrStatus status = run(&build, &kept->unrolled);
    *made = status == FR_OK ? kept : NULL;
    if (status != FR_OK) {
        fr_pgraph_build_free(kept);
    }
    return status;
}
