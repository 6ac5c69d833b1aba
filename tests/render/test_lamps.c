/// Light of lamps in pictures, against formulas.
#include "render/path.h"

#include "world_by_hand.h"

#include <math.h>

#define SOLAR_CONSTANT 1361.0

/// The mean light along a ray.
static double look_along(const FrWorld *world, vec3s origin, vec3s direction, uint32_t samples,
                         uint32_t bounces) {
    double sum = 0;
    for (uint32_t i = 0; i < samples; i++) {
        FrSampler sampler = fr_sampler(3, 4, i, samples);
        FrPathSample sample = fr_path_trace(world, origin, direction, &sampler, bounces);
        sum += (double)fr_luminance(sample.radiance) / samples;
    }
    return sum;
}

static FrWorld *world_with(const FrLampParams *lamp, FrMesh *mesh, float albedo) {
    GPtrArray *lamps = g_ptr_array_new();
    g_ptr_array_add(lamps, (void *)lamp);
    FrSurroundings around = {.lamps = lamps};
    FrWorld *world = fr_world_new(fr_sky_new_uniform(glms_vec3_zero(), true), NULL);
    world->lamps = fr_lamps_new(&around, world->origin);
    uint32_t index = fr_world_add_mesh(world, mesh, matt((vec3s){{albedo, albedo, albedo}}, 0));
    fr_world_add_stand(world, index, glms_mat4_identity());
    fr_world_commit(world);
    g_ptr_array_unref(lamps);
    return world;
}

static FrLampParams lamp_above(int kind, double power) {
    FrLampParams lamp;
    fr_params_init(fr_lamp_table(), &lamp);
    lamp.kind = kind;
    lamp.power = power;
    lamp.at = (vec3s){{0, 0, 4}};
    lamp.width = lamp.height = 0.05;
    return lamp;
}

/// ρ/π times Φ/4πd², Φ/2π(1 − cos α)d² and Φ/πd², in parts of the solar constant.
static void test_plate(void) {
    double alpha = 40 * G_PI / 180;
    double shares[3] = {1 / (4 * G_PI), 1 / (2 * G_PI * (1 - cos(alpha))), 1 / G_PI};
    for (int kind = 0; kind < 3; kind++) {
        FrLampParams lamp = lamp_above(kind, 100);
        FrWorld *world = world_with(&lamp, square(), 0.5f);
        vec3s slant = glms_vec3_normalize((vec3s){{0, 1, -1}});
        double seen = look_along(world, (vec3s){{0, -1, 1}}, slant, 256, 0);
        double wanted = 0.5 / G_PI * 100 / SOLAR_CONSTANT * shares[kind] / 16;
        g_assert_cmpfloat_with_epsilon(seen, wanted, 0.01 * wanted);
        fr_world_free(world);
        fr_params_clear(fr_lamp_table(), &lamp);
    }
}

/// In a ball of albedo ρ with a lamp in the middle every place has Φ / A(1 − ρ).
static void test_integrating_sphere(void) {
    FrLampParams lamp = lamp_above(0, 100);
    lamp.at = glms_vec3_zero();
    FrWorld *world = world_with(&lamp, sphere(), 0.5f);
    vec3s aside = glms_vec3_normalize((vec3s){{0.3f, 0.5f, 0.2f}});
    double seen = look_along(world, (vec3s){{0.5f, 0, 0}}, aside, 8192, 64);
    double wanted = 0.5 / G_PI * 100 / SOLAR_CONSTANT / (4 * G_PI * (1 - 0.5));
    g_assert_cmpfloat_with_epsilon(seen, wanted, 0.03 * wanted);
    fr_world_free(world);
    fr_params_clear(fr_lamp_table(), &lamp);
}

/// A lamp is seen with the radiance that it lights with, from in front only.
static void test_seen(void) {
    FrLampParams lamp = lamp_above(2, 100);
    FrWorld *world = world_with(&lamp, square(), 0.5f);
    vec3s up = {{0, 0, 1}}, down = {{0, 0, -1}};
    double wanted = 100 / SOLAR_CONSTANT / (G_PI * 0.05 * 0.05);
    double limit = 60 * (double)fr_luminance(world->white) / G_PI;
    double seen = look_along(world, (vec3s){{0, 0, 1}}, up, 1, 3);
    g_assert_cmpfloat_with_epsilon(seen, fmin(wanted, limit), 1e-3 * wanted);
    g_assert_cmpfloat(look_along(world, (vec3s){{0, 0, 6}}, down, 1, 3), ==, 0);
    fr_world_free(world);
    fr_params_clear(fr_lamp_table(), &lamp);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/lamps/a plate shows what each lamp brings to it", test_plate);
    g_test_add_func("/render/lamps/walls light each other as in an integrating sphere",
                    test_integrating_sphere);
    g_test_add_func("/render/lamps/a lamp is seen from in front", test_seen);
    return g_test_run();
}
