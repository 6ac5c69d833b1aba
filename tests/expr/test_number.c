// Numbers that vary.
#include "frond/number.h"

#include <locale.h>
#include <math.h>
#include <string.h>

static const double degrees = G_PI / 180;

static FrNumber parse(const char *text, double scale, double min, double max) {
    FrNumber number = {0};
    FrDiags *diags = fr_diags_new();
    if (fr_number_parse(&number, text, (FrSpan){0}, scale, min, max, NULL, diags) != FR_OK) {
        g_error("%s: %s", text, fr_diags_get(diags, 0)->text);
    }
    fr_diags_free(diags);
    return number;
}

static double at(const FrNumber *number, double t, FrKey key) {
    FrVars vars = {.value = {[FR_VAR_t] = t, [FR_VAR_i] = 3}, .key = key};
    return fr_number_eval(number, &vars, 5, NULL);
}

static void test_forms(void) {
    static const struct {
        const char *text;
        double from, to, variance;
        const char *function;
    } forms[] = {
        {"45", 45, 45, 0, NULL},
        {" 45 ", 45, 45, 0, NULL},
        {"80..30", 80, 30, 0, NULL},
        {"80.5..30.25", 80.5, 30.25, 0, NULL},
        {"80 .. 30", 80, 30, 0, NULL},
        {"80...5", 80, 0.5, 0, NULL},
        {"-1..+1", -1, 1, 0, NULL},
        {"1e1..2.5e-1", 10, 0.25, 0, NULL},
        {"45 ~ 5", 45, 45, 5, NULL},
        {"45~5", 45, 45, 5, NULL},
        {"80..30 ~ 5 : t^2", 80, 30, 5, "t^2"},
        {"80..30:bell ", 80, 30, 0, "bell"},
        {"80..30 : t > 0.5 ? 1 : 0", 80, 30, 0, "t > 0.5 ? 1 : 0"},
        {"= 3 + 2*i", 0, 1, 0, "3 + 2*i"},
        {"=i", 0, 1, 0, "i"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(forms); i++) {
        FrNumber number = {0};
        fr_number_parse(&number, forms[i].text, (FrSpan){0}, 1, -1000, 1000, NULL, NULL);
        g_assert_cmpfloat(number.from, ==, forms[i].from);
        g_assert_cmpfloat(number.to, ==, forms[i].to);
        g_assert_cmpfloat(number.variance, ==, forms[i].variance);
        g_assert_cmpstr(number.function != NULL ? fr_expr_text(number.function) : NULL, ==,
                        forms[i].function);
        fr_number_clear(&number);
    }
}

static void test_interval(void) {
    FrNumber number = parse("80..30", degrees, -90, 90);
    g_assert_false(number.is_constant);
    g_assert_cmpfloat_with_epsilon(at(&number, 0, 1), 80 * degrees, 1e-15);
    g_assert_cmpfloat_with_epsilon(at(&number, 0.5, 1), 55 * degrees, 1e-15);
    g_assert_cmpfloat_with_epsilon(at(&number, 1, 1), 30 * degrees, 1e-15);
    fr_number_clear(&number);
    number = parse("80..30 : t^2", 1, -90, 90);
    g_assert_cmpfloat(at(&number, 0.5, 1), ==, 67.5);
    fr_number_clear(&number);
}

static void test_v(void) {
    // v is the value before the function, in the document's unit.
    FrNumber number = parse("10..20 : (v^2 - 10)/10", degrees, -1000, 1000);
    double v = 15;
    g_assert_cmpfloat_with_epsilon(at(&number, 0.5, 1), (10 + (v * v - 10)) * degrees, 1e-12);
    fr_number_clear(&number);
}

static void test_variance(void) {
    FrNumber number = parse("45 ~ 5", 1, 0, 90);
    g_assert_false(number.is_constant);
    double least = 90, most = 0, sum = 0;
    for (uint32_t k = 0; k < 4000; k++) {
        double value = at(&number, 0, fr_key_child(1, k));
        least = fmin(least, value);
        most = fmax(most, value);
        sum += value;
    }
    g_assert_cmpfloat(least, >=, 40);
    g_assert_cmpfloat(least, <, 40.1);
    g_assert_cmpfloat(most, <, 50);
    g_assert_cmpfloat(most, >, 49.9);
    g_assert_cmpfloat_with_epsilon(sum / 4000, 45, 0.2);
    // The same place, the same value, whatever t is.
    g_assert_cmpfloat(at(&number, 0, 9), ==, at(&number, 1, 9));
    fr_number_clear(&number);
}

static void test_clamped(void) {
    FrNumber number = parse("= 1000*t - 500", degrees, 0, 90);
    g_assert_cmpfloat(at(&number, 0, 1), ==, 0);
    g_assert_cmpfloat(at(&number, 1, 1), ==, 90 * degrees);
    fr_number_clear(&number);
    number = parse("89..90 ~ 50", 1, 0, 90);
    for (uint32_t k = 0; k < 100; k++) {
        g_assert_cmpfloat(at(&number, 0.5, k), <=, 90);
    }
    fr_number_clear(&number);
    number = parse("-1.7e308..1.7e308 : 5*t", 1, -INFINITY, INFINITY);
    g_assert_true(isfinite(at(&number, 1, 1)));
    fr_number_clear(&number);
}

static void test_constant(void) {
    static const struct {
        const char *text;
        double value; // NAN: varies
    } texts[] = {
        {"45", 45},        {"45..45", 45},     {"= 2*pi", 2 * G_PI}, {"10..20 : 0.5", 15},
        {"45 : t", 45},    {"45..46", NAN},    {"45 ~ 1", NAN},      {"= i", NAN},
        {"= rand()", NAN}, {"10..20 : 0", 10}, {"45 ~ 0", 45},       {"= 99", 90},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        FrNumber number = parse(texts[i].text, degrees, 0, 90);
        g_assert_cmpint(number.is_constant, ==, !isnan(texts[i].value));
        if (number.is_constant) {
            g_assert_cmpfloat_with_epsilon(at(&number, 0.3, 1), texts[i].value * degrees, 1e-15);
        }
        fr_number_clear(&number);
    }
}

static void assert_wrong(const char *text, const char *code, uint32_t begin, uint32_t end) {
    FrSource *source = fr_source_new("number", text, strlen(text));
    FrSpan span = {.source = source, .begin = 0, .end = (uint32_t)strlen(text)};
    FrDiags *diags = fr_diags_new();
    FrNumber number = fr_number_constant(7, 1);
    g_assert_cmpint(fr_number_parse(&number, text, span, 1, 0, 90, NULL, diags), ==,
                    FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_count(diags), ==, 1);
    const FrDiag *diag = fr_diags_get(diags, 0);
    g_assert_cmpstr(diag->code, ==, code);
    g_assert_cmpuint(diag->span.begin, ==, begin);
    g_assert_cmpuint(diag->span.end, ==, end);
    // The number is as it was.
    g_assert_cmpfloat(number.constant, ==, 7);
    fr_diags_free(diags);
    fr_source_unref(source);
}

static void test_wrong(void) {
    assert_wrong("", "bad-number", 0, 0);
    assert_wrong("abc", "bad-number", 0, 3);
    assert_wrong("45 deg", "bad-number", 3, 6);
    assert_wrong("45..", "bad-number", 4, 4);
    assert_wrong("45..x", "bad-number", 4, 5);
    assert_wrong("0x10", "bad-number", 1, 4);
    assert_wrong("nan", "bad-number", 0, 3);
    assert_wrong("inf", "bad-number", 0, 3);
    assert_wrong("--5", "bad-number", 0, 3);
    assert_wrong("4,5", "bad-number", 1, 3);
    assert_wrong("1e999", "number-too-large", 0, 5);
    assert_wrong("120", "out-of-range", 0, 3);
    assert_wrong("10..-5", "out-of-range", 4, 6);
    assert_wrong("10 ~ -5", "out-of-range", 5, 7);
    assert_wrong("10 ~", "bad-number", 4, 4);
    assert_wrong("10..20 : tt", "unknown-name", 9, 11);
    assert_wrong("10..20 : ", "syntax", 9, 9);
    assert_wrong("= 1 +", "syntax", 5, 5);
}

static void test_warnings(void) {
    static const char *const texts[][2] = {
        {"45 : t^2", "function-without-effect"},
        {"= 1/0", "division-by-zero"},
        {"10..20 : log(-1)", "not-a-number"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        FrNumber number = {0};
        FrDiags *diags = fr_diags_new();
        g_assert_cmpint(fr_number_parse(&number, texts[i][0], (FrSpan){0}, 1, 0, 90, NULL, diags),
                        ==, FR_OK);
        g_assert_cmpuint(fr_diags_count(diags), ==, 1);
        g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, texts[i][1]);
        g_assert_cmpint(fr_diags_get(diags, 0)->severity, ==, FR_WARNING);
        fr_diags_free(diags);
        fr_number_clear(&number);
    }
}

static void test_fault(void) {
    FrNumber number = parse("10..20 : 1/(i - 3)", 1, 0, 90);
    FrVars vars = {.value = {[FR_VAR_i] = 3}};
    FrExprFault fault = {0};
    g_assert_cmpfloat(fr_number_eval(&number, &vars, 1, &fault), ==, 10);
    g_assert_cmpstr(fault.code, ==, "division-by-zero");
    fr_number_clear(&number);
}

static void test_copy(void) {
    FrNumber number = parse("1..3 : t*t", 1, 0, 90);
    FrNumber copy = fr_number_copy(&number);
    fr_number_clear(&number);
    g_assert_cmpfloat(at(&copy, 0.5, 1), ==, 1.5);
    fr_number_clear(&copy);
    FrNumber constant = fr_number_constant(90, degrees);
    g_assert_cmpfloat(at(&constant, 0.5, 1), ==, 90 * degrees);
}

static double over(const FrNumber *number, FrVar var, double value) {
    FrVars vars = {.value = {[FR_VAR_t] = 0.5}};
    vars.value[var] = value;
    return fr_number_eval(number, &vars, 5, NULL);
}

static void test_curves(void) {
    FrNumber number = parse("10..20 | parent 0,1 1,3 | depth 0,1 2,0.5 | season fall", 1, 0, 90);
    g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_x, 0), 15, 1e-12);
    g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_x, 0.5), 30, 1e-12);
    g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_depth, 1), 11.25, 1e-12);
    g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_depth, 9), 7.5, 1e-12);
    g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_season, 1), 0, 1e-12);
    // Held within the hard range after all.
    g_assert_cmpfloat(over(&number, FR_VAR_t, 20), ==, 90);
    g_assert_true(fr_number_uses(&number, FR_VAR_depth) && fr_number_uses(&number, FR_VAR_t));
    g_assert_false(fr_number_uses(&number, FR_VAR_age));
    FrNumber copy = fr_number_copy(&number);
    fr_number_clear(&number);
    g_assert_cmpfloat_with_epsilon(over(&copy, FR_VAR_x, 0.5), 30, 1e-12);
    fr_number_clear(&copy);
    // One value with a curve is no constant, and a curve of 1 changes no bit.
    number = parse("45 | parent flat", degrees, 0, 90);
    g_assert_false(number.is_constant);
    g_assert_cmpfloat(over(&number, FR_VAR_x, 0.3), ==, 45 * degrees);
    fr_number_clear(&number);
}

static void test_chance_and_curves(void) {
    // Chance is not made smaller by the parent's curve but by one along itself.
    FrNumber parent = parse("40 ~ 5 | parent 0,1 1,0.5", 1, 0, 90);
    FrNumber self = parse("40 ~ 5 | self 0,1 1,0.5", 1, 0, 90);
    double chance = over(&parent, FR_VAR_x, 0) - 40;
    g_assert_cmpfloat(fabs(chance), >, 0.01);
    g_assert_cmpfloat_with_epsilon(over(&parent, FR_VAR_x, 1), 20 + chance, 1e-12);
    g_assert_cmpfloat_with_epsilon(over(&self, FR_VAR_s, 1), 0.5 * (40 + chance), 1e-12);
    fr_number_clear(&parent);
    fr_number_clear(&self);
}

static void test_keys(void) {
    FrNumber number = parse("keys 0,10 5,80 6,80 ~ 0 | depth 0,1 1,0.5", 1, 0, 90);
    static const double frames[][2] = {{-1, 10}, {0, 10}, {5, 80}, {5.5, 80}, {99, 80}};
    for (size_t k = 0; k < G_N_ELEMENTS(frames); k++) {
        g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_age, frames[k][0]), frames[k][1],
                                       1e-12);
    }
    g_assert_cmpfloat_with_epsilon(over(&number, FR_VAR_depth, 1), 5, 1e-12);
    g_assert_true(fr_number_uses(&number, FR_VAR_age));
    fr_number_clear(&number);
}

static void test_wrong_curves(void) {
    assert_wrong("45 |", "unknown-name", 4, 4);
    assert_wrong("45 | parnt fall", "unknown-name", 5, 10);
    assert_wrong("45 | parent", "bad-number", 11, 11);
    assert_wrong("45 | parent fal", "unknown-curve", 12, 15);
    assert_wrong("45 | parent 0,1 x", "bad-value", 16, 17);
    assert_wrong("45 | parent 0,1 0,1", "curve-order", 16, 19);
    assert_wrong("45 | parent fall | ", "unknown-name", 19, 19);
    assert_wrong("45 deg | parent fall", "bad-number", 3, 6);
    assert_wrong("keys 0", "bad-value", 6, 6);
    assert_wrong("keys ~ 5", "bad-number", 5, 5);
    assert_wrong(
        "45 | x fall | x fall | x fall | x fall | x fall | x fall | x fall | x fall | x 0,1",
        "too-many-curves", 77, 78);
}

static void test_locale(void) {
    // Where such a locale is not installed this holds anyway.
    setlocale(LC_ALL, "de_DE.UTF-8");
    FrNumber number = parse("1.5..2.5 : 0.5", 1, 0, 90);
    g_assert_cmpfloat(number.constant, ==, 2);
    fr_number_clear(&number);
    setlocale(LC_ALL, "C");
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/expr/number/the text forms are read exactly", test_forms);
    g_test_add_func("/expr/number/an interval is walked by t or a function", test_interval);
    g_test_add_func("/expr/number/v is the value before the function", test_v);
    g_test_add_func("/expr/number/variance goes both ways and stays with the place", test_variance);
    g_test_add_func("/expr/number/values stay within the hard range", test_clamped);
    g_test_add_func("/expr/number/what never varies is known to be constant", test_constant);
    g_test_add_func("/expr/number/wrong text has its place and changes nothing", test_wrong);
    g_test_add_func("/expr/number/text without effect or value gets a warning", test_warnings);
    g_test_add_func("/expr/number/a fault gives the neutral value", test_fault);
    g_test_add_func("/expr/number/copies share the function", test_copy);
    g_test_add_func("/expr/number/curves over anything multiply", test_curves);
    g_test_add_func("/expr/number/chance is added after the curves", test_chance_and_curves);
    g_test_add_func("/expr/number/key frames are values at moments", test_keys);
    g_test_add_func("/expr/number/wrong curves have their places", test_wrong_curves);
    g_test_add_func("/expr/number/a decimal comma changes nothing", test_locale);
    return g_test_run();
}
