#include "pgraph/choice.h"

#include <math.h>

#define MOST_WEIGHT 1e6

static bool read_weights(const char *text, GArray *weights) {
    char **words = g_strsplit_set(text != NULL ? text : "", " \t\r\n", -1);
    bool is_right = true;
    for (char **word = words; *word != NULL && is_right; word++) {
        if (**word != '\0') {
            char *end;
            double weight = g_ascii_strtod(*word, &end);
            is_right = *end == '\0' && weight >= 0 && weight <= MOST_WEIGHT;
            g_array_append_val(weights, weight);
        }
    }
    g_strfreev(words);
    return is_right;
}

GArray *fr_weights_new(const FrPgraph *graph, uint32_t component, FrDiags *diags) {
    const FrPrototype *prototype = fr_pgraph_prototype(graph, component);
    const FrVariationParams *params = prototype->params;
    GArray *numbers = g_array_new(FALSE, FALSE, sizeof(double));
    GArray *weights = g_array_new(FALSE, FALSE, sizeof(FrWeight));
    bool is_right = read_weights(params->weights, numbers);
    double sum = 0;
    for (uint32_t k = 0; k < graph->links->len; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
        if (link->from == component) {
            uint32_t place = weights->len;
            double own = place < numbers->len ? g_array_index(numbers, double, place) : 1;
            FrWeight weight = {link->to, link->kind, own};
            g_array_append_val(weights, weight);
            sum += own;
        }
    }
    is_right &= numbers->len <= weights->len && (sum > 0 || weights->len == 0);
    g_array_unref(numbers);
    if (!is_right) {
        fr_diags_add(diags, FR_ERROR, "wrong-weights", prototype->span,
                     "the weights of '%s' must be numbers from 0 to %g, one for each of its %u "
                     "links, and not all 0",
                     prototype->id, MOST_WEIGHT, weights->len);
        g_array_unref(weights);
        return NULL;
    }
    return weights;
}

static double weight_of(const FrPrepared *prepared, const FrExpansion *expansion,
                        const FrStageLink *link) {
    uint32_t to = g_array_index(expansion->unrolled->stages, FrStage, link->stage).component;
    for (guint k = 0; k < prepared->weights->len; k++) {
        const FrWeight *weight = &g_array_index(prepared->weights, FrWeight, k);
        if (weight->to == to && weight->kind == link->kind) {
            return weight->weight;
        }
    }
    return 0;
}

// The link whose share of the weights holds `at`.
static uint32_t link_at(const FrExpansion *expansion, uint32_t row, double at) {
    const FrStage *stage = fr_instance_stage(expansion, row);
    const FrPrepared *prepared = &expansion->prepared[stage->component];
    uint32_t last = 0;
    for (uint32_t k = 0; k < stage->link_count; k++) {
        double weight = weight_of(prepared, expansion, fr_stage_link(expansion, stage, k));
        if (weight > 0 && at < weight) {
            return k;
        }
        last = weight > 0 ? k : last;
        at -= weight;
    }
    return last;
}

uint32_t fr_choose(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrStage *stage = fr_instance_stage(expansion, row);
    const FrPrepared *prepared = &expansion->prepared[stage->component];
    const FrVariationParams *params = prepared->params;
    if (stage->link_count == 0) {
        return 0;
    }
    if (params->rule == FR_CHOOSE_BY_NUMBER) {
        double number = floor(fr_value(evaluator, &params->choice, FR_VARIATION_choice));
        return (uint32_t)fmin(number, stage->link_count - 1);
    }
    double sum = 0;
    for (uint32_t k = 0; k < stage->link_count; k++) {
        sum += weight_of(prepared, expansion, fr_stage_link(expansion, stage, k));
    }
    double at =
        params->rule == FR_CHOOSE_IN_TURN
            ? fmod(expansion->level.i[row], fmax(sum, 1e-9))
            : sum * fr_random(expansion->level.key[row], fr_purpose(FR_VARIATION_weights), 0);
    return link_at(expansion, row, at);
}
