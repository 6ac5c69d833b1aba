// Values that are the same for a whole plant, and yet move with its sliders: numbers, vectors of
// numbers, and one of some texts that a number picks.
#include "expr/param_value.h"

#include "expr/lexer.h"

#include <math.h>
#include <string.h>

bool fr_value_fixed(const FrValueText *value, size_t begin, size_t end, double *number) {
    FrSpan span = fr_place(value->span, begin, end);
    char *text = g_strndup(value->text + begin, end - begin);
    FrExpr *expr = fr_expr_compile(text, span, value->scope, value->diags);
    g_free(text);
    if (expr == NULL) {
        return false;
    }
    bool is_fixed = fr_expr_is_constant(expr, number);
    if (is_fixed) {
        FrExprFault fault = {0};
        const FrVars none = {0};
        fr_expr_eval(expr, &none, &fault);
        fr_expr_report_fault(&fault, "expression", value->diags);
    } else {
        fr_diags_add(value->diags, FR_ERROR, "not-fixed", span,
                     "this is the same for the whole plant: only numbers and sliders may be used");
    }
    fr_expr_unref(expr);
    return is_fixed;
}

// Where the part that begins at `at` ends: at a sign of `ends` outside of parentheses.
static size_t end_of_part(const char *text, size_t at, size_t size, const char *ends) {
    int depth = 0;
    for (; at < size; at++) {
        depth += text[at] == '(';
        depth -= text[at] == ')';
        if (depth <= 0 && text[at] != ')' && strchr(ends, text[at]) != NULL) {
            break;
        }
    }
    return at;
}

bool fr_value_fixed_vector(const FrValueText *value, const FrParam *param, double parts[3]) {
    size_t size = strlen(value->text), at = strcspn(value->text, "=") + 1;
    int count = 0;
    for (bool is_last = false; !is_last; count++) {
        size_t end = end_of_part(value->text, at, size, ",");
        FrSpan place = fr_place(value->span, at, end);
        if (count == 3) {
            fr_diags_add(value->diags, FR_ERROR, "bad-value", place,
                         "a vector is three numbers, or one for all three");
            return false;
        }
        if (!fr_value_fixed(value, at, end, &parts[count])) {
            return false;
        }
        if (!(parts[count] >= param->min && parts[count] <= param->max)) {
            fr_diags_add(value->diags, FR_ERROR, "out-of-range", place,
                         "%.10g is outside the range from %.10g to %.10g", parts[count], param->min,
                         param->max);
            return false;
        }
        is_last = end == size;
        at = end + 1;
    }
    if (count == 2) {
        fr_diags_add(value->diags, FR_ERROR, "bad-value", value->span,
                     "a vector is three numbers, or one for all three");
        return false;
    }
    parts[1] = count == 1 ? parts[0] : parts[1];
    parts[2] = count == 1 ? parts[0] : parts[2];
    return true;
}

// ---- picking ----------------------------------------------------------------------------------

// A field of any kind that can be picked.
typedef union Field {
    int choice;
    char *text;
    FrCurve *curve;
    FrPoints points;
    vec3s vector;
} Field;

static void clear_field(FrParamKind kind, Field *field) {
    if (kind == FR_PARAM_TEXT) {
        g_free(field->text);
    } else if (kind == FR_PARAM_CURVE) {
        fr_curve_unref(field->curve);
    } else if (kind == FR_PARAM_POINTS) {
        g_free(field->points.at);
    }
}

// Behind the parenthesis that opens "= pick(", 0 if it is no such value.
static size_t begin_of_pick(const char *text) {
    const char *at = text + strspn(text, " \t\r\n");
    if (*at != '=') {
        return 0;
    }
    at++;
    at += strspn(at, " \t\r\n");
    if (strncmp(at, "pick", 4) != 0) {
        return 0;
    }
    at += 4;
    at += strspn(at, " \t\r\n");
    return *at == '(' ? (size_t)(at + 1 - text) : 0;
}

bool fr_value_is_pick(const FrValueText *value, const FrParam *param) {
    bool may = param->kind == FR_PARAM_CHOICE || param->kind == FR_PARAM_TEXT ||
               param->kind == FR_PARAM_CURVE || param->kind == FR_PARAM_POINTS ||
               param->kind == FR_PARAM_VECTOR || param->kind == FR_PARAM_COLOUR;
    return may && begin_of_pick(value->text) > 0;
}

// One of the texts between `at` and `end`, without the blanks around it.
static FrStatus parse_item(const FrValueText *value, const FrParam *param, size_t at, size_t end,
                           void *field) {
    while (at < end && g_ascii_isspace(value->text[at])) {
        at++;
    }
    while (at < end && g_ascii_isspace(value->text[end - 1])) {
        end--;
    }
    char *text = g_strndup(value->text + at, end - at);
    FrValueText item = *value;
    item.text = text;
    item.span = fr_place(value->span, at, end);
    FrStatus status = fr_value_parse(&item, param, field);
    g_free(text);
    return status;
}

FrStatus fr_value_pick(const FrValueText *value, const FrParam *param, void *field) {
    size_t at = begin_of_pick(value->text), end = strlen(value->text);
    while (end > at && g_ascii_isspace(value->text[end - 1])) {
        end--;
    }
    size_t comma = end > at ? end_of_part(value->text, at, end - 1, ",") : at;
    if (end == at || value->text[end - 1] != ')' || comma >= end - 1) {
        fr_diags_add(value->diags, FR_ERROR, "bad-value", value->span,
                     "here should be = pick(number, first; second; third)");
        return FR_ERR_DOCUMENT;
    }
    double number;
    if (!fr_value_fixed(value, at, comma, &number)) {
        return FR_ERR_DOCUMENT;
    }
    end--;
    size_t count = 1;
    for (at = comma + 1; (at = end_of_part(value->text, at, end, ";")) < end; at++) {
        count++;
    }
    size_t chosen = (size_t)fmax(0, fmin(floor(number + 0.5), (double)(count - 1)));
    FrStatus status = FR_OK;
    at = comma + 1;
    for (size_t k = 0; k < count; k++) {
        // Those that are not chosen must be right all the same.
        Field other = {0};
        size_t stop = end_of_part(value->text, at, end, ";");
        FrStatus one = parse_item(value, param, at, stop, k == chosen ? field : &other);
        status = MAX(status, one);
        clear_field(param->kind, &other);
        at = stop + 1;
    }
    return status;
}
