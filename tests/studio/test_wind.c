/// The wind that is looked at.
#include "studio/model/wind.h"

#include <glib.h>

static void test_direction(void) {
    StudioWind wind = studio_wind_default();
    float gust[4], east[4];
    wind.strength = 1;
    wind.direction = 0; // towards the north, which is y
    studio_wind_gust(&wind, 7, gust);
    g_assert_cmpfloat_with_epsilon(gust[0], 0, 1e-6);
    g_assert_cmpfloat_with_epsilon(gust[1], 0.27, 1e-6);
    g_assert_cmpfloat(gust[3], ==, 7);
    wind.direction = 90;
    wind.strength = 0.5;
    studio_wind_gust(&wind, 7, east);
    g_assert_cmpfloat_with_epsilon(east[0], 0.5f * gust[1], 1e-6);
    g_assert_cmpfloat_with_epsilon(east[1], 0, 1e-6);
}

static void test_time(void) {
    StudioWind wind = studio_wind_default(), fast = wind;
    fast.speed = 2;
    for (int i = 0; i < 10; i++) {
        studio_wind_advance(&wind, 0.02);
        studio_wind_advance(&fast, 0.02);
    }
    g_assert_cmpfloat_with_epsilon(wind.phase, 0.2, 1e-9);
    g_assert_cmpfloat_with_epsilon(fast.phase, 0.4, 1e-9);
    studio_wind_advance(&wind, 1000);
    g_assert_cmpfloat_with_epsilon(wind.phase, 0.3, 1e-9);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/wind/it blows where it is told, as far as it is strong",
                    test_direction);
    g_test_add_func("/studio/wind/gusts follow its speed and do not jump after a pause", test_time);
    return g_test_run();
}
