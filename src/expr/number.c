// Numbers that vary: their text form and their value for one instance.
#include "frond/number.h"

#include "expr/factors.h"
#include "expr/lexer.h"
#include "expr/tree.h"

#include <math.h>
#include <string.h>

// The draw of the variance; rand() counts up from 0 and never gets here.
#define VARIANCE_DRAW UINT32_MAX

FrNumber fr_number_constant(double value, double scale) {
    return (FrNumber){
        .from = value,
        .to = value,
        .scale = scale,
        .min = -INFINITY,
        .max = INFINITY,
        .is_constant = true,
        .constant = value * scale,
    };
}

FrNumber fr_number_copy(const FrNumber *number) {
    FrNumber copy = *number;
    if (copy.function != NULL) {
        fr_expr_ref(copy.function);
    }
    fr_factors_ref(copy.factors);
    return copy;
}

void fr_number_clear(FrNumber *number) {
    fr_expr_unref(number->function);
    number->function = NULL;
    fr_factors_unref(number->factors);
    number->factors = NULL;
}

bool fr_number_uses(const FrNumber *number, FrVar var) {
    if (number->is_constant) {
        return false;
    }
    if (number->factors != NULL && fr_factors_use(number->factors, var)) {
        return true;
    }
    if (number->function != NULL) {
        return fr_expr_uses(number->function, var);
    }
    return var == FR_VAR_t && number->from != number->to;
}

// ---- value ------------------------------------------------------------------------------------

static double limit(const FrNumber *number, double value) {
    double bounded = value < number->min ? number->min : value > number->max ? number->max : value;
    // Even where the range is open, sums and units must not carry a value to infinity.
    bounded *= number->scale;
    return fabs(bounded) < 1e300 ? bounded : copysign(1e300, bounded);
}

double fr_number_eval_varying(const FrNumber *number, FrVars *vars, uint32_t purpose,
                              FrExprFault *fault) {
    double t = vars->value[FR_VAR_t];
    double range = number->to - number->from;
    vars->purpose = purpose;
    vars->value[FR_VAR_v] = number->from + t * range;
    double part = number->function != NULL ? fr_expr_eval(number->function, vars, fault) : t;
    double value = number->from + part * range;
    if (number->factors != NULL) {
        fr_factors_key(number->factors, vars, &value);
        value *= fr_factors_product(number->factors, vars, false);
    }
    if (number->variance != 0) {
        value += number->variance * fr_random_signed(vars->key, purpose, VARIANCE_DRAW);
    }
    if (number->factors != NULL) {
        value *= fr_factors_product(number->factors, vars, true);
    }
    return limit(number, value);
}

// ---- text -------------------------------------------------------------------------------------

typedef struct Reader {
    const char *text;
    size_t size, at;
    FrSpan span;
    FrDiags *diags;
} Reader;

static void skip_space(Reader *reader) {
    while (reader->at < reader->size && g_ascii_isspace(reader->text[reader->at])) {
        reader->at++;
    }
}

static bool accept(Reader *reader, const char *sign) {
    skip_space(reader);
    size_t length = strlen(sign);
    if (strncmp(reader->text + reader->at, sign, length) != 0) {
        return false;
    }
    reader->at += length;
    return true;
}

// What stands at the reader, for messages: up to the next space.
static size_t word_end(const Reader *reader) {
    size_t end = reader->at;
    while (end < reader->size && !g_ascii_isspace(reader->text[end])) {
        end++;
    }
    return end;
}

static bool unexpected(Reader *reader, const char *wanted) {
    size_t end = word_end(reader);
    int length = (int)MIN(end - reader->at, 40);
    FrSpan place = fr_place(reader->span, reader->at, end);
    if (length == 0) {
        fr_diags_add(reader->diags, FR_ERROR, "bad-number", place, "%s is missing", wanted);
    } else {
        fr_diags_add(reader->diags, FR_ERROR, "bad-number", place, "here should be %s, not '%.*s'",
                     wanted, length, reader->text + reader->at);
    }
    return false;
}

static bool out_of_range(Reader *reader, const FrNumber *number, double value, size_t begin) {
    FrSpan place = fr_place(reader->span, begin, reader->at);
    if (number->max >= 1e300) {
        fr_diags_add(reader->diags, FR_ERROR, "out-of-range", place, "%g is less than %g", value,
                     number->min);
    } else if (number->min <= -1e300) {
        fr_diags_add(reader->diags, FR_ERROR, "out-of-range", place, "%g is more than %g", value,
                     number->max);
    } else {
        fr_diags_add(reader->diags, FR_ERROR, "out-of-range", place,
                     "%g is outside the range from %g to %g", value, number->min, number->max);
    }
    return false;
}

// One number with its sign.
static bool read_value(Reader *reader, double *value) {
    skip_space(reader);
    size_t begin = reader->at;
    char sign = reader->text[begin];
    if (sign == '-' || sign == '+') {
        reader->at++;
    }
    switch (fr_scan_number(reader->text, reader->size, &reader->at, value)) {
    case FR_SCAN_NUMBER:
        break;
    case FR_SCAN_TOO_LARGE:
        fr_diags_add(reader->diags, FR_ERROR, "number-too-large",
                     fr_place(reader->span, begin, reader->at), "this number is too large");
        return false;
    case FR_SCAN_NONE:
        reader->at = begin;
        return unexpected(reader, "a number (an expression begins with '=')");
    }
    if (sign == '-') {
        *value = -*value;
    }
    return true;
}

static bool read_bounded(Reader *reader, const FrNumber *number, double *value) {
    skip_space(reader);
    size_t begin = reader->at;
    if (!read_value(reader, value)) {
        return false;
    }
    // Negated so that NaN as a limit would not let everything pass.
    return (*value >= number->min && *value <= number->max) ||
           out_of_range(reader, number, *value, begin);
}

static bool read_variance(Reader *reader, FrNumber *number) {
    skip_space(reader);
    size_t begin = reader->at;
    if (!read_value(reader, &number->variance)) {
        return false;
    }
    if (number->variance < 0) {
        fr_diags_add(reader->diags, FR_ERROR, "out-of-range",
                     fr_place(reader->span, begin, reader->at),
                     "a variance is given without a sign: it goes both ways");
        return false;
    }
    return true;
}

// Ways to spread children over a range that have a name.
static const char *const ways[][2] = {
    {"place", "x"},
    {"uniform", "rand()"},
    {"normal", "clamp(0.5 + gauss()/6, 0, 1)"}, // the ends are three deviations from the middle
    {"alternate", "i % 2"},
};

static const char *way_of(const char *text) {
    for (size_t k = 0; k < G_N_ELEMENTS(ways); k++) {
        if (strcmp(text, ways[k][0]) == 0) {
            return ways[k][1];
        }
    }
    return NULL;
}

// The rest of the text as a function: a curve's bare name stands for that curve of t.
static bool read_function(Reader *reader, const FrScope *scope, FrNumber *number) {
    skip_space(reader);
    size_t end = reader->size;
    while (end > reader->at && g_ascii_isspace(reader->text[end - 1])) {
        end--;
    }
    FrSpan place = fr_place(reader->span, reader->at, end);
    char *text = g_strndup(reader->text + reader->at, end - reader->at);
    FrVar ignored;
    FrCurve *curve = fr_variable_find(text, &ignored) ? NULL : fr_scope_find_curve(scope, text);
    const char *way = curve == NULL ? way_of(text) : NULL;
    number->function = curve != NULL
                           ? fr_expr_of_curve(curve, text, place)
                           : fr_expr_compile(way != NULL ? way : text, place, scope, reader->diags);
    fr_curve_unref(curve);
    g_free(text);
    return number->function != NULL;
}

// A part of the text as a value of its own.
static FrValueText part_of(const Reader *reader, const FrScope *scope, char *text, size_t begin) {
    return (FrValueText){
        .text = text,
        .span = fr_place(reader->span, begin, begin + strlen(text)),
        .scope = scope,
        .diags = reader->diags,
    };
}

// Key frames, up to a variance or the end.
static bool read_keys(Reader *reader, const FrScope *scope, FrNumber *number) {
    size_t begin = reader->at;
    reader->at += MIN(strcspn(reader->text + begin, "~"), reader->size - begin);
    char *text = g_strndup(reader->text + begin, reader->at - begin);
    FrValueText value = part_of(reader, scope, text, begin);
    bool is_good = fr_factors_read_keys(&number->factors, &value);
    g_free(text);
    if (is_good && accept(reader, "~") && !read_variance(reader, number)) {
        return false;
    }
    skip_space(reader);
    return is_good && (reader->at == reader->size || unexpected(reader, "the end, '~' or '|'"));
}

// Values that come in turn, up to a variance or the end.
static bool read_list(Reader *reader, FrNumber *number) {
    GArray *values = g_array_new(FALSE, FALSE, sizeof(double));
    bool is_good = true;
    do {
        double value;
        is_good = read_bounded(reader, number, &value);
        g_array_append_val(values, value);
        skip_space(reader);
    } while (is_good && values->len < FR_MOST_LISTED && reader->at < reader->size &&
             reader->text[reader->at] != '~');
    if (is_good) {
        number->factors =
            fr_factors_of_list((const double *)(const void *)values->data, values->len);
    }
    g_array_unref(values);
    if (is_good && accept(reader, "~") && !read_variance(reader, number)) {
        return false;
    }
    skip_space(reader);
    return is_good && (reader->at == reader->size || unexpected(reader, "the end, '~' or '|'"));
}

static bool read_number(Reader *reader, const FrScope *scope, FrNumber *number) {
    if (accept(reader, "list ")) {
        return read_list(reader, number);
    }
    if (accept(reader, "keys ")) {
        return read_keys(reader, scope, number);
    }
    if (accept(reader, "=")) {
        number->from = 0;
        number->to = 1;
        return read_function(reader, scope, number);
    }
    if (!read_bounded(reader, number, &number->from)) {
        return false;
    }
    number->to = number->from;
    if (accept(reader, "..") && !read_bounded(reader, number, &number->to)) {
        return false;
    }
    if (accept(reader, "~") && !read_variance(reader, number)) {
        return false;
    }
    if (accept(reader, ":")) {
        return read_function(reader, scope, number);
    }
    return reader->at == reader->size ||
           unexpected(reader, "the end, '..', '~' or ':' (an expression begins with '=')");
}

// Where the curves of a number begin: at the first bar that is none of the operator `||`.
static size_t find_bar(const char *text, size_t size) {
    for (size_t k = 0; k < size; k++) {
        if (text[k] == '|' && text[k + 1] == '|') {
            k++;
        } else if (text[k] == '|') {
            return k;
        }
    }
    return size;
}

// The number, then the curves behind its bar.
static bool read_whole(Reader *reader, const FrScope *scope, FrNumber *number) {
    size_t size = reader->size;
    reader->size = find_bar(reader->text, size);
    if (!read_number(reader, scope, number)) {
        return false;
    }
    if (reader->size == size) {
        return true;
    }
    size_t begin = reader->size + 1;
    char *text = g_strndup(reader->text + begin, size - begin);
    FrValueText value = part_of(reader, scope, text, begin);
    FrFactors *keys = number->factors;
    number->factors = fr_factors_read(&value);
    bool is_good = number->factors != NULL;
    if (is_good && keys != NULL) {
        fr_factors_take_keys(number->factors, keys);
    }
    fr_factors_unref(keys);
    g_free(text);
    return is_good;
}

// Decides whether every instance has the same value, and works it out.
static void settle(FrNumber *number, FrSpan span, FrDiags *diags) {
    double part = 0;
    bool is_range = number->from != number->to;
    bool is_fixed = number->function != NULL && fr_expr_is_constant(number->function, &part);
    number->is_constant = number->variance == 0 && (!is_range || is_fixed) &&
                          (number->factors == NULL || fr_factors_are_fixed(number->factors));
    double value = number->from + part * (number->to - number->from);
    if (number->is_constant && number->factors != NULL) {
        value *= fr_factors_product(number->factors, NULL, false);
    }
    number->constant = limit(number, value);
    if (is_fixed) {
        // Then it fails for every instance or for none, and this is the time to say so.
        FrExprFault fault = {0};
        const FrVars none = {0};
        fr_expr_eval(number->function, &none, &fault);
        fr_expr_report_fault(&fault, "expression", diags);
    }
    if (number->function != NULL && !is_range) {
        fr_diags_add(diags, FR_WARNING, "function-without-effect", span,
                     "a function walks a range 'from..to'; a single number it leaves as it is");
    }
}

FrStatus fr_number_parse(FrNumber *number, const char *text, FrSpan span, double scale, double min,
                         double max, const FrScope *scope, FrDiags *diags) {
    Reader reader = {.text = text, .size = strlen(text), .span = span, .diags = diags};
    FrNumber parsed = {.scale = scale, .min = min, .max = max};
    if (!read_whole(&reader, scope, &parsed)) {
        fr_number_clear(&parsed);
        return FR_ERR_DOCUMENT;
    }
    settle(&parsed, span, diags);
    fr_number_clear(number);
    *number = parsed;
    return FR_OK;
}

FrDigest fr_number_digest(FrDigest seed, const FrNumber *number) {
    double sizes[] = {number->from,
                      number->to,
                      number->variance,
                      number->scale,
                      number->min,
                      number->max,
                      number->is_constant ? number->constant : 0};
    uint32_t parts[] = {number->is_constant, number->function != NULL, number->factors != NULL};
    FrDigest digest = fr_digest(fr_digest(seed, sizes, sizeof sizes), parts, sizeof parts);
    digest = number->function != NULL ? fr_expr_digest(digest, number->function) : digest;
    return number->factors != NULL ? fr_factors_digest(digest, number->factors) : digest;
}
