/// What of a growth can be looked at: buds and occupied space.
#include "growing.h"

static void init(World *world) {
    world_init(world);
    world_set(world, "model", "open");
    world_set(world, "dormancy", "0");
    const FrSeed seeds[] = {{.at = {0, 0, 0}, .id = 1}, {.at = {3, 0, 0}, .id = 2}};
    world_sow(world, seeds, 2);
}

static void test_buds(void) {
    World world;
    init(&world);
    FrGrowthStats stats = world_step(&world, 6);
    GArray *buds = fr_growth_buds(world.growth);
    uint64_t growing = 0;
    for (guint i = 0; i < buds->len; i++) {
        const FrGrowthBud *bud = &g_array_index(buds, FrGrowthBud, i);
        double near = fabs((double)bud->at.x - (bud->plant == 0 ? 0 : 3));
        growing += bud->is_growing;
        g_assert_cmpfloat_with_epsilon((double)glms_vec3_norm(bud->direction), 1, 1e-4);
        g_assert_cmpfloat((double)bud->light, >=, 0);
        g_assert_cmpfloat((double)bud->light, <=, 1);
        g_assert_cmpfloat(near, <, 12);
    }
    g_assert_cmpuint(growing, ==, stats.active_buds);
    g_assert_cmpuint(buds->len, ==, stats.active_buds + stats.dormant_buds);
    g_array_unref(buds);
    world_clear(&world);
}

/// What bends is drawn in parts; its internodes are still those that have grown.
static void test_internodes(void) {
    World world;
    init(&world);
    FrGrowthStats stats = world_step(&world, 8);
    uint64_t internodes = 0, parts = 0;
    for (uint32_t i = 0; i < 2; i++) {
        FrPlant *plant = world_plant(&world, i);
        internodes += fr_plant_internodes(plant);
        parts += plant->nodes.count;
        for (uint32_t k = 0; k < plant->nodes.count; k++) {
            bool is_part = (plant->nodes.flags[k] & FR_PART) != 0;
            g_assert_true(!is_part || plant->nodes.next[k] == k + 1);
        }
        fr_plant_free(plant);
    }
    g_assert_cmpuint(internodes, ==, stats.nodes);
    g_assert_cmpuint(parts, >, internodes);
    world_clear(&world);
}

static void test_cells(void) {
    World world;
    init(&world);
    world_step(&world, 6);
    GArray *cells = fr_growth_cells(world.growth, UINT32_MAX);
    g_assert_cmpuint(cells->len, >, 50);
    for (guint i = 0; i < cells->len; i++) {
        const FrGrowthCell *cell = &g_array_index(cells, FrGrowthCell, i);
        double middle[3], beyond[3];
        for (int c = 0; c < 3; c++) {
            middle[c] = beyond[c] = cell->min[c] + 0.5 * cell->width;
        }
        beyond[2] = 29;
        g_assert_true(fr_growth_is_taken(world.growth, middle));
        g_assert_false(fr_growth_is_taken(world.growth, beyond));
        g_assert_cmpuint(cell->plant, <, 2);
    }
    GArray *few = fr_growth_cells(world.growth, 20);
    g_assert_cmpuint(few->len, >, 0);
    g_assert_cmpuint(few->len, <=, 20);
    double wide = g_array_index(few, FrGrowthCell, 0).width;
    g_assert_cmpfloat(wide, >=, 8 * g_array_index(cells, FrGrowthCell, 0).width);
    for (guint i = 0; i < cells->len; i++) { // each is in one of the few
        const FrGrowthCell *cell = &g_array_index(cells, FrGrowthCell, i);
        bool is_held = false;
        for (guint k = 0; k < few->len && !is_held; k++) {
            const double *min = g_array_index(few, FrGrowthCell, k).min;
            is_held = true;
            for (int c = 0; c < 3; c++) {
                double middle = cell->min[c] + 0.5 * cell->width;
                is_held = is_held && middle > min[c] && middle < min[c] + wide;
            }
        }
        g_assert_true(is_held);
    }
    g_array_unref(few);
    g_array_unref(cells);
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(
        "/growth/shown/a plant has the internodes that have grown, in however many parts",
        test_internodes);
    g_test_add_func("/growth/shown/all buds are told, as many as grow and sleep", test_buds);
    g_test_add_func("/growth/shown/cells are those that are taken, and cubes hold all of them",
                    test_cells);
    return g_test_run();
}
