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
#include "pgraph/timing.h"

enum { GRAIN = 256 };

// ---- loops over a level -----------------------------------------------------------------------

static void measure_range(void *data, size_t begin, size_t end, int worker) {
    const FrExpansion *expansion = data;
    FrEvaluator evaluator = {.faults = expansion->faults[worker]};
    FrLap lap = fr_lap_begin(expansion, begin, GRAIN, worker);
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        fr_lap_row(&lap, expansion, row);
        if (expansion->level.twin[row] != FR_NONE) {
            fr_twin_measure(expansion, row);
        } else {
            fr_instance_measure(expansion, row, &evaluator);
        }
        fr_lap_count(&lap, expansion, row);
    }
    fr_lap_end(&lap);
}

static void count_range(void *data, size_t begin, size_t end, int worker) {
    const FrExpansion *expansion = data;
    FrEvaluator evaluator = {.faults = expansion->faults[worker]};
    FrLap lap = fr_lap_begin(expansion, begin, GRAIN, worker);
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        fr_lap_row(&lap, expansion, row);
        expansion->level.child_count[row] = expansion->level.twin[row] != FR_NONE
                                                ? fr_twin_children(expansion, row)
                                                : fr_instance_children(expansion, row, &evaluator);
    }
    fr_lap_end(&lap);
}

static void make_range(void *data, size_t begin, size_t end, int worker) {
    const FrExpansion *expansion = data;
    FrEvaluator evaluator = {.faults = expansion->faults[worker]};
    FrEvaluator place = {.faults = expansion->faults[worker]};
    FrLap lap = fr_lap_begin(expansion, begin, GRAIN, worker);
    for (uint32_t row = (uint32_t)begin, run; row < end; row += MAX(run, 1)) {
        fr_lap_row(&lap, expansion, row);
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
    fr_lap_end(&lap);
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
    fr_build_record_level(build);
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

// ---- all levels -------------------------------------------------------------------------------

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

FrStatus fr_build_expand(FrBuild *build) {
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
