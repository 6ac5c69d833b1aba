// The octree's answers against a look at all rays, and what it holds.
#include "light/density.h"
#include "light_scenes.h"

#include <string.h>

enum { POINTS = 60 };

static TestScene *leafy_room(void) {
    TestScene *test = test_scene_new();
    add_cube(test, 2, alike(0.6f, 0.1f, 0, 0));
    add_leaves(test, 150, 4, (vec3s){{-0.7f, -0.7f, -0.7f}}, (vec3s){{0.3f, 0.3f, 0.3f}}, 0.1f,
               alike(0.1f, 0, 0.2f, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_POINT, .power = 2, .position = {{0.5f, 0.5f, 0.8f}}});
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SUN, .power = 1, .direction = {{1, 0, -1}}});
    return test;
}

// Points in the room, beside it, and outside of the tree.
static void points_for(vec3s points[POINTS]) {
    for (uint32_t i = 0; i < POINTS; i++) {
        FrKey key = fr_key_child(fr_key_root(8), i);
        double size = i % 10 == 9 ? 5.0 : (i % 10 == 8 ? 1.9 : 1.0);
        for (uint32_t c = 0; c < 3; c++) {
            points[i].raw[c] = (float)(size * fr_random_signed(key, 1, c));
        }
    }
}

static void test_brute_force(void) {
    static const double distances[4] = {0.02, 0.1, 0.37, 1.3};
    FrContext context = fr_context_default();
    TestScene *test = leafy_room();
    vec3s points[POINTS];
    points_for(points);
    for (int d = 0; d < 12; d++) {
        FrDensityParams params = fr_density_default();
        params.photons = 10000;
        params.distance = distances[d / 3];
        params.estimator = d % 3;
        FrLight *light = light_of(&params, test, &context);
        const FrDensity *density = (const FrDensity *)(void *)light;
        FrEstimator how = fr_density_estimator(density);
        FrLightAnswer answers[POINTS];
        uint64_t samples = 0;
        g_assert_cmpint(fr_light_query(light, points, POINTS, &context, answers), ==, FR_OK);
        for (int i = 0; i < POINTS; i++) {
            FrLightAnswer all = fr_estimate_from_all(density->paths, &how, points[i]);
            g_assert_cmpint(memcmp(&answers[i], &all, sizeof all), ==, 0);
            samples += all.samples;
        }
        g_assert_cmpuint(samples, >, 30);
        fr_light_free(light);
    }
    test_scene_free(test);
}

// Rays that come from so far that floats in the room's coordinates cannot tell where they pass.
static void test_far_lamp(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    add_leaves(test, 40, 4, (vec3s){{-0.7f, -0.7f, -0.7f}}, (vec3s){{1.4f, 1.4f, 1.4f}}, 0.1f,
               alike(0.1f, 0, 0.2f, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_SPOT,
                            .power = 2,
                            .position = {{30000, 20000, 10000}},
                            .direction = {{-3, -2, -1}},
                            .angle = 5e-5f});
    FrDensityParams params = fr_density_default();
    params.photons = 20000;
    params.distance = 0.05;
    FrLight *light = light_of(&params, test, &context);
    const FrDensity *density = (const FrDensity *)(void *)light;
    FrEstimator how = fr_density_estimator(density);
    uint64_t samples = 0;
    for (uint32_t i = 0; i < POINTS; i++) {
        FrKey key = fr_key_child(fr_key_root(9), i);
        vec3s at;
        for (uint32_t c = 0; c < 3; c++) {
            at.raw[c] = (float)(0.9 * fr_random_signed(key, 1, c));
        }
        FrLightAnswer answer = ask(light, at, &context);
        FrLightAnswer all = fr_estimate_from_all(density->paths, &how, at);
        g_assert_cmpint(memcmp(&answer, &all, sizeof all), ==, 0);
        samples += all.samples;
    }
    g_assert_cmpuint(samples, >, 300);
    fr_light_free(light);
    test_scene_free(test);
}

// Every ray a cell refers to passes through it, and of the rays that pass none is missing: sampled
// along each ray.
static void test_references(void) {
    FrContext context = fr_context_default();
    TestScene *test = leafy_room();
    FrDensityParams params = fr_density_default();
    params.photons = 2000;
    FrLight *light = light_of(&params, test, &context);
    ask(light, (vec3s){{0.1f, 0.2f, 0.3f}}, &context);
    const FrDensity *density = (const FrDensity *)(void *)light;
    const FrOctree *tree = density->tree;
    uint32_t held = 0;
    for (guint k = 1; k < tree->cells->len; k++) {
        const FrCell *cell = &g_array_index(tree->cells, FrCell, k);
        double inverse = 1.0 / fr_octree_cell_width(tree, cell->level);
        bool *is_listed = g_new0(bool, density->paths->count);
        for (uint32_t i = 0; i < cell->rays.count; i++) {
            g_assert_false(is_listed[cell->rays.at[i]]);
            is_listed[cell->rays.at[i]] = true;
        }
        for (uint32_t r = 0; r < density->paths->count; r++) {
            const FrRay *ray = &density->paths->rays[r];
            double reach = fr_octree_reach(tree, ray);
            bool is_inside = false;
            for (int s = 0; s <= 400 && !is_inside; s++) {
                double at[3];
                for (int c = 0; c < 3; c++) {
                    at[c] = (double)ray->origin[c] + s / 400.0 * reach * (double)ray->direction[c];
                }
                is_inside = fr_cell_holds(tree, inverse, cell->at, at);
            }
            held += is_inside;
            g_assert_true(!is_inside || is_listed[r]);
        }
        g_free(is_listed);
    }
    g_assert_cmpuint(held, >, 1000);
    fr_light_free(light);
    test_scene_free(test);
}

static void test_memory(void) {
    FrContext context = fr_context_default();
    TestScene *test = leafy_room();
    FrDensityParams params = fr_density_default();
    params.photons = 5000;
    params.distance = 0.02;
    FrLight *light = light_of(&params, test, &context);
    g_assert_cmpuint(fr_light_stats(light).cells, ==, 1);
    g_assert_cmpuint(fr_light_stats(light).references, ==, 0);
    vec3s points[POINTS];
    points_for(points);
    uint64_t before = 1;
    for (int i = 0; i < 8; i++) {
        ask(light, points[i], &context);
        FrLightStats stats = fr_light_stats(light);
        // At most 27 cells of each level, whatever the size of the room.
        g_assert_cmpuint(stats.cells, >, before);
        g_assert_cmpuint(stats.cells - before, <=, 27 * 7);
        g_assert_cmpuint(stats.points, ==, (uint64_t)i + 1);
        before = stats.cells;
    }
    // The same place again costs nothing.
    ask(light, points[3], &context);
    g_assert_cmpuint(fr_light_stats(light).cells, ==, before);
    fr_light_forget(light);
    g_assert_cmpuint(fr_light_stats(light).points, ==, 0);
    ask(light, points[0], &context);
    g_assert_cmpuint(fr_light_stats(light).cells, <=, 1 + 27 * 7);
    FrLight *fresh = light_of(&params, test, &context);
    FrLightAnswer expected = ask(fresh, points[0], &context);
    FrLightAnswer again = ask(light, points[0], &context);
    g_assert_cmpint(memcmp(&expected, &again, sizeof again), ==, 0);
    g_assert_cmpuint(fr_light_stats(fresh).cells, ==, fr_light_stats(light).cells);
    g_assert_cmpuint(fr_light_stats(fresh).references, ==, fr_light_stats(light).references);
    fr_light_free(fresh);
    fr_light_free(light);
    test_scene_free(test);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/octree/answers are those of a look at all rays", test_brute_force);
    g_test_add_func("/light/octree/a cell refers to all rays that pass through it",
                    test_references);
    g_test_add_func("/light/octree/rays from very far away are found", test_far_lamp);
    g_test_add_func("/light/octree/memory follows the points that were asked for", test_memory);
    return g_test_run();
}
