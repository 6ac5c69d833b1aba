/// The sun by date and latitude, its path over a day, and the lamps of a day.
#include "frond/daylight.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREE (G_PI / 180.0)

static void assert_near(double value, double wanted, double tolerance) {
    if (!(fabs(value - wanted) <= tolerance)) {
        g_error("%.9g is not within %.3g of %.9g", value, tolerance, wanted);
    }
}

/// Meeus, Astronomical Algorithms, example 25.a: δ = −7.78507° on 1992 October 13, 0 h.
static void test_declination(void) {
    FrSunPosition sun = fr_light_sun(1992, 10, 13.0, 0, 0);
    assert_near(sun.declination / DEGREE, -7.78507, 0.0005);
}

/// Reda, Andreas 2004, Solar Position Algorithm (NREL/TP-560-34302), example A.5: Golden on 2003
/// October 17, 12:30:30, seven hours behind universal time. Their elevation has the refraction,
/// 0.016 degrees, added.
static void test_published_place(void) {
    double day = 17 + (19 + (30 + 30 / 60.0) / 60.0) / 24.0;
    FrSunPosition sun = fr_light_sun(2003, 10, day, 39.742476 * DEGREE, -105.1786 * DEGREE);
    assert_near(sun.azimuth / DEGREE, 194.34024, 0.01);
    assert_near(sun.elevation / DEGREE, 90 - 50.11162 - 0.016, 0.01);
}

static double noon_elevation(FrSunPath path) {
    vec3s places[9];
    g_assert_cmpuint(fr_light_sun_places(path, 9, places), ==, 9);
    assert_near((double)places[4].x, 0, 1e-6);
    return asin((double)places[4].z) / DEGREE;
}

static void test_noon(void) {
    FrSunPosition june = fr_light_sun(2025, 6, 21.1, 0, 0);
    FrSunPath berlin = {52.5 * DEGREE, june.declination};
    assert_near(noon_elevation(berlin), 90 - 52.5 + 23.436, 0.01);
}

static void test_path_through_place(void) {
    double azimuth = 135 * DEGREE, elevation = 42 * DEGREE;
    FrSunPath path = fr_light_sun_path(48 * DEGREE, azimuth, elevation);
    vec3s wanted = fr_light_sun_direction(azimuth, elevation);
    vec3s places[2000];
    g_assert_cmpuint(fr_light_sun_places(path, 2000, places), ==, 2000);
    float nearest = -1;
    for (size_t i = 0; i < 2000; i++) {
        nearest = fmaxf(nearest, glms_vec3_dot(places[i], wanted));
        g_assert_cmpfloat(places[i].z, >=, 0);
    }
    g_assert_cmpfloat(acos(fmin((double)nearest, 1)) / DEGREE, <, 0.1);
    // The morning is in the east, the evening mirrors it.
    g_assert_cmpfloat(places[0].x, >, 0);
    assert_near((double)(places[10].x + places[1989].x), 0, 1e-5);
    assert_near((double)(places[10].z - places[1989].z), 0, 1e-5);
}

static void test_polar_night(void) {
    vec3s place = {{7, 7, 7}};
    FrSunPath night = {80 * DEGREE, -23 * DEGREE};
    g_assert_cmpuint(fr_light_sun_places(night, 1, &place), ==, 0);
    g_assert_cmpfloat(place.x, ==, 7);
    FrSunPath day = {80 * DEGREE, 23 * DEGREE};
    vec3s places[12];
    g_assert_cmpuint(fr_light_sun_places(day, 12, places), ==, 12);
    for (int i = 0; i < 12; i++) {
        g_assert_cmpfloat(places[i].z, >, 0);
    }
}

/// Meinel: 1.353 · 0.7 kW/m² in the zenith; Kasten and Young: an air mass of 37.92 on the horizon.
static void test_sunlight(void) {
    assert_near(fr_light_sunlight(G_PI_2), 1.353 * 0.7, 1e-3);
    assert_near(fr_light_sunlight(1e-9), 1.353 * pow(0.7, pow(37.92, 0.678)), 1e-3);
    g_assert_cmpfloat(fr_light_sunlight(-0.01), ==, 0);
}

static size_t count_lamps(const FrLamp *lamps, size_t count, FrLampKind kind, double *power) {
    size_t found = 0;
    *power = 0;
    for (size_t i = 0; i < count; i++) {
        found += lamps[i].kind == kind;
        *power += lamps[i].kind == kind ? lamps[i].power : 0;
    }
    return found;
}

static void test_day(void) {
    FrLamp lamps[16];
    FrSunPath path = {0, 0};
    double power;
    size_t count = fr_light_day(FR_SKY_CLEAR, path, 8, 2, 1, lamps);
    g_assert_cmpuint(count, ==, 16);
    g_assert_cmpuint(count_lamps(lamps, count, FR_LAMP_SUN, &power), ==, 8);
    double suns = power;
    g_assert_cmpuint(count_lamps(lamps, count, FR_LAMP_SKY, &power), ==, 8);
    assert_near(suns, 20 * power, 1e-9);
    g_assert_cmpuint(fr_light_day(FR_SKY_OVERCAST, path, 8, 1, 1, lamps), ==, 1);
    g_assert_cmpint(lamps[0].sky, ==, FR_SKY_OVERCAST);
    g_assert_cmpuint(fr_light_day(FR_SKY_UNIFORM, path, 8, 1, 1, lamps), ==, 9);
    FrSunPath night = {80 * DEGREE, -23 * DEGREE};
    g_assert_cmpuint(fr_light_day(FR_SKY_CLEAR, night, 8, 1, 1, lamps), ==, 0);
    g_assert_cmpuint(fr_light_day(FR_SKY_UNIFORM, night, 8, 1, 1, lamps), ==, 1);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/sun/its declination is that of Meeus' example", test_declination);
    g_test_add_func("/light/sun/its place is that of the published example", test_published_place);
    g_test_add_func("/light/sun/it stands highest in the south at noon", test_noon);
    g_test_add_func("/light/sun/its path leads through the place it was made for",
                    test_path_through_place);
    g_test_add_func("/light/sun/a polar night has no places and a polar day has them all",
                    test_polar_night);
    g_test_add_func("/light/sun/sunlight follows the air mass", test_sunlight);
    g_test_add_func("/light/sun/a day is suns and skies", test_day);
    return g_test_run();
}
