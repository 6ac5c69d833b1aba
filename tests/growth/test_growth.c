/// The step of growing plants: what single buds do, and that nothing depends on order.
#include "frond/growth.h"

#include <cglm/struct.h>
#include <math.h>

static FrGrowth *make(const FrSpecies *species, const FrSeed *seeds, uint32_t count) {
    FrContext context = fr_context_default();
    FrGrowthSetup setup = {.params = fr_growth_default(), .species = species, .species_count = 1};
    FrGrowth *growth;
    g_assert_cmpint(fr_growth_new(&setup, &context, &growth), ==, FR_OK);
    g_assert_cmpint(fr_growth_add_seeds(growth, seeds, count, &context), ==, FR_OK);
    return growth;
}

static void step(FrGrowth *growth, int count) {
    FrContext context = fr_context_default();
    for (int i = 0; i < count; i++) {
        g_assert_cmpint(fr_growth_step(growth, &context), ==, FR_OK);
    }
}

static void drop(FrSpecies *species) {
    fr_params_clear(fr_species_table(), &species->params);
}

/// E05: a bud alone makes an internode a step.
static void test_single(void) {
    FrSpecies species = fr_species_default();
    species.params.model = FR_MODEL_OPEN;
    species.params.laterals = 0;
    FrSeed seed = {.id = 1};
    FrGrowth *growth = make(&species, &seed, 1);
    g_assert_cmpuint(fr_growth_stats(growth).active_buds, ==, 1);
    step(growth, 9);
    FrGrowthStats stats = fr_growth_stats(growth);
    g_assert_cmpuint(stats.nodes, ==, 9);
    g_assert_cmpuint(stats.axes, ==, 1);
    g_assert_cmpuint(stats.active_buds, ==, 1);
    fr_growth_free(growth);
    drop(&species);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/growth/a bud without laterals makes an internode a step", test_single);
    return g_test_run();
}
