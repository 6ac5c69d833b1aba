// Limits by name, and counts that do not wrap.
#include "frond/limits.h"

#include <string.h>

typedef struct LimitRow {
    const char *name;
    const char *code; // of the error, must be static
    const char *meaning;
    size_t offset;
} LimitRow;

static const LimitRow LIMIT_ROWS[] = {
#define LIMIT_ROW(field, value, meaning)                                                           \
    {#field, "limit-" #field, meaning, offsetof(FrLimits, field)},
    FR_LIMITS(LIMIT_ROW)
#undef LIMIT_ROW
};

FrLimits fr_limits_default(void) {
    return (FrLimits){
#define LIMIT_DEFAULT(field, value, meaning) .field = UINT64_C(value),
        FR_LIMITS(LIMIT_DEFAULT)
#undef LIMIT_DEFAULT
    };
}

static bool is_same_name(const char *a, const char *b) {
    for (; *a != 0 && *b != 0; a++, b++) {
        if ((*a == '-' ? '_' : *a) != (*b == '-' ? '_' : *b)) {
            return false;
        }
    }
    return *a == *b;
}

static const LimitRow *find_limit(const char *name) {
    for (size_t i = 0; i < G_N_ELEMENTS(LIMIT_ROWS); i++) {
        if (is_same_name(name, LIMIT_ROWS[i].name)) {
            return &LIMIT_ROWS[i];
        }
    }
    return NULL;
}

static char *names_of_limits(void) {
    GString *names = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(LIMIT_ROWS); i++) {
        g_string_append_printf(names, "%s%s", i == 0 ? "" : ", ", LIMIT_ROWS[i].name);
    }
    return g_string_free(names, FALSE);
}

FrStatus fr_limits_set(FrLimits *limits, const char *name, const char *value, FrDiags *diags) {
    const LimitRow *row = find_limit(name);
    if (row == NULL) {
        const char *names[G_N_ELEMENTS(LIMIT_ROWS)];
        for (size_t i = 0; i < G_N_ELEMENTS(LIMIT_ROWS); i++) {
            names[i] = LIMIT_ROWS[i].name;
        }
        const char *near = fr_nearest_name(name, names, G_N_ELEMENTS(names));
        char *all = near == NULL ? names_of_limits() : NULL;
        fr_diags_add(diags, FR_ERROR, "unknown-limit", (FrSpan){0},
                     near != NULL ? "there is no limit '%.64s'; did you mean '%s'?"
                                  : "there is no limit '%.64s'; there are: %s",
                     name, near != NULL ? near : all);
        g_free(all);
        return FR_ERR_USAGE;
    }
    guint64 number = 0;
    if (!g_ascii_string_to_unsigned(value, 10, 0, G_MAXUINT64, &number, NULL)) {
        fr_diags_add(diags, FR_ERROR, "limit-value", (FrSpan){0},
                     "the limit '%s' takes a whole number, not '%s'", row->name, value);
        return FR_ERR_USAGE;
    }
    memcpy((char *)limits + row->offset, &number, sizeof number);
    return FR_OK;
}

FrStatus fr_limit_check(uint64_t wanted, uint64_t limit, const char *limit_name,
                        const char *culprit, FrSpan span, FrDiags *diags) {
    if (wanted <= limit) {
        return FR_OK;
    }
    const LimitRow *row = find_limit(limit_name);
    char amount[32];
    if (wanted == UINT64_MAX) {
        g_strlcpy(amount, "over 10^19", sizeof amount);
    } else {
        g_snprintf(amount, sizeof amount, "%" G_GUINT64_FORMAT, wanted);
    }
    char *name = g_strdelimit(g_strdup(limit_name), "_", '-');
    fr_diags_add(diags, FR_ERROR, row != NULL ? row->code : "limit", span,
                 "%s asks for %s; the limit '%s' (%s) is %" G_GUINT64_FORMAT,
                 culprit != NULL && *culprit != 0 ? culprit : "this", amount, name,
                 row != NULL ? row->meaning : "in all", limit);
    g_free(name);
    return FR_ERR_LIMIT;
}

uint64_t fr_count_add(uint64_t a, uint64_t b) {
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

uint64_t fr_count_multiply(uint64_t a, uint64_t b) {
    return b != 0 && a > UINT64_MAX / b ? UINT64_MAX : a * b;
}
