// The skies against values worked out by hand from the published formulas.
#include "frond/light.h"

#include <glib.h>
#include <math.h>

static vec3s at(double altitude, double azimuth) {
    double a = altitude * G_PI / 180, b = azimuth * G_PI / 180;
    return (vec3s){{(float)(cos(a) * cos(b)), (float)(cos(a) * sin(b)), (float)sin(a)}};
}

static void test_zenith(void) {
    for (int kind = FR_SKY_UNIFORM; kind <= FR_SKY_CLEAR; kind++) {
        FrLamp sky = {.kind = FR_LAMP_SKY, .sky = (FrSkyKind)kind, .sun = at(40, 10)};
        g_assert_cmpfloat_with_epsilon(fr_lamp_sky_brightness(&sky, at(90, 0)), 1.0, 1e-5);
        g_assert_cmpfloat(fr_lamp_sky_brightness(&sky, at(-10, 0)), ==, 0.0);
    }
}

static void test_overcast(void) {
    FrLamp sky = {.kind = FR_LAMP_SKY, .sky = FR_SKY_OVERCAST};
    g_assert_cmpfloat_with_epsilon(fr_lamp_sky_brightness(&sky, at(1e-4, 70)), 1.0 / 3.0, 1e-5);
    g_assert_cmpfloat_with_epsilon(fr_lamp_sky_brightness(&sky, at(30, 200)), 2.0 / 3.0, 1e-5);
}

// The sun 30° from the zenith; a point 30° further down, 60° from the zenith.
static void test_clear(void) {
    FrLamp sky = {.kind = FR_LAMP_SKY, .sky = FR_SKY_CLEAR, .sun = at(60, 0)};
    sky.sun = (vec3s){{3 * sky.sun.x, 3 * sky.sun.y, 3 * sky.sun.z}};
    // 1 − e^(−0.32/0.5) over 1 − e^(−0.32): the glow is that of the zenith.
    g_assert_cmpfloat_with_epsilon(fr_lamp_sky_brightness(&sky, at(30, 0)), 0.472708 / 0.273851,
                                   1e-4);
    double sun = fr_lamp_sky_brightness(&sky, at(60, 0));
    // 11.36 over 0.91 + 10 e^(−π/2) + 0.3375; 1 − e^(−0.369504) over 1 − e^(−0.32).
    g_assert_cmpfloat_with_epsilon(sun, 11.36 / 3.326296 * 0.308923 / 0.273851, 2e-3);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/sky/every sky is one at the zenith and dark below", test_zenith);
    g_test_add_func("/light/sky/an overcast horizon has a third of the zenith", test_overcast);
    g_test_add_func("/light/sky/a clear sky is brightest at the sun", test_clear);
    return g_test_run();
}
