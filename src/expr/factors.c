#include "expr/factors.h"

#include "expr/lexer.h"
#include "expr/tree.h"

#include <math.h>
#include <string.h>

enum { MOST_FACTORS = 8 };

typedef struct Factor {
    FrVar var;
    FrCurve *curve;
} Factor;

struct FrFactors {
    gatomicrefcount references;
    FrCurve *keys;   // over age; NULL
    double *list;    // values in turn; NULL
    uint32_t listed; // of them
    double constant; // the product of what is the same for all
    uint32_t count;
    Factor of[MOST_FACTORS];
};

static FrFactors *factors_new(void) {
    FrFactors *factors = g_new0(FrFactors, 1);
    g_atomic_ref_count_init(&factors->references);
    factors->constant = 1;
    return factors;
}

FrFactors *fr_factors_ref(FrFactors *factors) {
    if (factors != NULL) {
        g_atomic_ref_count_inc(&factors->references);
    }
    return factors;
}

void fr_factors_unref(FrFactors *factors) {
    if (factors == NULL || !g_atomic_ref_count_dec(&factors->references)) {
        return;
    }
    for (uint32_t k = 0; k < factors->count; k++) {
        fr_curve_unref(factors->of[k].curve);
    }
    fr_curve_unref(factors->keys);
    g_free(factors->list);
    g_free(factors);
}

// ---- value ------------------------------------------------------------------------------------

bool fr_factors_key(const FrFactors *factors, const FrVars *vars, double *value) {
    if (factors->list != NULL) {
        double turn = fmod(vars->value[FR_VAR_i], factors->listed);
        *value = factors->list[turn > 0 ? (uint32_t)turn : 0];
        return true;
    }
    if (factors->keys == NULL) {
        return false;
    }
    *value = fr_curve_eval(factors->keys, vars->value[FR_VAR_age]);
    return true;
}

double fr_factors_product(const FrFactors *factors, const FrVars *vars, bool is_along_itself) {
    double product = is_along_itself ? 1 : factors->constant;
    for (uint32_t k = 0; k < factors->count; k++) {
        const Factor *factor = &factors->of[k];
        if ((factor->var == FR_VAR_s) == is_along_itself) {
            product *= fr_curve_eval(factor->curve, vars->value[factor->var]);
        }
    }
    return product;
}

bool fr_factors_are_fixed(const FrFactors *factors) {
    return factors->count == 0 && factors->keys == NULL && factors->list == NULL;
}

bool fr_factors_use(const FrFactors *factors, FrVar var) {
    for (uint32_t k = 0; k < factors->count; k++) {
        if (factors->of[k].var == var) {
            return true;
        }
    }
    if (var == FR_VAR_i && factors->list != NULL) {
        return true;
    }
    return var == FR_VAR_age && factors->keys != NULL;
}

FrDigest fr_factors_digest(FrDigest seed, const FrFactors *factors) {
    uint32_t head[3] = {factors->count, factors->keys != NULL, factors->listed};
    FrDigest digest = fr_digest(seed, head, sizeof head);
    for (uint32_t k = 0; k < factors->count; k++) {
        uint32_t var = factors->of[k].var;
        digest = fr_curve_digest(fr_digest(digest, &var, sizeof var), factors->of[k].curve);
    }
    digest = fr_digest(digest, factors->list, factors->listed * sizeof *factors->list);
    return factors->keys != NULL ? fr_curve_digest(digest, factors->keys) : digest;
}

// ---- text -------------------------------------------------------------------------------------

// A curve by name or points; NULL and an error also if there is none.
static FrCurve *read_curve(const FrValueText *value) {
    static const FrParam row = {.name = "curve", .kind = FR_PARAM_CURVE, .unit = "", .choices = ""};
    FrCurve *curve = NULL;
    if (fr_value_parse(value, &row, &curve) == FR_OK && curve == NULL) {
        fr_diags_add(value->diags, FR_ERROR, "bad-number", value->span,
                     "here a curve is missing: its name or points x,y x,y");
    }
    return curve;
}

static bool find_variable(const char *name, FrVar *var) {
    if (strcmp(name, "parent") == 0 || strcmp(name, "self") == 0) {
        *var = name[0] == 'p' ? FR_VAR_x : FR_VAR_s;
        return true;
    }
    return fr_variable_find(name, var);
}

// The part of a clause behind its first word, without the space around it.
static FrValueText rest_of(const FrValueText *clause, size_t end, char **text) {
    size_t first = end + strspn(clause->text + end, " \t\r\n");
    size_t last = strlen(clause->text);
    while (last > first && g_ascii_isspace(clause->text[last - 1])) {
        last--;
    }
    FrValueText rest = *clause;
    rest.text = *text = g_strndup(clause->text + first, last - first);
    rest.span = fr_place(clause->span, first, last);
    return rest;
}

// A number of the scope: times itself or, where a curve follows, times the curve at it.
static bool read_fixed(FrFactors *factors, double value, const FrValueText *rest) {
    if (*rest->text != '\0') {
        FrCurve *curve = read_curve(rest);
        if (curve == NULL) {
            return false;
        }
        value = fr_curve_eval(curve, value);
        fr_curve_unref(curve);
    }
    factors->constant *= value;
    return true;
}

static bool read_varying(FrFactors *factors, FrVar var, const FrValueText *rest, FrSpan name) {
    if (factors->count == MOST_FACTORS) {
        fr_diags_add(rest->diags, FR_ERROR, "too-many-curves", name,
                     "a number has at most %d curves", MOST_FACTORS);
        return false;
    }
    Factor factor = {var, read_curve(rest)};
    if (factor.curve != NULL) {
        factors->of[factors->count++] = factor;
    }
    return factor.curve != NULL;
}

// One clause: a variable, then a curve; or a slider, then a curve or nothing.
static bool read_factor(FrFactors *factors, const FrValueText *clause) {
    size_t begin = strspn(clause->text, " \t\r\n");
    size_t end = begin + strcspn(clause->text + begin, " \t\r\n");
    FrSpan place = fr_place(clause->span, begin, end);
    char *name = g_strndup(clause->text + begin, end - begin), *text;
    FrValueText rest = rest_of(clause, end, &text);
    FrVar var;
    double value;
    bool is_good = false;
    if (find_variable(name, &var)) {
        is_good = read_varying(factors, var, &rest, place);
    } else if (fr_scope_value(clause->scope, name, &value)) {
        is_good = read_fixed(factors, value, &rest);
    } else {
        fr_diags_add(
            clause->diags, FR_ERROR, "unknown-name", place,
            "here should be what a curve is over: parent, self, depth, order, age, season, "
            "another variable or a slider, not '%.40s'",
            name);
    }
    g_free(name);
    g_free(text);
    return is_good;
}

FrFactors *fr_factors_read(const FrValueText *value) {
    FrFactors *factors = factors_new();
    bool is_good = true;
    size_t begin = 0;
    while (is_good) {
        size_t end = begin + strcspn(value->text + begin, "|");
        char *text = g_strndup(value->text + begin, end - begin);
        FrValueText clause = *value;
        clause.text = text;
        clause.span = fr_place(value->span, begin, end);
        is_good = read_factor(factors, &clause);
        g_free(text);
        if (value->text[end] == '\0') {
            break;
        }
        begin = end + 1;
    }
    if (!is_good) {
        fr_factors_unref(factors);
        return NULL;
    }
    return factors;
}

bool fr_factors_read_keys(FrFactors **factors, const FrValueText *value) {
    FrCurve *keys = read_curve(value);
    if (keys == NULL) {
        return false;
    }
    if (*factors == NULL) {
        *factors = factors_new();
    }
    (*factors)->keys = keys;
    return true;
}

void fr_factors_take_keys(FrFactors *factors, const FrFactors *other) {
    factors->keys = other->keys != NULL ? fr_curve_ref(other->keys) : NULL;
    factors->list = g_memdup2(other->list, other->listed * sizeof *other->list);
    factors->listed = other->listed;
}

FrFactors *fr_factors_of_list(const double *values, uint32_t count) {
    FrFactors *factors = factors_new();
    factors->list = g_memdup2(values, count * sizeof *values);
    factors->listed = count;
    return factors;
}
