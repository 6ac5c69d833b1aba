#include "expr/unread.h"

#include <string.h>

static bool has_word(const char *words, const char *word) {
    size_t size = strlen(word);
    for (const char *at = words; *at != '\0'; at += strspn(at, " ")) {
        size_t length = strcspn(at, " ");
        if (length == size && memcmp(at, word, size) == 0) {
            return true;
        }
        at += length;
    }
    return false;
}

// A value as conditions write it.
static char *value_text(const FrParam *row, const void *params) {
    const void *field = (const char *)params + row->offset;
    switch (row->kind) {
    case FR_PARAM_CHOICE:
        return fr_param_choice(row, *(const int *)field);
    case FR_PARAM_SWITCH:
        return g_strdup(*(const bool *)field ? "yes" : "no");
    case FR_PARAM_NUMBER: {
        const FrNumber *number = field;
        return g_strdup(number->is_constant && number->constant == 0 ? "0" : "!0");
    }
    case FR_PARAM_POINTS:
        return g_strdup(((const FrPoints *)field)->count > 0 ? "*" : "");
    case FR_PARAM_CURVE:
        return g_strdup(*(FrCurve *const *)field != NULL ? "*" : "");
    case FR_PARAM_INTEGER:
        return g_strdup(*(const int64_t *)field == 0 ? "0" : "!0");
    case FR_PARAM_TEXT:
        return g_strdup(*(char *const *)field != NULL ? "*" : "");
    default:
        return g_strdup("");
    }
}

// Whether any of the deciders has one of the values.
static bool is_met(const FrParamCondition *condition, const FrParamTable *table,
                   const void *params) {
    char **names = g_strsplit(condition->deciders, " ", -1);
    bool is_met = false;
    for (char **name = names; *name != NULL; name++) {
        const FrParam *row = fr_params_find(table, *name);
        FR_ASSERT(row != NULL);
        char *value = value_text(row, params);
        is_met |= *condition->values == '\0' ? *value == '\0' : has_word(condition->values, value);
        g_free(value);
    }
    g_strfreev(names);
    return is_met;
}

// "mode is density or internode".
static char *told(const FrParamCondition *condition) {
    char *name = g_strdelimit(g_strdup(condition->deciders), "_", '-');
    char **names = g_strsplit(name, " ", -1);
    char *all = g_strjoinv(" or ", names);
    char **values = g_strsplit(condition->values, " ", -1);
    char *listed = g_strjoinv(" or ", values);
    bool is_given = strcmp(listed, "*") == 0;
    char *text = *listed == '\0' || is_given
                     ? g_strdup_printf("%s is %sgiven", all, is_given ? "" : "not ")
                 : *listed == '!' ? g_strdup_printf("%s is not 0", all)
                                  : g_strdup_printf("%s is %s", all, listed);
    g_free(listed);
    g_strfreev(values);
    g_free(all);
    g_strfreev(names);
    g_free(name);
    return text;
}

char *fr_params_why_unread(const FrParamCondition *conditions, size_t count,
                           const FrParamTable *table, const void *object, const FrParam *row) {
    for (size_t k = 0; k < count; k++) {
        const FrParamCondition *condition = &conditions[k];
        bool is_about =
            has_word(condition->parameters, row->name) &&
            (*condition->elements == '*' || has_word(condition->elements, table->element));
        if (is_about && !is_met(condition, table, object)) {
            return told(condition);
        }
    }
    return NULL;
}
