// Counting what an instance makes before anything is made.
#include "pgraph/choice.h"
#include "pgraph/global.h"
#include "pgraph/instance.h"

#include <math.h>

// More than any limit allows.
#define MOST_CHILDREN 4e9

static uint32_t count_children(const FrPrepared *prepared, FrEvaluator *evaluator) {
    double count = prepared->kind == FR_COMPONENT_SCATTER
                       ? fr_scatter_count(prepared->params, evaluator)
                       : fr_value(evaluator, prepared->number, prepared->number_parameter);
    count = floor(count + 0.5) * prepared->number_times;
    return count < MOST_CHILDREN ? (uint32_t)count : (uint32_t)MOST_CHILDREN;
}

static void measure_stem(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = &expansion->prepared[fr_instance_stage(expansion, row)->component];
    const FrStemParams *params = prepared->params;
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    FrStem stem =
        fr_stem_measure(prepared, evaluator, fr_instance_stem_base(expansion, row, pose.scale));
    level->axis_count[row] = stem.internodes > 0;
    level->node_count[row] = stem.internodes;
    if (prepared->is_string) {
        // Step by step, an object stands at either end of every step.
        bool has_both_ends = params->course == FR_COURSE_STEPS;
        level->organ_count[row] = stem.internodes + has_both_ends;
    }
    level->places[row] = prepared->bears ? stem.places.branches : 0;
}

void fr_instance_measure(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = &expansion->prepared[fr_instance_stage(expansion, row)->component];
    level->places[row] = 0;
    level->node_count[row] = 0;
    level->axis_count[row] = 0;
    level->organ_count[row] = 0;
    level->global_count[row] = fr_is_global(prepared->kind);
    switch (prepared->kind) {
    case FR_COMPONENT_HORN:
    case FR_COMPONENT_TREE:
        fr_instance_enter(expansion, row, evaluator);
        measure_stem(expansion, row, evaluator);
        break;
    case FR_COMPONENT_LEAF:
        level->organ_count[row] = 1;
        break;
    case FR_COMPONENT_SIMPLE:
        if (prepared->is_point_set) {
            bool goes_on = level->joint[row] == FR_JOINT_SET;
            level->axis_count[row] = !goes_on;
            level->node_count[row] = goes_on;
        } else {
            level->organ_count[row] = prepared->shape != FR_NONE;
        }
        break;
    case FR_COMPONENT_PHIBALL:
    case FR_COMPONENT_PHYLLOTAXIS:
    case FR_COMPONENT_HYDRA:
    case FR_COMPONENT_WREATH:
    case FR_COMPONENT_SCATTER:
        fr_instance_enter(expansion, row, evaluator);
        level->places[row] = prepared->bears ? count_children(prepared, evaluator) : 0;
        break;
    case FR_COMPONENT_REVO:
        level->organ_count[row] = prepared->shape != FR_NONE;
        break;
    case FR_COMPONENT_VARIATION:
        fr_instance_enter(expansion, row, evaluator);
        level->places[row] = fr_choose(expansion, row, evaluator);
        break;
    default:
        break;
    }
}

uint32_t fr_instance_children(const FrExpansion *expansion, uint32_t row) {
    const FrLevel *level = &expansion->level;
    const FrStage *stage = fr_instance_stage(expansion, row);
    FrComponentKind kind = expansion->prepared[stage->component].kind;
    uint32_t count = 0;
    for (uint32_t k = 0; k < stage->link_count; k++) {
        if (kind == FR_COMPONENT_VARIATION && k != level->places[row]) {
            continue;
        }
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        const FrFlags *flags = &fr_stage_prepared(expansion, link->stage)->flags;
        if (fr_link_is_multiplied(kind, link->kind)) {
            count += fr_flags_count(flags, level->places[row]);
        } else {
            count += fr_flags_allow(flags, level->i[row], level->n[row]);
        }
    }
    return count;
}
