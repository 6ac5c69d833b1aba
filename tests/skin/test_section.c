// Cross-sections: which of them no sound surface comes of.
#include "skin/section.h"

#include <glib.h>
#include <math.h>

#define FAULT(is_closed, ...)                                                                      \
    fault_of((double[][2]){__VA_ARGS__}, sizeof((double[][2]){__VA_ARGS__}) / sizeof(double[2]),   \
             is_closed)

static FrSectionFault fault_of(double (*points)[2], size_t count, bool is_closed) {
    return fr_section_fault(&(FrProfile){points, (uint32_t)count, is_closed});
}

static void sound(void) {
    g_assert_cmpint(FAULT(true, {1, 0}, {0, 1}, {-1, 0}), ==, FR_SECTION_SOUND);
    g_assert_cmpint(FAULT(true, {1, 0}, {0, 1}, {0, 1}, {-1, 0}, {1, 0}), ==, FR_SECTION_SOUND);
    // Points on straight edges, either way round, and a comb.
    g_assert_cmpint(FAULT(true, {-1, -1}, {-1, 0}, {-1, 1}, {1, 1}, {1, -1}, {0, -1}), ==,
                    FR_SECTION_SOUND);
    g_assert_cmpint(
        FAULT(true, {0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {2, 1}, {2, 3}, {1, 3}, {1, 1}, {0, 1}),
        ==, FR_SECTION_SOUND);
    // A ribbon may come back: it is a sheet.
    g_assert_cmpint(FAULT(false, {-1, 0}, {1, 0}, {-1, 0}), ==, FR_SECTION_SOUND);
    double star[FR_SECTION_LOOKED_MOST][2];
    for (int i = 0; i < FR_SECTION_LOOKED_MOST; i++) {
        double angle = 2 * G_PI * i / FR_SECTION_LOOKED_MOST, out = i % 2 == 0 ? 1 : 0.9;
        star[i][0] = out * cos(angle);
        star[i][1] = out * sin(angle);
    }
    g_assert_cmpint(fault_of(star, FR_SECTION_LOOKED_MOST, true), ==, FR_SECTION_SOUND);
}

static void touching(void) {
    g_assert_cmpint(FAULT(true, {0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {2, 0}), ==,
                    FR_SECTION_TOUCHES);
    g_assert_cmpint(FAULT(true, {0, 0}, {1, 0}, {0, 0}, {1, 0}, {2, 0}), ==, FR_SECTION_TOUCHES);
    g_assert_cmpint(FAULT(true, {0, 0}, {1, 0}, {2, 0}), ==, FR_SECTION_TOUCHES);
    // An eight, two squares at a corner, a corner on an edge, a spike.
    g_assert_cmpint(FAULT(true, {-1, -1}, {1, 1}, {1, -1}, {-1, 1}), ==, FR_SECTION_TOUCHES);
    g_assert_cmpint(FAULT(true, {0, 0}, {1, 0}, {1, 1}, {0, 0}, {-1, 0}, {-1, -1}), ==,
                    FR_SECTION_TOUCHES);
    g_assert_cmpint(FAULT(true, {-1, 0}, {1, 0}, {1, 1}, {0.3, 0}, {-1, 1}), ==,
                    FR_SECTION_TOUCHES);
    g_assert_cmpint(FAULT(true, {-1, 0}, {1, 0}, {3, 0}, {1, 0}, {0, 1}), ==, FR_SECTION_TOUCHES);
}

static void left_out(void) {
    g_assert_cmpint(FAULT(true, {1, 0}), ==, FR_SECTION_FEW);
    g_assert_cmpint(FAULT(true, {0, 0}, {0, 0}, {0, 0}), ==, FR_SECTION_FEW);
    g_assert_cmpint(FAULT(true, {1e30, 0}, {0, 1e30}, {-1e30, 0}), ==, FR_SECTION_FEW);
    g_assert_cmpint(FAULT(false, {0, 0}, {0, 0}), ==, FR_SECTION_FEW);
    g_assert_cmpint(FAULT(true, {1e30, 0}, {0, 1}, {-1, 0}, {0, -1}), ==, FR_SECTION_FAR);
    g_assert_cmpint(FAULT(true, {NAN, 0}, {0, 1}, {-1, 0}, {0, -1}), ==, FR_SECTION_FAR);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/section/simple polygons are sound", sound);
    g_test_add_func("/skin/section/what meets itself is told", touching);
    g_test_add_func("/skin/section/what is not used is told", left_out);
    return g_test_run();
}
