/// Where an internode goes and how long it is. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

static void test_tilted_gravity(void) {
    World world;
    world_init_plain(&world);
    world_set(&world, "laterals", "0");
    world_set(&world, "gravitropism", "1");
    world_set(&world, "phototropism", "0");
    world.setup.params.gravity = (vec3s){{0.5f, 0, -0.8660254f}};
    world_sow_one(&world);
    world_step(&world, 10);
    const FrGrownNodes *nodes = &world.growth->plants[0].nodes;
    vec3s top = glms_vec3_normalize(nodes->at[nodes->count - 1]);
    double tilt = acos((double)top.z) * 180 / G_PI;
    g_assert_cmpfloat(fabs(tilt - 30), <, 2);
    g_assert_cmpfloat(top.x, <, 0);
    world_clear(&world);
}

/// Mean rise of all internodes but the trunk's.
static double mean_rise(double gravitropism) {
    World world;
    world_init_plain(&world);
    world.species.params.gravitropism = gravitropism;
    world_set(&world, "dormancy", "0");
    world_set(&world, "auxin-reach", "1");
    world_set(&world, "phototropism", "0");
    world_set(&world, "collide", "no");
    world.setup.params.light = FR_GROWTH_FULL;
    world.setup.params.min.z = -20;
    world_sow_one(&world);
    world_step(&world, 9);
    const FrGrownPlant *plant = &world.growth->plants[0];
    double sum = 0, count = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        if (plant->axes[plant->nodes.axis[i]].order > 0) {
            vec3s from = plant->nodes.at[plant->nodes.parent[i]];
            vec3s along = glms_vec3_normalize(glms_vec3_sub(plant->nodes.at[i], from));
            sum += asin((double)along.z);
            count++;
        }
    }
    g_assert_cmpfloat(count, >, 50);
    world_clear(&world);
    return sum / count;
}

static void test_gravitropism(void) {
    double last = -2;
    for (int i = -2; i <= 4; i++) {
        double rise = mean_rise(0.1 * i);
        g_assert_cmpfloat(rise, >, last);
        last = rise;
    }
}

static void test_search(void) {
    World world;
    world_init_plain(&world);
    world_sow_one(&world);
    FrGrownPlant *plant = &world.growth->plants[0];
    FrLiveBud bud = plant->buds[0];
    bud.light = 0.1f;
    double shaded = fr_growth_length(world.growth, plant, &bud);
    bud.light = 0.9f;
    double lit = fr_growth_length(world.growth, plant, &bud);
    // 1 + γ (1 − 2 E) of the step, γ = 0.5
    g_assert_cmpfloat(fabs(shaded / world.species.params.step - 1.4), <, 1e-6);
    g_assert_cmpfloat(fabs(lit / world.species.params.step - 0.6), <, 1e-6);
    world_clear(&world);
}

static void test_part(void) {
    World world;
    world_init_plain(&world);
    world_set(&world, "turning", "part");
    world_set(&world, "phototropism", "1");
    world_set(&world, "gravitropism", "0");
    world_set(&world, "turn-part", "0.5");
    world_sow_one(&world);
    FrGrownPlant *plant = &world.growth->plants[0];
    FrLiveBud *bud = &plant->buds[0];
    bud->brightest = (vec3s){{1, 0, 0}};
    bud->slope = 1;
    vec3s half = fr_growth_direction(world.growth, plant, bud, 0);
    g_assert_cmpfloat(fabs((double)half.x - sqrt(0.5)), <, 1e-5);
    bud->slope = 0.2f;
    vec3s little = fr_growth_direction(world.growth, plant, bud, 0);
    g_assert_cmpfloat(fabs(asin((double)little.x) - 0.2 * G_PI / 2), <, 1e-5);
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/direction/E08 a trunk stands against gravity", test_tilted_gravity);
    g_test_add_func("/growth/direction/E12 branches rise with gravitropism", test_gravitropism);
    g_test_add_func("/growth/direction/E09 internodes are longer in shade", test_search);
    g_test_add_func("/growth/direction/a part of the way is turned, the more the more it draws",
                    test_part);
    return g_test_run();
}
