// What cpfg draws and measures, against values worked out by hand: what counts as a segment, the
// box, tropisms, generalized cylinders and functions.
#include "lsystems.h"

#include <glib/gstdio.h>
#include <math.h>

typedef struct Drawn {
    FrPlant *plant;
    FrLdrawn drawn;
} Drawn;

/// Draws an L-system of the axiom and `rest` with a view file of that text.
static Drawn draw(const char *view_text, const char *axiom, const char *rest) {
    FrContext context = fr_context_default();
    char *text = g_strdup_printf("Lsystem: 1\naxiom: %s\nX --> X\n%s\nendlsystem\n", axiom, rest);
    FrSource *source = fr_source_new("test.l", text, strlen(text));
    FrSource *view_source = fr_source_new("test.v", view_text, strlen(view_text));
    FrLview *view;
    g_assert_cmpint(fr_lview_read(view_source, NULL, &context, &view), ==, FR_OK);
    FrLoptions options = {.view = view};
    FrLsettings settings = fr_lsettings_default();
    settings.view = view;
    FrLsystem *system;
    FrLderivation *derivation;
    Drawn made;
    g_assert_cmpint(fr_lsystem_compile(source, &options, &context, &system), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_new(system, &settings, &context, &derivation), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_plant(derivation, &context, &made.plant, &made.drawn), ==,
                    FR_OK);
    g_assert_true(fr_plant_is_valid(made.plant, NULL));
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_lview_free(view);
    fr_source_unref(view_source);
    fr_source_unref(source);
    g_free(text);
    return made;
}

/// Where the last internode ends, in the plant's coordinates: the file's (x, y, z) is (x, −z, y).
static void check_tip(const char *view, const char *axiom, double x, double y, double z) {
    Drawn made = draw(view, axiom, "");
    vec3s tip = made.plant->nodes.position[made.plant->nodes.count - 1];
    g_assert_cmpfloat_with_epsilon(tip.x, (float)x, 1e-5F);
    g_assert_cmpfloat_with_epsilon(tip.y, (float)y, 1e-5F);
    g_assert_cmpfloat_with_epsilon(tip.z, (float)z, 1e-5F);
    fr_plant_free(made.plant);
}

static void check_segments(const char *view, const char *axiom, uint64_t segments, double length,
                           uint64_t cylinders) {
    Drawn made = draw(view, axiom, "");
    g_assert_cmpuint(made.drawn.segments, ==, segments);
    g_assert_cmpfloat_with_epsilon(made.drawn.length, length, 1e-4);
    g_assert_cmpuint(made.drawn.cylinders, ==, cylinders);
    fr_plant_free(made.plant);
}

// The square of the length must exceed 0.00001.
static void test_short(void) {
    check_segments("", "F(0.003)F(0.004)F(0)F", 2, 1.004, 0);
    check_segments("", "F(-1)", 1, 1, 0);
    check_segments("initial scale: 0.01\n", "F(0.2)F(1)", 1, 0.01, 0);
}

/// In the coordinates of the file, y up.
static void check_box(const char *axiom, const double min[3], const double max[3]) {
    Drawn made = draw("", axiom, "");
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(made.drawn.min[k], min[k], 1e-5);
        g_assert_cmpfloat_with_epsilon(made.drawn.max[k], max[k], 1e-5);
    }
    fr_plant_free(made.plant);
}

static void test_box(void) {
    check_box("f(2)F", (const double[]){0, 0, 0}, (const double[]){0, 3, 0});
    check_box("[+(90)f(4)]", (const double[]){-4, 0, 0}, (const double[]){0, 0, 0});
    check_box("F(3)@O(2)", (const double[]){-1, 0, -1}, (const double[]){1, 4, 1});
    check_box("!(5)F", (const double[]){0, 0, 0}, (const double[]){0, 1, 0});
}

// A symbol that '@' does not know is obeyed without it.
static void test_unknown(void) {
    check_tip("", "F@F(2)", 0, 0, 3);
    check_tip("", "F@+(90)F", -1, 0, 1);
}

// Without a bend the roll before a segment stays; a bend carries up from segment to segment.
static void test_rolls(void) {
    check_tip("", "F\\(90)F+(90)F", 0, -1, 2);
    check_tip("tropism: T: 0 -1 0 E: 0\n", "F\\(90)F+(90)F", 0, -1, 2);
}

// U = (0,0,-1) turns by 0.3 away from (1,0,0), then & leads along it; the second turn is
// 0.3 times the sine between the two, before a segment along U.
static void test_torque(void) {
    check_tip("torque: T: 1 0 0 E: 0.3\n", "F&(90)F", -sin(0.3), cos(0.3), 1);
}

// T is divided by its length, times I; the factor, not the result, is cut to 1 where I is given.
static void test_intensity(void) {
    check_tip("tropism: T: 0 -1 0 E: 0.2 I: 0.5\n", "+(90)F", -cos(0.1), 0, -sin(0.1));
    check_tip("tropism: T: 0 -1 0 E: 0.2 I: 4\n", "+(90)F", -cos(0.2), 0, -sin(0.2));
    check_tip("tropism: T: 0 -0.5 0 E: 0.2 I: 4\n", "+(90)F", -cos(0.1), 0, -sin(0.1));
    check_tip("tropism: T: 0 -0.5 0 E: 0.2\n", "+(90)F", -cos(0.2), 0, -sin(0.2));
}

// Lines draw the axis of a span in its strips, in place of the segment that is open; '@' has drawn
// it before. Within braces moves add points as '.' does; spans without length draw nothing.
static void test_lines(void) {
    check_segments("line style: pixel\n", "@Gsf(2)@Ge(3)", 3, 2, 1);
    check_segments("line style: pixel\n", "@GsF(2)@Ge(3)", 4, 4, 1);
    check_segments("line style: cylinder\n", "@GsF(2)@Ge(3)", 1, 2, 1);
    check_segments("line style: cylinder\n", "@Gsf(2)@Ge(3)", 0, 0, 1);
    check_segments("line style: pixel\n", "{(1,5).F(2)}", 5, 2, 1);
    check_segments("line style: cylinder\n", "{(1,5).F(2)}", 1, 2, 1);
    check_segments("line style: pixel\n", "{(1,5).f(2)}", 5, 2, 1);
    // Points at 0, 1, 2, 3: the one span goes from 1 to 2. Three points have none.
    check_segments("line style: pixel\n", "{(3,2).fff}", 2, 1, 1);
    check_segments("line style: pixel\n", "{(3,2).ff}", 0, 0, 0);
}

// Each branch goes on from the points around it: here two Hermite curves from (0, 1) with the
// tangents (0, 1.2) and (±1.2, 0), whose middles are at (±0.35, 1.15).
static void test_branches(void) {
    double curve = hypot(0.35, 0.15) + hypot(0.65, 0.15);
    check_segments("line style: pixel\n", "{(1,2).f[+(90)f][-(90)f]f}", 8, 2 + 2 * curve, 4);
}

// The points of a Bézier curve whose y is its x: the sample is the middle of the interval at which
// bisection comes within a thousandth.
static double ramp(double x) {
    double low = 0, high = 1, at;
    for (;;) {
        double u = (low + high) / 2, v = 1 - u;
        at = 3 * (double)0.3F * u * v * v + 3 * (double)0.7F * u * u * v + u * u * u;
        if (fabs(at - x) <= 0.001) {
            return at;
        }
        *(at > x ? &high : &low) = u;
    }
}

static char *function_value(const char *samples, const char *x) {
    char *folder = g_dir_make_tmp("frond-drawn-XXXXXX", NULL);
    char *path = g_build_filename(folder, "f.func", NULL);
    char *content = g_strdup_printf("fver 1 1\nname: ramp\n%sflip: off\npoints: 4\n0 0 1\n"
                                    "0.3 0.3 1\n0.7 0.7 1\n1 1 1\n",
                                    samples);
    g_assert_true(g_file_set_contents(path, content, -1, NULL));
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("test.v", "function set: f.func\n", 21);
    FrLview *view;
    g_assert_cmpint(fr_lview_read(source, folder, &context, &view), ==, FR_OK);
    char *text = g_strdup_printf("Lsystem: 1\naxiom: A(func(ramp,%s))\nX --> X\nendlsystem\n", x);
    FrSource *program = fr_source_new("test.l", text, strlen(text));
    FrLoptions options = {.view = view};
    FrLsettings settings = fr_lsettings_default();
    settings.view = view;
    FrLsystem *system;
    FrLderivation *derivation;
    g_assert_cmpint(fr_lsystem_compile(program, &options, &context, &system), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_new(system, &settings, &context, &derivation), ==, FR_OK);
    GString *out = g_string_new(NULL);
    fr_lstring_print(fr_lderivation_string(derivation), out);
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_lview_free(view);
    fr_source_unref(source);
    fr_source_unref(program);
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    g_free(content);
    g_free(text);
    return g_string_free(out, FALSE);
}

static void check_function(const char *samples, const char *x, double expected) {
    char *got = function_value(samples, x);
    char *wanted = g_strdup_printf("A(%g)", (double)(float)expected);
    g_assert_cmpstr(got, ==, wanted);
    g_free(got);
    g_free(wanted);
}

static void test_functions(void) {
    check_function("", "0.2", ramp(0.2));
    check_function("", "0.25", ramp(0.25));
    check_function("", "1", ramp(1));
    check_function("samples: 5\n", "0.25", ramp(0.25));
    check_function("samples: 5\n", "0.375", (ramp(0.25) + ramp(0.5)) / 2);
}

// Counting interprets and forgets: neither variables nor random numbers have moved.
static void test_count(void) {
    Derived d = begin("Lsystem: 1\nseed: 4\nStart: { n = 0; }\naxiom: AA\nA --> A(ran(1),n)\n"
                      "homomorphism\nA : {n = n+1;} 1 --> BBB : 1\nA --> B : 1\nendlsystem\n",
                      1);
    Derived e = begin("Lsystem: 1\nseed: 4\nStart: { n = 0; }\naxiom: AA\nA --> A(ran(1),n)\n"
                      "homomorphism\nA : {n = n+1;} 1 --> BBB : 1\nA --> B : 1\nendlsystem\n",
                      1);
    uint64_t modules;
    g_assert_cmpint(fr_lderivation_count(d.derivation, &d.context, &modules), ==, FR_OK);
    g_assert_true(modules == 2 || modules == 4 || modules == 6);
    step(&d, 1);
    step(&e, 1);
    char *expected = now(&e);
    check_now(&d, expected);
    g_free(expected);
    end(&d);
    end(&e);
}

// A published figure: RandomMoss of the field's library has 659 segments, each of length 1.
static void test_moss(void) {
    FrContext context = fr_context_default();
    Derived d = begin("#define STEPS 5\n#define P1 33\n#define P2 33\n#define P3 33\nLsystem: 1\n"
                      "seed: 2454\nderivation length: STEPS\nAxiom: F\n"
                      "F --> F[!,+F]F[!,-F]F : P1\nF --> F[!,+F]F : P2\nF --> F[!,-F]F : P3\n"
                      "Endlsystem\n",
                      1);
    step(&d, 5);
    FrPlant *plant;
    FrLdrawn drawn;
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &context, &plant, &drawn), ==, FR_OK);
    g_assert_cmpuint(drawn.segments, ==, 659);
    fr_plant_free(plant);
    end(&d);
}

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        void (*run)(void);
    } tests[] = {
        {"short segments do not count", test_short},
        {"the box holds the origin and balls, not widths", test_box},
        {"unknown symbols are obeyed without their sign", test_unknown},
        {"rolls stay without a bend", test_rolls},
        {"a torque turns up away", test_torque},
        {"an intensity scales a tropism", test_intensity},
        {"lines draw the strips of cylinders", test_lines},
        {"cylinders go on in branches", test_branches},
        {"functions have the values of their bisection", test_functions},
        {"counting changes nothing", test_count},
        {"a published moss has its segments", test_moss},
    };
    g_test_init(&argc, &argv, NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(tests); i++) {
        char *path = g_strconcat("/lsystem/drawn/", tests[i].name, NULL);
        g_test_add_func(path, tests[i].run);
        g_free(path);
    }
    return g_test_run();
}
