/// Plants that die as a whole, and stands that thin themselves.
#include "growing.h"
#include "growth/engine.h"

static void init_starving(World *world) {
    world_init(world);
    world_set(world, "model", "open");
    world_set(world, "step", "0.2");
    world_set(world, "auxin-reach", "2");
    world_set(world, "search", "0");
    world_set(world, "pipe-exponent", "2");
    world_set(world, "foliage", "0.04");
    world_set(world, "leaf-life", "3");
    world_set(world, "dead", "falls");
}

/// Seeds by chance over a square.
static FrSeed *strew(uint32_t count, double side) {
    FrSeed *seeds = g_new0(FrSeed, count);
    FrKey key = fr_key_root(7);
    for (uint32_t i = 0; i < count; i++) {
        seeds[i] = (FrSeed){
            .id = 1000 + i,
            .at = {side * (fr_random(key, 1, i) - 0.5), side * (fr_random(key, 2, i) - 0.5)}};
    }
    return seeds;
}

static uint32_t count_living(const FrGrowth *growth) {
    uint32_t living = 0;
    for (uint32_t i = 0; i < fr_growth_plant_count(growth); i++) {
        living += fr_growth_is_alive(growth, i);
    }
    return living;
}

// ---- one plant --------------------------------------------------------------------------------

/// A stem without branches in full light: after n steps its one bud pays for n internodes.
static void init_stem(World *world) {
    init_starving(world);
    world_set(world, "laterals", "0");
    world_set(world, "length-noise", "0");
    world_set(world, "wander", "0");
    world_set(world, "dead", "stands");
    world->setup.params.light = FR_GROWTH_FULL;
}

static void test_balance(void) {
    World world;
    init_stem(&world);
    world_set(&world, "upkeep", "0.5");
    world_set(&world, "wood-upkeep", "0.25"); // 0.5 + 0.25 · 2 m: ten internodes and no more
    world_set(&world, "endurance", "1");
    world_sow_one(&world);
    world_step(&world, 11); // what is sensed is the plant of the step before
    g_assert_true(fr_growth_is_alive(world.growth, 0));
    world_step(&world, 1);
    g_assert_false(fr_growth_is_alive(world.growth, 0));
    FrGrowthStats stats = world_step(&world, 3);
    g_assert_cmpuint(stats.nodes, ==, 11);
    g_assert_cmpuint(stats.active_buds + stats.dormant_buds, ==, 0);
    world_clear(&world);
}

static void test_endurance(void) {
    World world;
    init_stem(&world);
    world_set(&world, "upkeep", "0.5");
    world_set(&world, "wood-upkeep", "0.25");
    world_set(&world, "endurance", "4");
    world_sow_one(&world);
    world_step(&world, 14);
    g_assert_true(fr_growth_is_alive(world.growth, 0));
    world_step(&world, 1);
    g_assert_false(fr_growth_is_alive(world.growth, 0));
    world_clear(&world);
}

static void test_neutral(void) {
    World world;
    init_stem(&world);
    world_set(&world, "endurance", "1");
    world_sow_one(&world);
    world_step(&world, 40);
    g_assert_true(fr_growth_is_alive(world.growth, 0));
    world_clear(&world);
}

/// What falls leaves its space to others.
static void test_fallen(void) {
    World world;
    init_stem(&world);
    world_set(&world, "dead", "falls");
    world_set(&world, "upkeep", "0.5");
    world_set(&world, "wood-upkeep", "0.25");
    world_sow_one(&world);
    world_step(&world, 8);
    double inside[3] = {0, 0, 0.5};
    FrGrownPlant *plant = &world.growth->plants[0];
    inside[0] = (double)plant->nodes.at[3].x;
    inside[1] = (double)plant->nodes.at[3].y;
    inside[2] = (double)plant->nodes.at[3].z;
    g_assert_true(fr_growth_is_taken(world.growth, inside));
    FrGrowthStats stats = world_step(&world, 20);
    g_assert_cmpuint(stats.nodes, ==, 0);
    g_assert_false(fr_growth_is_taken(world.growth, inside));
    g_assert_cmpfloat(fr_growth_wood(world.growth, 0), ==, 0);
    FrPlant *drawn = world_plant(&world, 0);
    g_assert_cmpuint(drawn->nodes.count, ==, 0);
    fr_plant_free(drawn);
    world_clear(&world);
}

/// A stem of equal internodes and no taper is a cylinder.
static void test_wood(void) {
    World world;
    init_stem(&world);
    world_set(&world, "taper", "0");
    world_set(&world, "tip-radius", "0.01");
    world_sow_one(&world);
    world_step(&world, 10);
    const FrGrownNodes *nodes = &world.growth->plants[0].nodes;
    double height = (double)nodes->at[nodes->count - 1].z;
    double wanted = G_PI * 0.01 * 0.01 * height;
    g_assert_cmpfloat(fabs(fr_growth_wood(world.growth, 0) / wanted - 1), <, 1e-5);
    world_clear(&world);
}

// ---- stands -----------------------------------------------------------------------------------

enum { PLANTS = 300, STEPS = 28 };

static void sow_stand(World *world, int threads) {
    init_starving(world);
    world_set(world, "upkeep", "0.3");
    world->context.pool = fr_pool_new(threads);
    FrSeed *seeds = strew(PLANTS, 8.5);
    world_sow(world, seeds, PLANTS);
    g_free(seeds);
}

static void clear_stand(World *world) {
    fr_pool_free(world->context.pool);
    world_clear(world);
}

/// Slope of log(mean wood) over log(living), by the main axis, of the steps in which plants die.
static double slope_of(const double *x, const double *y, int count) {
    double mean_x = 0, mean_y = 0, xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < count; i++) {
        mean_x += x[i] / count;
        mean_y += y[i] / count;
    }
    for (int i = 0; i < count; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return (yy - xx + hypot(yy - xx, 2 * xy)) / (2 * xy);
}

static void test_thinning(void) {
    World world;
    sow_stand(&world, 2);
    double x[STEPS], y[STEPS];
    int count = 0;
    for (int step = 0; step < STEPS; step++) {
        world_step(&world, 1);
        double wood = 0;
        for (uint32_t i = 0; i < PLANTS; i++) {
            wood += fr_growth_is_alive(world.growth, i) ? fr_growth_wood(world.growth, i) : 0;
        }
        uint32_t living = count_living(world.growth);
        g_assert_cmpuint(living, >, 0);
        if (living < 0.85 * PLANTS) {
            x[count] = log10(living);
            y[count++] = log10(wood / living);
        }
    }
    g_assert_cmpint(count, >=, 6);
    g_assert_cmpfloat(x[0] - x[count - 1], >, 0.5); // two thirds of them have died meanwhile
    double slope = slope_of(x, y, count);
    g_assert_cmpfloat(slope, <, -1.3);
    g_assert_cmpfloat(slope, >, -1.8);
    clear_stand(&world);
}

/// The same plants die in the same steps, resumed after each or not, with any threads.
static void test_same(void) {
    enum { FEW = 14 };
    FrDigest wanted[FEW];
    World world;
    sow_stand(&world, 1);
    for (int step = 0; step < FEW; step++) {
        wanted[step] = world_step(&world, 1).digest;
    }
    g_assert_cmpuint(count_living(world.growth), <, PLANTS);
    clear_stand(&world);
    sow_stand(&world, 3);
    for (int step = 0; step < FEW; step++) {
        g_assert_cmpuint(world_step(&world, 1).digest, ==, wanted[step]);
        world_resume(&world);
        g_assert_cmpuint(fr_growth_stats(world.growth).digest, ==, wanted[step]);
    }
    clear_stand(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/starve/a plant starves when its wood takes more than its buds gather",
                    test_balance);
    g_test_add_func("/growth/starve/a starving plant lives for its endurance", test_endurance);
    g_test_add_func("/growth/starve/without upkeep none starves", test_neutral);
    g_test_add_func("/growth/starve/what falls gives its space back", test_fallen);
    g_test_add_func("/growth/starve/the wood of a stem is a cylinder's", test_wood);
    g_test_add_func("/growth/starve/a dense stand thins itself by the law of three halves",
                    test_thinning);
    g_test_add_func("/growth/starve/the same plants die for any threads and after resuming",
                    test_same);
    return g_test_run();
}
