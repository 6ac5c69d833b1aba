// Random draws of expressions.
#include "frond/number.h"

#include <math.h>

static double eval(const char *text, FrKey key, uint32_t purpose) {
    FrVars vars = {.key = key, .purpose = purpose};
    FrExpr *expr = fr_expr_compile(text, (FrSpan){0}, NULL, NULL);
    g_assert_nonnull(expr);
    double value = fr_expr_eval(expr, &vars, NULL);
    fr_expr_unref(expr);
    return value;
}

static void test_keyed(void) {
    g_assert_cmpfloat(eval("rand()", 1, 2), ==, eval("rand()", 1, 2));
    g_assert_cmpfloat(eval("rand()", 1, 2), !=, eval("rand()", 1, 3));
    g_assert_cmpfloat(eval("rand()", 1, 2), !=, eval("rand()", 2, 2));
    g_assert_cmpfloat(eval("rand()", 1, 2), ==, fr_random(1, 2, 0));
    g_assert_cmpfloat(eval("gauss()", 1, 2), ==, fr_random_normal(1, 2, 0));
}

static void test_each_its_own(void) {
    g_assert_cmpfloat(eval("rand() - rand()", 5, 1), !=, 0);
    g_assert_cmpfloat(eval("rand(1) - rand(2)", 5, 1), !=, 0);
    g_assert_cmpfloat(eval("rand(1) - rand(1.9)", 5, 1), ==, 0);
    g_assert_cmpfloat(eval("gauss(4) - gauss(4)", 5, 1), ==, 0);
    g_assert_cmpfloat(eval("rand(-1) - rand(1e300)", 5, 1), !=, 0);
}

// Correlation and mean of 20 000 pairs; each bound is over four standard errors.
static void test_independent(void) {
    static const char *const pairs[][2] = {
        {"rand()", "0*rand() + rand()"},
        {"rand()", "rand(0)"},
        {"rand(0)", "rand(1)"},
        {"rand(1)", "gauss(1)"},
    };
    const uint32_t count = 20000;
    for (size_t p = 0; p < G_N_ELEMENTS(pairs); p++) {
        FrExpr *a = fr_expr_compile(pairs[p][0], (FrSpan){0}, NULL, NULL);
        FrExpr *b = fr_expr_compile(pairs[p][1], (FrSpan){0}, NULL, NULL);
        double sum = 0, mean = 0;
        for (uint32_t k = 0; k < count; k++) {
            FrVars vars = {.key = fr_key_child(3, k), .purpose = 9};
            double u = fr_expr_eval(a, &vars, NULL);
            sum += (u - 0.5) * fr_expr_eval(b, &vars, NULL);
            mean += u;
        }
        g_assert_cmpfloat(fabs(mean / count - 0.5), <, 0.01);
        g_assert_cmpfloat(fabs(sum / count), <, 0.01);
        fr_expr_unref(a);
        fr_expr_unref(b);
    }
}

static void test_normal(void) {
    FrExpr *expr = fr_expr_compile("gauss()", (FrSpan){0}, NULL, NULL);
    double sum = 0, squares = 0;
    const uint32_t count = 20000;
    for (uint32_t k = 0; k < count; k++) {
        FrVars vars = {.key = fr_key_child(4, k)};
        double value = fr_expr_eval(expr, &vars, NULL);
        sum += value;
        squares += value * value;
    }
    g_assert_cmpfloat(fabs(sum / count), <, 0.03);
    g_assert_cmpfloat_with_epsilon(squares / count, 1, 0.05);
    fr_expr_unref(expr);
}

// The variance of a number and rand() in its function do not move together.
static void test_variance_apart(void) {
    FrNumber number = {0};
    g_assert_cmpint(
        fr_number_parse(&number, "0..1 ~ 1 : rand()", (FrSpan){0}, 1, -9, 9, NULL, NULL), ==,
        FR_OK);
    double sum = 0;
    const uint32_t count = 20000;
    for (uint32_t k = 0; k < count; k++) {
        FrVars vars = {.key = fr_key_child(4, k)};
        double part = fr_random(vars.key, 6, 0);
        sum += (part - 0.5) * (fr_number_eval(&number, &vars, 6, NULL) - part);
    }
    g_assert_cmpfloat(fabs(sum / count), <, 0.01);
    fr_number_clear(&number);
}

static void test_in_functions(void) {
    FrScope *scope = fr_scope_new();
    fr_scope_add_function(scope, "twice", "a", "a + a", (FrSpan){0}, NULL);
    fr_scope_add_function(scope, "draw", "", "rand()", (FrSpan){0}, NULL);
    FrVars vars = {.key = 8};
    // An argument is drawn once, a body at each call.
    FrExpr *once = fr_expr_compile("twice(rand()) / 2", (FrSpan){0}, scope, NULL);
    g_assert_cmpfloat(fr_expr_eval(once, &vars, NULL), ==, fr_random(8, 0, 0));
    FrExpr *calls = fr_expr_compile("draw() - draw()", (FrSpan){0}, scope, NULL);
    g_assert_cmpfloat(fr_expr_eval(calls, &vars, NULL), !=, 0);
    fr_expr_unref(once);
    fr_expr_unref(calls);
    fr_scope_free(scope);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/expr/random/draws depend on key and purpose only", test_keyed);
    g_test_add_func("/expr/random/each rand in an expression is its own", test_each_its_own);
    g_test_add_func("/expr/random/draws are independent of each other", test_independent);
    g_test_add_func("/expr/random/gauss is normal", test_normal);
    g_test_add_func("/expr/random/variance and rand are independent", test_variance_apart);
    g_test_add_func("/expr/random/functions draw an argument once", test_in_functions);
    return g_test_run();
}
