// Numbers that had no value in some instance, each reported once.
#include "pgraph/expand.h"
#include "pgraph/kept.h"

#include <string.h>

static gint compare_faults(gconstpointer a, gconstpointer b) {
    const FrValueFault *p = *(FrValueFault *const *)a;
    const FrValueFault *q = *(FrValueFault *const *)b;
    if (p->instance != q->instance) {
        return p->instance < q->instance ? -1 : 1;
    }
    return p->parameter < q->parameter ? -1 : p->parameter > q->parameter;
}

// What a parameter is called in documents; behind those of the table come what a graft defines.
static char *parameter_name(const FrPrototype *prototype, uint32_t parameter) {
    const FrParamTable *table = fr_pgraph_table(prototype->kind);
    return parameter < table->count
               ? fr_param_attribute(&table->rows[parameter])
               : g_strdup(g_array_index(prototype->defines, FrGraftDefine, parameter - table->count)
                              .name);
}

// Each parameter that had no value somewhere is reported once, first instances first.
void fr_build_report_faults(const FrBuild *build, int workers) {
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
        if (strcmp(fault->fault.code, FR_OUTGROWN) == 0) {
            fr_diags_add(build->context->diags, FR_WARNING, FR_OUTGROWN, prototype->span,
                         "the scales of '%s' and all that it stands on come to more than %g times; "
                         "so much larger it is made, and no more",
                         prototype->id, FR_LARGEST_SCALE);
            continue;
        }
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
