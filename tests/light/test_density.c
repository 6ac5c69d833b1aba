// The physics of ray density: what the laws of light say must come out.
#include "light/density.h"
#include "light_scenes.h"

static double total_of(const FrLight *light, TestScene *test) {
    double sum = 0.0;
    for (uint32_t s = 0; s < test->stands->len; s++) {
        const double *absorbed = fr_light_absorbed(light, s);
        const FrLightMesh *mesh = &g_array_index(test->meshes, FrLightMesh,
                                                 g_array_index(test->stands, FrLightStand, s).mesh);
        for (uint32_t i = 0; i < mesh->element_count; i++) {
            sum += absorbed[i];
        }
    }
    return sum;
}

// Each photon runs 1 / (1 − a) rays on average, each with its whole power.
static void test_furnace(void) {
    FrContext context = fr_context_default();
    static const float albedos[3] = {0.0f, 0.5f, 0.9f};
    for (int i = 0; i < 3; i++) {
        TestScene *test = test_scene_new();
        add_cube(test, 2, alike(albedos[i], 0, 0, 0));
        add_lamp(test,
                 (FrLamp){.kind = FR_LAMP_POINT, .power = 7, .position = {{0.3f, 0.1f, -0.2f}}});
        FrDensityParams params = fr_density_default();
        params.photons = 100000;
        params.bounces = 1000;
        FrLight *light = light_of(&params, test, &context);
        double stored = 7.0 * (double)fr_light_stats(light).rays / 100000;
        double expected = 7.0 / (1.0 - (double)albedos[i]);
        g_assert_cmpfloat(fabs(stored / expected - 1.0), <, 0.01);
        g_assert_cmpfloat(fabs(total_of(light, test) / 7.0 - 1.0), <, 0.01);
        fr_light_free(light);
        test_scene_free(test);
    }
}

// Six shining walls of albedo a: everywhere within, radiance is M / (π (1 − a)) from every side,
// so the fluence is 4 M / (1 − a).
static void test_uniform_field(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    add_cube(test, 2, alike(0.5f, 0, 0, 0));
    vec3s corners[24];
    cube_faces(1.9998f, corners);
    for (int f = 0; f < 6; f++) {
        const vec3s *c = &corners[4 * f];
        add_lamp(test, (FrLamp){.kind = FR_LAMP_AREA,
                                .power = 1,
                                .position = c[0],
                                .side = {glms_vec3_sub(c[1], c[0]), glms_vec3_sub(c[3], c[0])}});
    }
    double truth = 4.0 * (1.0 / (1.9998 * 1.9998)) / 0.5;
    for (int estimator = 0; estimator < 3; estimator++) {
        FrDensityParams params = fr_density_default();
        params.photons = 100000;
        params.estimator = estimator;
        params.neighbours = 400;
        FrLight *light = light_of(&params, test, &context);
        static const vec3s places[4] = {
            {{0, 0, 0}}, {{0.5f, 0.4f, 0.1f}}, {{-0.8f, 0, 0.8f}}, {{0.1f, 0.7f, -0.7f}}};
        for (int p = 0; p < 4; p++) {
            FrLightAnswer answer = ask(light, places[p], &context);
            double allowed = 2.0 / sqrt((double)answer.samples);
            g_assert_cmpuint(answer.samples, >, 300);
            g_assert_cmpfloat(fabs((double)answer.intensity / truth - 1.0), <, allowed);
            g_assert_cmpfloat((double)answer.confidence, <, 1.5 * allowed);
        }
        fr_light_free(light);
    }
    test_scene_free(test);
}

// The lamp is far, so that it has one direction for the whole ball.
static void test_direction(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    vec3s lamp = {{3, -4, 12}};
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SPOT,
                            .power = 100,
                            .position = lamp,
                            .direction = glms_vec3_negate(lamp),
                            .angle = 0.1f});
    add_plate(test, (vec3s){{0, 0, -1}}, 4, alike(0, 0, 0, 0));
    FrDensityParams params = fr_density_default();
    params.photons = 4700;
    params.distance = 0.6;
    FrLight *light = light_of(&params, test, &context);
    FrLightAnswer answer = ask(light, (vec3s){{0, 0, 0}}, &context);
    g_assert_cmpuint(answer.samples, >, 900);
    g_assert_cmpuint(answer.samples, <, 1100);
    vec3s truth = glms_vec3_normalize(lamp);
    g_assert_cmpfloat(acos((double)glms_vec3_dot(truth, answer.direction)), <, 2.0 * G_PI / 180);
    g_assert_cmpfloat((double)answer.confidence, >, 0.99);
    // The fluence is the power over the part of a sphere that it reaches.
    double expected = 100.0 / (2.0 * G_PI * (1.0 - cos(0.1)) * 169.0);
    g_assert_cmpfloat(fabs((double)answer.intensity / expected - 1.0), <,
                      2.0 / sqrt((double)answer.samples));
    fr_light_free(light);
    test_scene_free(test);
}

static void test_reference(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    add_cube(test, 2, alike(0.6f, 0.1f, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_POINT, .power = 5, .position = {{0, 0, 0.9f}}});
    test->scene.has_reference = true;
    test->scene.reference = (vec3s){{0.1f, 0.2f, 0.3f}};
    FrDensityParams params = fr_density_default();
    for (params.estimator = 0; params.estimator < 3; params.estimator++) {
        FrLight *light = light_of(&params, test, &context);
        g_assert_cmpfloat(ask(light, test->scene.reference, &context).intensity, ==, 1.0f);
        g_assert_cmpfloat(ask(light, (vec3s){{-0.8f, -0.8f, -0.8f}}, &context).intensity, <, 1.0f);
        fr_light_free(light);
    }
    test_scene_free(test);
}

static void test_dark_reference(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    TestScene *test = test_scene_new();
    add_plate(test, (vec3s){{0, 0, 0}}, 4, alike(0, 0, 0, 0));
    test->scene.has_reference = true;
    FrDensityParams params = fr_density_default();
    FrLight *light = NULL;
    g_assert_cmpint(fr_light_density_new(&params, &context, &light), ==, FR_OK);
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_ERR_DOCUMENT);
    fr_light_free(light);
    test_scene_free(test);
    fr_diags_free(context.diags);
}

static void test_plate(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    add_plate(test, (vec3s){{0, 0, 1}}, 2, alike(0, 0, 0, 0));
    add_plate(test, (vec3s){{0, 0, 0}}, 2, alike(0, 0, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SUN, .power = 3, .direction = {{0, 0, -2}}});
    FrDensityParams params = fr_density_default();
    for (params.estimator = 0; params.estimator < 3; params.estimator += 2) {
        FrLight *light = light_of(&params, test, &context);
        FrLightAnswer under = ask(light, (vec3s){{0, 0, 0.5f}}, &context);
        g_assert_cmpfloat(under.intensity, ==, 0.0f);
        g_assert_cmpuint(under.samples, ==, 0);
        g_assert_cmpfloat(glms_vec3_norm(under.direction), ==, 0.0f);
        // The upper plate takes all that falls on its four square metres, the lower one nothing.
        g_assert_cmpfloat_with_epsilon(*fr_light_absorbed(light, 0), 12.0, 1e-9);
        g_assert_cmpfloat(*fr_light_absorbed(light, 1), ==, 0.0);
        fr_light_free(light);
    }
    test_scene_free(test);
}

// Whatever the materials, a photon ends on a surface or leaves.
static void test_energy(void) {
    FrContext context = fr_context_default();
    for (uint32_t mix = 0; mix < 6; mix++) {
        TestScene *test = test_scene_new();
        FrKey key = fr_key_root(mix);
        add_cube(test, 2, alike(0.5f, 0.2f, 0.1f, 0.1f));
        for (uint32_t m = 0; m < 4; m++) {
            float part[4], sum = 0.0f;
            for (uint32_t i = 0; i < 4; i++) {
                part[i] = (float)fr_random(key, m, i);
                sum += part[i];
            }
            float scale = (float)fr_random(key, m, 4) / sum;
            add_leaves(test, 40, 10 * mix + m, (vec3s){{-0.9f, -0.9f, -0.9f}},
                       (vec3s){{0.9f, 0.9f, 0.9f}}, 0.3f,
                       alike(scale * part[0], scale * part[1], scale * part[2], scale * part[3]));
        }
        add_lamp(test, (FrLamp){.kind = FR_LAMP_POINT, .power = 2});
        add_lamp(test, (FrLamp){.kind = FR_LAMP_SPOT,
                                .power = 3,
                                .position = {{0.5f, 0, 0.5f}},
                                .direction = {{0, 0, -1}},
                                .angle = 0.6f});
        FrDensityParams params = fr_density_default();
        params.photons = 50000;
        params.bounces = 1000;
        FrLight *light = light_of(&params, test, &context);
        const FrPaths *paths = ((FrDensity *)(void *)light)->paths;
        uint64_t escaped = 0, ended = 0;
        for (uint32_t i = 0; i < paths->count; i++) {
            const FrRay *ray = &paths->rays[i];
            escaped += ray->next == FR_NONE && ray->triangle == FR_NONE;
            ended += ray->next == FR_NONE && ray->triangle != FR_NONE;
        }
        g_assert_cmpuint(escaped + ended, ==, 50000);
        g_assert_cmpuint(escaped, >, 500);
        // The elements got what the photons brought, to the accuracy of so many of them.
        g_assert_cmpfloat(fabs(total_of(light, test) / (5.0 * (double)ended / 50000) - 1.0), <,
                          0.01);
        fr_light_free(light);
        test_scene_free(test);
    }
}

static double share(FrLamp lamp, vec3s point) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    add_plate(test, (vec3s){{0, 0, -1}}, 4, alike(0, 0, 0, 0));
    test->scene.min = (vec3s){{-2, -2, -1}};
    test->scene.max = (vec3s){{2, 2, 1}};
    add_lamp(test, lamp);
    FrDensityParams params = fr_density_default();
    params.photons = 400000;
    params.distance = 0.2;
    FrLight *light = light_of(&params, test, &context);
    double value = (double)ask(light, point, &context).intensity;
    fr_light_free(light);
    test_scene_free(test);
    return value;
}

static void test_lamps(void) {
    vec3s origin = {{0, 0, 0}};
    // A sun's fluence is what arrives on a surface that faces it.
    FrLamp sun = {.kind = FR_LAMP_SUN, .power = 5, .direction = {{1, 1, -1}}};
    g_assert_cmpfloat_with_epsilon(share(sun, origin), 5.0, 0.1);
    // Skies: level ground gets ∫ L z dω, a point ∫ L dω: 2, 12/7 of it under the overcast sky.
    FrLamp sky = {.kind = FR_LAMP_SKY, .power = 3};
    g_assert_cmpfloat_with_epsilon(share(sky, origin), 6.0, 0.2);
    sky.sky = FR_SKY_OVERCAST;
    g_assert_cmpfloat_with_epsilon(share(sky, origin), 36.0 / 7.0, 0.2);
    // A spot: its power over its cap of the sphere; nothing beside the cone.
    FrLamp spot = {.kind = FR_LAMP_SPOT,
                   .power = 2,
                   .position = {{0, 0, 2}},
                   .direction = {{0, 0, -1}},
                   .angle = 0.5f};
    double cap = 2.0 * G_PI * (1.0 - cos(0.5)) * 4.0;
    g_assert_cmpfloat_with_epsilon(share(spot, origin), 2.0 / cap, 0.02);
    g_assert_cmpfloat(share(spot, (vec3s){{1.5f, 0, 0}}), ==, 0.0);
    // An area lamp sends nothing behind itself; straight ahead M A / (π r²) for a small one.
    FrLamp area = {.kind = FR_LAMP_AREA,
                   .power = 2,
                   .position = {{-0.05f, -0.05f, 2}},
                   .side = {{{0, 0.1f, 0}}, {{0.1f, 0, 0}}}};
    g_assert_cmpfloat_with_epsilon(share(area, origin), 2.0 / (G_PI * 4.0), 0.02);
    area.position.z = -0.5f;
    g_assert_cmpfloat(share(area, origin), ==, 0.0);
}

static void test_translucent(void) {
    FrContext context = fr_context_default();
    static const FrLightMaterial materials[3] = {
        {.front = {.transmit_specular = 0.25f}},
        {.front = {.transmit_diffuse = 0.25f}},
        {.front = {.specular = 0.25f}},
    };
    for (int i = 0; i < 3; i++) {
        TestScene *test = test_scene_new();
        add_plate(test, (vec3s){{0, 0, 0}}, 4, materials[i]);
        test->scene.min = (vec3s){{-2, -2, -1}};
        test->scene.max = (vec3s){{2, 2, 1}};
        add_lamp(test, (FrLamp){.kind = FR_LAMP_SUN, .power = 1, .direction = {{0, 0, -1}}});
        FrDensityParams params = fr_density_default();
        params.photons = 400000;
        FrLight *light = light_of(&params, test, &context);
        // Just below a wide plate that scatters, fluence is twice what it lets through.
        static const float below[3] = {0.25f, 0.5f, 0.0f}, above[3] = {1, 1, 1.25f};
        FrLightAnswer under = ask(light, (vec3s){{0, 0, -0.11f}}, &context);
        FrLightAnswer over = ask(light, (vec3s){{0, 0, 0.11f}}, &context);
        g_assert_cmpfloat_with_epsilon(under.intensity, below[i], 0.03f);
        g_assert_cmpfloat_with_epsilon(over.intensity, above[i], 0.03f);
        g_assert_cmpfloat_with_epsilon(*fr_light_absorbed(light, 0), 12.0, 1e-6);
        fr_light_free(light);
        test_scene_free(test);
    }
}

static bool is_right_half(void *user, uint32_t mask, float s, float t) {
    *(int *)user += 1;
    return mask == 7 && s > 0.5f && t >= 0.0f && t <= 1.0f;
}

static void test_mask(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    FrLightMaterial masked = {.mask = 7};
    int calls = 0;
    add_plate(test, (vec3s){{0, 0, 1}}, 2, masked);
    add_plate(test, (vec3s){{0, 0, 0}}, 2, alike(0, 0, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SUN, .power = 1, .direction = {{0, 0, -1}}});
    test->scene.mask = is_right_half;
    test->scene.mask_user = &calls;
    FrDensityParams params = fr_density_default();
    FrLight *light = light_of(&params, test, &context);
    g_assert_cmpint(calls, >=, 200000);
    g_assert_cmpfloat(ask(light, (vec3s){{-0.5f, 0.3f, 0.5f}}, &context).intensity, ==, 0.0f);
    g_assert_cmpfloat_with_epsilon(ask(light, (vec3s){{0.5f, 0.3f, 0.5f}}, &context).intensity,
                                   1.0f, 0.03f);
    g_assert_cmpfloat_with_epsilon(*fr_light_absorbed(light, 0), 2.0, 0.01);
    fr_light_free(light);
    test_scene_free(test);
}

static void test_limits(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrDensityParams params = fr_density_default();
    FrLight *light = NULL;
    context.limits.photons = 1000;
    g_assert_cmpint(fr_light_density_new(&params, &context, &light), ==, FR_ERR_LIMIT);
    g_assert_null(light);
    context.limits = fr_limits_default();
    TestScene *test = test_scene_new();
    add_cube(test, 2, alike(0.9f, 0, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_POINT, .power = 1});
    g_assert_cmpint(fr_light_density_new(&params, &context, &light), ==, FR_OK);
    context.limits.bytes = 1000000;
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_ERR_LIMIT);
    context.limits = fr_limits_default();
    context.limits.triangles = 11;
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_ERR_LIMIT);
    context.limits = fr_limits_default();
    context.limits.bytes = 2000;
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_ERR_LIMIT);
    // It is as good as new afterwards.
    context.limits = fr_limits_default();
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_OK);
    g_assert_cmpuint(fr_light_stats(light).photons, ==, 200000);
    fr_light_free(light);
    test_scene_free(test);
    fr_diags_free(context.diags);
}

static void test_nothing(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    FrDensityParams params = fr_density_default();
    params.photons = 10;
    FrLight *light = light_of(&params, test, &context);
    g_assert_cmpfloat(ask(light, (vec3s){{0, 0, 0}}, &context).intensity, ==, 0.0f);
    g_assert_cmpfloat(ask(light, (vec3s){{NAN, 0, 0}}, &context).intensity, ==, 0.0f);
    add_plate(test, (vec3s){{0, 0, 0}}, 0, alike(0, 0, 0, 0));
    add_plate(test, (vec3s){{NAN, 0, 0}}, 1, alike(0, 0, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SUN, .power = 1});
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SKY, .power = -1});
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_OK);
    g_assert_cmpfloat(ask(light, (vec3s){{1e9f, 0, 0}}, &context).intensity, ==, 0.0f);
    fr_light_free(light);
    test_scene_free(test);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/density/a closed white box stores its power over one less its albedo",
                    test_furnace);
    g_test_add_func("/light/density/in a uniform field all estimators tell the truth",
                    test_uniform_field);
    g_test_add_func("/light/density/one lamp is found within two degrees", test_direction);
    g_test_add_func("/light/density/a probe at the reference reads one", test_reference);
    g_test_add_func("/light/density/a dark reference is an error", test_dark_reference);
    g_test_add_func("/light/density/under an opaque plate there is nothing", test_plate);
    g_test_add_func("/light/density/every photon is absorbed or escapes", test_energy);
    g_test_add_func("/light/density/lamps and skies give what they are said to", test_lamps);
    g_test_add_func("/light/density/light goes through leaves and glass", test_translucent);
    g_test_add_func("/light/density/light goes through the holes of a mask", test_mask);
    g_test_add_func("/light/density/too much is refused and does no harm", test_limits);
    g_test_add_func("/light/density/empty and flat scenes are dark", test_nothing);
    return g_test_run();
}
