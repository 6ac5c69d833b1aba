/// Which buds wake, and which apices rest. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

static void compete(World *world, const FrLiveBudAt *buds, uint32_t count) {
    g_assert_cmpint(fr_growth_compete(world->growth, buds, count, &world->context), ==, FR_OK);
}

/// E14.
static void test_apices(void) {
    World world;
    world_init_plain(&world);
    world_set(&world, "apex-distance", "0.5");
    FrSeed seeds[2] = {{.id = 1}, {.at = {0.4, 0, 0}, .id = 2}};
    world_sow(&world, seeds, 2);
    FrLiveBudAt buds[2];
    for (int i = 0; i < 2; i++) {
        FrLiveBud *bud = &world.growth->plants[i].buds[0];
        bud->direction = (vec3s){{i == 0 ? 1 : -1, 0, 0}};
        buds[i] = (FrLiveBudAt){.bud = bud,
                                .params = &world.growth->species[0].params,
                                .world = fr_bud_world(&world.growth->plants[i], bud)};
    }
    compete(&world, buds, 2); // of equals one goes on
    g_assert_cmpint(buds[0].bud->is_resting + buds[1].bud->is_resting, ==, 1);
    buds[0].bud->light = 0.5f;
    compete(&world, buds, 2);
    g_assert_true(buds[0].bud->is_resting);
    g_assert_false(buds[1].bud->is_resting);
    buds[0].bud->direction.x = -1; // nothing lies ahead of it any more
    compete(&world, buds, 2);
    g_assert_false(buds[0].bud->is_resting);
    world_clear(&world);
}

/// E16.
static void test_auxin_reach(void) {
    uint64_t last = UINT64_MAX;
    for (int reach = 1; reach <= 6; reach++) {
        World world;
        world_init_plain(&world);
        world.species.params.auxin_reach = reach;
        world_set(&world, "collide", "no");
        world.setup.params.light = FR_GROWTH_FULL;
        world_sow_one(&world);
        uint64_t axes = world_step(&world, 10).axes;
        g_assert_cmpuint(axes, <, last);
        last = axes;
        world_clear(&world);
    }
}

static void test_auxin_chance(void) {
    uint64_t last = UINT64_MAX;
    for (int k = 0; k < 4; k++) {
        World world;
        world_init_plain(&world);
        world.species.params.auxin = 0.5 + 1.5 * k;
        world_set(&world, "collide", "no");
        world.setup.params.light = FR_GROWTH_FULL;
        world_sow_one(&world);
        uint64_t axes = world_step(&world, 12).axes;
        g_assert_cmpuint(axes, <, last);
        last = axes;
        world_clear(&world);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/wake/E14 of apices that face each other one rests", test_apices);
    g_test_add_func("/growth/wake/E16 the further auxin reaches, the fewer branches",
                    test_auxin_reach);
    g_test_add_func("/growth/wake/the more auxin, the fewer buds wake", test_auxin_chance);
    return g_test_run();
}
