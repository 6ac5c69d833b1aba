// Parameter tables, with one row of every kind.
#include "frond/param.h"

#include <math.h>
#include <string.h>

#define SAMPLE_PARAMS(X)                                                                           \
    X(NUMBER, branching_angle, "80..30", -180, 180, "deg", "", "angle to the stem")                \
    X(REAL, opening_angle, "45", 0, 90, "deg", "", "an angle")                                     \
    X(REAL, length, "1.5", 0, 100, "m", "", "a length")                                            \
    X(INTEGER, count, "12", 0, 1e16, "", "", "how many")                                           \
    X(SWITCH, closed, "yes", 0, 0, "", "", "whether")                                              \
    X(CHOICE, mode, "second", 0, 0, "", "first second third-one", "which")                         \
    X(TEXT, label, "", 0, 0, "", "", "a name")                                                     \
    X(CURVE, profile, "dome", 0, 0, "", "", "a curve")                                             \
    X(POINTS, outline, "0,0 1,0.5", 0, 0, "", "", "points")                                        \
    X(VECTOR, up, "0, 0, 1", -10, 10, "", "", "a direction")                                       \
    X(VECTOR, turn, "90", -360, 360, "deg", "", "angles")                                          \
    X(COLOUR, colour, "#ff8000", 0, 0, "", "", "a colour")

typedef struct Sample {
    SAMPLE_PARAMS(FR_PARAM_FIELD)
} Sample;

#define FR_PARAM_STRUCT Sample
static const FrParam rows[] = {SAMPLE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable table = {
    .element = "sample",
    .meaning = "one of each kind",
    .rows = rows,
    .count = G_N_ELEMENTS(rows),
    .struct_size = sizeof(Sample),
};

static void test_defaults(void) {
    Sample sample;
    fr_params_init(&table, &sample);
    g_assert_cmpfloat(sample.branching_angle.from, ==, 80);
    g_assert_cmpfloat_with_epsilon(sample.opening_angle, G_PI / 4, 1e-15);
    g_assert_cmpfloat(sample.length, ==, 1.5);
    g_assert_cmpint(sample.count, ==, 12);
    g_assert_true(sample.closed);
    g_assert_cmpint(sample.mode, ==, 1);
    g_assert_null(sample.label);
    g_assert_cmpfloat(fr_curve_eval(sample.profile, 0.5), ==, 1);
    g_assert_cmpuint(sample.outline.count, ==, 2);
    g_assert_cmpfloat(sample.outline.at[1][1], ==, 0.5);
    g_assert_cmpfloat((double)sample.up.z, ==, 1);
    g_assert_cmpfloat_with_epsilon((double)sample.turn.y, G_PI_2, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)sample.colour.y, 128.0 / 255, 1e-6);
    fr_params_clear(&table, &sample);
}

static FrStatus set(Sample *sample, const char *name, const char *text, FrDiags *diags) {
    FrSpan span = {0};
    return fr_params_set(&table, sample, fr_params_find(&table, name), text, span, NULL, diags);
}

static void set_good(Sample *sample, const char *name, const char *text) {
    g_assert_cmpint(set(sample, name, text, NULL), ==, FR_OK);
}

static void test_set(void) {
    Sample sample;
    fr_params_init(&table, &sample);
    set_good(&sample, "closed", "no");
    g_assert_false(sample.closed);
    set_good(&sample, "closed", "true");
    g_assert_true(sample.closed);
    set_good(&sample, "mode", "third-one");
    g_assert_cmpint(sample.mode, ==, 2);
    set_good(&sample, "label", "oak");
    g_assert_cmpstr(sample.label, ==, "oak");
    set_good(&sample, "label", "");
    g_assert_null(sample.label);
    set_good(&sample, "count", "9007199254740993");
    g_assert_cmpint(sample.count, ==, G_GINT64_CONSTANT(9007199254740993));
    set_good(&sample, "count", "1e3");
    g_assert_cmpint(sample.count, ==, 1000);
    set_good(&sample, "up", "1 2 3");
    g_assert_cmpfloat((double)sample.up.y, ==, 2);
    set_good(&sample, "colour", "#0f8");
    g_assert_cmpfloat((double)sample.colour.x, ==, 0);
    g_assert_cmpfloat((double)sample.colour.y, ==, 1);
    g_assert_cmpfloat_with_epsilon((double)sample.colour.z, 136.0 / 255, 1e-6);
    set_good(&sample, "profile", "0,1 0.5,2 1,0");
    g_assert_cmpfloat(fr_curve_eval(sample.profile, 0.5), ==, 2);
    set_good(&sample, "profile", "");
    g_assert_null(sample.profile);
    set_good(&sample, "outline", "");
    g_assert_cmpuint(sample.outline.count, ==, 0);
    set_good(&sample, "branching-angle", "10 ~ 5");
    g_assert_cmpfloat(sample.branching_angle.variance, ==, 5);
    fr_params_clear(&table, &sample);
}

static void assert_wrong(const char *name, const char *text, const char *code, uint32_t begin,
                         uint32_t end) {
    Sample sample, before;
    fr_params_init(&table, &sample);
    memcpy(&before, &sample, sizeof sample);
    FrSource *source = fr_source_new("value", text, strlen(text));
    FrSpan span = {.source = source, .begin = 0, .end = (uint32_t)strlen(text)};
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(
        fr_params_set(&table, &sample, fr_params_find(&table, name), text, span, NULL, diags), ==,
        FR_ERR_DOCUMENT);
    const FrDiag *diag = fr_diags_get(diags, 0);
    g_assert_cmpstr(diag->code, ==, code);
    g_assert_cmpuint(diag->span.begin, ==, begin);
    g_assert_cmpuint(diag->span.end, ==, end);
    g_assert_true(memcmp(&sample, &before, sizeof sample) == 0);
    fr_diags_free(diags);
    fr_source_unref(source);
    fr_params_clear(&table, &sample);
}

static void test_wrong(void) {
    assert_wrong("branching-angle", "200", "out-of-range", 0, 3);
    assert_wrong("opening-angle", "91", "out-of-range", 0, 2);
    assert_wrong("length", "5 m", "bad-value", 2, 3);
    assert_wrong("length", "nan", "bad-value", 0, 3);
    assert_wrong("length", "", "bad-value", 0, 0);
    assert_wrong("count", "1.5", "bad-value", 0, 3);
    assert_wrong("count", "-1", "out-of-range", 0, 2);
    assert_wrong("count", "1e30", "out-of-range", 0, 4);
    assert_wrong("closed", "maybe", "bad-value", 0, 5);
    assert_wrong("mode", "secnd", "unknown-choice", 0, 5);
    assert_wrong("profile", "domes", "unknown-curve", 0, 5);
    assert_wrong("profile", "0,0 1", "bad-value", 5, 5);
    assert_wrong("profile", "0,0 1,1 0.5,0", "curve-order", 8, 13);
    assert_wrong("profile", "0,-1e308 1e-300,1e308", "curve-slope", 0, 21);
    assert_wrong("outline", "0;0", "bad-value", 1, 3);
    assert_wrong("outline", "0,0,1", "bad-value", 3, 4);
    assert_wrong("up", "1,2", "bad-value", 3, 3);
    assert_wrong("up", "1,2,3,4", "bad-value", 5, 6);
    assert_wrong("up", "1,20,3", "out-of-range", 2, 4);
    assert_wrong("colour", "red", "bad-colour", 0, 3);
    assert_wrong("colour", "#12345g", "bad-colour", 0, 7);
}

static void test_suggestions(void) {
    Sample sample;
    fr_params_init(&table, &sample);
    FrDiags *diags = fr_diags_new();
    set(&sample, "mode", "secnd", diags);
    set(&sample, "profile", "domes", diags);
    g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, "'second'"));
    g_assert_nonnull(strstr(fr_diags_get(diags, 1)->text, "'dome'"));
    char *near = fr_params_suggest(&table, "branchin-angle");
    g_assert_cmpstr(near, ==, "branching-angle");
    g_free(near);
    g_assert_null(fr_params_suggest(&table, "zzzzzz"));
    fr_diags_free(diags);
    fr_params_clear(&table, &sample);
}

static void test_names(void) {
    const FrParam *param = fr_params_find(&table, "branching-angle");
    g_assert_true(param == &rows[0]);
    g_assert_true(fr_params_find(&table, "branching_angle") == param);
    g_assert_null(fr_params_find(&table, "branching"));
    g_assert_null(fr_params_find(&table, "branching-angles"));
    char *name = fr_param_attribute(param);
    g_assert_cmpstr(name, ==, "branching-angle");
    g_free(name);
    char *choice = fr_param_choice(fr_params_find(&table, "mode"), 2);
    g_assert_cmpstr(choice, ==, "third-one");
    g_free(choice);
}

static void test_copy(void) {
    Sample sample, copy;
    fr_params_init(&table, &sample);
    set_good(&sample, "label", "oak");
    set_good(&sample, "branching-angle", "0..10 : t*t");
    fr_params_copy(&table, &copy, &sample);
    fr_params_clear(&table, &sample);
    g_assert_cmpstr(copy.label, ==, "oak");
    g_assert_cmpfloat(copy.outline.at[1][0], ==, 1);
    g_assert_cmpfloat(fr_curve_eval(copy.profile, 0.5), ==, 1);
    g_assert_cmpstr(fr_expr_text(copy.branching_angle.function), ==, "t*t");
    fr_params_clear(&table, &copy);
}

static void test_scope(void) {
    FrScope *scope = fr_scope_new();
    const double points[][2] = {{0, 5}, {1, 7}};
    FrCurve *curve = fr_curve_new(FR_CURVE_LINEAR, points, 2);
    fr_scope_add_curve(scope, "crown", curve);
    Sample sample;
    fr_params_init(&table, &sample);
    FrStatus status = fr_params_set(&table, &sample, fr_params_find(&table, "profile"), "crown",
                                    (FrSpan){0}, scope, NULL);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_true(sample.profile == curve);
    fr_params_clear(&table, &sample);
    fr_curve_unref(curve);
    fr_scope_free(scope);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/expr/param/defaults come from the rows in SI units", test_defaults);
    g_test_add_func("/expr/param/every kind is set from its text", test_set);
    g_test_add_func("/expr/param/wrong text has its place and changes nothing", test_wrong);
    g_test_add_func("/expr/param/near names are suggested", test_suggestions);
    g_test_add_func("/expr/param/hyphen and underscore are one in names", test_names);
    g_test_add_func("/expr/param/a copy owns what it points to", test_copy);
    g_test_add_func("/expr/param/curves of the scope are found", test_scope);
    return g_test_run();
}
