// The language as docs/expressions.md teaches it: every example of that page is run here.
#include "frond/number.h"

#include <math.h>
#include <string.h>

typedef struct Page {
    FrScope *scope;
    FrVars vars;
    unsigned examples;
} Page;

static FrSource *source_of(const char *text, FrSpan *span) {
    FrSource *source = fr_source_new("example", text, strlen(text));
    *span = (FrSpan){.source = source, .begin = 0, .end = (uint32_t)strlen(text)};
    return source;
}

static void check_value(const Page *page, const char *text, const char *expected) {
    double value = NAN;
    FrDiags *diags = fr_diags_new();
    FrExprFault fault = {0};
    FrExpr *expr = fr_expr_compile(text, (FrSpan){0}, page->scope, diags);
    if (expr != NULL) {
        value = fr_expr_eval(expr, &page->vars, &fault);
    }
    if (fault.code != NULL || !(fabs(value - g_ascii_strtod(expected, NULL)) < 1e-9)) {
        g_error("%s gives %.17g, not %s", text, value, expected);
    }
    g_assert_cmpstr(fr_expr_text(expr), ==, text);
    fr_expr_unref(expr);
    fr_diags_free(diags);
}

static void check_number(const Page *page, const char *text, const char *expected) {
    FrNumber number = fr_number_constant(0, 1);
    FrVars vars = page->vars;
    FrStatus status =
        fr_number_parse(&number, text, (FrSpan){0}, 1, -1000, 1000, page->scope, NULL);
    double value = fr_number_eval(&number, &vars, 1, NULL);
    if (status != FR_OK || !(fabs(value - g_ascii_strtod(expected, NULL)) < 1e-9)) {
        g_error("%s gives %.17g, not %s", text, value, expected);
    }
    fr_number_clear(&number);
}

static void check_error(const Page *page, const char *text, const char *expected) {
    FrSpan span;
    FrSource *source = source_of(text, &span);
    FrDiags *diags = fr_diags_new();
    g_assert_null(fr_expr_compile(text, span, page->scope, diags));
    g_assert_cmpuint(fr_diags_error_count(diags), >=, 1);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, expected);
    g_assert_true(fr_diags_get(diags, 0)->span.source == source);
    fr_diags_free(diags);
    fr_source_unref(source);
}

static void check_fault(const Page *page, const char *text, const char *expected) {
    FrExprFault fault = {0};
    FrExpr *expr = fr_expr_compile(text, (FrSpan){0}, page->scope, NULL);
    g_assert_nonnull(expr);
    double value = fr_expr_eval(expr, &page->vars, &fault);
    char *outcome = g_strdup_printf("%g %s", value, fault.code);
    g_assert_cmpstr(outcome, ==, expected);
    g_free(outcome);
    fr_expr_unref(expr);
}

static void define(const Page *page, const char *line) {
    char **sides = g_strsplit(line, " = ", 2);
    char **words = g_strsplit(g_strstrip(sides[0]), " ", 2);
    FrStatus status = fr_scope_add_function(page->scope, words[0], words[1] != NULL ? words[1] : "",
                                            sides[1], (FrSpan){0}, NULL);
    g_assert_cmpint(status, ==, FR_OK);
    g_strfreev(words);
    g_strfreev(sides);
}

static void run_line(Page *page, const char *kind, const char *line) {
    char **sides = g_strsplit(line, "→", 2);
    char *text = g_strstrip(sides[0]), *expected = sides[1] != NULL ? g_strstrip(sides[1]) : NULL;
    page->examples++;
    if (strcmp(kind, "function") == 0) {
        define(page, line);
    } else if (strcmp(kind, "expression") == 0) {
        check_value(page, text, expected);
    } else if (strcmp(kind, "number") == 0) {
        check_number(page, text, expected);
    } else if (strcmp(kind, "error") == 0) {
        check_error(page, text, expected);
    } else if (strcmp(kind, "fault") == 0) {
        check_fault(page, text, expected);
    } else {
        g_error("no such block of examples: %s", kind);
    }
    g_strfreev(sides);
}

static void test_page(void) {
    char *path = g_build_filename(g_getenv("FROND_SOURCE"), "docs", "expressions.md", NULL);
    char *text;
    g_assert_true(g_file_get_contents(path, &text, NULL, NULL));
    Page page = {.scope = fr_scope_new()};
    page.vars = (FrVars){.key = fr_key_root(7), .purpose = 3};
    page.vars.value[FR_VAR_t] = 0.25;
    page.vars.value[FR_VAR_i] = 3;
    page.vars.value[FR_VAR_n] = 13;
    page.vars.value[FR_VAR_x] = 0.5;
    page.vars.value[FR_VAR_depth] = 2;
    page.vars.value[FR_VAR_age] = 2.5;
    char **lines = g_strsplit(text, "\n", -1);
    const char *kind = NULL;
    for (char **line = lines; *line != NULL; line++) {
        if (g_str_has_prefix(*line, "```")) {
            kind = kind == NULL ? *line + 3 : NULL;
        } else if (kind != NULL) {
            run_line(&page, kind, *line);
        }
    }
    g_assert_cmpuint(page.examples, >, 80);
    g_strfreev(lines);
    g_free(text);
    g_free(path);
    fr_scope_free(page.scope);
}

// ---- beyond the page --------------------------------------------------------------------------

static void test_every_variable(void) {
    static const char *const names[] = {
#define NAME(name, meaning) #name,
        FR_VARS(NAME)
#undef NAME
    };
    FrVars vars = {0};
    for (int i = 0; i < FR_VAR_COUNT; i++) {
        vars.value[i] = 100 + i;
    }
    for (int i = 0; i < FR_VAR_COUNT; i++) {
        FrExpr *expr = fr_expr_compile(names[i], (FrSpan){0}, NULL, NULL);
        g_assert_cmpfloat(fr_expr_eval(expr, &vars, NULL), ==, 100 + i);
        for (int k = 0; k < FR_VAR_COUNT; k++) {
            g_assert_cmpint(fr_expr_uses(expr, (FrVar)k), ==, i == k);
        }
        fr_expr_unref(expr);
    }
}

// Every way in which an operand can come to an operator: computed, constant, variable; left, right.
static void test_operand_forms(void) {
    static const struct {
        const char *text;
        double value;
    } forms[] = {
        {"(i+t) - (n*t)", 3.25 - 3.25},
        {"(i+t) - 2", 1.25},
        {"(i+t) - n", -9.75},
        {"2 - (i+t)", -1.25},
        {"n - (i+t)", 9.75},
        {"n - i", 10},
        {"(n+t) / (i+t)", 13.25 / 3.25},
        {"(n+t) / 2", 6.625},
        {"(n+t) / i", 13.25 / 3},
        {"2 / (i+t)", 2 / 3.25},
        {"n / (i+t)", 13 / 3.25},
        {"n / i", 13.0 / 3},
        {"2 < (i+t)", 1},
        {"(i+t) < 2", 0},
        {"i <= (i*1)", 1},
        {"i >= (i+t)", 0},
        {"2 > (i+t)", 0},
        {"n % (i+1)", 1},
        {"2 ^ (i+1)", 16},
        {"i ^ (i-1)", 9},
        {"(i+1)^3", 64},
        {"(i+1)^2", 16},
        {"(i+1)^2.5", 32},
        {"-(i+1)", -4},
        {"!(i-3)", 1},
        {"2*i - 3*n + t*4", -32},
        {"i*(n*(t*(1+i)))", 39},
        {"min(i+1, n-1, 2*t)", 0.5},
        {"1 + (i > 2 ? n : 0)", 14},
        {"(i > 2 ? n : t) * (i < 2 ? n : t)", 3.25},
    };
    FrVars vars = {.value = {[FR_VAR_t] = 0.25, [FR_VAR_i] = 3, [FR_VAR_n] = 13}};
    for (size_t i = 0; i < G_N_ELEMENTS(forms); i++) {
        FrExpr *expr = fr_expr_compile(forms[i].text, (FrSpan){0}, NULL, NULL);
        g_assert_nonnull(expr);
        g_assert_cmpfloat_with_epsilon(fr_expr_eval(expr, &vars, NULL), forms[i].value, 1e-12);
        fr_expr_unref(expr);
    }
}

static void assert_place(const char *text, const char *code, uint32_t begin, uint32_t end) {
    FrSpan span;
    FrSource *source = source_of(text, &span);
    FrDiags *diags = fr_diags_new();
    FrExprFault fault = {0};
    FrVars vars = {.value = {[FR_VAR_i] = 3}};
    FrExpr *expr = fr_expr_compile(text, span, NULL, diags);
    if (expr != NULL) {
        fr_expr_eval(expr, &vars, &fault);
        fr_expr_report_fault(&fault, "test", diags);
    }
    const FrDiag *diag = fr_diags_get(diags, 0);
    g_assert_cmpstr(diag->code, ==, code);
    g_assert_cmpuint(diag->span.begin, ==, begin);
    g_assert_cmpuint(diag->span.end, ==, end);
    fr_expr_unref(expr);
    fr_diags_free(diags);
    fr_source_unref(source);
}

static void test_places(void) {
    assert_place("1 + heigt*2", "unknown-name", 4, 9);
    assert_place("2*sinn(t)", "unknown-function", 2, 6);
    assert_place("1 + atan2(t)", "argument-count", 4, 12);
    assert_place("(t + 1", "syntax", 6, 6);
    assert_place("t + ) + 1", "syntax", 4, 5);
    assert_place("t × 2", "unexpected-character", 2, 4);
    // At run time: the operation, not the whole.
    assert_place("5 + 1/(i-3)*2", "division-by-zero", 4, 11);
    assert_place("2*log(i - 4)", "not-a-number", 2, 12);
    assert_place("1 + 9^(999*i)", "overflow", 4, 13);
    assert_place("2 + 1/0", "division-by-zero", 4, 7);
}

static void test_many_errors(void) {
    FrDiags *diags = fr_diags_new();
    g_assert_null(fr_expr_compile("foo + sin() * bar(2)", (FrSpan){0}, NULL, diags));
    g_assert_cmpuint(fr_diags_count(diags), ==, 3);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "unknown-name");
    g_assert_cmpstr(fr_diags_get(diags, 1)->code, ==, "argument-count");
    g_assert_cmpstr(fr_diags_get(diags, 2)->code, ==, "unknown-function");
    fr_diags_free(diags);
}

static void test_suggestions(void) {
    static const char *const slips[][2] = {
        {"heigt", "'height'"},
        {"ligth", "'light'"},
        {"smothstep(0,1,t)", "'smoothstep'"},
        {"sin", "sin("},
        {"hemisperical(t)", "'hemispherical'"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(slips); i++) {
        FrDiags *diags = fr_diags_new();
        g_assert_null(fr_expr_compile(slips[i][0], (FrSpan){0}, NULL, diags));
        g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, slips[i][1]));
        fr_diags_free(diags);
    }
}

static void test_constant(void) {
    double value = 0;
    FrExpr *expr = fr_expr_compile("2*(3 + sin(0)) - bell(0.5)", (FrSpan){0}, NULL, NULL);
    g_assert_true(fr_expr_is_constant(expr, &value));
    g_assert_cmpfloat(value, ==, 5);
    fr_expr_unref(expr);
    static const char *const varying[] = {"t", "rand()", "gauss(2)", "1 + rand(1)"};
    for (size_t i = 0; i < G_N_ELEMENTS(varying); i++) {
        expr = fr_expr_compile(varying[i], (FrSpan){0}, NULL, NULL);
        g_assert_false(fr_expr_is_constant(expr, &value));
        g_assert_cmpint(fr_expr_is_random(expr), ==, i > 0);
        fr_expr_unref(expr);
    }
}

static void test_extra(void) {
    static const char *const names[] = {"t", "length", "w"};
    const double values[] = {10, 20, 30};
    FrVars vars = {.value = {[FR_VAR_t] = 1, [FR_VAR_i] = 2}};
    double value;
    FrExpr *expr = fr_expr_compile_with("t + length*w - i", (FrSpan){0}, NULL, names, 3, NULL);
    g_assert_cmpfloat(fr_expr_eval_with(expr, &vars, values, NULL), ==, 608);
    // The parameter named t hides the variable.
    g_assert_false(fr_expr_uses(expr, FR_VAR_t));
    g_assert_false(fr_expr_is_constant(expr, &value));
    fr_expr_unref(expr);
}

static void test_bad_variable(void) {
    FrVars vars = {.value = {[FR_VAR_x] = NAN}};
    FrExprFault fault = {0};
    FrExpr *expr = fr_expr_compile("x", (FrSpan){0}, NULL, NULL);
    g_assert_cmpfloat(fr_expr_eval(expr, &vars, &fault), ==, 0);
    g_assert_cmpstr(fault.code, ==, "not-a-number");
    // The first fault stays.
    fault.code = "overflow";
    fr_expr_eval(expr, &vars, &fault);
    g_assert_cmpstr(fault.code, ==, "overflow");
    fr_expr_unref(expr);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/expr/language/F3 F4 every example of the page is right", test_page);
    g_test_add_func("/expr/language/F4 every variable is found and told", test_every_variable);
    g_test_add_func("/expr/language/operands may be computed constant or variable",
                    test_operand_forms);
    g_test_add_func("/expr/language/errors and faults have their place", test_places);
    g_test_add_func("/expr/language/several wrong names are reported at once", test_many_errors);
    g_test_add_func("/expr/language/slips of the finger get a suggestion", test_suggestions);
    g_test_add_func("/expr/language/constants are known as such", test_constant);
    g_test_add_func("/expr/language/extra variables come first", test_extra);
    g_test_add_func("/expr/language/a variable without a value gives zero", test_bad_variable);
    return g_test_run();
}
