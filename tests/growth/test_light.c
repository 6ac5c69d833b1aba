/// What buds and leaves see of the sky. E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

static FrLiveBud look(const FrGrowthObstacle *obstacle) {
    World world;
    world_init_plain(&world);
    world.setup.obstacles = obstacle;
    world.setup.obstacle_count = obstacle == NULL ? 0 : 1;
    world.setup.params.views = 64;
    world_sow_one(&world);
    world_step(&world, 1);
    FrLiveBud bud = world.growth->plants[0].buds[0];
    world_clear(&world);
    return bud;
}

static void test_light(void) {
    g_assert_cmpfloat(fabs((double)look(NULL).light - 1), <, 1e-6);
    vec3s plate[4] = {{{-15, -15, 2}}, {{15, -15, 2}}, {{15, 15, 2}}, {{-15, 15, 2}}};
    FrGrowthObstacle above = world_sheet(plate);
    g_assert_cmpfloat(look(&above).light, <, 0.12f);
    vec3s wall[4] = {{{0.5f, -19, 0}}, {{0.5f, 19, 0}}, {{0.5f, 19, 29}}, {{0.5f, -19, 29}}};
    FrGrowthObstacle beside = world_sheet(wall);
    FrLiveBud bud = look(&beside);
    g_assert_cmpfloat(bud.light, >, 0.4f);
    g_assert_cmpfloat(bud.light, <, 0.6f);
    g_assert_cmpfloat(bud.brightest.x, <, -0.3f);
}

/// E20.
static void test_level_leaves(void) {
    World world;
    world_init(&world);
    world_set(&world, "leaf-facing", "horizontal");
    world_set(&world, "leaves", "3");
    world_sow_one(&world);
    FrGrowthStats stats = world_step(&world, 8);
    FrPlant *plant = world_plant(&world, 0);
    g_assert_cmpuint(plant->organs.count, ==, stats.leaves);
    g_assert_cmpuint(plant->organs.count, >, 10);
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(plant, i, &position, &rotation);
        g_assert_cmpfloat(fr_frame_up(rotation).z, >=, 0.999f);
    }
    fr_plant_free(plant);
    world_clear(&world);
}

/// Leaves that face the light do so, wherever it comes from.
static void test_lit_leaves(void) {
    World world;
    world_init_plain(&world);
    world_set(&world, "leaf-facing", "lit");
    vec3s wall[4] = {{{0.3f, -19, 0}}, {{0.3f, 19, 0}}, {{0.3f, 19, 29}}, {{0.3f, -19, 29}}};
    FrGrowthObstacle beside = world_sheet(wall);
    world.setup.obstacles = &beside;
    world.setup.obstacle_count = 1;
    world_sow_one(&world);
    world_step(&world, 4);
    FrPlant *plant = world_plant(&world, 0);
    g_assert_cmpuint(plant->organs.count, >, 4);
    double lean = 0;
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        versors world_frame =
            glms_quat_mul(plant->nodes.frame[plant->organs.node[i]], plant->organs.rotation[i]);
        lean += (double)fr_frame_up(world_frame).x / plant->organs.count;
    }
    g_assert_cmpfloat(lean, <, -0.25); // away from the wall
    fr_plant_free(plant);
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/light/E07 a plate darkens, a wall halves, the sky lights", test_light);
    g_test_add_func("/growth/light/E20 level leaves are level", test_level_leaves);
    g_test_add_func("/growth/light/leaves that face the light turn from a wall", test_lit_leaves);
    return g_test_run();
}
