// Distances from surfaces of triangles, held against closed forms and against every triangle in
// turn.
#include "frond/distance.h"
#include "frond/random.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// A cube from −1 to 1, counter-clockwise from outside.
static const vec3s cube[8] = {{{-1, -1, -1}}, {{1, -1, -1}}, {{1, 1, -1}}, {{-1, 1, -1}},
                              {{-1, -1, 1}},  {{1, -1, 1}},  {{1, 1, 1}},  {{-1, 1, 1}}};
static const uint32_t sides[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                   1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

static double of_cube(const double at[3]) {
    double outside = 0, inside = -INFINITY;
    for (int r = 0; r < 3; r++) {
        double over = fabs(at[r]) - 1;
        outside += over > 0 ? over * over : 0;
        inside = fmax(inside, over);
    }
    return inside > 0 ? sqrt(outside) : inside;
}

static void random_point(FrKey key, uint32_t k, double reach, double at[3]) {
    for (uint32_t r = 0; r < 3; r++) {
        at[r] = reach * fr_random_signed(key, r, k);
    }
}

static void closed_form(void) {
    FrDistance *distance = fr_distance_new(cube, 8, sides, 36);
    g_assert_true(fr_distance_is_closed(distance));
    for (uint32_t k = 0; k < 2000; k++) {
        double at[3], outward[3], on[3], aside[3];
        random_point(fr_key_root(3), k, 2, at);
        double found = fr_distance_at(distance, at, outward);
        g_assert_cmpfloat_with_epsilon(found, of_cube(at), 1e-12);
        for (int r = 0; r < 3; r++) {
            on[r] = at[r] - found * outward[r];
        }
        // Outward leads away from the nearest point of the surface.
        g_assert_cmpfloat_with_epsilon(fr_distance_at(distance, on, aside), 0, 1e-9);
    }
    fr_distance_free(distance);
}

static void on_the_surface(void) {
    FrDistance *distance = fr_distance_new(cube, 8, sides, 36);
    double outward[3];
    double at[3] = {0.3, 1, 0.2};
    g_assert_cmpfloat_with_epsilon(fr_distance_at(distance, at, outward), 0, 1e-12);
    g_assert_cmpfloat_with_epsilon(outward[1], 1, 1e-12);
    fr_distance_free(distance);
}

static void within_reach(void) {
    FrDistance *distance = fr_distance_new(cube, 8, sides, 36);
    for (uint32_t k = 0; k < 2000; k++) {
        double at[3], all[3], near[3] = {7, 7, 7};
        random_point(fr_key_root(5), k, 2, at);
        double found = fr_distance_at(distance, at, all);
        double within = fr_distance_within(distance, at, 0.4, near);
        if (fabs(found) < 0.4) {
            g_assert_cmpfloat(within, ==, found);
            g_assert_true(memcmp(near, all, sizeof near) == 0);
        } else {
            g_assert_true(isinf(within));
            g_assert_cmpfloat(near[0], ==, 7);
        }
    }
    fr_distance_free(distance);
}

static void open_surface(void) {
    const vec3s sheet[3] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
    const uint32_t corners[3] = {0, 1, 2};
    FrDistance *distance = fr_distance_new(sheet, 3, corners, 3);
    double outward[3];
    g_assert_false(fr_distance_is_closed(distance));
    g_assert_cmpfloat(fr_distance_at(distance, (const double[3]){0.2, 0.2, -2}, outward), ==, 2);
    g_assert_cmpfloat(outward[2], ==, -1);
    fr_distance_free(distance);
    g_assert_null(fr_distance_new(sheet, 3, (const uint32_t[3]){0, 1, 1}, 3));
}

static void every_triangle(void) {
    // A crowd of triangles: the tree finds what looking at all of them finds.
    enum { COUNT = 300 };
    vec3s corners[3 * COUNT];
    uint32_t indices[3 * COUNT];
    for (uint32_t k = 0; k < 3 * COUNT; k++) {
        double middle[3], off[3];
        random_point(fr_key_root(5), k / 3, 3, middle);
        random_point(fr_key_root(6), k, 0.5, off);
        for (int r = 0; r < 3; r++) {
            corners[k].raw[r] = (float)(middle[r] + off[r]);
        }
        indices[k] = k;
    }
    FrDistance *all = fr_distance_new(corners, 3 * COUNT, indices, 3 * COUNT);
    for (uint32_t p = 0; p < 100; p++) {
        double at[3], outward[3], nearest = INFINITY;
        random_point(fr_key_root(7), p, 4, at);
        for (uint32_t t = 0; t < COUNT; t++) {
            FrDistance *one = fr_distance_new(corners, 3 * COUNT, indices + 3 * t, 3);
            nearest = fmin(nearest, fr_distance_at(one, at, outward));
            fr_distance_free(one);
        }
        g_assert_cmpfloat(fr_distance_at(all, at, outward), ==, nearest);
    }
    fr_distance_free(all);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/space/distance/" name, function)
    TEST("a cube of triangles is as far as a cube", closed_form);
    TEST("on a face the way out is its normal", on_the_surface);
    TEST("within a reach it is the same, beyond it there is none", within_reach);
    TEST("an open surface has no inside, and nothing no distance", open_surface);
    TEST("the tree finds the nearest of all triangles", every_triangle);
    return g_test_run();
}
