/// Seeds that wait for their place.
#include "growing.h"

static const vec3s corners[8] = {{{-1, -1, -1}}, {{1, -1, -1}}, {{1, 1, -1}}, {{-1, 1, -1}},
                                 {{-1, -1, 1}},  {{1, -1, 1}},  {{1, 1, 1}},  {{-1, 1, 1}}};
static const uint32_t faces[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                   1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
static const vec3s lid[4] = {
    {{-1, -1, 0.15F}}, {{1, -1, 0.15F}}, {{1, 1, 0.15F}}, {{-1, 1, 0.15F}}};

/// A world of two seeds, one where a box may stand.
typedef struct Site {
    World world;
    FrGrowthObstacle obstacle;
} Site;

static void site_init(Site *site, bool is_taken, const char *particles) {
    world_init_plain(&site->world);
    world_set(&site->world, "particles", particles);
    world_set(&site->world, "kill", "0"); // all stay
    site->obstacle = (FrGrowthObstacle){
        .positions = corners, .vertex_count = 8, .indices = faces, .index_count = 36};
    site->world.setup.obstacles = &site->obstacle;
    site->world.setup.obstacle_count = is_taken;
    const FrSeed seeds[2] = {{.id = 1}, {.id = 2, .at = {9, 0, 0}}};
    world_sow(&site->world, seeds, 2);
}

static void site_change(Site *site, bool is_taken) {
    site->world.setup.obstacle_count = is_taken;
    g_assert_cmpint(fr_growth_change(site->world.growth, &site->world.setup, &site->world.context),
                    ==, FR_OK);
}

static uint32_t nodes_of(const Site *site, uint32_t plant) {
    FrPlant *grown = world_plant(&site->world, plant);
    uint32_t count = grown->nodes.count;
    fr_plant_free(grown);
    return count;
}

static void test_freed(void) {
    Site site;
    site_init(&site, true, "50");
    g_assert_cmpuint(world_step(&site.world, 3).plants, ==, 1);
    g_assert_cmpuint(fr_growth_stats(site.world.growth).particles, ==, 50);
    site_change(&site, false);
    g_assert_cmpuint(fr_growth_stats(site.world.growth).plants, ==, 1);
    FrGrowthStats stats = world_step(&site.world, 1);
    g_assert_cmpuint(stats.plants, ==, 2);
    g_assert_cmpuint(stats.particles, ==, 100);
    g_assert_cmpuint(nodes_of(&site, 0), ==, 1);
    g_assert_cmpuint(nodes_of(&site, 1), >, 3);
    world_clear(&site.world);
}

/// A box that goes and comes back while a seed waits changes nothing.
static void test_still_taken(void) {
    Site site;
    site_init(&site, true, "50");
    world_step(&site.world, 2);
    site_change(&site, false);
    site_change(&site, true);
    FrGrowthStats stats = world_step(&site.world, 2);
    g_assert_cmpuint(stats.plants, ==, 1);
    g_assert_cmpuint(stats.particles, ==, 50);
    world_clear(&site.world);
}

/// What comes upon a seed before it has sprouted does not end it.
static void test_covered(void) {
    Site site;
    site_init(&site, false, "50");
    site_change(&site, true);
    g_assert_cmpuint(world_step(&site.world, 2).plants, ==, 1);
    site_change(&site, false);
    FrGrowthStats stats = world_step(&site.world, 2);
    g_assert_cmpuint(stats.plants, ==, 2);
    g_assert_cmpuint(stats.particles, ==, 100); // as many as there were
    g_assert_cmpuint(nodes_of(&site, 0), >, 1);
    world_clear(&site.world);
}

/// A lid within the first internode ends the bud; the seed is there still.
static void test_lid(void) {
    Site site;
    site_init(&site, false, "50");
    FrGrowthObstacle box = site.obstacle;
    site.obstacle = world_sheet(lid);
    site_change(&site, true);
    world_step(&site.world, 2);
    g_assert_cmpuint(nodes_of(&site, 0), ==, 0);
    site_change(&site, false);
    world_step(&site.world, 2);
    g_assert_cmpuint(nodes_of(&site, 0), >, 1);
    site.obstacle = box;
    world_clear(&site.world);
}

/// What has sprouted does not begin anew.
static void test_sprouted(void) {
    Site site;
    site_init(&site, false, "50");
    world_step(&site.world, 3);
    uint32_t nodes = nodes_of(&site, 0);
    site_change(&site, true);
    world_step(&site.world, 2);
    g_assert_cmpuint(nodes_of(&site, 0), >=, nodes);
    site_change(&site, false);
    g_assert_cmpuint(world_step(&site.world, 1).particles, <=, 100);
    g_assert_cmpuint(nodes_of(&site, 0), >=, nodes);
    world_clear(&site.world);
}

static void test_agreed(void) {
    Site site;
    site_init(&site, true, "50");
    site.world.setup.params.history = 9;
    site_change(&site, true);
    FrDigest before = world_step(&site.world, 3).digest;
    site_change(&site, false);
    g_assert_cmpuint(fr_growth_stats(site.world.growth).digest, ==, before);
    FrDigest after[2] = {world_step(&site.world, 1).digest, world_step(&site.world, 1).digest};
    // Taken back as far as to before the change, in the world as it is now.
    g_assert_true(fr_growth_undo(site.world.growth) && fr_growth_undo(site.world.growth));
    g_assert_cmpuint(fr_growth_stats(site.world.growth).digest, ==, before);
    g_assert_true(fr_growth_undo(site.world.growth));
    FrGrowthStats earlier = world_step(&site.world, 1);
    g_assert_cmpuint(earlier.step, ==, 3);
    g_assert_cmpuint(earlier.plants, ==, 2);
    world_clear(&site.world);

    site_init(&site, true, "50");
    world_step(&site.world, 3);
    site_change(&site, false);
    for (int i = 0; i < 2; i++) {
        world_resume(&site.world);
        g_assert_cmpuint(world_step(&site.world, 1).digest, ==, after[i]);
    }
    world_clear(&site.world);
}

/// The particles of the plant that begins are too many; all is as it was.
static void test_refused(void) {
    Site site;
    site_init(&site, true, "40000");
    FrGrowthStats before = world_step(&site.world, 2);
    site_change(&site, false);
    site.world.context.limits.bytes = before.cells + before.bytes;
    g_assert_cmpint(fr_growth_step(site.world.growth, &site.world.context), ==, FR_ERR_LIMIT);
    FrGrowthStats after = fr_growth_stats(site.world.growth);
    g_assert_cmpuint(after.digest, ==, before.digest);
    g_assert_cmpuint(after.step, ==, 2);
    g_assert_cmpuint(after.particles, ==, 40000);
    site.world.context.limits = fr_limits_default();
    after = world_step(&site.world, 1);
    g_assert_cmpuint(after.plants, ==, 2);
    g_assert_cmpuint(after.particles, ==, 80000);
    world_clear(&site.world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/sow/a seed comes in with the step after its place has become free",
                    test_freed);
    g_test_add_func("/growth/sow/it waits as long as the place is taken", test_still_taken);
    g_test_add_func("/growth/sow/a seed that an obstacle comes upon waits", test_covered);
    g_test_add_func("/growth/sow/a seed that found no way begins anew in a new world", test_lid);
    g_test_add_func("/growth/sow/what has sprouted goes on as it is", test_sprouted);
    g_test_add_func("/growth/sow/undoing and resuming agree on who waits", test_agreed);
    g_test_add_func("/growth/sow/a step that fails lets them wait", test_refused);
    return g_test_run();
}
