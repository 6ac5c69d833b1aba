/// The step of growing plants as a whole: what single buds do, and that nothing depends on order.
#include "growing.h"

enum { PLANTS = 12, STEPS = 12 };

/// E05: a bud alone makes an internode a step.
static void test_single(void) {
    World world;
    world_init(&world);
    world_set(&world, "model", "open");
    world_set(&world, "laterals", "0");
    world_sow_one(&world);
    g_assert_cmpuint(fr_growth_stats(world.growth).active_buds, ==, 1);
    FrGrowthStats stats = world_step(&world, 9);
    g_assert_cmpuint(stats.nodes, ==, 9);
    g_assert_cmpuint(stats.axes, ==, 1);
    g_assert_cmpuint(stats.active_buds, ==, 1);
    world_clear(&world);
}

/// A close stand with everything on: collision, sky, particles, shedding.
static void init_stand(World *world) {
    world_init(world);
    world_set(world, "model", "open");
    world_set(world, "dormancy", "0");
    world_set(world, "particles", "60");
    world_set(world, "auxin-reach", "2");
}

static void place(FrSeed *seeds, bool is_reversed) {
    for (uint32_t i = 0; i < PLANTS; i++) {
        FrSeed *seed = &seeds[is_reversed ? PLANTS - 1 - i : i];
        *seed = (FrSeed){.at = {0.7 * (i % 4) + 0.05 * i, 0.8 * (i / 4), 0}, .id = 100 + i};
    }
}

static void grow_stand(int threads, bool is_reversed, FrDigest *digests) {
    World world;
    init_stand(&world);
    world.context.pool = fr_pool_new(threads);
    FrSeed seeds[PLANTS];
    place(seeds, is_reversed);
    world_sow(&world, seeds, PLANTS);
    for (int i = 0; i < STEPS; i++) {
        FrGrowthStats stats = world_step(&world, 1);
        digests[i] = stats.digest;
        if (i == STEPS - 1) { // the stand must be one where all that happens
            g_assert_cmpuint(stats.nodes, >, 500);
            g_assert_cmpuint(stats.collisions, >, 0);
            g_assert_cmpuint(stats.particles, >, 0);
        }
    }
    fr_pool_free(world.context.pool);
    world_clear(&world);
}

static void assert_same(const FrDigest *digests, const FrDigest *wanted) {
    for (int i = 0; i < STEPS; i++) {
        g_assert_cmpuint(digests[i], ==, wanted[i]);
    }
}

static void test_threads(void) {
    FrDigest wanted[STEPS], digests[STEPS];
    grow_stand(1, false, wanted);
    static const int threads[] = {2, 3, 8};
    for (size_t i = 0; i < G_N_ELEMENTS(threads); i++) {
        grow_stand(threads[i], false, digests);
        assert_same(digests, wanted);
    }
}

/// E22.
static void test_shuffled(void) {
    FrDigest wanted[STEPS], digests[STEPS];
    grow_stand(1, false, wanted);
    grow_stand(2, true, digests);
    assert_same(digests, wanted);
}

/// E01: a run that is saved and resumed after every step ends as one that is not.
static void test_resumed(void) {
    FrDigest wanted[STEPS];
    grow_stand(1, false, wanted);
    World world;
    init_stand(&world);
    FrSeed seeds[PLANTS];
    place(seeds, false);
    world_sow(&world, seeds, PLANTS);
    for (int i = 0; i < STEPS; i++) {
        FrGrowthStats stats = world_step(&world, 1);
        g_assert_cmpuint(stats.digest, ==, wanted[i]);
        world_resume(&world);
        g_assert_cmpuint(fr_growth_stats(world.growth).digest, ==, wanted[i]);
    }
    world_clear(&world);
}

static void test_undone(void) {
    World world;
    init_stand(&world);
    world.setup.params.history = 3;
    FrSeed seeds[PLANTS];
    place(seeds, false);
    world_sow(&world, seeds, PLANTS);
    g_assert_false(fr_growth_undo(world.growth));
    FrDigest before = world_step(&world, 5).digest;
    FrDigest after = world_step(&world, 3).digest;
    for (int i = 0; i < 3; i++) {
        g_assert_true(fr_growth_undo(world.growth));
    }
    g_assert_cmpuint(fr_growth_stats(world.growth).digest, ==, before);
    g_assert_cmpuint(fr_growth_stats(world.growth).step, ==, 5);
    g_assert_false(fr_growth_undo(world.growth));
    g_assert_cmpuint(world_step(&world, 3).digest, ==, after);
    world_clear(&world);
}

/// Wrong bytes change nothing, whichever byte is wrong and wherever they end.
static void test_damaged(void) {
    World world;
    init_stand(&world);
    FrSeed seeds[PLANTS];
    place(seeds, false);
    world_sow(&world, seeds, PLANTS);
    FrDigest wanted = world_step(&world, 4).digest;
    GBytes *bytes = fr_growth_save(world.growth);
    gsize size;
    uint8_t *data = g_bytes_unref_to_data(bytes, &size);
    for (gsize at = 0; at < size; at += 97) {
        data[at] ^= 0x40;
        g_assert_cmpint(fr_growth_restore(world.growth, data, size, (FrSpan){0}, &world.context),
                        ==, FR_ERR_DOCUMENT);
        data[at] ^= 0x40;
        g_assert_cmpint(fr_growth_restore(world.growth, data, at, (FrSpan){0}, &world.context), ==,
                        FR_ERR_DOCUMENT);
    }
    g_assert_cmpuint(fr_growth_stats(world.growth).digest, ==, wanted);
    g_assert_cmpstr(fr_diags_get(world.context.diags, 0)->code, ==, "growth-state");
    g_free(data);
    world_clear(&world);
}

/// Even with a right digest no number in the bytes leads out of the arrays.
static void test_hostile(void) {
    World world;
    init_stand(&world);
    FrSeed seeds[PLANTS];
    place(seeds, false);
    world_sow(&world, seeds, PLANTS);
    world_step(&world, 3);
    GBytes *bytes = fr_growth_save(world.growth);
    gsize size;
    uint8_t *data = g_bytes_unref_to_data(bytes, &size);
    gsize body = size - sizeof(FrDigest);
    for (gsize at = 0; at < body; at += 13) {
        uint8_t old = data[at];
        data[at] = (uint8_t)(old + 0x81);
        FrDigest digest = fr_digest(0, data, body);
        memcpy(data + body, &digest, sizeof digest);
        FrStatus status = fr_growth_restore(world.growth, data, size, (FrSpan){0}, &world.context);
        if (status == FR_OK) {
            world_step(&world, 1);
            fr_plant_free(world_plant(&world, 0));
        }
        data[at] = old;
    }
    g_free(data);
    world_clear(&world);
}

/// What there is already counts, and stays.
static void test_limited(void) {
    World world;
    world_init(&world);
    world_sow_one(&world);
    FrGrowthStats stats = world_step(&world, 4);
    world.context.limits.bytes = stats.cells + stats.bytes - 1;
    g_assert_cmpint(fr_growth_step(world.growth, &world.context), ==, FR_ERR_LIMIT);
    g_assert_cmpuint(fr_growth_stats(world.growth).digest, ==, stats.digest);
    world.context.limits.bytes++;
    g_assert_cmpint(fr_growth_step(world.growth, &world.context), ==, FR_OK);
    world_clear(&world);
}

/// Seeds whose envelopes are filled when it is cancelled do not stay.
static void test_cancelled(void) {
    World world;
    world_init(&world);
    world_set(&world, "particles", "1000");
    world_sow_one(&world);
    world.context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(world.context.progress);
    g_assert_cmpint(fr_growth_add_seeds(world.growth, &(FrSeed){.id = 2}, 1, &world.context), ==,
                    FR_CANCELLED);
    g_assert_cmpuint(fr_growth_plant_count(world.growth), ==, 1);
    fr_progress_free(world.context.progress);
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/growth/a bud without laterals makes an internode a step", test_single);
    g_test_add_func("/growth/growth/the digest of every step is the same for any thread count",
                    test_threads);
    g_test_add_func("/growth/growth/the order of seeds changes nothing", test_shuffled);
    g_test_add_func("/growth/growth/saving and resuming after every step changes nothing",
                    test_resumed);
    g_test_add_func("/growth/growth/undone steps can be made again", test_undone);
    g_test_add_func("/growth/growth/damaged states are refused and change nothing", test_damaged);
    g_test_add_func("/growth/growth/hostile states crash nothing", test_hostile);
    g_test_add_func("/growth/growth/a step beyond the limit of bytes changes nothing",
                    test_limited);
    g_test_add_func("/growth/growth/seeds that are cancelled do not stay", test_cancelled);
    return g_test_run();
}
