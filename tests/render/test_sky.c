#include "render/sky.h"

#include "render/colour.h"
#include "render/sampler.h"

#include <math.h>

static FrSceneParams scene(double elevation, double turbidity) {
    return (FrSceneParams){.sun_azimuth = 0.5 * G_PI,
                           .sun_elevation = elevation * (G_PI / 180.0),
                           .sun_strength = 1,
                           .sky_strength = 1,
                           .turbidity = turbidity};
}

static FrSky *make(double elevation, double turbidity) {
    FrSceneParams params = scene(elevation, turbidity);
    FrContext context = fr_context_default();
    return fr_sky_new(&params, true, &context);
}

static void assert_usable(const FrSky *sky) {
    for (size_t i = 0; i < (size_t)sky->columns * sky->rows; i++) {
        for (int c = 0; c < 3; c++) {
            g_assert_true(isfinite(sky->radiance[i].raw[c]) && sky->radiance[i].raw[c] >= 0.0f);
        }
    }
    g_assert_true(fr_luminance(sky->flat_irradiance) > 0.0f);
}

static void test_range(void) {
    static const double elevations[] = {-10, -1, 0, 20, 90};
    static const double turbidities[] = {1, 10};
    for (size_t e = 0; e < G_N_ELEMENTS(elevations); e++) {
        for (size_t t = 0; t < G_N_ELEMENTS(turbidities); t++) {
            FrSky *sky = make(elevations[e], turbidities[t]);
            assert_usable(sky);
            fr_sky_free(sky);
        }
    }
}

static void test_direction(void) {
    FrSky *sky = make(30, 3);
    // Azimuth 90° clockwise from +y is +x.
    g_assert_cmpfloat_with_epsilon(sky->sun_direction.x, cos(G_PI / 6), 1e-6);
    g_assert_cmpfloat_with_epsilon(sky->sun_direction.y, 0.0, 1e-6);
    g_assert_cmpfloat_with_epsilon(sky->sun_direction.z, 0.5, 1e-6);
    fr_sky_free(sky);
}

// Rayleigh's optical depth at 550 nm is 13.558e-6/m × 8 km = 0.1085 and ozone's 1.881e-6/m × 15 km
// = 0.0282; straight up through clean air e^−0.1367 of green light arrives.
static void test_sunlight(void) {
    FrSky *clean = make(90, 1);
    g_assert_cmpfloat_with_epsilon(clean->sun_irradiance.g, exp(-0.1367), 0.003);
    fr_sky_free(clean);
    FrSky *high = make(60, 3);
    FrSky *low = make(5, 3);
    g_assert_cmpfloat(low->sun_irradiance.g, <, 0.4f * high->sun_irradiance.g);
    g_assert_cmpfloat(low->sun_irradiance.b / low->sun_irradiance.r, <,
                      0.4f * high->sun_irradiance.b / high->sun_irradiance.r);
    fr_sky_free(high);
    fr_sky_free(low);
    FrSky *set = make(-5, 3);
    g_assert_true(fr_is_black(set->sun_irradiance));
    fr_sky_free(set);
}

static void test_blue(void) {
    FrSky *sky = make(40, 2);
    vec3s high = fr_sky_radiance(sky, glms_vec3_normalize((vec3s){{-0.5f, 0, 0.9f}}));
    vec3s horizon = fr_sky_radiance(sky, glms_vec3_normalize((vec3s){{-1, 0, 0.03f}}));
    g_assert_cmpfloat(high.b, >, 1.5f * high.g);
    g_assert_cmpfloat(high.g, >, 1.5f * high.r);
    g_assert_cmpfloat(fr_luminance(horizon), >, fr_luminance(high));
    g_assert_cmpfloat(horizon.b / horizon.r, <, 0.6f * high.b / high.r);
    fr_sky_free(sky);
}

// A clear sky gives level ground some 10 to 25 % of its light when the sun is high.
static void test_share(void) {
    FrSky *sky = make(50, 3);
    float sun = fr_luminance(sky->sun_irradiance) * sky->sun_direction.z;
    float share = 1.0f - sun / fr_luminance(sky->flat_irradiance);
    g_assert_cmpfloat(share, >, 0.10f);
    g_assert_cmpfloat(share, <, 0.25f);
    fr_sky_free(sky);
}

static void test_sampling(void) {
    FrSky *sky = make(25, 4);
    double sum[3] = {0, 0, 0};
    double whole = 0.0;
    enum { COUNT = 1 << 15 };
    for (uint32_t i = 0; i < COUNT; i++) {
        FrSampler sampler = fr_sampler(0, 0, i, COUNT);
        float u;
        float v;
        fr_sampler_pair(&sampler, &u, &v);
        float density;
        vec3s direction = fr_sky_sample(sky, u, v, &density);
        g_assert_cmpfloat(density, >, 0.0f);
        g_assert_cmpfloat(direction.z, >=, 0.0f);
        g_assert_cmpfloat_with_epsilon(glms_vec3_norm(direction), 1.0, 1e-5);
        vec3s light = fr_sky_radiance(sky, direction);
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)(light.raw[c] * direction.z / density) / COUNT;
        }
        fr_sampler_pair(&sampler, &u, &v);
        float z = 2.0f * u - 1.0f;
        float turn = 2.0f * FR_PI_F * v;
        float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
        vec3s anywhere = {{side * cosf(turn), side * sinf(turn), z}};
        whole += (double)(fr_sky_density(sky, anywhere) * 4.0f * FR_PI_F) / COUNT;
    }
    g_assert_cmpfloat_with_epsilon(whole, 1.0, 0.02);
    for (int c = 0; c < 3; c++) {
        double flat = (double)(sky->flat_irradiance.raw[c] -
                               sky->sun_irradiance.raw[c] * sky->sun_direction.z);
        g_assert_cmpfloat_with_epsilon(sum[c] / flat, 1.0, 0.01);
    }
    fr_sky_free(sky);
}

static void test_dark(void) {
    FrSky *sky = fr_sky_new_uniform(glms_vec3_zero(), true);
    float density = 1.0f;
    vec3s direction = fr_sky_sample(sky, 0.3f, 0.999f, &density);
    g_assert_cmpfloat(density, ==, 0.0f);
    g_assert_true(isfinite(direction.x));
    fr_sky_free(sky);
}

static void test_uniform(void) {
    vec3s light = {{0.25f, 0.5f, 2.0f}};
    FrSky *sky = fr_sky_new_uniform(light, false);
    for (int c = 0; c < 3; c++) {
        g_assert_cmpfloat_with_epsilon(sky->flat_irradiance.raw[c], FR_PI_F * light.raw[c], 1e-4);
    }
    vec3s seen = fr_sky_radiance(sky, (vec3s){{0.6f, 0.0f, 0.8f}});
    g_assert_cmpfloat_with_epsilon(seen.b, 2.0, 1e-6);
    g_assert_true(fr_is_black(fr_sky_radiance(sky, (vec3s){{0.6f, 0.0f, -0.8f}})));
    fr_sky_free(sky);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/sky/any sun and haze give finite light", test_range);
    g_test_add_func("/render/sky/azimuths go clockwise from +y", test_direction);
    g_test_add_func("/render/sky/a low sun is dim and red", test_sunlight);
    g_test_add_func("/render/sky/the sky is blue above and pale at the horizon", test_blue);
    g_test_add_func("/render/sky/a clear sky gives its share of the light", test_share);
    g_test_add_func("/render/sky/samples integrate to the sky's light", test_sampling);
    g_test_add_func("/render/sky/a black sky is never sampled", test_dark);
    g_test_add_func("/render/sky/a uniform sky lights level ground with π times its radiance",
                    test_uniform);
    return g_test_run();
}
