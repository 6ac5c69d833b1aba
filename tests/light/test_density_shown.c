// What of the density of rays can be looked at: ways of photons, cells of the octree.
#include "light/density.h"
#include "light_scenes.h"

static FrLight *room(TestScene *test, const FrContext *context) {
    add_cube(test, 2, alike(0.5f, 0, 0, 0));
    add_lamp(test, (FrLamp){.kind = FR_LAMP_POINT, .power = 5, .position = {{0.2f, 0, 0.9f}}});
    FrDensityParams params = fr_density_default();
    params.photons = 3000;
    params.distance = 0.1;
    return light_of(&params, test, context);
}

static void test_ways(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    FrLight *light = room(test, &context);
    GArray *rays = fr_light_rays(light, UINT32_MAX);
    g_assert_cmpuint(rays->len, ==, fr_light_stats(light).rays);
    for (guint i = 0; i < rays->len; i++) {
        const FrLightRay *ray = &g_array_index(rays, FrLightRay, i);
        g_assert_true(ray->is_met); // the room is closed
        if (ray->bounce == 0) {
            g_assert_cmpfloat((double)glms_vec3_distance(ray->from, (vec3s){{0.2f, 0, 0.9f}}), <,
                              1e-5);
        } else {
            const FrLightRay *before = &g_array_index(rays, FrLightRay, i - 1);
            g_assert_cmpuint(before->photon, ==, ray->photon);
            g_assert_cmpuint(before->bounce + 1, ==, ray->bounce);
            g_assert_cmpfloat((double)glms_vec3_distance(before->to, ray->from), <, 1e-4);
        }
    }
    GArray *few = fr_light_rays(light, 10);
    uint32_t photons = 0;
    for (guint i = 0; i < few->len; i++) {
        photons += g_array_index(few, FrLightRay, i).bounce == 0;
    }
    g_assert_cmpuint(photons, ==, 10);
    g_array_unref(few);
    g_array_unref(rays);
    fr_light_free(light);
    test_scene_free(test);
}

// How much of a ray is within a cell that is smaller by `less` on each side, in metres.
static double within(const FrLightRay *ray, const FrLightCell *cell, double less) {
    double begin = 0, end = 1;
    for (int c = 0; c < 3; c++) {
        double from = (double)ray->from.raw[c], way = (double)ray->to.raw[c] - from;
        double low = cell->min[c] + less, high = cell->min[c] + cell->width - less;
        if (fabs(way) < 1e-9) {
            end = from >= low && from <= high ? end : -1;
        } else {
            double a = (low - from) / way, b = (high - from) / way;
            begin = fmax(begin, fmin(a, b));
            end = fmin(end, fmax(a, b));
        }
    }
    return end - begin;
}

static void test_cells(void) {
    FrContext context = fr_context_default();
    TestScene *test = test_scene_new();
    FrLight *light = room(test, &context);
    GArray *whole = fr_light_cells(light, 1000);
    g_assert_cmpuint(whole->len, ==, 1); // nothing was asked for yet
    g_array_unref(whole);
    ask(light, (vec3s){{0.3f, 0.1f, -0.2f}}, &context);
    GArray *rays = fr_light_rays(light, UINT32_MAX), *cells = fr_light_cells(light, 1000);
    g_assert_cmpuint(cells->len, >=, 8);
    for (guint i = 0; i < cells->len; i++) {
        const FrLightCell *cell = &g_array_index(cells, FrLightCell, i);
        uint32_t sure = 0, perhaps = 0;
        for (guint r = 0; r < rays->len; r++) {
            const FrLightRay *ray = &g_array_index(rays, FrLightRay, r);
            sure += within(ray, cell, 1e-4) > 0;
            perhaps += within(ray, cell, -1e-4) > 0;
        }
        g_assert_cmpuint(cell->ray_count, >=, sure);
        g_assert_cmpuint(cell->ray_count, <=, perhaps);
    }
    GArray *few = fr_light_cells(light, cells->len - 1);
    g_assert_cmpuint(few->len, <, cells->len);
    g_array_unref(few);
    g_array_unref(cells);
    g_array_unref(rays);
    fr_light_free(light);
    test_scene_free(test);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/density/ways of photons lead from the lamp from surface to surface",
                    test_ways);
    g_test_add_func("/light/density/a cell that is shown counts the rays that pass through it",
                    test_cells);
    return g_test_run();
}
