// The text form of every kind of parameter.
#include "expr/param_value.h"

#include "expr/lexer.h"
#include "expr/tree.h"

#include <math.h>
#include <string.h>

#define RADIANS (3.14159265358979323846 / 180)

static double scale_of(const FrParam *param) {
    return strcmp(param->unit, "deg") == 0 ? RADIANS : 1;
}

// Longest part of a wrong value that is quoted.
static int quoted(const char *text) {
    return (int)MIN(strlen(text), 40);
}

// ---- reading numbers from a list --------------------------------------------------------------

typedef struct Cursor {
    const FrValueText *value;
    size_t at, size;
} Cursor;

static void skip_space(Cursor *cursor) {
    while (cursor->at < cursor->size && g_ascii_isspace(cursor->value->text[cursor->at])) {
        cursor->at++;
    }
}

static bool is_at_end(Cursor *cursor) {
    skip_space(cursor);
    return cursor->at == cursor->size;
}

static bool accept_comma(Cursor *cursor) {
    skip_space(cursor);
    if (cursor->value->text[cursor->at] != ',') {
        return false;
    }
    cursor->at++;
    return true;
}

// Reports what stands at the cursor, up to the next separator.
static bool wrong(const Cursor *cursor, const char *wanted) {
    const char *rest = cursor->value->text + cursor->at;
    size_t length = strcspn(rest, " ,\t\r\n");
    length = length == 0 && *rest != '\0' ? 1 : length;
    FrSpan place = fr_place(cursor->value->span, cursor->at, cursor->at + length);
    if (*rest == '\0') {
        fr_diags_add(cursor->value->diags, FR_ERROR, "bad-value", place, "%s is missing", wanted);
    } else {
        fr_diags_add(cursor->value->diags, FR_ERROR, "bad-value", place,
                     "here should be %s, not '%.*s'", wanted, (int)MIN(length, 40), rest);
    }
    return false;
}

static bool read_number(Cursor *cursor, double *number) {
    skip_space(cursor);
    const char *text = cursor->value->text;
    size_t begin = cursor->at;
    bool is_negative = text[begin] == '-';
    if (is_negative || text[begin] == '+') {
        cursor->at++;
    }
    FrScan scan = fr_scan_number(text, cursor->size, &cursor->at, number);
    if (scan == FR_SCAN_TOO_LARGE) {
        fr_diags_add(cursor->value->diags, FR_ERROR, "number-too-large",
                     fr_place(cursor->value->span, begin, cursor->at), "this number is too large");
        return false;
    }
    if (scan == FR_SCAN_NONE) {
        cursor->at = begin;
        return wrong(cursor, "a number");
    }
    *number = is_negative ? -*number : *number;
    return true;
}

static bool check_range(const Cursor *cursor, const FrParam *param, double number, size_t begin) {
    if (number >= param->min && number <= param->max) {
        return true;
    }
    FrSpan place = fr_place(cursor->value->span, begin, cursor->at);
    fr_diags_add(cursor->value->diags, FR_ERROR, "out-of-range", place,
                 "%.10g is outside the range from %.10g to %.10g", number, param->min, param->max);
    return false;
}

static bool read_bounded(Cursor *cursor, const FrParam *param, double *number) {
    skip_space(cursor);
    size_t begin = cursor->at;
    return read_number(cursor, number) && check_range(cursor, param, *number, begin);
}

static bool expect_end(Cursor *cursor) {
    return is_at_end(cursor) || wrong(cursor, "the end");
}

// "= 2*size": a number that is the same for all, of numbers and sliders only.
static bool read_fixed(Cursor *cursor, double *number) {
    bool is_good = fr_value_fixed(cursor->value, cursor->at + 1, cursor->size, number);
    cursor->at = is_good ? cursor->size : cursor->at;
    return is_good;
}

static bool is_expression(Cursor *cursor) {
    skip_space(cursor);
    return cursor->value->text[cursor->at] == '=';
}

// ---- kinds ------------------------------------------------------------------------------------

static bool parse_real(Cursor *cursor, const FrParam *param, double *field) {
    double number;
    size_t begin = cursor->at;
    bool is_good = is_expression(cursor)
                       ? read_fixed(cursor, &number) && check_range(cursor, param, number, begin)
                       : read_bounded(cursor, param, &number);
    if (!is_good || !expect_end(cursor)) {
        return false;
    }
    *field = number * scale_of(param);
    return true;
}

// An expression is rounded: sliders move in between.
static bool parse_fixed_integer(Cursor *cursor, const FrParam *param, int64_t *field) {
    double number;
    size_t begin = cursor->at;
    if (!read_fixed(cursor, &number) || !check_range(cursor, param, round(number), begin)) {
        return false;
    }
    *field = (int64_t)CLAMP(round(number), -0x1p62, 0x1p62);
    return true;
}

static bool parse_integer(Cursor *cursor, const FrParam *param, int64_t *field) {
    if (is_expression(cursor)) {
        return parse_fixed_integer(cursor, param, field);
    }
    double number;
    size_t begin = cursor->at;
    if (!read_number(cursor, &number)) {
        return false;
    }
    if (number != floor(number)) {
        fr_diags_add(cursor->value->diags, FR_ERROR, "bad-value",
                     fr_place(cursor->value->span, begin, cursor->at),
                     "here should be a whole number, not %g", number);
        return false;
    }
    if (!check_range(cursor, param, number, begin) || !expect_end(cursor)) {
        return false;
    }
    // Beyond 2^53 the double would not be the number that was written.
    const char *digits = cursor->value->text + begin + (cursor->value->text[begin] == '+');
    char *end;
    gint64 exact = g_ascii_strtoll(digits, &end, 10);
    bool is_plain = *end == '\0' || g_ascii_isspace(*end);
    *field = is_plain ? exact : fabs(number) < 0x1p63 ? (int64_t)number : INT64_MAX;
    return true;
}

static bool parse_switch(Cursor *cursor, bool *field) {
    const FrValueText *value = cursor->value;
    if (is_expression(cursor)) {
        double number;
        bool is_good = read_fixed(cursor, &number);
        *field = is_good ? number != 0 : *field;
        return is_good;
    }
    static const char *const words[] = {"yes", "no", "true", "false"};
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
        if (strcmp(value->text, words[i]) == 0) {
            *field = i % 2 == 0;
            return true;
        }
    }
    fr_diags_add(value->diags, FR_ERROR, "bad-value", value->span,
                 "here should be yes or no, not '%.*s'", quoted(value->text), value->text);
    return false;
}

static bool parse_choice(const FrValueText *value, const FrParam *param, int *field) {
    char **names = g_strsplit(param->choices, " ", -1);
    guint count = g_strv_length(names);
    guint found = 0;
    while (found < count && strcmp(names[found], value->text) != 0) {
        found++;
    }
    if (found < count) {
        *field = (int)found;
    } else {
        const char *near = fr_nearest_name(value->text, (const char *const *)names, count);
        if (near != NULL) {
            fr_diags_add(value->diags, FR_ERROR, "unknown-choice", value->span,
                         "'%.*s' is not one of the choices; did you mean '%s'?",
                         quoted(value->text), value->text, near);
        } else {
            fr_diags_add(value->diags, FR_ERROR, "unknown-choice", value->span,
                         "'%.*s' is not one of the choices: %s", quoted(value->text), value->text,
                         param->choices);
        }
    }
    g_strfreev(names);
    return found < count;
}

static void parse_text(const FrValueText *value, char **field) {
    char *text = *value->text != '\0' ? g_strdup(value->text) : NULL;
    g_free(*field);
    *field = text;
}

// "x,y x,y …", at least one point. Appends to `points`; `places` receives where each is.
static bool read_points(Cursor *cursor, GArray *points, GArray *places) {
    while (!is_at_end(cursor)) {
        double point[2];
        FrSpan place;
        size_t begin = cursor->at;
        if (!read_number(cursor, &point[0])) {
            return false;
        }
        if (!accept_comma(cursor)) {
            return wrong(cursor, "a comma between x and y");
        }
        if (!read_number(cursor, &point[1])) {
            return false;
        }
        place = fr_place(cursor->value->span, begin, cursor->at);
        g_array_append_val(points, point);
        g_array_append_val(places, place);
    }
    return true;
}

static bool parse_points(Cursor *cursor, FrPoints *field) {
    GArray *points = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    GArray *places = g_array_new(FALSE, FALSE, sizeof(FrSpan));
    bool is_good = read_points(cursor, points, places);
    g_array_unref(places);
    if (!is_good) {
        g_array_unref(points);
        return false;
    }
    g_free(field->at);
    field->count = points->len;
    field->at = (double(*)[2])(void *)g_array_free(points, points->len == 0);
    return true;
}

static FrCurve *curve_of_points(Cursor *cursor) {
    GArray *points = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    GArray *places = g_array_new(FALSE, FALSE, sizeof(FrSpan));
    FrCurve *curve = NULL;
    if (read_points(cursor, points, places)) {
        const double(*at)[2] = (const double(*)[2])(void *)points->data;
        guint bad = 1;
        while (bad < points->len && at[bad][0] > at[bad - 1][0]) {
            bad++;
        }
        curve = bad < points->len ? NULL : fr_curve_new(FR_CURVE_SMOOTH, at, points->len);
        if (bad < points->len) {
            fr_diags_add(cursor->value->diags, FR_ERROR, "curve-order",
                         g_array_index(places, FrSpan, bad),
                         "the x of this point is not greater than that of the one before");
        } else if (curve == NULL) {
            fr_diags_add(cursor->value->diags, FR_ERROR, "curve-slope", cursor->value->span,
                         "the points are too far apart or too close for a curve");
        }
    }
    g_array_unref(points);
    g_array_unref(places);
    return curve;
}

static FrCurve *curve_of_name(const FrValueText *value) {
    FrCurve *curve = fr_scope_find_curve(value->scope, value->text);
    if (curve != NULL) {
        return curve;
    }
    GPtrArray *names = g_ptr_array_new();
    fr_scope_list_curves(value->scope, names);
    const char *near = fr_nearest_name(value->text, (const char *const *)names->pdata, names->len);
    fr_diags_add(value->diags, FR_ERROR, "unknown-curve", value->span,
                 near != NULL ? "there is no curve '%.*s'; did you mean '%s'?"
                              : "there is no curve '%.*s'",
                 quoted(value->text), value->text, near);
    g_ptr_array_unref(names);
    return NULL;
}

static bool parse_curve(Cursor *cursor, FrCurve **field) {
    FrCurve *curve = NULL;
    if (!is_at_end(cursor)) {
        bool is_name = g_ascii_isalpha(cursor->value->text[cursor->at]) ||
                       cursor->value->text[cursor->at] == '_';
        curve = is_name ? curve_of_name(cursor->value) : curve_of_points(cursor);
        if (curve == NULL) {
            return false;
        }
    }
    fr_curve_unref(*field);
    *field = curve;
    return true;
}

static bool read_vector(Cursor *cursor, const FrParam *param, double parts[3]) {
    if (is_expression(cursor)) {
        return fr_value_fixed_vector(cursor->value, param, parts);
    }
    if (!read_bounded(cursor, param, &parts[0])) {
        return false;
    }
    parts[1] = parts[2] = parts[0];
    if (!is_at_end(cursor)) {
        for (int i = 1; i < 3; i++) {
            // A comma or mere space may part them.
            accept_comma(cursor);
            if (!read_bounded(cursor, param, &parts[i])) {
                return false;
            }
        }
    }
    return expect_end(cursor);
}

static bool parse_vector(Cursor *cursor, const FrParam *param, vec3s *field) {
    double parts[3];
    if (!read_vector(cursor, param, parts)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        double part = parts[i] * scale_of(param);
        field->raw[i] = (float)CLAMP(part, -3e38, 3e38);
    }
    return true;
}

static bool parse_colour(const FrValueText *value, vec3s *field) {
    size_t digits = strlen(value->text);
    bool is_good = (digits == 4 || digits == 7) && value->text[0] == '#';
    for (size_t i = 1; is_good && i < digits; i++) {
        is_good = g_ascii_isxdigit(value->text[i]);
    }
    if (!is_good) {
        fr_diags_add(value->diags, FR_ERROR, "bad-colour", value->span,
                     "here should be a colour like #8a6d3b, not '%.*s'", quoted(value->text),
                     value->text);
        return false;
    }
    for (int i = 0; i < 3; i++) {
        const char *hex = value->text + 1;
        int high = g_ascii_xdigit_value(digits == 4 ? hex[i] : hex[2 * i]);
        int low = g_ascii_xdigit_value(digits == 4 ? hex[i] : hex[2 * i + 1]);
        field->raw[i] = (float)(16 * high + low) / 255;
    }
    return true;
}

// A formula gives the same wherever it is asked: it may use its own variables only.
static bool is_pure(const FrValueText *value, const FrParam *param, const FrExpr *expr) {
    bool is_other = fr_expr_is_random(expr);
    for (int var = 0; var < FR_VAR_COUNT; var++) {
        is_other |= fr_expr_uses(expr, (FrVar)var);
    }
    if (is_other) {
        fr_diags_add(value->diags, FR_ERROR, "not-a-formula", value->span,
                     "a formula may use only the variables %s and no random numbers",
                     param->choices);
    }
    return !is_other;
}

static bool parse_formula(Cursor *cursor, const FrParam *param, FrExpr **field) {
    const FrValueText *value = cursor->value;
    FrExpr *expr = NULL;
    if (!is_at_end(cursor)) {
        char **names = g_strsplit(param->choices, " ", -1);
        expr = fr_expr_compile_with(value->text, value->span, value->scope,
                                    (const char *const *)names, g_strv_length(names), value->diags);
        g_strfreev(names);
        if (expr == NULL || !is_pure(value, param, expr)) {
            fr_expr_unref(expr);
            return false;
        }
    }
    fr_expr_unref(*field);
    *field = expr;
    return true;
}

// Where a number names the place along the component itself: the clause of its curve, or all of it.
static FrSpan self_place(const FrValueText *value) {
    const char *text = value->text;
    for (size_t k = strcspn(text, "|"); text[k] != '\0'; k += strcspn(text + k, "|")) {
        k += strspn(text + k, "| \t\r\n");
        size_t size = strcspn(text + k, "| \t\r\n");
        if ((size == 4 && strncmp(text + k, "self", size) == 0) || (size == 1 && text[k] == 's')) {
            return fr_place(value->span, k, k + size);
        }
    }
    return value->span;
}

static FrStatus parse_number(const FrValueText *value, const FrParam *param, FrNumber *field) {
    FrNumber number = {0};
    FrStatus status = fr_number_parse(&number, value->text, value->span, scale_of(param),
                                      param->min, param->max, value->scope, value->diags);
    if (status == FR_OK && strcmp(param->choices, "self") != 0 &&
        fr_number_uses(&number, FR_VAR_s)) {
        char *attribute = fr_param_attribute(param);
        fr_diags_add(value->diags, FR_ERROR, "not-along-itself", self_place(value),
                     "'%s' is one number for the whole component: it cannot differ along it",
                     attribute);
        g_free(attribute);
        status = FR_ERR_DOCUMENT;
    }
    if (status != FR_OK) {
        fr_number_clear(&number);
        return status;
    }
    fr_number_clear(field);
    *field = number;
    return FR_OK;
}

FrStatus fr_value_parse(const FrValueText *value, const FrParam *param, void *field) {
    Cursor cursor = {.value = value, .size = strlen(value->text)};
    bool is_good = true;
    if (fr_value_is_pick(value, param)) {
        return fr_value_pick(value, param, field);
    }
    switch (param->kind) {
    case FR_PARAM_NUMBER:
        return parse_number(value, param, field);
    case FR_PARAM_REAL:
        is_good = parse_real(&cursor, param, field);
        break;
    case FR_PARAM_INTEGER:
        is_good = parse_integer(&cursor, param, field);
        break;
    case FR_PARAM_SWITCH:
        is_good = parse_switch(&cursor, field);
        break;
    case FR_PARAM_CHOICE:
        is_good = parse_choice(value, param, field);
        break;
    case FR_PARAM_TEXT:
        parse_text(value, field);
        break;
    case FR_PARAM_CURVE:
        is_good = parse_curve(&cursor, field);
        break;
    case FR_PARAM_POINTS:
        is_good = parse_points(&cursor, field);
        break;
    case FR_PARAM_VECTOR:
        is_good = parse_vector(&cursor, param, field);
        break;
    case FR_PARAM_COLOUR:
        is_good = parse_colour(value, field);
        break;
    case FR_PARAM_FORMULA:
        is_good = parse_formula(&cursor, param, field);
        break;
    }
    return is_good ? FR_OK : FR_ERR_DOCUMENT;
}
