/// A step is taken whole or not at all; setups are checked without one. E numbers are those of
/// docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

/// Cancelled after light and particles have changed what buds know, and have killed.
static void test_cancelled(void) {
    World world;
    world_init(&world);
    world_set(&world, "particle-rule", "bud");
    world_set(&world, "kill", "0.5");
    world_sow_one(&world);
    world_step(&world, 6);
    FrGrowthStats before = fr_growth_stats(world.growth);
    const FrLiveBud *bud = &world.growth->plants[0].buds[0];
    FrParticle near = {.at = fr_bud_world(&world.growth->plants[0], bud), .w = 1, .kill = -1};
    g_assert_cmpint(fr_growth_add_particles(world.growth, &near, 1, &world.context), ==, FR_OK);
    world.growth->params.light = FR_GROWTH_FULL;
    world.context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(world.context.progress);
    g_assert_cmpint(fr_growth_sense(world.growth, &world.context), ==, FR_CANCELLED);
    FrGrowthStats after = fr_growth_stats(world.growth);
    g_assert_cmpuint(after.digest, ==, before.digest);
    g_assert_cmpuint(after.particles, ==, 1);
    fr_progress_free(world.context.progress);
    world.context.progress = NULL;
    g_assert_cmpint(fr_growth_sense(world.growth, &world.context), ==, FR_OK);
    after = fr_growth_stats(world.growth);
    g_assert_cmpuint(after.digest, !=, before.digest);
    world_clear(&world);
}

/// What is wrong with a setup is known without an arena of cells and particles.
static void test_checked(void) {
    World world;
    world_init(&world);
    world.context.limits.bytes = 1000;
    world.setup.params.particles = 1000000;
    const FrSeed seeds[2] = {{.id = 1}, {.at = {100, 0, 0}, .id = 2}};
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(world.context.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(world.context.diags, 0)->code, ==, "seed-place");
    world.context.limits.plants = 1;
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_ERR_LIMIT);
    world.context.limits.plants = 2;
    world.setup.params.cell = 0.0001;
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_ERR_DOCUMENT);
    world_clear(&world);
}

/// A seed in a box, one beside its envelope and a good one, told without making the world.
static void test_checked_seeds(void) {
    static const vec3s corners[8] = {{{3, -1, 0}}, {{5, -1, 0}}, {{5, 1, 0}}, {{3, 1, 0}},
                                     {{3, -1, 2}}, {{5, -1, 2}}, {{5, 1, 2}}, {{3, 1, 2}}};
    static const uint32_t sides[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                       1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    FrGrowthObstacle box = {
        .positions = corners, .vertex_count = 8, .indices = sides, .index_count = 36};
    World world;
    world_init(&world);
    world.setup.obstacles = &box;
    world.setup.obstacle_count = 1;
    const FrSeed seeds[2] = {{.id = 1, .at = {2, 0, 0}}, {.id = 2, .at = {4, 0.2, 0}}};
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(world.context.diags), ==, 1);
    const FrDiag *diag = fr_diags_get(world.context.diags, 0);
    g_assert_cmpstr(diag->code, ==, "seed-place");
    g_assert_nonnull(strstr(diag->text, "1 of 2 seeds"));
    g_assert_nonnull(strstr(diag->text, "4,0.2,0: it is in "));
    world_set(&world, "envelope", "0,-3 1,-2 0,-1");
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(world.context.diags), ==, 3);
    g_assert_cmpstr(fr_diags_get(world.context.diags, 2)->code, ==, "seed-envelope");
    world_clear(&world);
}

/// Cells begin where the arena began at first, so nothing grows where it was widened downwards.
static void test_widened(void) {
    World world;
    world_init(&world);
    world_sow_one(&world);
    world_step(&world, 1);
    world.setup.params.min.x = -30;
    g_assert_cmpint(fr_growth_change(world.growth, &world.setup, &world.context), ==, FR_OK);
    const FrSeed seeds[2] = {{.id = 2, .at = {-25, 0, 0}}, {.id = 3, .at = {-15, 0, 0}}};
    g_assert_cmpint(fr_growth_add_seeds(world.growth, seeds, 2, &world.context), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(world.context.diags), ==, 1);
    const FrDiag *diag = fr_diags_get(world.context.diags, 0);
    g_assert_cmpstr(diag->code, ==, "seed-place");
    g_assert_nonnull(strstr(diag->text, "-25,0,0: the arena has become larger"));
    world_step(&world, 2);
    g_assert_false(fr_growth_is_alive(world.growth, 1));
    g_assert_true(fr_growth_is_alive(world.growth, 2));
    world_clear(&world);
}

/// Grown for some steps, then on beside a sheet above.
static FrDigest under_sheet(bool names_species) {
    static const vec3s corners[4] = {
        {{-9, -9, 1.6f}}, {{9, -9, 1.6f}}, {{9, 9, 1.6f}}, {{-9, 9, 1.6f}}};
    World world;
    world_init(&world);
    const FrGrowthObstacle sheet = world_sheet(corners);
    world_sow_one(&world);
    world_step(&world, 4);
    world.setup.obstacles = &sheet;
    world.setup.obstacle_count = 1;
    world.setup.species = names_species ? &world.species : NULL;
    g_assert_cmpint(fr_growth_change(world.growth, &world.setup, &world.context), ==, FR_OK);
    FrGrowthStats stats = world_step(&world, 12);
    const FrGrownPlant *plant = &world.growth->plants[0];
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        g_assert_cmpfloat(plant->nodes.at[i].z, <, 1.6f);
    }
    world_clear(&world);
    return stats.digest;
}

static void test_same_species(void) {
    g_assert_cmpuint(under_sheet(true), ==, under_sheet(false));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(
        "/growth/step/a step that is cancelled before plants change leaves all as it was",
        test_cancelled);
    g_test_add_func("/growth/step/a setup is checked without making its world", test_checked);
    g_test_add_func("/growth/step/seeds in obstacles and beside envelopes are told by checking",
                    test_checked_seeds);
    g_test_add_func("/growth/step/a seed outside of all cells is told where the arena was widened",
                    test_widened);
    g_test_add_func("/growth/step/species that are not named again stay when obstacles change",
                    test_same_species);
    return g_test_run();
}
