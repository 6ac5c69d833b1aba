// Rational B-splines against circles, closed forms and differences.
#include "frond/nurbs.h"

#include <glib.h>

#include <math.h>
#include <string.h>

static const FrNurbsCircle forms[] = {FR_CIRCLE_TRIANGLE, FR_CIRCLE_SQUARE, FR_CIRCLE_NINE,
                                      FR_CIRCLE_CUBIC};

static void circles(void) {
    for (size_t f = 0; f < G_N_ELEMENTS(forms); f++) {
        FrNurbsCurve circle = fr_nurbs_circle(forms[f]);
        double turned = 0.0, last = 0.0;
        for (int i = 0; i <= 1000; i++) {
            double point[3], slope[3];
            fr_nurbs_curve_at(&circle, i / 1000.0, point, slope);
            g_assert_cmpfloat_with_epsilon(hypot(point[0], point[1]), 1.0, 1e-15);
            g_assert_cmpfloat_with_epsilon(point[0] * slope[0] + point[1] * slope[1], 0.0, 1e-12);
            double angle = atan2(point[1], point[0]);
            turned += i > 0 ? remainder(angle - last, 2 * G_PI) : 0.0;
            last = angle;
        }
        g_assert_cmpfloat_with_epsilon(turned, 2 * G_PI, 1e-9);
        fr_nurbs_curve_clear(&circle);
    }
}

// Parametric speeds as published: fastest over slowest.
static void speeds(void) {
    const double published[] = {1.33, 2.00, 1.17, 2.00};
    for (size_t f = 0; f < G_N_ELEMENTS(forms); f++) {
        FrNurbsCurve circle = fr_nurbs_circle(forms[f]);
        double low = INFINITY, high = 0.0;
        for (int i = 0; i < 3000; i++) {
            double slope[3];
            fr_nurbs_curve_at(&circle, (i + 0.5) / 3000, NULL, slope);
            low = fmin(low, hypot(slope[0], slope[1]));
            high = fmax(high, hypot(slope[0], slope[1]));
        }
        g_assert_cmpfloat_with_epsilon(high / low, published[f], 0.006);
        fr_nurbs_curve_clear(&circle);
    }
}

static void basis(void) {
    // Piegl and Tiller, example 2.3: degree 2, knots 0 0 0 1 2 3 4 4 5 5 5, u = 5/2.
    const double knots[] = {0, 0, 0, 1, 2, 3, 4, 4, 5, 5, 5};
    double value[3], slope[3];
    uint32_t span = fr_nurbs_span(knots, 2, 8, 2.5);
    g_assert_cmpuint(span, ==, 4);
    fr_nurbs_basis(knots, 2, span, 2.5, value, slope);
    const double published[] = {1.0 / 8, 6.0 / 8, 1.0 / 8}, published_slope[] = {-0.5, 0, 0.5};
    for (int i = 0; i < 3; i++) {
        g_assert_cmpfloat_with_epsilon(value[i], published[i], 1e-15);
        g_assert_cmpfloat_with_epsilon(slope[i], published_slope[i], 1e-15);
    }
    g_assert_cmpuint(fr_nurbs_span(knots, 2, 8, 5.0), ==, 7);
}

static void insertion(void) {
    for (size_t f = 0; f < G_N_ELEMENTS(forms); f++) {
        FrNurbsCurve circle = fr_nurbs_circle(forms[f]), finer = fr_nurbs_curve_copy(&circle);
        const double knots[] = {0.1, 0.5, 0.77, 0.9};
        for (int i = 0; i < 4; i++) {
            fr_nurbs_curve_insert(&finer, knots[i]);
        }
        g_assert_cmpuint(finer.count, ==, circle.count + 4);
        for (int i = 0; i <= 100; i++) {
            double a[3], b[3];
            fr_nurbs_curve_at(&circle, i / 100.0, a, NULL);
            fr_nurbs_curve_at(&finer, i / 100.0, b, NULL);
            for (int k = 0; k < 3; k++) {
                g_assert_cmpfloat_with_epsilon(a[k], b[k], 1e-14);
            }
        }
        fr_nurbs_curve_clear(&circle);
        fr_nurbs_curve_clear(&finer);
    }
}

/// A part of a curve is it there, from end to end, and begins and ends with its points.
static void assert_part(const FrNurbsCurve *curve, double from, double to) {
    double range[2] = {from, to};
    double *knots = g_new(double, curve->count + 3 * (curve->degree + 1));
    g_assert_true(fr_nurbs_is_cut(curve->knots, curve->degree, curve->count, range));
    uint32_t count = fr_nurbs_cut_knots(curve->knots, curve->degree, curve->count, range, knots);
    FrNurbsCurve part = {curve->degree, count, knots, g_malloc_n(count, sizeof *part.points)};
    fr_nurbs_cut(curve->knots, curve->degree, curve->count, (const double(*)[4])curve->points, 1,
                 knots, count, part.points, 1);
    for (int i = 0; i <= 50; i++) {
        double a[3], b[3], u = range[0] + (range[1] - range[0]) * i / 50.0;
        fr_nurbs_curve_at(curve, u, a, NULL);
        fr_nurbs_curve_at(&part, u, b, NULL);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(a[k], b[k], 1e-13);
            bool is_end = i == 0 || i == 50;
            double end = part.points[i == 0 ? 0 : count - 1][k];
            g_assert_true(!is_end || fabs(end - a[k]) < 1e-13);
        }
    }
    fr_nurbs_curve_clear(&part);
}

static void parts(void) {
    for (size_t f = 0; f < G_N_ELEMENTS(forms); f++) {
        FrNurbsCurve circle = fr_nurbs_circle(forms[f]);
        assert_part(&circle, 0.1, 0.4);
        assert_part(&circle, 0.25, 0.75);
        assert_part(&circle, 0.5, 2);
        assert_part(&circle, -3, 0.01);
        double whole[2] = {-1, 2};
        g_assert_false(fr_nurbs_is_cut(circle.knots, circle.degree, circle.count, whole));
        g_assert_cmpfloat(whole[0], ==, 0);
        g_assert_cmpfloat(whole[1], ==, 1);
        fr_nurbs_curve_clear(&circle);
    }
    // A spline that is not clamped, and one with an inner knot as often as can be.
    double uniform[] = {0, 1, 2, 3, 4, 5, 6, 7, 8}, broken[] = {0, 0, 0, 1, 1, 1, 2, 3, 3, 3};
    double points[][4] = {{0, 0, 0, 1},   {1, 3, 0, 2}, {2, -1, 1, 1}, {4, 0, 2, 3},
                          {5, 5, 5, 0.5}, {6, 1, 0, 1}, {7, 2, 0, 1}};
    FrNurbsCurve loose = {3, 5, uniform, points}, torn = {2, 7, broken, points};
    assert_part(&loose, 3, 5);
    assert_part(&loose, 3.5, 4.25);
    assert_part(&torn, 1, 2.5);
    assert_part(&torn, 1.5, 2);
}

// The uniform cubic: at its knots the curve is (a + 4b + c) / 6.
static void closed_polygon(void) {
    const double star[6][2] = {{2, 0}, {0.5, 0.8}, {-1, 1.7}, {-1, 0}, {-1, -1.7}, {0.5, -0.8}};
    FrNurbsCurve curve = fr_nurbs_from_polygon(star, 6, true, 3);
    g_assert_cmpuint(curve.count, ==, 9);
    for (int i = 0; i <= 6; i++) {
        double point[3], nearest = INFINITY;
        fr_nurbs_curve_at(&curve, i / 6.0, point, NULL);
        for (int j = 0; j < 6; j++) {
            const double *a = star[j], *b = star[(j + 1) % 6], *c = star[(j + 2) % 6];
            double x = (a[0] + 4 * b[0] + c[0]) / 6, y = (a[1] + 4 * b[1] + c[1]) / 6;
            nearest = fmin(nearest, hypot(point[0] - x, point[1] - y));
        }
        g_assert_cmpfloat(nearest, <, 1e-14);
    }
    double first[3], last[3];
    fr_nurbs_curve_at(&curve, 0, NULL, first);
    fr_nurbs_curve_at(&curve, 1, NULL, last);
    g_assert_cmpfloat_with_epsilon(first[0], last[0], 1e-12);
    g_assert_cmpfloat_with_epsilon(first[1], last[1], 1e-12);
    fr_nurbs_curve_clear(&curve);
    curve = fr_nurbs_from_polygon(star, 6, true, 1);
    double corner[3];
    fr_nurbs_curve_at(&curve, 2.0 / 6, corner, NULL);
    g_assert_cmpfloat_with_epsilon(corner[0], star[2][0], 1e-14);
    fr_nurbs_curve_clear(&curve);
}

static void merging(void) {
    const double star[5][2] = {{2, 0}, {0.5, 0.8}, {-1, 1.7}, {-1, -1.7}, {0.5, -0.8}};
    FrNurbsCurve a = fr_nurbs_circle(FR_CIRCLE_CUBIC);
    FrNurbsCurve b = fr_nurbs_from_polygon(star, 5, true, 3);
    fr_nurbs_curves_merge(&a, &b);
    g_assert_cmpuint(a.count, ==, b.count);
    for (uint32_t i = 0; i < a.count + 4; i++) {
        g_assert_cmpfloat_with_epsilon(a.knots[i], b.knots[i], 1e-12);
    }
    for (int i = 0; i <= 100; i++) {
        double point[3];
        fr_nurbs_curve_at(&a, i / 100.0, point, NULL);
        g_assert_cmpfloat_with_epsilon(hypot(point[0], point[1]), 1.0, 1e-14);
    }
    fr_nurbs_curve_clear(&a);
    fr_nurbs_curve_clear(&b);
}

/// A bent quarter of a torus, with weights in both directions.
static FrNurbsSurface patch(double (*points)[4]) {
    static const double knots_u[] = {0, 0, 0, 1, 1, 1}, knots_v[] = {0, 0, 0, 0.4, 1, 1, 1};
    for (int j = 0; j < 4; j++) {
        for (int i = 0; i < 3; i++) {
            double point[4] = {i - 0.3 * j, 0.5 * j + 0.2 * i * i, 2 + 0.3 * i * j,
                               1 + 0.5 * i - 0.2 * j};
            memcpy(points[j * 3 + i], point, sizeof point);
        }
    }
    return (FrNurbsSurface){2, 2, 3, 4, knots_u, knots_v, (const double(*)[4])points};
}

static void surface_slopes(void) {
    double points[12][4];
    FrNurbsSurface surface = patch(points);
    g_assert_true(fr_nurbs_surface_is_valid(&surface));
    for (int n = 0; n < 49; n++) {
        double u = 0.05 + 0.13 * (n % 7), v = 0.05 + 0.13 * (n / 7), h = 1e-6;
        double du[3], dv[3], a[3], b[3], c[3], d[3];
        fr_nurbs_surface_at(&surface, u, v, NULL, du, dv);
        fr_nurbs_surface_at(&surface, u - h, v, a, NULL, NULL);
        fr_nurbs_surface_at(&surface, u + h, v, b, NULL, NULL);
        fr_nurbs_surface_at(&surface, u, v - h, c, NULL, NULL);
        fr_nurbs_surface_at(&surface, u, v + h, d, NULL, NULL);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(du[k], (b[k] - a[k]) / (2 * h), 1e-7);
            g_assert_cmpfloat_with_epsilon(dv[k], (d[k] - c[k]) / (2 * h), 1e-7);
        }
    }
}

static void projection(void) {
    const double camera[4][4] = {
        {1.2, 0.1, 0.3, 0.5}, {0, 0.9, -0.4, 1}, {0.2, 0.4, 0.8, 2}, {0.05, 0.1, 0.3, 1.5}};
    double points[12][4], images[12][4];
    FrNurbsSurface surface = patch(points), projected = surface;
    projected.points = (const double(*)[4])images;
    for (int i = 0; i < 12; i++) {
        fr_nurbs_project(camera, points[i], images[i]);
    }
    for (int n = 0; n <= 100; n++) {
        double at[4], image[4], evaluated[3], u = (n % 10) / 9.0, v = (n / 10) / 10.0;
        fr_nurbs_surface_at(&surface, u, v, at, NULL, NULL);
        at[3] = 1.0;
        fr_nurbs_project(camera, at, image);
        fr_nurbs_surface_at(&projected, u, v, evaluated, NULL, NULL);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(image[k], evaluated[k], 1e-14);
        }
    }
}

static void interpolation(void) {
    double at[9], knots[13], values[9][2];
    for (int i = 0; i < 9; i++) {
        at[i] = i / 8.0 + 0.03 * sin(i * G_PI / 4);
        values[i][0] = 1 + at[i] - 3 * at[i] * at[i] * at[i]; // a cubic comes back as it is
        values[i][1] = sin(3 * at[i]);
    }
    fr_nurbs_average_knots(at, 9, 3, knots);
    fr_nurbs_interpolate(knots, 3, at, 9, values[0], 2, 2);
    double points[9][4];
    for (int i = 0; i < 9; i++) {
        double control[4] = {values[i][0], values[i][1], 0, 1};
        memcpy(points[i], control, sizeof control);
    }
    FrNurbsCurve curve = {3, 9, knots, points};
    for (int i = 0; i < 9; i++) {
        double point[3];
        fr_nurbs_curve_at(&curve, at[i], point, NULL);
        g_assert_cmpfloat_with_epsilon(point[1], sin(3 * at[i]), 1e-14);
    }
    for (int i = 0; i <= 50; i++) {
        double u = i / 50.0, point[3];
        u = fmin(fmax(u, at[0]), at[8]);
        fr_nurbs_curve_at(&curve, u, point, NULL);
        g_assert_cmpfloat_with_epsilon(point[0], 1 + u - 3 * u * u * u, 1e-13);
    }
}

static void refused(void) {
    double points[12][4], falling[] = {0, 0, 0, 1, 0.5, 1};
    FrNurbsSurface surface = patch(points);
    surface.knots_u = falling;
    g_assert_false(fr_nurbs_surface_is_valid(&surface));
    surface = patch(points);
    points[5][3] = 0.0;
    g_assert_false(fr_nurbs_surface_is_valid(&surface));
    points[5][3] = NAN;
    g_assert_false(fr_nurbs_surface_is_valid(&surface));
}

static FrNurbsCurve polygon(const double (*points)[3], uint32_t count) {
    FrNurbsCurve curve = {.degree = 1, .count = count};
    curve.knots = g_new(double, count + 2);
    curve.points = g_malloc_n(count, sizeof *curve.points);
    double *at = g_new(double, count);
    for (uint32_t i = 0; i < count; i++) {
        at[i] = (double)i / (count - 1);
        const double point[4] = {points[i][0], points[i][1], points[i][2], 1};
        memcpy(curve.points[i], point, sizeof point);
    }
    fr_nurbs_average_knots(at, count, 1, curve.knots);
    g_free(at);
    return curve;
}

/// A cubic arc from one point to another, lifted between.
static FrNurbsCurve arc(const double from[3], const double to[3]) {
    FrNurbsCurve curve = {.degree = 3, .count = 4};
    curve.knots = g_memdup2((double[]){0, 0, 0, 0, 1, 1, 1, 1}, 8 * sizeof(double));
    curve.points = g_malloc_n(4, sizeof *curve.points);
    for (int j = 0; j < 4; j++) {
        for (int k = 0; k < 3; k++) {
            curve.points[j][k] = from[k] + j / 3.0 * (to[k] - from[k]);
        }
        curve.points[j][2] += j == 1 || j == 2 ? 0.3 : 0;
        curve.points[j][3] = 1;
    }
    return curve;
}

static void assert_side(const FrNurbsSurface *patch, const FrNurbsCurve *side, bool along_u,
                        double other) {
    for (int n = 0; n <= 50; n++) {
        double p[3], q[3], t = n / 50.0;
        fr_nurbs_surface_at(patch, along_u ? t : other, along_u ? other : t, p, NULL, NULL);
        fr_nurbs_curve_at(side, t, q, NULL);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(p[k], q[k], 1e-12);
        }
    }
}

static const double margin[][3] = {
    {0, 1, 0}, {1, 1.5, .1}, {1.2, 1.1, 0}, {2.5, 2, .3}, {4, .6, 0}};
static const double midrib[][3] = {{0, 0, 0}, {1, 0, .4}, {2, 0, .5}, {3, 0, .3}, {4, 0, 0}};

static void coons(void) {
    // A toothed margin, a bent midrib, and arcs at both ends.
    FrNurbsCurve bottom = polygon(midrib, 5), top = polygon(margin, 5);
    FrNurbsCurve left = arc(midrib[0], margin[0]), right = arc(midrib[4], margin[4]);
    double net[20][4];
    fr_nurbs_coons(&bottom, &top, &left, &right, net);
    FrNurbsSurface patch = {1, 3, 5, 4, bottom.knots, left.knots, (const double(*)[4])net};
    assert_side(&patch, &bottom, true, 0);
    assert_side(&patch, &top, true, 1);
    assert_side(&patch, &left, false, 0);
    assert_side(&patch, &right, false, 1);
    // The definition, at a point inside.
    double u = 0.3, v = 0.6, b[3], t[3], l[3], r[3], s[3];
    fr_nurbs_curve_at(&bottom, u, b, NULL);
    fr_nurbs_curve_at(&top, u, t, NULL);
    fr_nurbs_curve_at(&left, v, l, NULL);
    fr_nurbs_curve_at(&right, v, r, NULL);
    fr_nurbs_surface_at(&patch, u, v, s, NULL, NULL);
    for (int k = 0; k < 3; k++) {
        double corners = (1 - v) * ((1 - u) * midrib[0][k] + u * midrib[4][k]) +
                         v * ((1 - u) * margin[0][k] + u * margin[4][k]);
        double wanted = (1 - v) * b[k] + v * t[k] + (1 - u) * l[k] + u * r[k] - corners;
        g_assert_cmpfloat_with_epsilon(s[k], wanted, 1e-14);
    }
    fr_nurbs_curve_clear(&bottom);
    fr_nurbs_curve_clear(&top);
    fr_nurbs_curve_clear(&left);
    fr_nurbs_curve_clear(&right);
}

static void coons_of_points(void) {
    static const double pointed[][3] = {
        {0, 0, 0}, {1, 1.5, .1}, {1.2, 1.1, 0}, {2.5, 2, .3}, {4, 0, 0}};
    static const double still[2][2][3] = {{{0, 0, 0}, {0, 0, 0}}, {{4, 0, 0}, {4, 0, 0}}};
    FrNurbsCurve bottom = polygon(midrib, 5), top = polygon(pointed, 5);
    FrNurbsCurve left = polygon(still[0], 2), right = polygon(still[1], 2);
    double net[10][4];
    fr_nurbs_coons(&bottom, &top, &left, &right, net);
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(net[i][k], midrib[i][k], 1e-15);
            g_assert_cmpfloat_with_epsilon(net[5 + i][k], pointed[i][k], 1e-15);
        }
    }
    fr_nurbs_curve_clear(&bottom);
    fr_nurbs_curve_clear(&top);
    fr_nurbs_curve_clear(&left);
    fr_nurbs_curve_clear(&right);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/nurbs/circles of all four forms are exact", circles);
    g_test_add_func("/math/nurbs/circles have their published speeds", speeds);
    g_test_add_func("/math/nurbs/basis functions are those of the book", basis);
    g_test_add_func("/math/nurbs/an inserted knot changes nothing", insertion);
    g_test_add_func("/math/nurbs/a part of a spline is the spline there", parts);
    g_test_add_func("/math/nurbs/a closed polygon makes a smooth closed spline", closed_polygon);
    g_test_add_func("/math/nurbs/curves with merged knots stay the same", merging);
    g_test_add_func("/math/nurbs/slopes agree with differences", surface_slopes);
    g_test_add_func("/math/nurbs/projecting first is evaluating first", projection);
    g_test_add_func("/math/nurbs/interpolation hits its points", interpolation);
    g_test_add_func("/math/nurbs/a Coons patch has the sides it is given", coons);
    g_test_add_func("/math/nurbs/with ends that are points it is the linear blend",
                    coons_of_points);
    g_test_add_func("/math/nurbs/wrong knots and weights are refused", refused);
    return g_test_run();
}
