/// Nothing grows through what is in the way, or out of its envelope. E numbers are those of
/// docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

static void test_envelope(void) {
    World world;
    world_init_plain(&world);
    world_set(&world, "envelope", "0,0 1.2,1 0.3,2 1.2,3 0,4");
    world_set(&world, "dormancy", "0");
    world_set(&world, "step", "0.15");
    world_sow_one(&world);
    FrGrowthStats stats = world_step(&world, 22);
    g_assert_cmpuint(stats.nodes, >, 300);
    const FrGrownPlant *plant = &world.growth->plants[0];
    const FrPoints *outline = &world.species.params.envelope;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        vec3s at = plant->nodes.at[i];
        double across = hypot((double)at.x, (double)at.y);
        g_assert_cmpfloat(across, <=, fr_envelope_radius(outline, (double)at.z) + 1e-6);
    }
    world_clear(&world);
}

/// True if a segment meets a triangle (Möller, Trumbore 1997), in double precision.
static bool meets(const double from[3], const double to[3], const double corner[3][3]) {
    double way[3], a[3], b[3], p[3], t[3], q[3];
    for (int k = 0; k < 3; k++) {
        way[k] = to[k] - from[k];
        a[k] = corner[1][k] - corner[0][k];
        b[k] = corner[2][k] - corner[0][k];
        t[k] = from[k] - corner[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3;
        p[k] = way[m] * b[n] - way[n] * b[m];
        q[k] = t[m] * a[n] - t[n] * a[m];
    }
    double scale = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
    if (scale == 0) {
        return false;
    }
    double u = (t[0] * p[0] + t[1] * p[1] + t[2] * p[2]) / scale;
    double v = (way[0] * q[0] + way[1] * q[1] + way[2] * q[2]) / scale;
    double s = (b[0] * q[0] + b[1] * q[1] + b[2] * q[2]) / scale;
    return u >= 0 && v >= 0 && u + v <= 1 && s >= 0 && s <= 1;
}

/// E02, E13: branches of plants around an octahedron go nowhere through it.
static void test_obstacle(void) {
    static const vec3s corners[6] = {{{1.1f, 0, 1.5f}},  {{-1.1f, 0, 1.5f}}, {{0, 1.1f, 1.5f}},
                                     {{0, -1.1f, 1.5f}}, {{0, 0, 2.6f}},     {{0, 0, 0.4f}}};
    static const uint32_t indices[] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                       2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    FrGrowthObstacle stone = {
        .positions = corners, .vertex_count = 6, .indices = indices, .index_count = 24};
    World world;
    world_init_plain(&world);
    world_set(&world, "dormancy", "0");
    world_set(&world, "step", "0.2");
    world.setup.obstacles = &stone;
    world.setup.obstacle_count = 1;
    FrSeed seeds[6];
    for (uint32_t i = 0; i < 6; i++) {
        seeds[i] = (FrSeed){.at = {0.9 * cos(i), 0.9 * sin(i), 0}, .id = i};
    }
    world_sow(&world, seeds, 6);
    FrGrowthStats stats = world_step(&world, 15);
    g_assert_cmpuint(stats.nodes, >, 1000);
    for (uint32_t p = 0; p < 6; p++) {
        const FrGrownPlant *plant = &world.growth->plants[p];
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            vec3s base = fr_grown_base(plant, i);
            double from[3], to[3], corner[3][3];
            for (int k = 0; k < 3; k++) {
                from[k] = (double)base.raw[k];
                to[k] = plant->seed.at[k] + (double)plant->nodes.at[i].raw[k];
            }
            for (int t = 0; t < 8; t++) {
                for (int c = 0; c < 9; c++) {
                    corner[c / 3][c % 3] = (double)corners[indices[3 * t + c / 3]].raw[c % 3];
                }
                g_assert_false(meets(from, to, (const double(*)[3])corner));
            }
        }
    }
    world_clear(&world);
}

/// A seed beside its envelope is told; one below it is not, for its trunk grows into it.
static void test_beside_envelope(void) {
    static const struct {
        const char *envelope;
        size_t warnings;
    } cases[] = {{"0,0 1,1 0,2", 0}, {"0,1.5 1,2 0,3", 0}, {"0,-3 1,-2 0,-1", 1}, {"", 0}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        World world;
        world_init_plain(&world);
        world_set(&world, "envelope", cases[i].envelope);
        FrSource *source = fr_source_new("seeds", "here", 4);
        const FrSeed seed = {.id = 1, .span = {.source = source, .end = 4}};
        world_sow(&world, &seed, 1);
        g_assert_cmpuint(fr_diags_count(world.context.diags), ==, cases[i].warnings);
        if (cases[i].warnings > 0) {
            const FrDiag *diag = fr_diags_get(world.context.diags, 0);
            g_assert_cmpstr(diag->code, ==, "seed-envelope");
            g_assert_true(diag->span.source == source);
        }
        world_clear(&world);
        fr_source_unref(source);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/collide/E04 no internode leaves its envelope", test_envelope);
    g_test_add_func("/growth/collide/E02 E13 no internode meets an obstacle's triangles",
                    test_obstacle);
    g_test_add_func("/growth/collide/a seed beside its envelope is told at its place",
                    test_beside_envelope);
    return g_test_run();
}
