/// Attraction particles. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

/// One axis that is drawn by places up to eight steps away and reaches them at two.
static void init_drawn(World *world) {
    world_init_plain(world);
    world_set(world, "step", "0.3");
    world_set(world, "influence", "2.4");
    world_set(world, "kill", "0.6");
    world_set(world, "laterals", "0");
}

/// E11: a direction at infinity draws every bud; a place draws those near it, and dies when
/// reached.
static void test_particles(void) {
    World world;
    init_drawn(&world);
    world_set(&world, "attraction", "2");
    world_set(&world, "gravitropism", "0");
    world_set(&world, "phototropism", "0");
    world_sow_one(&world);
    FrParticle particles[2] = {{.at = {{1, 0, 1}}, .w = 1, .kill = -1},
                               {.at = {{9, 9, 9}}, .w = 1, .kill = -1}};
    g_assert_cmpint(fr_growth_add_particles(world.growth, particles, 2, &world.context), ==, FR_OK);
    uint64_t count;
    bool *is_active;
    FrParticle *left = fr_growth_particles(world.growth, &count, &is_active);
    g_assert_cmpuint(count, ==, 2);
    g_assert_cmpint(is_active[0] + is_active[1], ==, 1);
    g_free(left);
    g_free(is_active);
    FrGrowthStats stats = world_step(&world, 7);
    g_assert_cmpuint(stats.particles, ==, 1); // one has been reached, one is far away
    const FrGrownNodes *nodes = &world.growth->plants[0].nodes;
    g_assert_cmpfloat(nodes->at[nodes->count - 1].x, >, 0.4f);
    world_clear(&world);
}

/// Mean angle between one internode of an axis and the next, with so many particles in the crown.
static double irregularity(const char *particles) {
    World world;
    world_init_plain(&world);
    world_set(&world, "envelope", "1,0 1.5,1 1,3 0,5");
    world_set(&world, "particles", particles);
    world_set(&world, "particle-mean", "nearest");
    world_set(&world, "dormancy", "0");
    world_set(&world, "auxin-reach", "1");
    world_set(&world, "influence", "0.6");
    world_set(&world, "kill", "0.2");
    world_set(&world, "gravitropism", "0");
    world_set(&world, "phototropism", "0");
    world_set(&world, "trials", "1");
    world.setup.params.light = FR_GROWTH_FULL;
    world_sow_one(&world);
    world_step(&world, 10);
    const FrGrownPlant *plant = &world.growth->plants[0];
    double turns = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        uint32_t parent = plant->nodes.parent[i];
        if (parent != FR_NONE && plant->nodes.axis[parent] == plant->nodes.axis[i]) {
            vec3s before = glms_vec3_sub(fr_grown_tip(plant, parent), fr_grown_base(plant, parent));
            vec3s after = glms_vec3_sub(fr_grown_tip(plant, i), fr_grown_base(plant, i));
            turns += (double)glms_vec3_angle(before, after);
            count++;
        }
    }
    g_assert_cmpuint(count, >, 50);
    world_clear(&world);
    return turns / count;
}

/// E11.
static void test_irregular(void) {
    double none = irregularity("0"), some = irregularity("30"), many = irregularity("300");
    g_test_message("turns of %g, %g and %g", none, some, many);
    g_assert_cmpfloat(none, <, 0.005);
    g_assert_cmpfloat(some, >, none + 0.02);
    g_assert_cmpfloat(many, >, some + 0.02);
}

/// The published rule: what is reached takes the bud along.
static void test_particle_and_bud(void) {
    World world;
    init_drawn(&world);
    world_set(&world, "particle-rule", "bud");
    world_sow_one(&world);
    FrParticle particle = {.at = {{0, 0, 1}}, .w = 1, .kill = -1};
    g_assert_cmpint(fr_growth_add_particles(world.growth, &particle, 1, &world.context), ==, FR_OK);
    FrGrowthStats stats = world_step(&world, 6);
    g_assert_cmpuint(stats.particles, ==, 0);
    g_assert_cmpuint(stats.active_buds, ==, 0);
    g_assert_cmpuint(stats.nodes, <, 5);
    world_clear(&world);
}

static void grow_colony(int threads, bool is_resumed, FrDigest *digests, int steps) {
    World world;
    world_init(&world);
    bool is_known = fr_species_preset("vase", &world.species.params);
    g_assert_true(is_known);
    world.context.pool = fr_pool_new(threads);
    FrSeed seeds[2] = {{.id = 4}, {.at = {1.5, 0, 0}, .id = 9}};
    world_sow(&world, seeds, 2);
    for (int i = 0; i < steps; i++) {
        digests[i] = world_step(&world, 1).digest;
        if (is_resumed) {
            GBytes *bytes = fr_growth_save(world.growth);
            gsize size;
            const void *data = g_bytes_get_data(bytes, &size);
            g_assert_cmpint(
                fr_growth_restore(world.growth, data, size, (FrSpan){0}, &world.context), ==,
                FR_OK);
            g_bytes_unref(bytes);
        }
    }
    g_assert_cmpuint(fr_growth_stats(world.growth).axes, >, 60);
    fr_pool_free(world.context.pool);
    world_clear(&world);
}

static void test_colony(void) {
    enum { STEPS = 50 };
    FrDigest wanted[STEPS], digests[STEPS];
    grow_colony(1, false, wanted, STEPS);
    grow_colony(3, true, digests, STEPS);
    for (int i = 0; i < STEPS; i++) {
        g_assert_cmpuint(digests[i], ==, wanted[i]);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/attract/E11 particles draw buds and die when reached", test_particles);
    g_test_add_func("/growth/attract/E11 the more particles, the less regular", test_irregular);
    g_test_add_func("/growth/attract/E11 by the published rule the bud dies too",
                    test_particle_and_bud);
    g_test_add_func("/growth/attract/space is colonized alike by any threads and after resuming",
                    test_colony);
    return g_test_run();
}
