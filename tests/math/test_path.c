// Space curves.
#include "frond/curve.h"

#include <cglm/struct.h>

#include <math.h>

static void test_line(void) {
    const vec3s points[] = {{{0, 0, 0}}, {{0, 0, 1}}, {{0, 0, 1}}, {{0, 0, 4}}};
    FrPath *path = fr_path_new(points, 4);
    g_assert_cmpfloat_with_epsilon(fr_path_length(path), 4, 1e-5);
    vec3s point, tangent;
    for (int i = 0; i <= 8; i++) {
        fr_path_at(path, i * 0.5, &point, &tangent);
        g_assert_cmpfloat_with_epsilon((double)point.z, i * 0.5, 1e-5);
        g_assert_cmpfloat_with_epsilon((double)tangent.z, 1, 1e-5);
    }
    fr_path_unref(path);
}

static void test_through_points(void) {
    const vec3s points[] = {{{0, 0, 0}}, {{1, 0, 2}}, {{1, 3, 2}}, {{0, 0, 9}}};
    FrPath *path = fr_path_new(points, 4);
    for (int i = 0; i < 4; i++) {
        double nearest = INFINITY;
        for (int k = 0; k <= 4000; k++) {
            vec3s point, tangent;
            fr_path_at(path, fr_path_length(path) * k / 4000, &point, &tangent);
            nearest = fmin(nearest, (double)glms_vec3_distance(point, points[i]));
            g_assert_cmpfloat_with_epsilon((double)glms_vec3_norm(tangent), 1, 1e-5);
        }
        g_assert_cmpfloat(nearest, <, 5e-3);
    }
    fr_path_unref(path);
}

// Points of a circle give nearly its circumference, and the walk is even.
static void test_circle(void) {
    vec3s points[33];
    for (int i = 0; i < 33; i++) {
        float angle = (float)(2 * G_PI * i / 32);
        points[i] = (vec3s){{cosf(angle), sinf(angle), 0}};
    }
    FrPath *path = fr_path_new(points, 33);
    double length = fr_path_length(path);
    g_assert_cmpfloat_with_epsilon(length, 2 * G_PI, 1e-2);
    vec3s point, tangent;
    for (int i = 1; i < 100; i++) {
        fr_path_at(path, length * i / 100, &point, &tangent);
        double angle = atan2((double)point.y, (double)point.x);
        g_assert_cmpfloat(fabs(remainder(angle - 2 * G_PI * i / 100, 2 * G_PI)), <, 5e-3);
        // The first and last pieces run out straight.
        bool is_end = i < 5 || i > 95;
        g_assert_cmpfloat(fabs((double)glms_vec3_dot(point, tangent)), <, is_end ? 0.1 : 1e-3);
    }
    fr_path_unref(path);
}

static void test_ends(void) {
    const vec3s points[] = {{{1, 2, 3}}, {{2, 2, 3}}};
    vec3s point, tangent;
    FrPath *path = fr_path_new(points, 2);
    fr_path_at(path, -1, &point, &tangent);
    g_assert_cmpfloat((double)point.x, ==, 1);
    fr_path_at(path, 99, &point, &tangent);
    g_assert_cmpfloat((double)point.x, ==, 2);
    fr_path_at(path, NAN, &point, &tangent);
    g_assert_cmpfloat((double)point.x, ==, 1);
    fr_path_unref(path);
}

static void test_degenerate(void) {
    const vec3s same[] = {{{1, 2, 3}}, {{1, 2, 3}}};
    const vec3s infinite[] = {{{1, 2, 3}}, {{INFINITY, 0, 0}}};
    vec3s point, tangent;
    FrPath *path = fr_path_new(same, 2);
    g_assert_cmpfloat(fr_path_length(path), ==, 0);
    fr_path_at(path, 1, &point, &tangent);
    g_assert_cmpfloat((double)point.z, ==, 3);
    g_assert_cmpfloat((double)tangent.z, ==, 1);
    fr_path_unref(path);
    g_assert_null(fr_path_new(infinite, 2));
    g_assert_null(fr_path_new(same, 0));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/path/a line is walked evenly", test_line);
    g_test_add_func("/math/path/the curve goes through its points", test_through_points);
    g_test_add_func("/math/path/a circle has its length and tangents", test_circle);
    g_test_add_func("/math/path/beyond its ends a path stays there", test_ends);
    g_test_add_func("/math/path/repeated and infinite points are defined", test_degenerate);
    return g_test_run();
}
