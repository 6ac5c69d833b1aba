#include "expr/builtin.h"
#include "expr/tree.h"

#include <string.h>

struct FrScope {
    const FrScope *outer;   // NULL
    GHashTable *values;     // name → double
    GHashTable *curves;     // name → FrCurve
    GHashTable *functions;  // name → FrFunction, borrowed from `in_order`
    GPtrArray *in_order;    // FrFunction
    GPtrArray *curve_names; // in the order added, borrowed from `curves`
};

static void free_function(void *data) {
    FrFunction *function = data;
    g_free(function->name);
    g_strfreev(function->parameters);
    fr_tree_free(function->tree);
    g_free(function);
}

FrScope *fr_scope_new(void) {
    return fr_scope_new_within(NULL);
}

FrScope *fr_scope_new_within(const FrScope *outer) {
    FrScope *scope = g_new(FrScope, 1);
    scope->outer = outer;
    scope->values = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    scope->curves =
        g_hash_table_new_full(g_str_hash, g_str_equal, g_free, (GDestroyNotify)fr_curve_unref);
    scope->functions = g_hash_table_new(g_str_hash, g_str_equal);
    scope->in_order = g_ptr_array_new_with_free_func(free_function);
    scope->curve_names = g_ptr_array_new();
    return scope;
}

void fr_scope_free(FrScope *scope) {
    if (scope == NULL) {
        return;
    }
    g_hash_table_unref(scope->values);
    g_hash_table_unref(scope->curves);
    g_hash_table_unref(scope->functions);
    g_ptr_array_unref(scope->in_order);
    g_ptr_array_unref(scope->curve_names);
    g_free(scope);
}

// Calls look among functions and curves alike, so they share their names. A built-in curve may be
// replaced, a built-in function not.
static bool is_taken(const FrScope *scope, const char *name) {
    bool is_found = fr_builtin_find(name) != FR_NONE;
    for (; scope != NULL && !is_found; scope = scope->outer) {
        is_found = g_hash_table_contains(scope->functions, name) ||
                   g_hash_table_contains(scope->curves, name) ||
                   g_hash_table_contains(scope->values, name);
    }
    return is_found;
}

bool fr_scope_add_curve(FrScope *scope, const char *name, FrCurve *curve) {
    if (is_taken(scope, name)) {
        return false;
    }
    char *key = g_strdup(name);
    g_hash_table_insert(scope->curves, key, fr_curve_ref(curve));
    g_ptr_array_add(scope->curve_names, key);
    return true;
}

static bool is_identifier(const char *name) {
    bool is_good = g_ascii_isalpha(*name) || *name == '_';
    for (const char *c = name; *c != '\0'; c++) {
        is_good = is_good && (g_ascii_isalnum(*c) || *c == '_');
    }
    return is_good;
}

bool fr_scope_add_value(FrScope *scope, const char *name, double value) {
    FrVar variable;
    double constant;
    FrCurve *curve = fr_scope_find_curve(scope, name);
    bool is_free = curve == NULL && is_identifier(name) && !is_taken(scope, name) &&
                   !fr_variable_find(name, &variable) && !fr_builtin_constant(name, &constant);
    fr_curve_unref(curve);
    if (!is_free) {
        return false;
    }
    g_hash_table_insert(scope->values, g_strdup(name), g_memdup2(&value, sizeof value));
    return true;
}

// The names in a list separated by spaces and commas.
static char **split_names(const char *list) {
    GPtrArray *names = g_ptr_array_new();
    char **words = g_strsplit_set(list, " ,\t\r\n", -1);
    for (char **word = words; *word != NULL; word++) {
        if (**word != '\0') {
            g_ptr_array_add(names, g_strdup(*word));
        }
    }
    g_strfreev(words);
    g_ptr_array_add(names, NULL);
    return (char **)g_ptr_array_free(names, FALSE);
}

static bool check_parameters(char *const *parameters, const char *name, FrSpan span,
                             FrDiags *diags) {
    guint count = g_strv_length((char **)parameters);
    if (count > FR_MOST_ARGUMENTS) {
        fr_diags_add(diags, FR_ERROR, "argument-count", span,
                     "the function '%s' has %u parameters; at most %d are allowed", name, count,
                     FR_MOST_ARGUMENTS);
        return false;
    }
    for (guint i = 0; i < count; i++) {
        if (!is_identifier(parameters[i])) {
            fr_diags_add(diags, FR_ERROR, "bad-name", span,
                         "'%s' cannot name a parameter: only letters, digits and _", parameters[i]);
            return false;
        }
        for (guint k = 0; k < i; k++) {
            if (strcmp(parameters[i], parameters[k]) == 0) {
                fr_diags_add(diags, FR_ERROR, "duplicate-parameter", span,
                             "the function '%s' has two parameters '%s'", name, parameters[i]);
                return false;
            }
        }
    }
    return true;
}

FrStatus fr_scope_add_function(FrScope *scope, const char *name, const char *parameters,
                               const char *body, FrSpan span, FrDiags *diags) {
    if (!is_identifier(name)) {
        fr_diags_add(diags, FR_ERROR, "bad-name", span,
                     "'%s' cannot name a function: only letters, digits and _", name);
        return FR_ERR_DOCUMENT;
    }
    if (is_taken(scope, name)) {
        fr_diags_add(diags, FR_ERROR, "name-taken", span,
                     "there is already a function or curve '%s'", name);
        return FR_ERR_DOCUMENT;
    }
    char **names = split_names(parameters);
    FrTree *tree = NULL;
    if (check_parameters(names, name, span, diags)) {
        tree = fr_tree_parse(body, span, scope, (const char *const *)names, g_strv_length(names),
                             diags);
    }
    if (tree == NULL) {
        g_strfreev(names);
        return FR_ERR_DOCUMENT;
    }
    FrFunction *function = g_new(FrFunction, 1);
    *function = (FrFunction){
        .name = g_strdup(name),
        .parameters = names,
        .count = g_strv_length(names),
        .tree = tree,
    };
    g_ptr_array_add(scope->in_order, function);
    g_hash_table_insert(scope->functions, function->name, function);
    return FR_OK;
}

// ---- looking up -------------------------------------------------------------------------------

bool fr_scope_value(const FrScope *scope, const char *name, double *value) {
    const double *found = NULL;
    for (; scope != NULL && found == NULL; scope = scope->outer) {
        found = g_hash_table_lookup(scope->values, name);
    }
    if (found != NULL) {
        *value = *found;
    }
    return found != NULL;
}

const FrFunction *fr_scope_function(const FrScope *scope, const char *name) {
    const FrFunction *found = NULL;
    for (; scope != NULL && found == NULL; scope = scope->outer) {
        found = g_hash_table_lookup(scope->functions, name);
    }
    return found;
}

FrCurve *fr_scope_curve(const FrScope *scope, const char *name) {
    FrCurve *curve = NULL;
    for (; scope != NULL && curve == NULL; scope = scope->outer) {
        curve = g_hash_table_lookup(scope->curves, name);
    }
    return curve != NULL ? fr_curve_ref(curve) : fr_curve_builtin(name);
}

FrCurve *fr_scope_find_curve(const FrScope *scope, const char *name) {
    FrCurve *curve = fr_scope_curve(scope, name);
    if (curve == NULL && strchr(name, '_') != NULL) {
        char *hyphens = g_strdelimit(g_strdup(name), "_", '-');
        curve = fr_scope_curve(scope, hyphens);
        g_free(hyphens);
    }
    return curve;
}

void fr_scope_list_functions(const FrScope *scope, GPtrArray *names) {
    for (uint32_t i = 0; i < fr_builtin_count; i++) {
        g_ptr_array_add(names, (char *)fr_builtins[i].name);
    }
    for (; scope != NULL; scope = scope->outer) {
        for (guint i = 0; i < scope->in_order->len; i++) {
            const FrFunction *function = g_ptr_array_index(scope->in_order, i);
            g_ptr_array_add(names, function->name);
        }
    }
}

void fr_scope_list_curves(const FrScope *scope, GPtrArray *names) {
    for (; scope != NULL; scope = scope->outer) {
        for (guint i = 0; i < scope->curve_names->len; i++) {
            g_ptr_array_add(names, g_ptr_array_index(scope->curve_names, i));
        }
    }
    size_t count;
    const char *const *builtin = fr_curve_builtin_names(&count);
    for (size_t i = 0; i < count; i++) {
        g_ptr_array_add(names, (char *)builtin[i]);
    }
}

void fr_scope_list_values(const FrScope *scope, GPtrArray *names) {
    for (; scope != NULL; scope = scope->outer) {
        GHashTableIter iterator;
        gpointer name;
        g_hash_table_iter_init(&iterator, scope->values);
        while (g_hash_table_iter_next(&iterator, &name, NULL)) {
            g_ptr_array_add(names, name);
        }
    }
}
