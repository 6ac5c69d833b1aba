/// Views of the sky: how much is seen, from where, through what.
#include "frond/daylight.h"
#include "frond/sky_views.h"

#include "rectangles.h"

#include <math.h>
#include <string.h>

static const FrLamp even_sky = {.kind = FR_LAMP_SKY, .power = 1, .sky = FR_SKY_UNIFORM};

static FrLightAnswer ask(const FrLightScene *scene, const FrSkyViewSettings *settings, vec3s at) {
    FrContext context = fr_context_default();
    FrLight *light = fr_sky_views_new(settings);
    FrLightAnswer answer;
    g_assert_cmpint(fr_light_set_scene(light, scene, &context), ==, FR_OK);
    g_assert_cmpint(fr_light_query(light, &at, 1, &context, &answer), ==, FR_OK);
    fr_light_free(light);
    return answer;
}

static FrMesh *level_plate(float half, float height) {
    return rectangle((vec3s){{-half, -half, height}}, (vec3s){{2 * half, 0, 0}},
                     (vec3s){{0, 2 * half, 0}});
}

static void test_open_sky(void) {
    FrLamp lamps[17];
    Plate plate;
    plate_init(&plate, level_plate(1, -5), lamps, 0);
    FrSkyViewSettings settings = fr_sky_views_default();
    for (int sky = FR_SKY_UNIFORM; sky <= FR_SKY_CLEAR; sky++) {
        FrSunPath path = {0.8, 0.3};
        plate.scene.lamp_count = (uint32_t)fr_light_day((FrSkyKind)sky, path, 8, 1, 1, lamps);
        FrLightAnswer answer = ask(&plate.scene, &settings, (vec3s){{0, 0, 0}});
        g_assert_cmpfloat_with_epsilon(answer.intensity, 1, 1e-5f);
        g_assert_cmpuint(answer.samples, ==, 20);
    }
    plate_clear(&plate);
}

/// E07: an opaque plate above a bud gives no light.
static void test_plate(void) {
    Plate plate;
    plate_init(&plate, level_plate(5000, 1), &even_sky, 1);
    FrSkyViewSettings settings = fr_sky_views_default();
    FrLightAnswer answer = ask(&plate.scene, &settings, (vec3s){{0, 0, 0}});
    g_assert_cmpfloat(answer.intensity, ==, 0);
    g_assert_cmpfloat(glms_vec3_norm(answer.direction), ==, 0);
    // From above it is not in the way; what is as near as the stem is not either.
    g_assert_cmpfloat(ask(&plate.scene, &settings, (vec3s){{0, 0, 2}}).intensity, ==, 1);
    settings.near = 5e5f;
    g_assert_cmpfloat(ask(&plate.scene, &settings, (vec3s){{0, 0, 0}}).intensity, ==, 1);
    plate_clear(&plate);
}

/// E07: a wall that hides half the sky leaves 0.4 to 0.6 of it, and the light comes from the other
/// side.
static void test_wall(void) {
    Plate plate;
    plate_init(
        &plate,
        rectangle((vec3s){{1e-3f, -5000, -1}}, (vec3s){{0, 10000, 0}}, (vec3s){{0, 0, 10000}}),
        &even_sky, 1);
    FrSkyViewSettings settings = {.count = 20, .is_even = true, .near = 1e-4f};
    FrLightAnswer answer = ask(&plate.scene, &settings, (vec3s){{0, 0, 0}});
    g_assert_cmpfloat(answer.intensity, >=, 0.4f);
    g_assert_cmpfloat(answer.intensity, <=, 0.6f);
    g_assert_cmpfloat(answer.direction.x, <, -0.3f);
    // n of m: every view counts the same.
    g_assert_cmpfloat_with_epsilon(answer.intensity, (float)answer.samples / 20, 1e-6f);
    plate_clear(&plate);
}

/// Two leaves that let through 0.5 and 0.3 leave 0.15 of the light; a hole leaves it all.
static bool hole_at_right(void *user, uint32_t mask, float s, float t) {
    (void)user, (void)t;
    return mask == 7 && s > 0.5f;
}

static void test_leaves(void) {
    Plate plate;
    plate_init(&plate, level_plate(5000, 0), &even_sky, 1);
    FrLightMesh meshes[2] = {plate.lit, plate.lit};
    FrLightMaterial materials[2] = {
        {.front = {.transmit_diffuse = 0.9f}, .back = {.transmit_diffuse = 0.9f}},
        {.front = {.transmit_diffuse = 0.2f, .transmit_specular = 0.1f},
         .back = {.transmit_diffuse = 0.9f}}};
    materials[0].front.transmit_diffuse = 0.5f;
    meshes[0].materials = &materials[0];
    meshes[1].materials = &materials[1];
    FrLightStand stands[2] = {{0, glms_translate(glms_mat4_identity(), (vec3s){{0, 0, 1}})},
                              {1, glms_translate(glms_mat4_identity(), (vec3s){{0, 0, 2}})}};
    FrLightScene scene = plate.scene;
    scene.meshes = meshes;
    scene.stands = stands;
    scene.mesh_count = scene.stand_count = 2;
    FrLamp noon = {.kind = FR_LAMP_SUN, .power = 3, .direction = {{0.001f, 0.002f, -1}}};
    scene.lamps = &noon;
    FrSkyViewSettings settings = fr_sky_views_default();
    FrLightAnswer answer = ask(&scene, &settings, (vec3s){{0, 0, 0}});
    g_assert_cmpfloat_with_epsilon(answer.intensity, 0.15f, 1e-5f);
    materials[0].mask = materials[1].mask = 7;
    scene.mask = hole_at_right;
    answer = ask(&scene, &settings, (vec3s){{100, -100, 0}});
    g_assert_cmpfloat(answer.intensity, ==, 1);
    plate_clear(&plate);
}

/// The brightest spot is the sun where it can be seen.
static void test_brightest(void) {
    vec3s to_sun = glms_vec3_normalize((vec3s){{0.5f, 0.3f, 0.7f}});
    FrLamp lamps[2] = {{.kind = FR_LAMP_SUN, .power = 1, .direction = glms_vec3_negate(to_sun)},
                       {.kind = FR_LAMP_SKY, .power = 0.1, .sky = FR_SKY_CLEAR, .sun = to_sun}};
    Plate plate;
    plate_init(&plate, level_plate(1, -5), lamps, 2);
    FrSkyViewSettings settings = fr_sky_views_default();
    FrLightAnswer answer = ask(&plate.scene, &settings, (vec3s){{0, 0, 0}});
    g_assert_cmpfloat(glms_vec3_dot(answer.direction, to_sun), >, 0.99999f);
    g_assert_cmpfloat(answer.confidence, >, 0.8f);
    plate_clear(&plate);
}

/// Φ / 4πr² from a point, Φ / 2π(1 − cos α) r² within a cone, and Φ cos / πr² from a small area.
static void test_lamps(void) {
    float side = 0.01f;
    vec3s at = {{0, 0, 3}}, down = {{0, 0, -1}};
    FrLamp lamps[3] = {{.kind = FR_LAMP_POINT, .power = 10, .position = at},
                       {.kind = FR_LAMP_SPOT, .power = 10, .position = at},
                       {.kind = FR_LAMP_AREA, .power = 10}};
    lamps[1].direction = down;
    lamps[1].angle = 0.5f;
    lamps[2].position = (vec3s){{-side / 2, -side / 2, 3}};
    lamps[2].side[0] = (vec3s){{0, side, 0}};
    lamps[2].side[1] = (vec3s){{side, 0, 0}};
    double wanted[3] = {10 / (4 * G_PI * 9), 10 / (2 * G_PI * (1 - cos(0.5)) * 9), 10 / (G_PI * 9)};
    FrSkyViewSettings settings = fr_sky_views_default();
    for (int i = 0; i < 3; i++) {
        Plate plate;
        plate_init(&plate, level_plate(1, -5), &lamps[i], 1);
        FrLightAnswer answer = ask(&plate.scene, &settings, (vec3s){{0, 0, 0}});
        g_assert_cmpfloat_with_epsilon((double)answer.intensity, wanted[i], 1e-4 * wanted[i]);
        g_assert_cmpfloat(answer.direction.z, >, 0.9999f);
        // Behind an area and outside of a cone it is dark.
        answer = ask(&plate.scene, &settings, (vec3s){{0, 0, 6}});
        g_assert_true((answer.intensity > 0) == (i == 0));
        // A probe at the reference reads 1.
        plate.scene.has_reference = true;
        plate.scene.reference = (vec3s){{0.3f, 0, 1}};
        g_assert_cmpfloat(ask(&plate.scene, &settings, plate.scene.reference).intensity, ==, 1);
        plate_clear(&plate);
    }
}

static void test_threads(void) {
    enum { COUNT = 500 };
    FrLamp lamps[17];
    FrSunPath path = {0.8, 0.3};
    Plate plate;
    plate_init(&plate, level_plate(2, 1), lamps, 0);
    plate.scene.lamp_count = (uint32_t)fr_light_day(FR_SKY_CLEAR, path, 8, 1, 1, lamps);
    vec3s points[COUNT];
    for (int i = 0; i < COUNT; i++) {
        points[i] = (vec3s){{(float)(i % 25) * 0.2f - 2.5f, (float)(i / 25) * 0.2f - 2, 0}};
    }
    FrLightAnswer answers[2][COUNT];
    static const int threads[] = {1, 2, 3, 8};
    for (size_t t = 0; t < G_N_ELEMENTS(threads); t++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[t]);
        FrSkyViewSettings settings = fr_sky_views_default();
        FrLight *light = fr_sky_views_new(&settings);
        g_assert_cmpint(fr_light_set_scene(light, &plate.scene, &context), ==, FR_OK);
        g_assert_cmpint(fr_light_query(light, points, COUNT, &context, answers[t > 0]), ==, FR_OK);
        g_assert_cmpuint(fr_light_stats(light).rays, ==, UINT64_C(20) * COUNT);
        g_assert_true(memcmp(answers[0], answers[t > 0], sizeof answers[0]) == 0);
        fr_light_free(light);
        fr_pool_free(context.pool);
    }
    plate_clear(&plate);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/sky_views/the open sky is one, whatever its kind", test_open_sky);
    g_test_add_func("/light/sky_views/an opaque plate leaves no light", test_plate);
    g_test_add_func("/light/sky_views/a wall leaves half the sky, and light comes from the other",
                    test_wall);
    g_test_add_func("/light/sky_views/leaves let light through and holes all of it", test_leaves);
    g_test_add_func("/light/sky_views/the brightest spot is the sun", test_brightest);
    g_test_add_func("/light/sky_views/lamps fade with the square of distance", test_lamps);
    g_test_add_func("/light/sky_views/the bits are the same for any number of threads",
                    test_threads);
    return g_test_run();
}
