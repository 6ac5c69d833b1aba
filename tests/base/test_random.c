// Random numbers against published vectors, and their independence of what else is drawn.
#include "frond/random.h"

#include <glib.h>
#include <math.h>

// The first outputs of SplitMix64 for two seeds, from its reference implementation.
static void test_mixer(void) {
    g_assert_cmphex(fr_key_root(0), ==, UINT64_C(0xe220a8397b1dcdaf));
    g_assert_cmphex(fr_key_root(1234567), ==, UINT64_C(6457827717110365317));
}

// FNV-1a vectors of the authors' test suite, then the mixer.
static void test_names(void) {
    g_assert_cmphex(fr_key_name(""), ==, fr_mix64(UINT64_C(0xcbf29ce484222325)));
    g_assert_cmphex(fr_key_name("a"), ==, fr_mix64(UINT64_C(0xaf63dc4c8601ec8c)));
    g_assert_cmphex(fr_key_name("foobar"), ==, fr_mix64(UINT64_C(0x85944171f73967e8)));
}

// 16 bins of 64 draws each in the mean: chi-square with 15 degrees of freedom stays under 37.7
// with probability 0.999.
static void test_uniform(void) {
    int bins[16] = {0};
    double least = 1, most = 0;
    for (uint32_t i = 0; i < 1024; i++) {
        double u = fr_random(fr_key_child(fr_key_root(7), i), 3, 0);
        bins[(int)(u * 16)]++;
        least = fmin(least, u);
        most = fmax(most, u);
    }
    double chi_square = 0;
    for (int i = 0; i < 16; i++) {
        chi_square += (bins[i] - 64.0) * (bins[i] - 64.0) / 64.0;
    }
    g_assert_cmpfloat(chi_square, <, 37.7);
    g_assert_cmpfloat(least, >=, 0);
    g_assert_cmpfloat(most, <, 1);
}

static void test_signed(void) {
    double sum = 0;
    for (uint32_t i = 0; i < 10000; i++) {
        double u = fr_random_signed(fr_key_root(1), 0, i);
        g_assert_true(-1 <= u && u < 1);
        sum += u;
    }
    g_assert_cmpfloat(fabs(sum / 10000), <, 0.03); // 5 standard errors
}

static void test_normal(void) {
    enum { COUNT = 20000 };
    double sum = 0, squares = 0, within_one = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        double z = fr_random_normal(fr_key_root(5), 2, i);
        g_assert_true(isfinite(z));
        sum += z;
        squares += z * z;
        within_one += fabs(z) < 1 ? 1 : 0;
    }
    g_assert_cmpfloat(fabs(sum / COUNT), <, 0.035);
    g_assert_cmpfloat(fabs(squares / COUNT - 1), <, 0.05);
    g_assert_cmpfloat(fabs(within_one / COUNT - 0.6827), <, 0.017);
}

static void test_purposes(void) {
    FrKey key = fr_key_name("trunk");
    g_assert_cmphex(fr_random_bits(key, 1, 0), !=, fr_random_bits(key, 2, 0));
    g_assert_cmphex(fr_random_bits(key, 1, 0), !=, fr_random_bits(key, 1, 1));
    g_assert_cmphex(fr_random_bits(key, 1, 0), !=, fr_random_bits(key, 0, 1));
    g_assert_cmphex(fr_random_bits(fr_key_child(key, 0), 1, 0), !=,
                    fr_random_bits(fr_key_child(key, 1), 1, 0));
    g_assert_cmphex(fr_random_bits(key, 1, 0), ==, fr_random_bits(fr_key_name("trunk"), 1, 0));
}

// A child's key depends on the order of the path, not only on its words.
static void test_paths(void) {
    FrKey root = fr_key_root(1);
    g_assert_cmphex(fr_key_child(fr_key_child(root, 1), 2), !=,
                    fr_key_child(fr_key_child(root, 2), 1));
    g_assert_cmphex(fr_key_child(root, 0), !=, root);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/random/the mixer is that of SplitMix64", test_mixer);
    g_test_add_func("/base/random/names are hashed by FNV-1a", test_names);
    g_test_add_func("/base/random/draws are uniform over neighbouring keys", test_uniform);
    g_test_add_func("/base/random/signed draws have mean zero", test_signed);
    g_test_add_func("/base/random/normal draws have mean zero and variance one", test_normal);
    g_test_add_func("/base/random/purposes and draws are independent", test_purposes);
    g_test_add_func("/base/random/a path's order matters", test_paths);
    return g_test_run();
}
