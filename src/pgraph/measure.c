// Counting what an instance makes before anything is made.
#include "pgraph/choice.h"
#include "pgraph/edit.h"
#include "pgraph/global.h"
#include "pgraph/graft.h"
#include "pgraph/instance.h"
#include "pgraph/life.h"
#include "pgraph/ramp.h"

#include <math.h>

// More than any limit allows.
#define MOST_CHILDREN 4e9

static uint32_t count_children(const FrPrepared *prepared, FrEvaluator *evaluator) {
    double count = prepared->kind == FR_COMPONENT_SCATTER
                       ? fr_scatter_count(prepared, evaluator)
                       : fr_value(evaluator, prepared->number, prepared->number_parameter);
    count = floor(count + 0.5) * prepared->number_times;
    return (double)count < MOST_CHILDREN ? (uint32_t)count : (uint32_t)MOST_CHILDREN;
}

static FrStem stem_of(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrPrepared *prepared = &expansion->prepared[fr_instance_stage(expansion, row)->component];
    FrPose pose = fr_instance_pose(expansion, row, evaluator);
    return fr_stem_measure(prepared, evaluator, fr_instance_stem_base(expansion, row, pose));
}

// Branches of all limbs; more than fit are refused before they are made.
static uint32_t count_branches(const FrStem *stem) {
    uint64_t count = 0;
    for (uint32_t l = 0; l < stem->limb_count; l++) {
        count += stem->limbs[l].end_branch - stem->limbs[l].first_branch;
    }
    return (double)count < MOST_CHILDREN ? (uint32_t)count : (uint32_t)MOST_CHILDREN;
}

static void measure_stem(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    FrStem stem = stem_of(expansion, row, evaluator);
    const FrPrepared *prepared = stem.prepared;
    level->axis_count[row] = stem.internodes > 0 ? stem.axes : 0;
    level->node_count[row] = stem.internodes;
    level->tips[row] = stem.tips;
    if (prepared->is_string) {
        // Step by step, an object stands at either end of every step.
        bool has_both_ends = stem.course == FR_COURSE_STEPS;
        uint64_t organs = ((uint64_t)stem.internodes + has_both_ends) * prepared->piece_count;
        level->organ_count[row] = (uint32_t)MIN(organs, UINT32_MAX - 1);
    }
    if (prepared->bears) {
        level->places[row] = stem.limbs != NULL ? count_branches(&stem) : stem.places.branches;
    }
    fr_stem_clear(&stem);
}

static G_GNUC_NO_INLINE bool is_pruned(const FrExpansion *expansion, uint32_t row) {
    const FrGraphEdit *edit = fr_instance_edit(expansion, row);
    return edit != NULL && edit->params.prune;
}

// What has no life of its own and no edit costs two comparisons.
static inline bool is_absent(const FrExpansion *expansion, uint32_t row, const FrPrepared *prepared,
                             FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    bool lives = level->clock[row] >= 0;
    if (prepared->is_timed) {
        lives = fr_instance_lives(expansion, row, evaluator);
    } else {
        level->age[row] = level->clock[row];
    }
    return !lives || (level->edit[row] != FR_EDIT_NOWHERE && is_pruned(expansion, row));
}

void fr_instance_measure(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = &expansion->prepared[fr_instance_stage(expansion, row)->component];
    level->places[row] = 0;
    level->tips[row] = 1;
    level->node_count[row] = 0;
    level->axis_count[row] = 0;
    level->organ_count[row] = 0;
    level->global_count[row] = 0;
    level->is_absent[row] = is_absent(expansion, row, prepared, evaluator);
    if (level->is_absent[row]) {
        return;
    }
    if (expansion->ramps != NULL) {
        level->ramp[row] = fr_ramp_step(expansion, row, evaluator);
    }
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
            level->organ_count[row] = prepared->piece_count;
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
    case FR_COMPONENT_GRAFT:
        fr_graft_measure(expansion, row);
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

// Branches with a component that are made, on all limbs of a stem.
static uint32_t flagged_branches(const FrStem *stem, const FrFlags *flags) {
    uint32_t count = 0, branches = stem->places.branches;
    for (uint32_t l = 0; l < stem->limb_count; l++) {
        for (uint32_t b = stem->limbs[l].first_branch; b < stem->limbs[l].end_branch; b++) {
            count += fr_flags_allow(flags, b, branches);
        }
    }
    return count;
}

uint32_t fr_instance_children(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    if (level->is_absent[row]) {
        return 0;
    }
    const FrStage *stage = fr_instance_stage(expansion, row);
    FrComponentKind kind = expansion->prepared[stage->component].kind;
    FrStem stem = {0};
    if (level->tips[row] > 1) {
        fr_instance_enter(expansion, row, evaluator);
        stem = stem_of(expansion, row, evaluator);
    }
    uint32_t count = 0;
    for (uint32_t k = 0; k < stage->link_count; k++) {
        if (kind == FR_COMPONENT_VARIATION && k != level->places[row]) {
            continue;
        }
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        const FrFlags *flags = &fr_stage_prepared(expansion, link->stage)->flags;
        if (link->kind == FR_LINK_SYMBOL) {
            const FrScion *scion = fr_scion_of(expansion->grafting, row);
            count += fr_flags_count(flags, fr_scion_places(scion, link->symbol));
        } else if (!fr_link_is_multiplied(kind, link->kind)) {
            count += fr_flags_allow(flags, level->i[row], level->n[row]) * level->tips[row];
        } else if (stem.limbs != NULL && !flags->is_all) {
            count += flagged_branches(&stem, flags);
        } else {
            count += fr_flags_count(flags, level->places[row]);
        }
    }
    fr_stem_clear(&stem);
    return count;
}
