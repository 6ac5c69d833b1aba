/// What falls, and the wood that remembers it. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

/// E10: after a step no branch that may fall is left with so many dark buds.
static void test_shed(void) {
    World world;
    world_init(&world);
    world_set(&world, "model", "open");
    world_set(&world, "dormancy", "0");
    world_set(&world, "shed-light", "0.5");
    world_set(&world, "auxin-reach", "1");
    world_set(&world, "foliage", "0.5");
    world_sow_one(&world);
    uint64_t fallen = 0;
    for (int i = 0; i < 16; i++) {
        fallen += world_step(&world, 1).shed;
        const FrGrownPlant *plant = &world.growth->plants[0];
        const FrGrownNodes *nodes = &plant->nodes;
        uint32_t *buds = g_new0(uint32_t, nodes->count), *dark = g_new0(uint32_t, nodes->count);
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            for (uint32_t n = plant->buds[b].node; n != FR_NONE; n = nodes->parent[n]) {
                buds[n]++;
                dark[n] += plant->buds[b].light < 0.5f;
            }
        }
        for (uint32_t a = 1; a < plant->axis_count; a++) {
            const FrGrownAxis *axis = &plant->axes[a];
            if (axis->first != FR_NONE && axis->birth + 3u <= world.growth->step &&
                buds[axis->first] > 0) {
                g_assert_cmpfloat(dark[axis->first], <, 0.8 * buds[axis->first]);
            }
        }
        g_free(buds);
        g_free(dark);
    }
    g_assert_cmpuint(fallen, >, 0);
    world_clear(&world);
}

/// E19: the area of cross-sections is the same on both sides of a fork, and of fallen branches it
/// stays.
static void test_wood(void) {
    World world;
    world_init(&world);
    world_set(&world, "model", "open");
    world_set(&world, "dormancy", "0");
    world_set(&world, "taper", "0");
    world_set(&world, "smooth", "no");
    world_set(&world, "pipe-exponent", "2");
    world_set(&world, "foliage", "0.2");
    world_set(&world, "shed-light", "0.5");
    world_sow_one(&world);
    double last = 0;
    for (int i = 0; i < 12; i++) {
        world_step(&world, 1);
        FrPlant *plant = world_plant(&world, 0);
        double base = (double)plant->nodes.radius[0];
        g_assert_cmpfloat(base, >=, last - 1e-7); // a trunk never thins
        last = base;
        fr_plant_free(plant);
    }
    world_set(&world, "shed", "none");
    fr_growth_free(world.growth);
    world_sow_one(&world);
    world_step(&world, 10);
    FrPlant *plant = world_plant(&world, 0);
    double *area = g_new0(double, plant->nodes.count);
    for (uint32_t i = plant->nodes.count; i-- > 0;) {
        double own = (double)plant->nodes.radius[i] * (double)plant->nodes.radius[i];
        if (area[i] > 0) {
            g_assert_cmpfloat(fabs(own / area[i] - 1), <, 1e-6);
        }
        if (plant->nodes.parent[i] != FR_NONE) {
            area[plant->nodes.parent[i]] += own;
        }
    }
    g_free(area);
    fr_plant_free(plant);
    world_clear(&world);
}

/// Pipes at the foot of a plant that fills its envelope and then grows as much as falls.
static void grow_pipes(const char *fallen_wood, double pipes_after[60]) {
    World world;
    world_init(&world);
    world_set(&world, "model", "open");
    world_set(&world, "dormancy", "0");
    world_set(&world, "envelope", "1.2,0 1.2,2");
    world_set(&world, "shed-light", "0.4");
    world_set(&world, "fallen-wood", fallen_wood);
    world_sow_one(&world);
    for (int i = 0; i < 60; i++) {
        world_step(&world, 1);
        const FrGrownPlant *plant = &world.growth->plants[0];
        double *pipes = g_new(double, plant->nodes.count);
        fr_growth_pipes(plant, &world.species.params, pipes);
        pipes_after[i] = pipes[0];
        g_free(pipes);
        g_assert_true(i == 0 || pipes_after[i] >= pipes_after[i - 1] * 0.999999);
    }
    world_clear(&world);
}

static void test_fallen_wood(void) {
    double kept[60], reused[60];
    grow_pipes("kept", kept);
    grow_pipes("reused", reused);
    g_test_message("%g, then %g; %g, then %g", kept[29], kept[59], reused[29], reused[59]);
    g_assert_cmpfloat(reused[29], <, kept[29]);
    g_assert_cmpfloat(reused[59] - reused[29], <, 0.3 * (kept[59] - kept[29]));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/shed/E10 no branch keeps so many dark buds", test_shed);
    g_test_add_func("/growth/shed/E19 forks keep the area, trunks never thin", test_wood);
    g_test_add_func("/growth/shed/trunks never thin, and thicken less where wood is used again",
                    test_fallen_wood);
    return g_test_run();
}
