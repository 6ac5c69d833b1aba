// Curves y(x): monotone data of the literature, crown shapes of Weber and Penn, areas.
#include "frond/curve.h"

#include <math.h>
#include <string.h>

// RPN 14 of Fritsch and Carlson 1980.
static const double rpn14[][2] = {
    {7.99, 0},      {8.09, 2.76429e-5}, {8.19, 4.37498e-2}, {8.7, 0.169183}, {9.2, 0.469428},
    {10, 0.943740}, {12, 0.998636},     {15, 0.999919},     {20, 0.999994},
};

// Akima 3 of the same paper.
static const double akima[][2] = {
    {0, 10},   {2, 10},  {3, 10},  {5, 10},  {6, 10},  {8, 10},
    {9, 10.5}, {11, 15}, {12, 50}, {14, 60}, {15, 85},
};

static void check_monotone(const double (*points)[2], size_t count) {
    FrCurve *curve = fr_curve_new(FR_CURVE_SMOOTH, points, count);
    for (size_t i = 0; i < count; i++) {
        g_assert_cmpfloat_with_epsilon(fr_curve_eval(curve, points[i][0]), points[i][1], 1e-12);
    }
    double first = points[0][0], width = points[count - 1][0] - first;
    double last = points[0][1];
    for (int i = 0; i <= 10000; i++) {
        double y = fr_curve_eval(curve, first + width * i / 10000);
        g_assert_cmpfloat(y, >=, last - 1e-12);
        last = y;
    }
    fr_curve_unref(curve);
}

static void test_monotone(void) {
    check_monotone(rpn14, G_N_ELEMENTS(rpn14));
    check_monotone(akima, G_N_ELEMENTS(akima));
}

static void test_no_overshoot(void) {
    const double points[][2] = {{0, 0}, {0.1, 1}, {0.2, 1}, {0.9, -1}, {1, 5}};
    FrCurve *curve = fr_curve_new(FR_CURVE_SMOOTH, points, 5);
    for (int i = 0; i <= 1000; i++) {
        double x = i / 1000.0, y = fr_curve_eval(curve, x);
        size_t k = x < 0.1 ? 0 : x < 0.2 ? 1 : x < 0.9 ? 2 : 3;
        g_assert_cmpfloat(y, >=, fmin(points[k][1], points[k + 1][1]));
        g_assert_cmpfloat(y, <=, fmax(points[k][1], points[k + 1][1]));
    }
    fr_curve_unref(curve);
}

// The slopes of three points are those of their parabola, which the cubic then is.
static void test_parabola(void) {
    const double points[][2] = {{1, 1}, {2, 4}, {3, 9}, {4, 16}};
    FrCurve *curve = fr_curve_new(FR_CURVE_SMOOTH, points, 4);
    for (int i = 0; i <= 30; i++) {
        double x = 1 + i / 10.0;
        g_assert_cmpfloat_with_epsilon(fr_curve_eval(curve, x), x * x, 1e-12);
    }
    g_assert_cmpfloat_with_epsilon(fr_curve_integral(curve, 3.5), (3.5 * 3.5 * 3.5 - 1) / 3, 1e-12);
    fr_curve_unref(curve);
}

static void test_linear_and_step(void) {
    const double points[][2] = {{0, 1}, {1, 3}, {3, 3}};
    FrCurve *linear = fr_curve_new(FR_CURVE_LINEAR, points, 3);
    FrCurve *step = fr_curve_new(FR_CURVE_STEP, points, 3);
    g_assert_cmpfloat(fr_curve_eval(linear, 0.25), ==, 1.5);
    g_assert_cmpfloat(fr_curve_eval(step, 0.999), ==, 1);
    g_assert_cmpfloat(fr_curve_eval(step, 1), ==, 3);
    g_assert_cmpfloat(fr_curve_integral(linear, 2), ==, 5);
    g_assert_cmpfloat(fr_curve_integral(step, 2), ==, 4);
    // Outside, the end values hold, also for the area.
    g_assert_cmpfloat(fr_curve_eval(linear, -5), ==, 1);
    g_assert_cmpfloat(fr_curve_eval(linear, 5), ==, 3);
    g_assert_cmpfloat(fr_curve_eval(linear, NAN), ==, 1);
    g_assert_cmpfloat(fr_curve_integral(linear, 4), ==, 11);
    g_assert_cmpfloat(fr_curve_integral(linear, -1), ==, -1);
    fr_curve_unref(linear);
    fr_curve_unref(step);
}

static void test_integral(void) {
    FrCurve *curve = fr_curve_new(FR_CURVE_SMOOTH, akima, G_N_ELEMENTS(akima));
    double sum = 0;
    const int steps = 15000;
    for (int i = 0; i < steps; i++) {
        sum += fr_curve_eval(curve, 15.0 * (i + 0.5) / steps) * 15.0 / steps;
        if (i % 500 == 0) {
            double x = 15.0 * (i + 1) / steps;
            g_assert_cmpfloat_with_epsilon(fr_curve_integral(curve, x), sum, 1e-4);
        }
    }
    fr_curve_unref(curve);
}

static void test_refused(void) {
    const double falling[][2] = {{0, 0}, {0, 1}};
    const double infinite[][2] = {{0, 0}, {1, INFINITY}};
    const double steep[][2] = {{0, -1e308}, {1e-300, 1e308}};
    g_assert_null(fr_curve_new(FR_CURVE_SMOOTH, falling, 2));
    g_assert_null(fr_curve_new(FR_CURVE_LINEAR, infinite, 2));
    g_assert_null(fr_curve_new(FR_CURVE_SMOOTH, steep, 2));
    g_assert_null(fr_curve_new(FR_CURVE_SMOOTH, falling, 0));
}

static void test_one_point(void) {
    const double point[][2] = {{2, 7}};
    FrCurve *curve = fr_curve_new(FR_CURVE_SMOOTH, point, 1);
    g_assert_cmpfloat(fr_curve_eval(curve, -3), ==, 7);
    g_assert_cmpfloat(fr_curve_eval(curve, 3), ==, 7);
    g_assert_cmpfloat(fr_curve_integral(curve, 4), ==, 14);
    fr_curve_unref(curve);
}

// ShapeRatio of Weber and Penn 1995, table in section 4.3; r is 1 at the base of the crown.
static double shape_ratio(const char *name, double r) {
    double flame = r <= 0.7 ? r / 0.7 : (1 - r) / 0.3;
    return strcmp(name, "conical") == 0               ? 0.2 + 0.8 * r
           : strcmp(name, "spherical") == 0           ? 0.2 + 0.8 * sin(G_PI * r)
           : strcmp(name, "hemispherical") == 0       ? 0.2 + 0.8 * sin(0.5 * G_PI * r)
           : strcmp(name, "cylindrical") == 0         ? 1
           : strcmp(name, "tapered-cylindrical") == 0 ? 0.5 + 0.5 * r
           : strcmp(name, "flame") == 0               ? flame
           : strcmp(name, "inverse-conical") == 0     ? 1 - 0.8 * r
           : strcmp(name, "tend-flame") == 0          ? 0.5 + 0.5 * flame
                                                      : NAN;
}

static void test_crowns(void) {
    size_t count;
    const char *const *names = fr_curve_builtin_names(&count);
    int crowns = 0;
    for (size_t i = 0; i < count; i++) {
        FrCurve *curve = fr_curve_builtin(names[i]);
        g_assert_nonnull(curve);
        if (!isnan(shape_ratio(names[i], 0.5))) {
            crowns++;
            for (int k = 0; k <= 100; k++) {
                double x = k / 100.0;
                g_assert_cmpfloat_with_epsilon(fr_curve_eval(curve, x),
                                               shape_ratio(names[i], 1 - x), 1e-3);
            }
        }
        fr_curve_unref(curve);
    }
    g_assert_cmpint(crowns, ==, 8);
    g_assert_null(fr_curve_builtin("conic"));
}

static void test_plain(void) {
    static const struct {
        const char *name;
        double at[3]; // at 0, 1/4, 1
    } plain[] = {
        {"flat", {1, 1, 1}},   {"ramp", {0, 0.25, 1}}, {"fall", {1, 0.75, 0}},
        {"bell", {0, 0.5, 0}}, {"dome", {0, 0.75, 0}}, {"s", {0, 0.15625, 1}},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(plain); i++) {
        FrCurve *curve = fr_curve_builtin(plain[i].name);
        g_assert_cmpfloat_with_epsilon(fr_curve_eval(curve, 0), plain[i].at[0], 1e-12);
        g_assert_cmpfloat_with_epsilon(fr_curve_eval(curve, 0.25), plain[i].at[1], 1e-12);
        g_assert_cmpfloat_with_epsilon(fr_curve_eval(curve, 1), plain[i].at[2], 1e-12);
        fr_curve_unref(curve);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/curve/monotone data of the literature stay monotone", test_monotone);
    g_test_add_func("/math/curve/a smooth curve never overshoots its points", test_no_overshoot);
    g_test_add_func("/math/curve/points of a parabola give the parabola and its area",
                    test_parabola);
    g_test_add_func("/math/curve/linear and step curves and their ends", test_linear_and_step);
    g_test_add_func("/math/curve/the integral is that of the values", test_integral);
    g_test_add_func("/math/curve/points out of order or without end are refused", test_refused);
    g_test_add_func("/math/curve/one point is a constant", test_one_point);
    g_test_add_func("/math/curve/the crowns are those of Weber and Penn", test_crowns);
    g_test_add_func("/math/curve/the plain shapes are what they are called", test_plain);
    return g_test_run();
}
