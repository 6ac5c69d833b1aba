// Gradient noise: its range, zeros, smoothness, and repeats.
#include "frond/noise.h"

#include <glib.h>
#include <math.h>

static const FrKey key = 42;

static double place(uint32_t axis, uint32_t k) {
    return 200 * fr_random_signed(9, axis, k);
}

static void test_lattice(void) {
    for (int i = -5; i < 5; i++) {
        g_assert_cmpfloat(fr_noise1(key, i), ==, 0);
        g_assert_cmpfloat(fr_noise2(key, i, 3 - i), ==, 0);
        g_assert_cmpfloat(fr_noise3(key, i, 3 - i, 2 * i), ==, 0);
    }
}

static void test_range(void) {
    double least[3] = {0}, most[3] = {0}, sum[3] = {0};
    const uint32_t count = 200000;
    for (uint32_t k = 0; k < count; k++) {
        double x = place(0, k), y = place(1, k), z = place(2, k);
        double values[3] = {fr_noise1(key, x), fr_noise2(key, x, y), fr_noise3(key, x, y, z)};
        for (int d = 0; d < 3; d++) {
            least[d] = fmin(least[d], values[d]);
            most[d] = fmax(most[d], values[d]);
            sum[d] += values[d];
        }
    }
    for (int d = 0; d < 3; d++) {
        g_assert_cmpfloat(least[d], >=, -1);
        g_assert_cmpfloat(most[d], <=, 1);
        // Most of the range is used, and evenly on both sides of 0.
        g_assert_cmpfloat(least[d], <, -0.7);
        g_assert_cmpfloat(most[d], >, 0.7);
        g_assert_cmpfloat(fabs(sum[d] / count), <, 0.02);
    }
}

// The quintic fade makes the second derivative continuous: differences shrink with the cube.
static void test_smooth(void) {
    const double h = 1e-3;
    for (int i = -20; i < 20; i++) {
        double before = fr_noise2(key, i - h, 0.3) - 2 * fr_noise2(key, i - 2 * h, 0.3) +
                        fr_noise2(key, i - 3 * h, 0.3);
        double after = fr_noise2(key, i + 3 * h, 0.3) - 2 * fr_noise2(key, i + 2 * h, 0.3) +
                       fr_noise2(key, i + h, 0.3);
        g_assert_cmpfloat(fabs(before - after) / (h * h), <, 1);
    }
}

static void test_tiles(void) {
    for (uint32_t k = 0; k < 1000; k++) {
        double x = place(0, k), y = place(1, k);
        double here = fr_noise2_tiled(key, x, y, 7);
        g_assert_cmpfloat_with_epsilon(fr_noise2_tiled(key, x + 7, y, 7), here, 1e-9);
        g_assert_cmpfloat_with_epsilon(fr_noise2_tiled(key, x, y - 14, 7), here, 1e-9);
    }
    // In the first tile, away from its far edges, it is the noise that does not repeat.
    g_assert_cmpfloat(fr_noise2_tiled(key, 1.5, 2.25, 7), ==, fr_noise2(key, 1.5, 2.25));
}

static void test_keys_differ(void) {
    int same = 0;
    for (uint32_t k = 0; k < 100; k++) {
        same += fr_noise1(1, place(0, k)) == fr_noise1(2, place(0, k));
    }
    g_assert_cmpint(same, ==, 0);
}

static void test_far(void) {
    const double far[] = {1e300, -1e300, 0x1p60, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < G_N_ELEMENTS(far); i++) {
        g_assert_cmpfloat(fr_noise1(key, far[i]), ==, 0);
        g_assert_cmpfloat(fr_noise2(key, far[i], 0.5), ==, 0);
        g_assert_cmpfloat(fr_noise2_tiled(key, 0.5, far[i], 3), ==, 0);
        g_assert_cmpfloat(fr_noise3(key, 0.5, far[i], 0.5), ==, 0);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/noise/at whole numbers it is zero", test_lattice);
    g_test_add_func("/math/noise/it fills minus one to one evenly", test_range);
    g_test_add_func("/math/noise/its second derivative is continuous", test_smooth);
    g_test_add_func("/math/noise/tiled noise repeats", test_tiles);
    g_test_add_func("/math/noise/keys give different noise", test_keys_differ);
    g_test_add_func("/math/noise/far away it is zero", test_far);
    return g_test_run();
}
