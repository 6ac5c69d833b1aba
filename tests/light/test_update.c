// A light that has followed a scene's changes is, bit for bit, a light made new for the scene.
#include "light/density.h"
#include "light_scenes.h"

#include <string.h>

enum { POINTS = 12 };

/// Everything a light knows: its paths, what elements absorbed, its answers.
typedef struct Knowledge {
    FrDigest paths, absorbed;
    uint64_t rays;
    FrLightAnswer answers[3 * POINTS];
} Knowledge;

static vec3s point_of(uint32_t i) {
    FrKey key = fr_key_child(fr_key_root(99), i);
    return (vec3s){{(float)fr_random_signed(key, 1, 0), (float)fr_random_signed(key, 1, 1),
                    (float)fr_random_signed(key, 1, 2)}};
}

static void learn(FrLight *light, TestScene *test, const FrContext *context, Knowledge *known) {
    FrDensity *density = (FrDensity *)(void *)light;
    vec3s points[POINTS];
    memset(known, 0, sizeof *known);
    known->paths = fr_paths_digest(density->paths);
    known->rays = fr_light_stats(light).rays;
    for (uint32_t s = 0; s < test->stands->len; s++) {
        const FrLightMesh *mesh = &g_array_index(test->meshes, FrLightMesh,
                                                 g_array_index(test->stands, FrLightStand, s).mesh);
        known->absorbed = fr_digest(known->absorbed, fr_light_absorbed(light, s),
                                    mesh->element_count * sizeof(double));
    }
    for (uint32_t i = 0; i < POINTS; i++) {
        points[i] = point_of(i);
    }
    for (int estimator = 0; estimator < 3; estimator++) {
        density->params.estimator = estimator;
        g_assert_cmpint(
            fr_light_query(light, points, POINTS, context, known->answers + estimator * POINTS), ==,
            FR_OK);
    }
    density->params.estimator = 0;
}

static void assert_same(const Knowledge *a, const Knowledge *b) {
    g_assert_cmphex(a->paths, ==, b->paths);
    g_assert_cmpuint(a->rays, ==, b->rays);
    g_assert_cmphex(a->absorbed, ==, b->absorbed);
    g_assert_cmpint(memcmp(a->answers, b->answers, sizeof a->answers), ==, 0);
}

static TestScene *room(void) {
    TestScene *test = test_scene_new();
    add_cube(test, 2.2f, alike(0.6f, 0.1f, 0, 0));
    add_plate(test, (vec3s){{0.2f, 0.1f, -0.2f}}, 0.8f, alike(0.4f, 0, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_AREA,
                            .power = 3,
                            .position = {{-0.3f, -0.3f, 1.0f}},
                            .side = {{{0, 0.6f, 0}}, {{0.6f, 0, 0}}}});
    add_lamp(test, (FrLamp){.kind = FR_LAMP_POINT, .power = 1, .position = {{0.9f, 0.9f, 0.3f}}});
    test->scene.min = (vec3s){{-1.1f, -1.1f, -1.1f}};
    test->scene.max = (vec3s){{1.1f, 1.1f, 1.1f}};
    return test;
}

static FrDensityParams few(void) {
    FrDensityParams params = fr_density_default();
    params.photons = 40000;
    params.neighbours = 200;
    return params;
}

// Follows the change and compares with a new light; returns how many rays were traced.
static uint64_t step(FrLight *light, TestScene *test, const FrContext *context) {
    Knowledge followed, made;
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), context), ==, FR_OK);
    uint64_t recast = fr_light_stats(light).recast;
    learn(light, test, context, &followed);
    FrDensityParams params = few();
    FrLight *fresh = light_of(&params, test, context);
    learn(fresh, test, context, &made);
    fr_light_free(fresh);
    assert_same(&followed, &made);
    return recast;
}

static const vec3s CORNER = {{-0.9f, -0.9f, -0.9f}}, MIDDLE = {{0.1f, 0.1f, 0.1f}};

static void test_growth(void) {
    FrContext context = fr_context_default();
    TestScene *test = room();
    FrDensityParams params = few();
    FrLight *light = light_of(&params, test, &context);
    uint64_t all = fr_light_stats(light).recast;
    g_assert_cmpuint(all, ==, fr_light_stats(light).rays);
    for (uint64_t i = 0; i < 8; i++) {
        add_leaves(test, 30, i, CORNER, MIDDLE, 0.06f, alike(0.1f, 0.05f, 0.2f, 0.1f));
        uint64_t recast = step(light, test, &context);
        g_assert_cmpuint(recast, >, 0);
        g_assert_cmpuint(recast, <, all / 3);
        fr_light_forget(light);
    }
    // Nothing new, nothing to do.
    g_assert_cmpuint(step(light, test, &context), ==, 0);
    fr_light_free(light);
    test_scene_free(test);
}

static void test_shedding(void) {
    FrContext context = fr_context_default();
    TestScene *test = room();
    FrDensityParams params = few();
    for (uint64_t i = 0; i < 6; i++) {
        add_leaves(test, 20, i, CORNER, MIDDLE, 0.08f, alike(0.1f, 0, 0.2f, 0));
    }
    FrLight *light = light_of(&params, test, &context);
    uint64_t all = fr_light_stats(light).recast;
    g_array_remove_index(test->stands, 3);
    g_assert_cmpuint(step(light, test, &context), <, all / 4);
    // A stand that moves leaves one place and comes to another; others change their numbers.
    g_array_index(test->stands, FrLightStand, 4).transform.m31 = 0.3f;
    g_array_remove_index(test->stands, 2);
    g_assert_cmpuint(step(light, test, &context), <, all / 4);
    // Other optics at the same place are another surface.
    ((FrLightMaterial *)g_array_index(test->meshes, FrLightMesh, 7).materials)->front.diffuse =
        0.9f;
    g_assert_cmpuint(step(light, test, &context), <, all / 4);
    g_array_set_size(test->stands, 2);
    g_assert_cmpuint(step(light, test, &context), <, all / 4);
    g_array_set_size(test->stands, 0);
    step(light, test, &context);
    fr_light_free(light);
    test_scene_free(test);
}

// The same surface twice, in one stand and in two, the first of which then goes.
static void test_coincident(void) {
    FrContext context = fr_context_default();
    TestScene *test = room();
    FrDensityParams params = few();
    add_leaves(test, 20, 5, CORNER, MIDDLE, 0.2f, alike(0.1f, 0, 0.2f, 0));
    FrLight *light = light_of(&params, test, &context);
    FrLightStand again = g_array_index(test->stands, FrLightStand, 2);
    g_array_append_val(test->stands, again);
    g_assert_cmpuint(step(light, test, &context), ==, 0);
    g_array_remove_index(test->stands, 2);
    g_assert_cmpuint(step(light, test, &context), ==, 0);
    // Other leaves in the same planes: which of two at one distance is met must not depend on
    // which came first.
    add_leaves(test, 20, 5, CORNER, MIDDLE, 0.1f, alike(0.7f, 0, 0, 0));
    step(light, test, &context);
    add_plate(test, (vec3s){{0.2f, 0.1f, -0.2f}}, 0.4f, alike(0, 0, 0.9f, 0));
    step(light, test, &context);
    g_array_remove_index(test->stands, 1);
    step(light, test, &context);
    fr_light_free(light);
    test_scene_free(test);
}

static void test_lamps(void) {
    FrContext context = fr_context_default();
    TestScene *test = room();
    FrDensityParams params = few();
    FrLight *light = light_of(&params, test, &context);
    g_array_index(test->lamps, FrLamp, 1).power = 2;
    g_assert_cmpuint(step(light, test, &context), ==, fr_light_stats(light).rays);
    test->scene.max.z = 1.2f;
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SKY, .power = 1});
    step(light, test, &context);
    g_array_set_size(test->lamps, 0);
    step(light, test, &context);
    fr_light_free(light);
    test_scene_free(test);
}

static void test_after_error(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    TestScene *test = room();
    FrDensityParams params = few();
    FrLight *light = light_of(&params, test, &context);
    add_leaves(test, 200, 3, CORNER, MIDDLE, 0.2f, alike(0.1f, 0, 0.2f, 0));
    FrContext narrow = context;
    narrow.limits.triangles = 100;
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &narrow), ==, FR_ERR_LIMIT);
    step(light, test, &context);
    fr_light_free(light);
    test_scene_free(test);
    fr_diags_free(context.diags);
}

/// Fewer bytes than the rays take already.
static void test_narrowed(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    TestScene *test = room();
    FrDensityParams params = few();
    FrLight *light = light_of(&params, test, &context);
    FrContext narrow = context;
    narrow.limits.bytes = fr_light_stats(light).rays * 6;
    add_leaves(test, 20, 3, CORNER, MIDDLE, 0.2f, alike(0.1f, 0, 0.2f, 0));
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &narrow), ==, FR_ERR_LIMIT);
    step(light, test, &context);
    fr_light_free(light);
    test_scene_free(test);
    fr_diags_free(context.diags);
}

static void test_threads(void) {
    static const int threads[4] = {1, 2, 3, 8};
    Knowledge known[4];
    for (int i = 0; i < 4; i++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[i]);
        TestScene *test = room();
        FrDensityParams params = few();
        FrLight *light = light_of(&params, test, &context);
        ask(light, MIDDLE, &context);
        add_leaves(test, 100, 3, CORNER, MIDDLE, 0.1f, alike(0.1f, 0, 0.2f, 0));
        g_assert_cmpint(fr_light_set_scene(light, test_scene(test), &context), ==, FR_OK);
        learn(light, test, &context, &known[i]);
        assert_same(&known[0], &known[i]);
        fr_light_free(light);
        test_scene_free(test);
        fr_pool_free(context.pool);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/update/growth traces little and changes nothing else", test_growth);
    g_test_add_func("/light/update/what is shed, moved or changed is followed", test_shedding);
    g_test_add_func("/light/update/surfaces in one place do not depend on order", test_coincident);
    g_test_add_func("/light/update/other lamps send all photons anew", test_lamps);
    g_test_add_func("/light/update/after an error everything is made anew", test_after_error);
    g_test_add_func("/light/update/a limit that became narrower holds", test_narrowed);
    g_test_add_func("/light/update/one, two, three and eight threads agree", test_threads);
    return g_test_run();
}
