#include "render/sampler.h"

#include <glib.h>

// The second dimension of Sobol' 1967 by its direction numbers: v1 = 1/2, v(k+1) = v(k) ⊕ v(k)/2.
static uint32_t second_by_directions(uint32_t index) {
    uint32_t direction = 0x80000000u;
    uint32_t sum = 0;
    for (; index != 0; index >>= 1) {
        sum ^= (index & 1) != 0 ? direction : 0;
        direction ^= direction >> 1;
    }
    return sum;
}

static void test_sobol(void) {
    static const uint32_t first_eight[8] = {0x00000000, 0x80000000, 0xc0000000, 0x40000000,
                                            0xa0000000, 0x20000000, 0x60000000, 0xe0000000};
    for (uint32_t i = 0; i < 8; i++) {
        g_assert_cmphex(fr_sobol_second(i), ==, first_eight[i]);
    }
    for (uint32_t i = 0; i < 2000; i++) {
        uint32_t index = i < 1000 ? i : (uint32_t)fr_random_bits(1, 2, i);
        g_assert_cmphex(fr_sobol_second(index), ==, second_by_directions(index));
    }
}

static void test_reverse(void) {
    g_assert_cmphex(fr_reverse_bits(0x00000001), ==, 0x80000000);
    g_assert_cmphex(fr_reverse_bits(0x12345678), ==, 0x1e6a2c48);
}

// A (0, 4, 2)-net: each of the 5 ways to cut the square into 16 boxes has one point in every box.
static void test_net(void) {
    for (uint32_t dimension = 0; dimension < 6; dimension++) {
        float u[16];
        float v[16];
        for (uint32_t i = 0; i < 16; i++) {
            FrSampler sampler = fr_sampler(31, 7, i, 16);
            for (uint32_t d = 0; d <= dimension; d++) {
                fr_sampler_pair(&sampler, &u[i], &v[i]);
            }
            g_assert_true(u[i] >= 0.0f && u[i] < 1.0f && v[i] >= 0.0f && v[i] < 1.0f);
        }
        for (uint32_t cut = 0; cut <= 4; cut++) {
            uint32_t seen = 0;
            for (uint32_t i = 0; i < 16; i++) {
                uint32_t column = (uint32_t)(u[i] * (float)(1u << cut));
                uint32_t row = (uint32_t)(v[i] * (float)(16u >> cut));
                seen |= 1u << (column * (16u >> cut) + row);
            }
            g_assert_cmphex(seen, ==, 0xffff);
        }
    }
}

static void test_independence(void) {
    double sum = 0.0;
    double product = 0.0;
    for (uint32_t x = 0; x < 4096; x++) {
        FrSampler sampler = fr_sampler(x, 3, 0, 1);
        FrSampler neighbour = fr_sampler(x + 1, 3, 0, 1);
        double a = (double)fr_sampler_single(&sampler) - 0.5;
        double b = (double)fr_sampler_single(&neighbour) - 0.5;
        double c = (double)fr_sampler_single(&sampler) - 0.5;
        sum += a;
        product += a * b + a * c;
    }
    // Standard deviations: √(1/12/4096) ≈ 0.0045 and √(2/144/4096) ≈ 0.0018.
    g_assert_cmpfloat_with_epsilon(sum / 4096, 0.0, 0.018);
    g_assert_cmpfloat_with_epsilon(product / 4096, 0.0, 0.0075);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/sampler/bits are reversed", test_reverse);
    g_test_add_func("/render/sampler/the second dimension is Sobol's", test_sobol);
    g_test_add_func("/render/sampler/sixteen samples fill every elementary box", test_net);
    g_test_add_func("/render/sampler/pixels and dimensions are independent", test_independence);
    return g_test_run();
}
