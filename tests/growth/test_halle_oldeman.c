/// The architectural models and the shipped species. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

/// A plant of a model to which nothing is in the way, neither wood nor shade.
static void init_unhindered(World *world, const char *model) {
    world_init(world);
    world_set(world, "model", model);
    world_set(world, "collide", "no");
    world->setup.params.light = FR_GROWTH_FULL;
}

static void test_leeuwenberg(void) {
    World world;
    init_unhindered(&world, "leeuwenberg");
    world_sow_one(&world);
    world_step(&world, 15);
    const FrGrownPlant *plant = &world.growth->plants[0];
    g_assert_cmpuint(plant->axis_count, >, 20);
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        const FrGrownAxis *axis = &plant->axes[a];
        g_assert_cmpuint(axis->internodes, <=, 3); // none outlives its module
        g_assert_cmpuint(axis->row, ==, 0);        // all are of one kind
        if (axis->bearer != FR_NONE) {             // and stand where one has ended
            g_assert_cmpuint(plant->axes[plant->nodes.axis[axis->bearer]].last, ==, axis->bearer);
        }
    }
    world_clear(&world);
}

static void test_rauh(void) {
    World world;
    init_unhindered(&world, "rauh");
    world_set(&world, "shed", "none");
    world_sow_one(&world);
    world_step(&world, 20);
    const FrGrownPlant *plant = &world.growth->plants[0];
    g_assert_cmpuint(plant->axes[0].internodes, ==, 20); // one axis from base to top
    g_assert_cmpuint(plant->axis_count, >, 20);
    for (uint32_t a = 1; a < plant->axis_count; a++) {
        uint32_t bearer = plant->axes[a].bearer, place = 0, axis = plant->nodes.axis[bearer];
        for (uint32_t i = bearer; i != FR_NONE && plant->nodes.axis[i] == axis;
             i = plant->nodes.parent[i]) {
            place++;
        }
        g_assert_cmpuint(place % 3, ==, 0); // tiers at the ends of units
    }
    world_clear(&world);
}

static void test_models(void) {
    for (int model = 0; model < FR_MODEL_OPEN; model++) {
        World world;
        world_init(&world);
        world.species.params.model = model;
        world_set(&world, "dormancy", "0");
        world_sow_one(&world);
        FrGrowthStats stats = world_step(&world, 14);
        bool is_single = model == FR_MODEL_HOLTTUM || model == FR_MODEL_CORNER;
        g_assert_cmpuint(stats.nodes, >=, 14);
        g_assert_true(is_single ? stats.axes == 1 : stats.axes > 1);
        fr_plant_free(world_plant(&world, 0));
        world_clear(&world);
    }
}

/// Sums of |rise| of internodes, and how many there are, by how their axes are meant to stand.
static void add_rises(const World *world, double rises[3], double counts[3]) {
    const FrGrownPlant *plant = &world->growth->plants[0];
    const FrReadySpecies *species = &world->growth->species[0];
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        const FrGrownAxis *axis = &plant->axes[plant->nodes.axis[i]];
        vec3s along = glms_vec3_sub(fr_grown_tip(plant, i), fr_grown_base(plant, i));
        int bearing = fr_order_of(species, axis->row)->bearing;
        rises[bearing] += fabs((double)glms_vec3_normalize(along).z);
        counts[bearing]++;
    }
}

static void test_level(void) {
    for (int model = 0; model < FR_MODEL_OPEN; model++) {
        World world;
        world_init(&world);
        world.species.params.model = model;
        world_set(&world, "shed", "none");
        world_sow_one(&world);
        world_step(&world, 14);
        double rises[3] = {0}, counts[3] = {0};
        add_rises(&world, rises, counts);
        if (counts[FR_BEARING_LEVEL] > 0) {
            g_assert_cmpfloat(rises[FR_BEARING_LEVEL], <, 0.3 * counts[FR_BEARING_LEVEL]);
        }
        if (counts[FR_BEARING_UPRIGHT] > 0) {
            g_assert_cmpfloat(rises[FR_BEARING_UPRIGHT], >, 0.7 * counts[FR_BEARING_UPRIGHT]);
        }
        world_clear(&world);
    }
}

/// Grows a stem of `model` and tells its radius at the foot, the number of its leaves and their
/// length.
static void measure_stem(int model, double *radius, double *leaves, double *length) {
    World world;
    world_init(&world);
    world.species.params.model = model;
    world_set(&world, "laterals", "0");
    world_sow_one(&world);
    world_step(&world, 8);
    FrPlant *plant = world_plant(&world, 0);
    *radius = (double)plant->nodes.radius[0];
    *leaves = plant->organs.count;
    *length = (double)g_array_index(plant->shapes, FrShape, plant->organs.shape[0]).blade.length;
    fr_plant_free(plant);
    world_clear(&world);
}

static void test_habit(void) {
    double radius, leaves, length, thick, few, large;
    measure_stem(FR_MODEL_ATTIMS, &radius, &leaves, &length);
    measure_stem(FR_MODEL_CORNER, &thick, &few, &large);
    g_assert_cmpfloat(fabs(thick / radius - 10), <, 1e-4);
    g_assert_cmpfloat(fabs(large / length - 5.5), <, 1e-4);
    g_assert_cmpfloat(few, ==, 2 * 16); // 4 times as many at each of the last two nodes, not five
    g_assert_cmpfloat(leaves, ==, 5 * 4);
}

static void test_presets(void) {
    for (const char *const *name = fr_species_presets(); *name != NULL; name++) {
        World world;
        world_init(&world);
        g_assert_true(fr_species_preset(*name, &world.species.params));
        world_sow_one(&world);
        FrGrowthStats stats = world_step(&world, 12);
        g_assert_cmpuint(stats.nodes, >, 10);
        world_clear(&world);
    }
    FrSpecies species = fr_species_default();
    g_assert_false(fr_species_preset("no such", &species.params));
    fr_params_clear(fr_species_table(), &species.params);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/halle_oldeman/E15 Leeuwenberg: no axis outlives its module",
                    test_leeuwenberg);
    g_test_add_func("/growth/halle_oldeman/E15 Rauh: one trunk, tiers at the ends of units",
                    test_rauh);
    g_test_add_func("/growth/halle_oldeman/every architectural model grows", test_models);
    g_test_add_func("/growth/halle_oldeman/what is meant to stand or lie level does in all models",
                    test_level);
    g_test_add_func("/growth/halle_oldeman/palms have thick stems and few large leaves",
                    test_habit);
    g_test_add_func("/growth/halle_oldeman/every shipped species grows", test_presets);
    return g_test_run();
}
