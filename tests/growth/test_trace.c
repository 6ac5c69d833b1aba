/// E06: eight steps of one plant, worked out by hand from the formulas of docs/growth-engine.md.
///
/// Internodes of the trunk are 1 m, those of its branches 0.5 m: step 2 m, times 1 + 0.5 (1 − 2 E)
/// in full light. A branch leaves at right angles and turns up by normalize(v + u): each internode
/// halves what it lacks to the vertical, so they rise at 45°, 67.5°, 78.75°. A bud wakes when two
/// internodes are above it, or the apex is gone: the ceiling at 5.6 m stops the trunk in step 6, a
/// branch in step 8. A particle at 3.1 m dies when the trunk has come as near as 0.2 m.
#include "growing.h"
#include "growth/engine.h"

static void init(World *world) {
    static const char *const values[][2] = {
        {"model", "open"},         {"step", "2"},         {"step-ratio", "0.5"},
        {"search", "0.5"},         {"min-length", "0.1"}, {"length-noise", "0"},
        {"wander", "0"},           {"laterals", "1"},     {"divergence", "90"},
        {"branching-angle", "90"}, {"max-order", "1"},    {"dormancy", "1"},
        {"auxin-reach", "1"},      {"phototropism", "0"}, {"gravitropism", "1"},
        {"attraction", "1"},       {"influence", "5"},    {"kill", "0.2"},
        {"trials", "1"},           {"shed", "light"},     {"shed-age", "0"},
        {"shed-dead", "1"}};
    world_init(world);
    for (size_t i = 0; i < G_N_ELEMENTS(values); i++) {
        world_set(world, values[i][0], values[i][1]);
    }
    world->setup.params.light = FR_GROWTH_FULL;
    world->setup.params.cell = 0.1;
}

static void test_trace(void) {
    /// After each step: internodes, axes that have any, growing buds, particles; in it: buds
    /// stopped, internodes fallen.
    static const uint64_t counts[8][6] = {
        {1, 1, 1, 1, 0, 0}, {2, 1, 1, 1, 0, 0},  {3, 1, 2, 0, 0, 0},  {5, 2, 3, 0, 0, 0},
        {8, 3, 4, 0, 0, 0}, {11, 4, 5, 0, 1, 0}, {16, 6, 5, 0, 0, 0}, {19, 5, 4, 0, 1, 1}};
    static const vec3s corners[4] = {
        {{-9, -9, 5.6f}}, {{9, -9, 5.6f}}, {{9, 9, 5.6f}}, {{-9, 9, 5.6f}}};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    const FrGrowthObstacle ceiling = {
        .positions = corners, .vertex_count = 4, .indices = indices, .index_count = 6};
    World world;
    init(&world);
    world.setup.obstacles = &ceiling;
    world.setup.obstacle_count = 1;
    world_sow_one(&world);
    const FrParticle particle = {.at = {{0, 0, 3.1f}}, .w = 1, .kill = -1};
    g_assert_cmpint(fr_growth_add_particles(world.growth, &particle, 1, &world.context), ==, FR_OK);
    for (int i = 0; i < 8; i++) {
        FrGrowthStats stats = world_step(&world, 1);
        const uint64_t found[6] = {stats.nodes,     stats.axes,       stats.active_buds,
                                   stats.particles, stats.collisions, stats.shed};
        for (int k = 0; k < 6; k++) {
            g_assert_cmpuint(found[k], ==, counts[i][k]);
        }
    }
    world_clear(&world);
}

/// Where the branch ends that leaves the trunk at 1 m, and the next, a quarter of a turn further.
static void test_places(void) {
    /// From the trunk outwards and up, m.
    static const double ends[5][2] = {{0.35355, 0.35355},
                                      {0.54490, 0.81550},
                                      {0.64244, 1.30589},
                                      {0.69145, 1.80349},
                                      {0.71598, 2.30289}};
    World world;
    init(&world);
    world_sow_one(&world);
    world_step(&world, 8);
    const FrGrownPlant *plant = &world.growth->plants[0];
    double first = NAN;
    for (uint32_t a = 1; a <= 4; a++) {
        uint32_t node = plant->axes[a].last, place = plant->axes[a].internodes;
        g_assert_cmpuint(place, ==, 6 - a);
        double around = 0;
        for (; place > 0; place--, node = plant->nodes.parent[node]) {
            vec3s at = plant->nodes.at[node];
            g_assert_cmpfloat(fabs(hypot((double)at.x, (double)at.y) - ends[place - 1][0]), <,
                              2e-5);
            g_assert_cmpfloat(fabs((double)at.z - a - ends[place - 1][1]), <, 2e-5);
            around = atan2((double)at.y, (double)at.x);
        }
        first = a == 1 ? around : first;
        double turned = remainder(around - first, 2 * G_PI);
        g_assert_cmpfloat(fabs(remainder(turned - (a - 1) * G_PI / 2, 2 * G_PI)), <, 1e-4);
    }
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/trace/E06 eight steps do what was worked out by hand", test_trace);
    g_test_add_func("/growth/trace/E06 internodes end where they were worked out to", test_places);
    return g_test_run();
}
