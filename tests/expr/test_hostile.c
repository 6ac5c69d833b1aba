// Texts meant to crash, hang or fill memory.
#include "frond/number.h"

#include <math.h>
#include <string.h>

static char *repeat(const char *piece, size_t count) {
    GString *text = g_string_new(NULL);
    for (size_t i = 0; i < count; i++) {
        g_string_append(text, piece);
    }
    return g_string_free(text, FALSE);
}

// Wrong in any case, and soon found so.
static void refuse(char *text, const char *code) {
    FrDiags *diags = fr_diags_new();
    gint64 start = g_get_monotonic_time();
    g_assert_null(fr_expr_compile(text, (FrSpan){0}, NULL, diags));
    // Sanitizers take time of their own.
    bool is_measured = g_getenv("FROND_SANITIZED") == NULL;
    g_assert_true(!is_measured || g_get_monotonic_time() - start < 1000000);
    g_assert_cmpuint(fr_diags_error_count(diags), >, 0);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, code);
    fr_diags_free(diags);
    g_free(text);
}

static void test_nesting(void) {
    refuse(repeat("(", 60000), "expression-nesting");
    refuse(repeat("-", 60000), "expression-nesting");
    refuse(repeat("!", 60000), "expression-nesting");
    refuse(repeat("+", 60000), "expression-nesting");
    refuse(repeat("2^", 30000), "expression-nesting");
    refuse(repeat("1?", 30000), "expression-nesting");
    refuse(repeat("1?1:", 16000), "expression-nesting");
    refuse(repeat("sin(", 16000), "expression-nesting");
    refuse(repeat("t(", 16000), "expression-nesting");
    refuse(repeat("1+", 30000), "expression-nesting");
    refuse(repeat("i*", 30000), "expression-nesting");
    refuse(repeat("1&&", 20000), "expression-nesting");
    refuse(repeat("(", 1000000), "expression-size");
}

// The manual promises 200 levels, of parentheses as of signs.
static void test_deepest(void) {
    static const struct {
        const char *opens, *closes;
    } cases[] = {{"(", ")"}, {"-", ""}, {"abs(", ")"}};
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        char *opens = repeat(cases[k].opens, 200);
        char *closes = repeat(cases[k].closes, 200);
        char *text = g_strdup_printf("%s1%s", opens, closes);
        FrExpr *expr = fr_expr_compile(text, (FrSpan){0}, NULL, NULL);
        g_assert_nonnull(expr);
        fr_expr_unref(expr);
        refuse(g_strdup_printf("%s%s%s", cases[k].opens, text, cases[k].closes),
               "expression-nesting");
        g_free(text);
        g_free(closes);
        g_free(opens);
    }
}

static void test_long(void) {
    char *digits = repeat("1", 60000);
    refuse(digits, "number-too-large");
    char *inner = repeat("1,", 30000);
    refuse(g_strdup_printf("min(%s1)", inner), "argument-count");
    g_free(inner);
    // Many wrong names are not all looked up.
    refuse(repeat("nothing+", 8000), "unknown-name");
    refuse(repeat("name", 16000), "unknown-name");
    refuse(repeat("curve('", 9000), "unknown-curve");
    refuse(g_strdup("curve('bell, t)"), "syntax");
    // Long and right.
    char *spaces = repeat(" ", 60000);
    char *text = g_strdup_printf("%s7%s", spaces, "");
    FrExpr *expr = fr_expr_compile(text, (FrSpan){0}, NULL, NULL);
    g_assert_nonnull(expr);
    fr_expr_unref(expr);
    g_free(text);
    g_free(spaces);
}

// f1 calls f0 twice, f2 calls f1 twice, … 2^64 calls in all.
static void try_doubling(const char *first, const char *step) {
    FrScope *scope = fr_scope_new();
    FrDiags *diags = fr_diags_new();
    fr_scope_add_function(scope, "f0", "a", first, (FrSpan){0}, NULL);
    for (int i = 1; i <= 64; i++) {
        char *name = g_strdup_printf("f%d", i);
        char *body = g_strdup_printf(step, i - 1, i - 1);
        g_assert_cmpint(fr_scope_add_function(scope, name, "a", body, (FrSpan){0}, NULL), ==,
                        FR_OK);
        g_free(name);
        g_free(body);
    }
    g_assert_null(fr_expr_compile("f64(t)", (FrSpan){0}, scope, diags));
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "expression-size");
    FrExpr *small = fr_expr_compile("f9(t)", (FrSpan){0}, scope, NULL);
    g_assert_nonnull(small);
    fr_expr_unref(small);
    fr_diags_free(diags);
    fr_scope_free(scope);
}

static void test_exponential(void) {
    try_doubling("a + 1", "f%d(a) + f%d(a + 1)");
    try_doubling("a", "f%d(f%d(a))");
    try_doubling("1", "f%d(f%d(1))");
}

static void test_chain(void) {
    FrScope *scope = fr_scope_new();
    FrDiags *diags = fr_diags_new();
    fr_scope_add_function(scope, "f0", "a", "a", (FrSpan){0}, NULL);
    for (int i = 1; i <= 5000; i++) {
        char *name = g_strdup_printf("f%d", i);
        char *body = g_strdup_printf("f%d(a + 1)", i - 1);
        fr_scope_add_function(scope, name, "a", body, (FrSpan){0}, NULL);
        g_free(name);
        g_free(body);
    }
    g_assert_null(fr_expr_compile("f5000(t)", (FrSpan){0}, scope, diags));
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "expression-nesting");
    FrExpr *expr = fr_expr_compile("f100(t)", (FrSpan){0}, scope, NULL);
    FrVars vars = {0};
    g_assert_cmpfloat(fr_expr_eval(expr, &vars, NULL), ==, 100);
    fr_expr_unref(expr);
    fr_diags_free(diags);
    fr_scope_free(scope);
}

// Any bytes: an expression with finite values, or an error. Never neither.
static void test_bytes(void) {
    static const char *const pieces[] = {
        "t",  "i",    "rand()", "gauss(", "1e308", "0",   ".",  "..", "+", "-",  "*",
        "/",  "%",    "^",      "(",      ")",     ",",   "?",  ":",  "<", "==", "!",
        "&&", "||",   "min(",   "log(",   "'",     "\"",  "=",  "~",  "e", "1e", "\xff",
        "é",  "bell", "curve(", "pow(",   "mod(",  "1/0", "-1", " ",  "s", "2",
    };
    for (uint32_t k = 0; k < 20000; k++) {
        GString *text = g_string_new(NULL);
        uint32_t length = 1 + (uint32_t)(fr_random(1, 1, k) * 12);
        for (uint32_t i = 0; i < length; i++) {
            double pick = fr_random(k, 2, i) * (double)G_N_ELEMENTS(pieces);
            g_string_append(text, pieces[(size_t)pick]);
        }
        FrDiags *diags = fr_diags_new();
        FrVars vars = {.value = {0.5, 3, 1e300, -1e300}, .key = k};
        FrExpr *expr = fr_expr_compile(text->str, (FrSpan){0}, NULL, diags);
        g_assert_true((expr == NULL) == (fr_diags_error_count(diags) > 0));
        g_assert_true(expr == NULL || isfinite(fr_expr_eval(expr, &vars, NULL)));
        FrNumber number = fr_number_constant(1, 1);
        size_t errors = fr_diags_error_count(diags);
        FrStatus status = fr_number_parse(&number, text->str, (FrSpan){0}, 1, -10, 10, NULL, diags);
        g_assert_true((status == FR_OK) == (fr_diags_error_count(diags) == errors));
        double value = fr_number_eval(&number, &vars, 1, NULL);
        g_assert_true(value >= -10 && value <= 10);
        fr_number_clear(&number);
        fr_expr_unref(expr);
        fr_diags_free(diags);
        g_string_free(text, TRUE);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/expr/hostile/deep nesting is refused", test_nesting);
    g_test_add_func("/expr/hostile/200 levels are allowed and not one more", test_deepest);
    g_test_add_func("/expr/hostile/long texts are refused or read in time", test_long);
    g_test_add_func("/expr/hostile/functions cannot grow without bound", test_exponential);
    g_test_add_func("/expr/hostile/long chains of functions are refused", test_chain);
    g_test_add_func("/expr/hostile/any pieces give a finite value or an error", test_bytes);
    return g_test_run();
}
