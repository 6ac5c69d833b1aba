#include "pgraph/evaluate.h"

#include "pgraph/params.h"

static guint fault_hash(gconstpointer data) {
    const FrValueFault *fault = data;
    return fault->component * 64 + fault->parameter;
}

static gboolean fault_equal(gconstpointer a, gconstpointer b) {
    const FrValueFault *p = a;
    const FrValueFault *q = b;
    return p->component == q->component && p->parameter == q->parameter;
}

GHashTable *fr_value_faults_new(void) {
    return g_hash_table_new_full(fault_hash, fault_equal, g_free, NULL);
}

void fr_value_note(FrEvaluator *evaluator, uint32_t component, uint32_t parameter,
                   const FrExprFault *fault) {
    if (fault->code == NULL) {
        return;
    }
    FrValueFault met = {component, parameter, evaluator->instance, *fault};
    FrValueFault *known = g_hash_table_lookup(evaluator->faults, &met);
    if (known == NULL) {
        g_hash_table_add(evaluator->faults, g_memdup2(&met, sizeof met));
    } else if (met.instance < known->instance) {
        *known = met;
    }
}

double fr_value_varying(FrEvaluator *evaluator, const FrNumber *number, uint32_t parameter) {
    FrExprFault fault = {0};
    double value = fr_number_eval_varying(number, &evaluator->vars, fr_purpose(parameter), &fault);
    fr_value_note(evaluator, evaluator->component, parameter, &fault);
    return value;
}
