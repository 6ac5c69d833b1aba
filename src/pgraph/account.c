// What a plant will be made of, counted against the limits before it is made.
#include "pgraph/expand.h"
#include "pgraph/global.h"

#include <math.h>

enum { ROW_BYTES_NODE = 72, ROW_BYTES_AXIS = 60, ROW_BYTES_ORGAN = 64 };

// Rows have 32-bit indices, of which the last means none.
#define MOST_ROWS ((uint64_t)UINT32_MAX - 1)

FrStatus fr_build_check(const FrBuild *build, uint64_t wanted, uint64_t limit, const char *name,
                        uint32_t row) {
    const FrExpansion *expansion = &build->expansion;
    uint32_t component = fr_instance_stage(expansion, row)->component;
    const FrPrototype *prototype = fr_pgraph_prototype(expansion->graph, component);
    return fr_limit_check(wanted, MIN(limit, MOST_ROWS), name, prototype->id, prototype->span,
                          build->context->diags);
}

static uint32_t multiplied_links(const FrExpansion *expansion, uint32_t row) {
    const FrStage *stage = fr_instance_stage(expansion, row);
    FrComponentKind kind = expansion->prepared[stage->component].kind;
    uint32_t count = 0;
    for (uint32_t k = 0; k < stage->link_count; k++) {
        count += fr_link_is_multiplied(kind, fr_stage_link(expansion, stage, k)->kind);
    }
    return count;
}

// Sums what has been measured. Children count as if flags made all of them, and single ones as
// one for each link: what is left out costs time too.
FrLevelSums fr_level_sum(const FrExpansion *expansion) {
    const FrLevel *level = &expansion->level;
    FrLevelSums sums = {0};
    uint64_t most_children = 0;
    for (uint32_t row = 0; row < level->count; row++) {
        uint64_t children =
            (uint64_t)level->tips[row] * fr_instance_stage(expansion, row)->link_count;
        if (fr_stage_prepared(expansion, level->stage[row])->kind == FR_COMPONENT_GRAFT) {
            children += level->places[row]; // those of every link
        } else if (level->places[row] > 0) {
            // Places on which nothing stands are worked out too.
            children += (uint64_t)level->places[row] * MAX(multiplied_links(expansion, row), 1);
        }
        sums.considered = fr_count_add(sums.considered, children);
        sums.nodes += level->node_count[row];
        sums.axes += level->axis_count[row];
        sums.organs += level->organ_count[row];
        if (level->global_count[row] > 0) {
            bool is_scope = fr_is_scope(fr_stage_prepared(expansion, level->stage[row])->kind);
            *(is_scope ? &sums.scopes : &sums.fields) += 1;
        }
        if (children > most_children) {
            most_children = children;
            sums.most_children = row;
        }
        if (level->node_count[row] > level->node_count[sums.most_nodes]) {
            sums.most_nodes = row;
        }
        if (level->organ_count[row] > level->organ_count[sums.most_organs]) {
            sums.most_organs = row;
        }
    }
    return sums;
}

FrStatus fr_build_check_level(const FrBuild *build, const FrLevelSums *sums) {
    const FrLimits *limits = &build->context->limits;
    const FrPlant *plant = build->expansion.plant;
    uint64_t considered = fr_count_add(build->considered, sums->considered);
    uint64_t nodes = plant->nodes.count + sums->nodes;
    uint64_t organs = plant->organs.count + sums->organs;
    uint64_t axes = plant->axes.count + sums->axes;
    uint64_t bytes = nodes * ROW_BYTES_NODE + axes * ROW_BYTES_AXIS + organs * ROW_BYTES_ORGAN;
    bytes += (plant->deformers->len + sums->scopes) * sizeof(FrDeformer) +
             (build->expansion.fields->len + sums->fields) * sizeof(FrField);
    bytes = fr_count_add(
        bytes, fr_count_multiply(fr_count_add(build->expansion.level.count, sums->considered),
                                 fr_level_row_bytes()));
    FrStatus status =
        fr_build_check(build, considered, limits->instances, "instances", sums->most_children);
    if (status == FR_OK) {
        status = fr_build_check(build, nodes, limits->nodes, "nodes", sums->most_nodes);
    }
    if (status == FR_OK) {
        status = fr_build_check(build, organs, limits->organs, "organs", sums->most_organs);
    }
    if (status == FR_OK) {
        const FrPrototype *prototype = fr_pgraph_prototype(
            build->expansion.graph,
            fr_instance_stage(&build->expansion, sums->most_children)->component);
        status = fr_limit_check(bytes, limits->bytes, "bytes", prototype->id, prototype->span,
                                build->context->diags);
    }
    return status;
}

static uint64_t least_count(const FrNumber *number) {
    double least = 0; // a function may give anything
    if (number->is_constant) {
        least = number->constant;
    } else if (number->function == NULL && number->factors == NULL) {
        least = fmin(number->from, number->to) - fabs(number->variance);
    }
    return (uint64_t)fmax(0, floor(least + 0.5));
}

// A lower bound of instances from the numbers' ranges, so that absurd plants are refused at once.
FrStatus fr_build_check_least(const FrBuild *build) {
    const FrExpansion *expansion = &build->expansion;
    const FrPgraph *graph = expansion->graph;
    uint32_t count = fr_pgraph_count(graph);
    uint64_t *multiplicity = g_new0(uint64_t, count);
    bool *is_flagged = g_new0(bool, count);
    for (uint32_t c = 0; c < count; c++) {
        const FrPrepared *prepared = &expansion->prepared[c];
        const FrNumber *number = NULL;
        is_flagged[c] = !prepared->flags.is_all;
        if (prepared->number != NULL) {
            number = prepared->number;
        } else if (prepared->kind == FR_COMPONENT_TREE) {
            const FrTreeParams *tree = prepared->params;
            number = tree->mode == FR_BRANCHES_BY_NUMBER ? &tree->number : NULL;
        }
        multiplicity[c] = number != NULL ? least_count(number) : 0;
        if (prepared->number_times > 1) {
            multiplicity[c] = fr_count_multiply(multiplicity[c], prepared->number_times);
        }
    }
    uint32_t culprit;
    uint64_t least =
        fr_unrolled_least(expansion->unrolled, graph, multiplicity, is_flagged, &culprit);
    g_free(multiplicity);
    g_free(is_flagged);
    if (culprit == FR_NONE) {
        return FR_OK;
    }
    const FrPrototype *prototype = fr_pgraph_prototype(graph, culprit);
    return fr_limit_check(least, build->context->limits.instances, "instances", prototype->id,
                          prototype->span, build->context->diags);
}
