// Parameter tables: what all kinds of values have in common. How each is read is in param_value.c.
#include "frond/param.h"

#include "expr/param_value.h"

#include <string.h>

static void *field_of(void *object, const FrParam *param) {
    return (char *)object + param->offset;
}

// Frees what one value owns.
static void clear_value(FrParamKind kind, void *field) {
    switch (kind) {
    case FR_PARAM_NUMBER:
        fr_number_clear(field);
        break;
    case FR_PARAM_TEXT:
        g_free(*(char **)field);
        *(char **)field = NULL;
        break;
    case FR_PARAM_CURVE:
        fr_curve_unref(*(FrCurve **)field);
        *(FrCurve **)field = NULL;
        break;
    case FR_PARAM_POINTS:
        g_free(((FrPoints *)field)->at);
        *(FrPoints *)field = (FrPoints){0};
        break;
    case FR_PARAM_FORMULA:
        fr_expr_unref(*(FrExpr **)field);
        *(FrExpr **)field = NULL;
        break;
    case FR_PARAM_REAL:
    case FR_PARAM_INTEGER:
    case FR_PARAM_SWITCH:
    case FR_PARAM_CHOICE:
    case FR_PARAM_VECTOR:
    case FR_PARAM_COLOUR:
        break;
    }
}

// Gives a field that was copied byte by byte its own share of what it points to.
static void own_value(FrParamKind kind, void *field) {
    switch (kind) {
    case FR_PARAM_NUMBER: {
        FrNumber copy = fr_number_copy(field);
        *(FrNumber *)field = copy;
        break;
    }
    case FR_PARAM_TEXT:
        *(char **)field = g_strdup(*(char **)field);
        break;
    case FR_PARAM_CURVE:
        if (*(FrCurve **)field != NULL) {
            fr_curve_ref(*(FrCurve **)field);
        }
        break;
    case FR_PARAM_FORMULA:
        if (*(FrExpr **)field != NULL) {
            fr_expr_ref(*(FrExpr **)field);
        }
        break;
    case FR_PARAM_POINTS: {
        FrPoints *points = field;
        points->at = g_memdup2(points->at, points->count * sizeof *points->at);
        break;
    }
    case FR_PARAM_REAL:
    case FR_PARAM_INTEGER:
    case FR_PARAM_SWITCH:
    case FR_PARAM_CHOICE:
    case FR_PARAM_VECTOR:
    case FR_PARAM_COLOUR:
        break;
    }
}

void fr_params_init(const FrParamTable *table, void *object) {
    memset(object, 0, table->struct_size);
    for (size_t i = 0; i < table->count; i++) {
        const FrParam *row = &table->rows[i];
        FrStatus status =
            fr_params_set(table, object, row, row->default_text, (FrSpan){0}, NULL, NULL);
        FR_ASSERT(status == FR_OK);
    }
}

void fr_params_clear(const FrParamTable *table, void *object) {
    for (size_t i = 0; i < table->count; i++) {
        clear_value(table->rows[i].kind, field_of(object, &table->rows[i]));
    }
}

void fr_params_copy(const FrParamTable *table, void *to, const void *from) {
    memcpy(to, from, table->struct_size);
    for (size_t i = 0; i < table->count; i++) {
        own_value(table->rows[i].kind, field_of(to, &table->rows[i]));
    }
}

FrStatus fr_params_set(const FrParamTable *table, void *object, const FrParam *param,
                       const char *text, FrSpan span, const FrScope *scope, FrDiags *diags) {
    FR_ASSERT(param >= table->rows && param < table->rows + table->count);
    FrValueText value = {.text = text, .span = span, .scope = scope, .diags = diags};
    return fr_value_parse(&value, param, field_of(object, param));
}

static FrDigest digest_text(FrDigest seed, const char *text) {
    return text != NULL ? fr_digest(seed, text, strlen(text) + 1) : fr_digest(seed, "", 1);
}

FrDigest fr_param_digest(FrDigest seed, const FrParam *param, const void *object) {
    const void *field = (const char *)object + param->offset;
    switch (param->kind) {
    case FR_PARAM_NUMBER:
        return fr_number_digest(seed, field);
    case FR_PARAM_REAL:
        return fr_digest(seed, field, sizeof(double));
    case FR_PARAM_INTEGER:
        return fr_digest(seed, field, sizeof(int64_t));
    case FR_PARAM_SWITCH:
        return fr_digest(seed, field, sizeof(bool));
    case FR_PARAM_CHOICE:
        return fr_digest(seed, field, sizeof(int));
    case FR_PARAM_VECTOR:
    case FR_PARAM_COLOUR:
        return fr_digest(seed, field, sizeof(vec3s));
    case FR_PARAM_TEXT:
        return digest_text(seed, *(char *const *)field);
    case FR_PARAM_CURVE: {
        const FrCurve *curve = *(FrCurve *const *)field;
        return curve != NULL ? fr_curve_digest(seed, curve) : digest_text(seed, NULL);
    }
    case FR_PARAM_FORMULA: {
        const FrExpr *formula = *(FrExpr *const *)field;
        return formula != NULL ? fr_expr_digest(seed, formula) : digest_text(seed, NULL);
    }
    case FR_PARAM_POINTS: {
        const FrPoints *points = field;
        FrDigest digest = fr_digest(seed, &points->count, sizeof points->count);
        return fr_digest(digest, points->at, points->count * sizeof *points->at);
    }
    }
    return seed;
}

// ---- names ------------------------------------------------------------------------------------

const FrParam *fr_params_find(const FrParamTable *table, const char *name) {
    for (size_t i = 0; i < table->count; i++) {
        const char *a = name, *b = table->rows[i].name;
        while (*a != '\0' && (*a == *b || (*a == '-' && *b == '_'))) {
            a++;
            b++;
        }
        if (*a == '\0' && *b == '\0') {
            return &table->rows[i];
        }
    }
    return NULL;
}

char *fr_params_suggest(const FrParamTable *table, const char *name) {
    const char **names = g_new(const char *, table->count + 1);
    for (size_t i = 0; i < table->count; i++) {
        names[i] = table->rows[i].name;
    }
    const char *near = fr_nearest_name(name, names, table->count);
    g_free(names);
    return near != NULL ? fr_param_attribute(fr_params_find(table, near)) : NULL;
}

char *fr_param_attribute(const FrParam *param) {
    return g_strdelimit(g_strdup(param->name), "_", '-');
}

char *fr_param_choice(const FrParam *param, int index) {
    char **names = g_strsplit(param->choices, " ", -1);
    FR_ASSERT(index >= 0 && (guint)index < g_strv_length(names));
    char *name = g_strdup(names[index]);
    g_strfreev(names);
    return name;
}
