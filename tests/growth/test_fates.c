/// Vigour, shared out at forks or by rank. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

/// The counts of the program that the authors of Palubicki et al. 2009 gave away.
static void test_palubicki(void) {
    static const double published[] = {1, 9, 28, 72, 180, 441, 1053, 2501, 5867, 13676, 31163};
    World world;
    world_init(&world);
    bool is_known = fr_species_preset("self-organizing", &world.species.params);
    g_assert_true(is_known);
    world.setup.params.light = FR_GROWTH_SHADOWS;
    world.setup.params.shadow_cell = 200.0 / 201;
    world.setup.params.min = (vec3s){{-100, -100, 0}};
    world.setup.params.max = (vec3s){{100, 100, 200}};
    world_sow_one(&world);
    for (size_t i = 0; i < G_N_ELEMENTS(published); i++) {
        double count = (double)world_step(&world, 1).nodes;
        g_assert_cmpfloat(fabs(count / published[i] - 1), <, 0.05);
    }
    world_clear(&world);
}

/// What brings more light gets more, and what is shared out is all there is.
static void check_shares(int fate) {
    World world;
    world_init(&world);
    bool is_known = fr_species_preset("self-organizing", &world.species.params);
    g_assert_true(is_known);
    world.species.params.fate = fate;
    world.species.params.vigour_base = 2;
    world.setup.params.light = FR_GROWTH_FULL;
    world_sow_one(&world);
    FrGrowthStats stats = world_step(&world, 6);
    g_assert_cmpuint(stats.axes, >, 3);
    const FrGrownPlant *plant = &world.growth->plants[0];
    double light = 0;
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        light += (double)plant->buds[b].light;
    }
    g_assert_cmpfloat(light, >, 5);
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        if (plant->axes[a].bearer != FR_NONE && plant->axes[a].birth < world.growth->step) {
            g_assert_cmpfloat(plant->axes[a].vigour, >, 0);
            g_assert_cmpfloat(plant->axes[a].vigour, <, plant->axes[0].vigour);
        }
    }
    world_clear(&world);
}

static void test_flux(void) {
    check_shares(FR_FATE_FLUX);
}

static void test_priority(void) {
    check_shares(FR_FATE_PRIORITY);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/fates/the constants of 2009 give the counts of 2009", test_palubicki);
    g_test_add_func("/growth/fates/vigour is shared out at forks", test_flux);
    g_test_add_func("/growth/fates/vigour is shared out by rank", test_priority);
    return g_test_run();
}
