// Functions and curves that a document defines.
#include "frond/expr.h"

#include <string.h>

static FrStatus add(FrScope *scope, const char *name, const char *parameters, const char *body,
                    const char *expected_code) {
    FrDiags *diags = fr_diags_new();
    FrStatus status = fr_scope_add_function(scope, name, parameters, body, (FrSpan){0}, diags);
    g_assert_cmpint(status == FR_OK, ==, fr_diags_error_count(diags) == 0);
    if (expected_code != NULL) {
        g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, expected_code);
    }
    fr_diags_free(diags);
    return status;
}

static double eval(const FrScope *scope, const char *text) {
    FrVars vars = {.value = {[FR_VAR_i] = 3, [FR_VAR_t] = 0.5}};
    FrExpr *expr = fr_expr_compile(text, (FrSpan){0}, scope, NULL);
    g_assert_nonnull(expr);
    double value = fr_expr_eval(expr, &vars, NULL);
    fr_expr_unref(expr);
    return value;
}

static void test_functions(void) {
    FrScope *scope = fr_scope_new();
    add(scope, "area", "a, b", "a*b", NULL);
    add(scope, "volume", "a b c", "area(a, b)*c", NULL);
    add(scope, "second", "a b", "b", NULL);
    add(scope, "one", "a", "1", NULL);
    g_assert_cmpfloat(eval(scope, "volume(2, i, i+1)"), ==, 24);
    // Computed arguments that the body ignores or only passes on leave nothing on the stack.
    g_assert_cmpfloat(eval(scope, "1 + second(i*t, i+t)*2"), ==, 8);
    g_assert_cmpfloat(eval(scope, "10 - one(i*t)"), ==, 9);
    g_assert_cmpfloat(eval(scope, "second(second(i*t, i+1), second(i*2, i*4)) - (i*t)"), ==, 10.5);
    g_assert_cmpfloat(eval(scope, "volume(i*t, i+t, volume(i-t, t+1, i/t))"), ==,
                      1.5 * 3.5 * (2.5 * 1.5 * 6));
    fr_scope_free(scope);
}

static void test_parameters_hide(void) {
    FrScope *scope = fr_scope_new();
    add(scope, "f", "t", "t*10", NULL);
    g_assert_cmpfloat(eval(scope, "f(i) + t"), ==, 30.5);
    fr_scope_free(scope);
}

static void test_no_recursion(void) {
    FrScope *scope = fr_scope_new();
    g_assert_cmpint(add(scope, "f", "a", "f(a - 1)", "unknown-function"), ==, FR_ERR_DOCUMENT);
    g_assert_cmpint(add(scope, "f", "a", "g(a)", "unknown-function"), ==, FR_ERR_DOCUMENT);
    fr_scope_free(scope);
}

static void test_refused(void) {
    FrScope *scope = fr_scope_new();
    FrCurve *curve = fr_curve_builtin("ramp");
    g_assert_true(fr_scope_add_curve(scope, "crown", curve));
    g_assert_false(fr_scope_add_curve(scope, "crown", curve));
    g_assert_false(fr_scope_add_curve(scope, "sin", curve));
    add(scope, "crown", "a", "a", "name-taken");
    add(scope, "sin", "a", "a", "name-taken");
    add(scope, "a b", "a", "a", "bad-name");
    add(scope, "", "a", "a", "bad-name");
    add(scope, "f", "a a", "a", "duplicate-parameter");
    add(scope, "f", "a-b", "a", "bad-name");
    add(scope, "f", "a b c d e f g h i j k l m n o p q", "1", "argument-count");
    add(scope, "f", "a", "a +", "syntax");
    // Nothing of that is left.
    add(scope, "f", "a", "a + 1", NULL);
    g_assert_false(fr_scope_add_curve(scope, "f", curve));
    fr_curve_unref(curve);
    fr_scope_free(scope);
}

static void test_curves(void) {
    FrScope *scope = fr_scope_new();
    const double points[][2] = {{0, 5}, {1, 7}};
    FrCurve *curve = fr_curve_new(FR_CURVE_LINEAR, points, 2);
    fr_scope_add_curve(scope, "my-curve", curve);
    fr_scope_add_curve(scope, "bell", curve);
    fr_curve_unref(curve);
    g_assert_cmpfloat(eval(scope, "my_curve(t)"), ==, 6);
    g_assert_cmpfloat(eval(scope, "curve('my-curve', 1)"), ==, 7);
    // A curve of the document goes before a built-in one.
    g_assert_cmpfloat(eval(scope, "bell(0)"), ==, 5);
    g_assert_cmpfloat(eval(scope, "dome(0.5)"), ==, 1);
    g_assert_null(fr_scope_curve(scope, "nothing"));
    fr_scope_free(scope);
}

// Expressions keep what they need of a scope that is gone.
static void test_outlives(void) {
    FrScope *scope = fr_scope_new();
    const double points[][2] = {{0, 5}, {1, 7}};
    FrCurve *curve = fr_curve_new(FR_CURVE_LINEAR, points, 2);
    fr_scope_add_curve(scope, "crown", curve);
    fr_curve_unref(curve);
    const char *body = "1/(a - 3) + crown(t)";
    FrSource *source = fr_source_new("functions", body, strlen(body));
    FrSpan span = {.source = source, .begin = 0, .end = (uint32_t)strlen(body)};
    fr_scope_add_function(scope, "f", "a", body, span, NULL);
    FrExpr *expr = fr_expr_compile("f(i)", (FrSpan){0}, scope, NULL);
    fr_scope_free(scope);
    fr_source_unref(source);
    FrVars vars = {.value = {[FR_VAR_i] = 3, [FR_VAR_t] = 0.5}};
    FrExprFault fault = {0};
    g_assert_cmpfloat(fr_expr_eval(expr, &vars, &fault), ==, 6);
    // The fault is where the function's body divides.
    g_assert_cmpstr(fr_source_name(fault.span.source), ==, "functions");
    g_assert_cmpuint(fault.span.begin, ==, 0);
    g_assert_cmpuint(fault.span.end, ==, 9);
    fr_expr_unref(expr);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/expr/scope/functions call earlier ones", test_functions);
    g_test_add_func("/expr/scope/parameters hide variables", test_parameters_hide);
    g_test_add_func("/expr/scope/a function cannot call itself", test_no_recursion);
    g_test_add_func("/expr/scope/bad and taken names are refused", test_refused);
    g_test_add_func("/expr/scope/curves are called by name", test_curves);
    g_test_add_func("/expr/scope/expressions outlive their scope", test_outlives);
    return g_test_run();
}
