/// Distances from stems, held against every stem in turn.
#include "frond/random.h"
#include "space/stems.h"

#include <glib.h>
#include <math.h>

enum { COUNT = 300 };

static void make(FrStem *stems) {
    FrKey key = fr_key_root(11);
    for (uint32_t i = 0; i < COUNT; i++) {
        for (uint32_t r = 0; r < 3; r++) {
            stems[i].from[r] = 2 * fr_random_signed(key, r, i);
            stems[i].to[r] = stems[i].from[r] + 0.3 * fr_random_signed(key, 3 + r, i);
        }
        stems[i].radius[0] = 0.1 * fr_random(key, 6, i);
        stems[i].radius[1] = stems[i].radius[0] * fr_random(key, 7, i);
    }
}

/// By walking along the middle line in small steps.
static double nearest(const FrStem *stem, const double at[3]) {
    enum { STEPS = 2000 };
    double least = INFINITY, radius = 0;
    for (int k = 0; k <= STEPS; k++) {
        double t = (double)k / STEPS, off = 0;
        for (int r = 0; r < 3; r++) {
            double d = at[r] - (stem->from[r] + t * (stem->to[r] - stem->from[r]));
            off += d * d;
        }
        if (sqrt(off) < least) {
            least = sqrt(off);
            radius = stem->radius[0] + t * (stem->radius[1] - stem->radius[0]);
        }
    }
    return least - radius;
}

static void point(uint32_t k, double at[3]) {
    for (uint32_t r = 0; r < 3; r++) {
        at[r] = 2.2 * fr_random_signed(fr_key_root(5), r, k);
    }
}

static void test_each(void) {
    FrStem list[COUNT];
    make(list);
    FrStems *stems = fr_stems_new(list, COUNT);
    for (uint32_t k = 0; k < 12; k++) {
        double at[3], least = INFINITY;
        point(k, at);
        for (uint32_t i = 0; i < COUNT; i++) {
            least = fmin(least, nearest(&list[i], at));
        }
        FrBark bark = fr_stems_near(stems, at, INFINITY, 0);
        g_assert_cmpfloat_with_epsilon(bark.distance, least, 1e-3);
    }
    fr_stems_free(stems);
}

static void test_order(void) {
    FrStem list[COUNT], turned[COUNT];
    make(list);
    for (uint32_t i = 0; i < COUNT; i++) {
        turned[i] = list[(i * 7 + 3) % COUNT]; // 7 and 300 have no common divisor
    }
    FrStems *one = fr_stems_new(list, COUNT), *other = fr_stems_new(turned, COUNT);
    for (uint32_t k = 0; k < 500; k++) {
        double at[3];
        point(k, at);
        FrBark a = fr_stems_near(one, at, 1, 0), b = fr_stems_near(other, at, 1, 0);
        g_assert_true(a.distance == b.distance && a.radius == b.radius);
        g_assert_true(a.outward[0] == b.outward[0] && a.outward[2] == b.outward[2]);
    }
    fr_stems_free(one);
    fr_stems_free(other);
}

static const FrStem post = {{0, 0, 0}, {0, 0, 2}, {0.3, 0.1}};

static void test_inside(void) {
    FrStems *stems = fr_stems_new(&post, 1);
    FrBark bark = fr_stems_near(stems, (const double[3]){0.05, 0, 1}, 0.1, 0);
    g_assert_cmpfloat_with_epsilon(bark.distance, -0.15, 1e-12);
    g_assert_cmpfloat_with_epsilon(bark.radius, 0.2, 1e-12);
    g_assert_cmpfloat_with_epsilon(bark.outward[0], 1, 1e-12);
    bark = fr_stems_near(stems, (const double[3]){0, 0, 1}, 0.1, 0); // any way out is across
    g_assert_cmpfloat_with_epsilon(bark.distance, -0.2, 1e-12);
    g_assert_cmpfloat_with_epsilon(bark.outward[2], 0, 1e-12);
    g_assert_cmpfloat_with_epsilon(hypot(bark.outward[0], bark.outward[1]), 1, 1e-12);
    fr_stems_free(stems);
}

static void test_none(void) {
    g_assert_null(fr_stems_new(NULL, 0));
    g_assert_true(isinf(fr_stems_near(NULL, (const double[3]){0}, 1, 0).distance));
    FrStems *stems = fr_stems_new(&post, 1);
    const double beside[3] = {0.7, 0, 1};
    g_assert_true(isinf(fr_stems_near(stems, beside, 0.49, 0).distance));
    g_assert_cmpfloat_with_epsilon(fr_stems_near(stems, beside, 0.51, 0).distance, 0.5, 1e-12);
    g_assert_true(isinf(fr_stems_near(stems, beside, 0.51, 0.25).distance));
    fr_stems_free(stems);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/space/stems/the nearest is that of all stems in turn", test_each);
    g_test_add_func("/space/stems/the order of stems has no say", test_order);
    g_test_add_func("/space/stems/inside, distances are below zero and lead out", test_inside);
    g_test_add_func("/space/stems/what is too far or too thin is not found", test_none);
    return g_test_run();
}
