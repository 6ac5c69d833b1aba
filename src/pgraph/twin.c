// Instances that are taken over from the last build: their rows are copied and renumbered.
//
// What an instance makes stands together in every table, in the order of instances. So the rows of
// neighbours whose twins are neighbours move as one block by one shift. Indices into the block are
// shifted with it; a bearer outside of it is the one that the instance was handed down; what comes
// from tables (shapes, profiles, materials, components) is written anew.
#include "pgraph/global.h"
#include "pgraph/kept.h"

#include "plant/columns.h"

#include <string.h>

static const FrLevel *level_before(const FrExpansion *expansion) {
    return &g_array_index(expansion->twins->last->rows->levels, FrLevel, expansion->depth);
}

static const FrPrepared *prepared_of(const FrExpansion *expansion, uint32_t row) {
    return &expansion->prepared[fr_instance_stage(expansion, row)->component];
}

void fr_twins_of_roots(const FrExpansion *expansion) {
    const FrTwins *twins = expansion->twins;
    const FrLevel *level = &expansion->level;
    const FrLevel *last = twins != NULL && twins->last != NULL ? level_before(expansion) : NULL;
    for (uint32_t row = 0; row < level->count; row++) {
        level->twin[row] = FR_NONE;
        for (uint32_t k = 0; last != NULL && k < last->count; k++) {
            bool is_twin = twins->was[level->stage[row]] == last->stage[k];
            if (is_twin && twins->is_same[level->stage[row]]) {
                level->twin[row] = k;
            }
        }
    }
}

void fr_twin_measure(const FrExpansion *expansion, uint32_t row) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    uint32_t twin = level->twin[row];
    level->age[row] = last->age[twin];
    level->is_absent[row] = last->is_absent[twin];
    level->ramp[row] = last->ramp[twin];
    level->places[row] = last->places[twin];
    level->tips[row] = last->tips[twin];
    level->node_count[row] = last->node_count[twin + 1] - last->node_count[twin];
    level->axis_count[row] = last->axis_count[twin + 1] - last->axis_count[twin];
    level->organ_count[row] = last->organ_count[twin + 1] - last->organ_count[twin];
    level->global_count[row] =
        !level->is_absent[row] && fr_is_global(prepared_of(expansion, row)->kind);
}

uint32_t fr_twin_children(const FrExpansion *expansion, uint32_t row) {
    const FrLevel *last = level_before(expansion);
    uint32_t twin = expansion->level.twin[row];
    return last->child_count[twin + 1] - last->child_count[twin];
}

// Scopes and fields are made anew: what stands in them names them by index. So are point sets,
// which write into rows of others.
static bool is_copied(const FrExpansion *expansion, uint32_t row) {
    const FrPrepared *prepared = prepared_of(expansion, row);
    return expansion->level.twin[row] != FR_NONE && !fr_is_global(prepared->kind) &&
           !prepared->is_point_set;
}

uint32_t fr_twin_run(const FrExpansion *expansion, uint32_t row, uint32_t end) {
    const uint32_t *twin = expansion->level.twin;
    uint32_t count = 0;
    while (row + count < end && is_copied(expansion, row + count) &&
           twin[row + count] == twin[row] + count) {
        count++;
    }
    return count;
}

// ---- one block ---------------------------------------------------------------------------------

// Rows first … first + count − 1 of a table, from those of the last build at `from`.
typedef struct Block {
    uint32_t first, from, count, shift;
} Block;

static Block block_of(const uint32_t *now, const uint32_t *before, uint32_t row, uint32_t twin,
                      uint32_t rows) {
    return (Block){now[row], before[twin], before[twin + rows] - before[twin],
                   now[row] - before[twin]};
}

static void copy_rows(void *to, const void *from, const FrColumns *columns, Block block) {
    for (size_t c = 0; c < columns->count && block.count > 0; c++) {
        const FrColumn *column = &columns->columns[c];
        memcpy((char *)fr_column_data(to, column) + (size_t)block.first * column->width,
               (const char *)fr_column_data(from, column) + (size_t)block.from * column->width,
               (size_t)block.count * column->width);
    }
}

static void shift_all(uint32_t *column, Block block, uint32_t shift) {
    for (uint32_t k = block.first; k < block.first + block.count && shift != 0; k++) {
        column[k] += column[k] != FR_NONE ? shift : 0;
    }
}

// The bearer of something of row `row`: an own node, or what the row stands on.
static uint32_t bearer_now(const FrExpansion *expansion, uint32_t row, uint32_t before) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    uint32_t twin = level->twin[row];
    bool is_own = before >= last->node_count[twin] && before < last->node_count[twin + 1];
    return is_own ? before - last->node_count[twin] + level->node_count[row] : level->bearer[row];
}

static void copy_axes(const FrExpansion *expansion, uint32_t row, uint32_t count, Block nodes) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    FrPlant *plant = expansion->plant;
    FrAxes *axes = &plant->axes;
    Block block = block_of(level->axis_count, last->axis_count, row, level->twin[row], count);
    copy_rows(axes, &expansion->twins->last->rows->axes, &fr_axis_columns, block);
    shift_all(axes->first, block, nodes.shift);
    shift_all(axes->last, block, nodes.shift);
    shift_all(plant->nodes.axis, nodes, block.shift);
    for (uint32_t r = row; r < row + count; r++) {
        for (uint32_t axis = level->axis_count[r]; axis < level->axis_count[r + 1]; axis++) {
            axes->bearer[axis] = bearer_now(expansion, r, axes->bearer[axis]);
            axes->profile[axis] = prepared_of(expansion, r)->profile;
            uint32_t finish = prepared_of(expansion, r)->finish;
            axes->finish[axis] = finish != FR_NONE ? finish + (axes->finish[axis] & 1) : FR_NONE;
            axes->material[axis] = fr_instance_material(expansion, r);
            axes->component[axis] = fr_instance_stage(expansion, r)->component;
            axes->deformer[axis] = level->deformer[r];
            if (axes->first[axis] != FR_NONE) {
                plant->nodes.parent[axes->first[axis]] = axes->bearer[axis];
            }
        }
    }
}

static void copy_organs(const FrExpansion *expansion, uint32_t row, uint32_t count,
                        FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    FrOrgans *organs = &expansion->plant->organs;
    Block block = block_of(level->organ_count, last->organ_count, row, level->twin[row], count);
    copy_rows(organs, &expansion->twins->last->rows->organs, &fr_organ_columns, block);
    for (uint32_t r = row; r < row + count; r++) {
        const FrPrepared *prepared = prepared_of(expansion, r);
        if (prepared->shape_choice == FR_SHAPE_EVALUATED) {
            fr_instance_enter(expansion, r, evaluator);
        }
        for (uint32_t organ = level->organ_count[r]; organ < level->organ_count[r + 1]; organ++) {
            organs->node[organ] = bearer_now(expansion, r, organs->node[organ]);
            organs->material[organ] = fr_instance_material(expansion, r);
            organs->component[organ] = fr_instance_stage(expansion, r)->component;
            organs->deformer[organ] = level->deformer[r];
            if (prepared->piece_count > 0) {
                uint32_t piece = (organ - level->organ_count[r]) % prepared->piece_count;
                fr_piece_write(expansion, r, organ, &prepared->pieces[piece]);
            } else {
                organs->shape[organ] = prepared->kind == FR_COMPONENT_LEAF
                                           ? fr_instance_leaf_shape(expansion, r, organ, evaluator)
                                           : prepared->shape;
            }
        }
    }
}

// ---- children ----------------------------------------------------------------------------------

static uint32_t twin_of_child(const FrExpansion *expansion, uint32_t stage, uint32_t before) {
    return expansion->twins->is_same[stage] ? before : FR_NONE;
}

static void copy_children(const FrExpansion *expansion, uint32_t row, uint32_t count) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    const FrLevel *next = &expansion->next;
    Block block = block_of(level->child_count, last->child_count, row, level->twin[row], count);
    if (block.count == 0) {
        return;
    }
    const FrLevel *from = last + 1; // the level of their twins
#define FR_COPY(type, column)                                                                      \
    memcpy(next->column + block.first, from->column + block.from, block.count * sizeof(type));
    FR_LEVEL_SITE(FR_COPY)
#undef FR_COPY
    for (uint32_t r = row; r < row + count; r++) {
        uint32_t material = fr_instance_material(expansion, r);
        for (uint32_t at = level->child_count[r]; at < level->child_count[r + 1]; at++) {
            uint32_t stage = expansion->twins->is_now[next->stage[at]];
            next->stage[at] = stage;
            next->twin[at] = twin_of_child(expansion, stage, at - block.shift);
            next->parent[at] = r;
            next->bearer[at] = bearer_now(expansion, r, next->bearer[at]);
            next->material[at] = material;
            next->deformer[at] = level->deformer[r];
            next->field[at] = level->field[r];
            next->scopes[at] = level->scopes[r];
            next->step[at] = level->step[r];
        }
    }
}

void fr_twin_copy(const FrExpansion *expansion, uint32_t row, uint32_t count,
                  FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    FrNodes *nodes = &expansion->plant->nodes;
    Block block = block_of(level->node_count, last->node_count, row, level->twin[row], count);
    copy_rows(nodes, &expansion->twins->last->rows->nodes, &fr_node_columns, block);
    shift_all(nodes->parent, block, block.shift);
    shift_all(nodes->next, block, block.shift);
    copy_axes(expansion, row, count, block);
    copy_organs(expansion, row, count, evaluator);
    copy_children(expansion, row, count);
}

void fr_twin_pass_on(const FrExpansion *expansion, uint32_t row) {
    const FrLevel *level = &expansion->level, *last = level_before(expansion);
    uint32_t first = last->child_count[level->twin[row]];
    for (uint32_t at = level->child_count[row]; at < level->child_count[row + 1]; at++) {
        uint32_t stage = expansion->next.stage[at];
        expansion->next.twin[at] =
            twin_of_child(expansion, stage, first + at - level->child_count[row]);
    }
}
