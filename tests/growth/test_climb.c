/// Plants that climb: what they hold on to, and what they do without.
#include "growing.h"
#include "growth/engine.h"

enum { SIDES = 32, MOST_RINGS = 12 };

/// A surface of revolution about the z axis, closed where its outline begins and ends at radius 0.
typedef struct Turned {
    vec3s corners[SIDES * MOST_RINGS];
    uint32_t indices[6 * SIDES * (MOST_RINGS - 1)];
    FrGrowthObstacle obstacle;
} Turned;

static void turn(Turned *turned, const float (*outline)[2], uint32_t rings, vec3s middle) {
    uint32_t *next = turned->indices;
    for (uint32_t ring = 0; ring < rings; ring++) {
        for (uint32_t side = 0; side < SIDES; side++) {
            double around = 2 * G_PI * side / SIDES;
            float radius = outline[ring][0];
            turned->corners[ring * SIDES + side] =
                glms_vec3_add(middle, (vec3s){{radius * (float)cos(around),
                                               radius * (float)sin(around), outline[ring][1]}});
            uint32_t a = ring * SIDES + side, b = ring * SIDES + (side + 1) % SIDES;
            if (ring + 1 < rings) {
                const uint32_t quad[6] = {a, b, b + SIDES, a, b + SIDES, a + SIDES};
                memcpy(next, quad, sizeof quad);
                next += 6;
            }
        }
    }
    turned->obstacle = (FrGrowthObstacle){.positions = turned->corners,
                                          .vertex_count = rings * SIDES,
                                          .indices = turned->indices,
                                          .index_count = 6 * SIDES * (rings - 1)};
}

static const vec3s wall_corners[8] = {{{-4, 0.5f, 0}}, {{4, 0.5f, 0}}, {{4, 1, 0}}, {{-4, 1, 0}},
                                      {{-4, 0.5f, 4}}, {{4, 0.5f, 4}}, {{4, 1, 4}}, {{-4, 1, 4}}};
static const uint32_t wall_sides[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                        1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
static const FrGrowthObstacle wall = {
    .positions = wall_corners, .vertex_count = 8, .indices = wall_sides, .index_count = 36};

static const vec3s level_corners[4] = {
    {{-20, -20, 0}}, {{20, -20, 0}}, {{-20, 20, 0}}, {{20, 20, 0}}};
static const uint32_t level_sides[6] = {0, 1, 3, 0, 3, 2};
static const FrGrowthObstacle level = {.positions = level_corners,
                                       .vertex_count = 4,
                                       .indices = level_sides,
                                       .index_count = 6,
                                       .is_ground = true};

static void ivy(World *world, const FrGrowthObstacle *obstacle) {
    world_init(world);
    g_assert_true(fr_species_preset("ivy", &world->species.params));
    world->setup.params.min = (vec3s){{-5, -5, -1}};
    world->setup.params.max = (vec3s){{5, 5, 6}};
    world->setup.params.cell = 0.02;
    world->setup.obstacles = obstacle;
    world->setup.obstacle_count = obstacle != NULL;
}

static void sow_at(World *world, double x, double y, double z) {
    world_sow(world, &(FrSeed){.id = 1, .at = {x, y, z}}, 1);
}

/// Distance from the middle line or the middle of what was turned, or from the wall's plane.
typedef double (*DistanceFn)(vec3s at);

static double to_wall(vec3s at) {
    double off[3] = {fabs((double)at.x) - 4, fabs((double)at.y - 0.75) - 0.25,
                     fabs((double)at.z - 2) - 2};
    double outside = 0, inside = -INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        outside += fmax(off[axis], 0) * fmax(off[axis], 0);
        inside = fmax(inside, off[axis]);
    }
    return inside > 0 ? sqrt(outside) : inside;
}

static double to_column(vec3s at) {
    double side = hypot((double)at.x, (double)at.y - 1) - 0.3, above = (double)at.z - 4;
    return above > 0 ? hypot(fmax(side, 0), above) : side;
}

static double to_ball(vec3s at) {
    vec3s middle = {{0, 1, 0.8f}};
    return (double)glms_vec3_distance(at, middle) - 0.8;
}

/// Everything lies outside and within reach, most of it as near as it holds on.
static void check_clings(const World *world, DistanceFn distance, double faceted) {
    const FrGrownPlant *plant = &world->growth->plants[0];
    const FrSpeciesParams *params = &world->species.params;
    double gap = 1.1 * world->setup.params.cell, holds = gap + params->step / 2 + faceted;
    uint32_t held = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        double off = distance(fr_grown_tip(plant, i));
        g_assert_cmpfloat(off, >, -faceted);
        g_assert_cmpfloat(off, <, params->climb);
        held += off < holds;
    }
    g_assert_cmpuint(plant->nodes.count, >, 200);
    g_assert_cmpuint(held, >, plant->nodes.count * 8 / 10);
}

static void test_wall(void) {
    World world;
    ivy(&world, &wall);
    sow_at(&world, 0, 0.4, 0);
    world_step(&world, 30);
    check_clings(&world, to_wall, 0);
    world_clear(&world);
}

static void make_column(Turned *column) {
    const float outline[4][2] = {{0, -0.5f}, {0.3f, -0.5f}, {0.3f, 4}, {0, 4}};
    turn(column, outline, 4, (vec3s){{0, 1, 0}});
}

static void test_column(void) {
    World world;
    Turned column;
    make_column(&column);
    ivy(&world, &column.obstacle);
    sow_at(&world, 0, 0.6, 0);
    world_step(&world, 30);
    check_clings(&world, to_column, 0.3 * (1 - cos(G_PI / SIDES)));
    world_clear(&world);
}

static void test_ball(void) {
    World world;
    Turned ball;
    float outline[MOST_RINGS][2];
    for (int i = 0; i < MOST_RINGS; i++) {
        double along = G_PI * i / (MOST_RINGS - 1);
        outline[i][0] = 0.8f * (float)sin(along);
        outline[i][1] = 0.8f - 0.8f * (float)cos(along);
    }
    outline[MOST_RINGS - 1][0] = 0;
    turn(&ball, outline, MOST_RINGS, (vec3s){{0, 1, 0}});
    ivy(&world, &ball.obstacle);
    sow_at(&world, 0, 0.1, 0.6);
    world_step(&world, 34);
    check_clings(&world, to_ball, 0.8 * (1 - cos(G_PI / (MOST_RINGS - 1) / 2)) + 0.01);
    world_clear(&world);
}

static double height_of(vec3s at) {
    return (double)at.z;
}

static void test_ground(void) {
    World world;
    ivy(&world, &level);
    sow_at(&world, 0, 0, 0);
    world_step(&world, 30);
    check_clings(&world, height_of, 0);
    world_clear(&world);
}

// ---- without a hold ---------------------------------------------------------------------------

static double highest(const World *world) {
    const FrGrownPlant *plant = &world->growth->plants[0];
    double most = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        most = fmax(most, (double)plant->nodes.at[i].z);
    }
    return most;
}

static void test_without(void) {
    World world;
    ivy(&world, NULL);
    sow_at(&world, 0, 0, 0);
    FrGrowthStats stats = world_step(&world, 80);
    g_assert_cmpfloat(highest(&world), <, world.species.params.climb_free);
    g_assert_cmpuint(stats.active_buds, ==, 0);
    world_clear(&world);
}

static void test_invisible(void) {
    World world;
    FrGrowthObstacle clear = wall;
    clear.is_clear = true;
    ivy(&world, &clear);
    sow_at(&world, 0, 0.4, 0);
    world_step(&world, 30);
    g_assert_cmpfloat(highest(&world), <, world.species.params.climb_free);
    world_clear(&world);
}

/// Lowest direction of the internodes that one shoot ends with.
static double last_rise(double sag) {
    World world;
    ivy(&world, NULL);
    world_set(&world, "laterals", "0");
    world_set(&world, "wander", "5");
    world_set(&world, "climb-free", "2");
    world.species.params.climb_sag = sag;
    sow_at(&world, 0, 0, 2);
    world_step(&world, 40);
    const FrGrownNodes *nodes = &world.growth->plants[0].nodes;
    g_assert_cmpuint(nodes->count, >, 15);
    vec3s end = glms_vec3_normalize(
        glms_vec3_sub(nodes->at[nodes->count - 1], nodes->at[nodes->count - 2]));
    world_clear(&world);
    return (double)end.z;
}

static void test_sag(void) {
    g_assert_cmpfloat(last_rise(0), >, 0.5);
    g_assert_cmpfloat(last_rise(1), <, -0.5);
}

// ---- along the surface ------------------------------------------------------------------------

/// By how much the trunk has gone around the column, seen from above.
static double wound(const char *wind) {
    World world;
    Turned column;
    make_column(&column);
    ivy(&world, &column.obstacle);
    world_set(&world, "climb-wind", wind);
    world_set(&world, "laterals", "0");
    world_set(&world, "wander", "0");
    sow_at(&world, 0, 0.6, 0);
    world_step(&world, 40);
    const FrGrownPlant *plant = &world.growth->plants[0];
    double sum = 0;
    vec3s before = fr_grown_tip(plant, 0);
    for (uint32_t i = 1; i < plant->nodes.count; i++) {
        vec3s at = fr_grown_tip(plant, i);
        sum += remainder(atan2((double)at.y - 1, (double)at.x) -
                             atan2((double)before.y - 1, (double)before.x),
                         2 * G_PI);
        before = at;
    }
    world_clear(&world);
    return sum;
}

static void test_winding(void) {
    g_assert_cmpfloat(wound("0.4"), >, 2 * G_PI);
    g_assert_cmpfloat(wound("-0.4"), <, -2 * G_PI);
    g_assert_cmpfloat(fabs(wound("0")), <, 0.5);
}

static void test_leaves(void) {
    World world;
    ivy(&world, &wall);
    sow_at(&world, 0, 0.4, 0);
    world_step(&world, 20);
    FrPlant *plant = world_plant(&world, 0);
    g_assert_cmpuint(plant->organs.count, >, 50);
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        versors frame =
            glms_quat_mul(plant->nodes.frame[plant->organs.node[i]], plant->organs.rotation[i]);
        uint32_t node = plant->organs.node[i];
        if ((double)plant->nodes.position[node].y > 0.25) { // the wall begins 0.1 m farther
            continue;
        }
        g_assert_cmpfloat(fr_frame_up(frame).y, <, -0.5);
        g_assert_cmpfloat(fr_frame_heading(frame).z, <, 0.3);
    }
    fr_plant_free(plant);
    world_clear(&world);
}

// ---- the same bits ----------------------------------------------------------------------------

static void test_neutral(void) {
    FrDigest digests[2];
    for (int i = 0; i < 2; i++) {
        World world;
        world_init(&world);
        world.setup.obstacles = &wall;
        world.setup.obstacle_count = 1;
        if (i == 1) {
            world_set(&world, "cling", "1");
            world_set(&world, "climb-free", "0.01");
            world_set(&world, "climb-sag", "9");
            world_set(&world, "climb-wind", "5");
        }
        sow_at(&world, 0, 0.4, 0.1);
        digests[i] = world_step(&world, 8).digest;
        world_clear(&world);
    }
    g_assert_cmpuint(digests[0], ==, digests[1]);
}

enum { STEPS = 16 };

static void grow_on_wall(int threads, FrDigest *digests) {
    World world;
    ivy(&world, &wall);
    world.context.pool = fr_pool_new(threads);
    const FrSeed seeds[3] = {{.id = 1, .at = {0, 0.4, 0}},
                             {.id = 2, .at = {0.4, 0.4, 0}},
                             {.id = 3, .at = {-0.4, 0.3, 0}}};
    world_sow(&world, seeds, 3);
    for (int i = 0; i < STEPS; i++) {
        digests[i] = world_step(&world, 1).digest;
    }
    fr_pool_free(world.context.pool);
    world_clear(&world);
}

static void test_threads(void) {
    FrDigest one[STEPS];
    grow_on_wall(1, one);
    for (int threads = 2; threads <= 8; threads = threads == 3 ? 8 : threads + 1) {
        FrDigest many[STEPS];
        grow_on_wall(threads, many);
        g_assert_true(memcmp(one, many, sizeof one) == 0);
    }
}

static void test_resumed(void) {
    World world;
    ivy(&world, &wall);
    sow_at(&world, 0, 0.4, 0);
    FrDigest wanted[STEPS];
    for (int i = 0; i < STEPS; i++) {
        wanted[i] = world_step(&world, 1).digest;
    }
    fr_growth_free(world.growth);
    sow_at(&world, 0, 0.4, 0);
    for (int i = 0; i < STEPS; i++) {
        g_assert_cmpuint(world_step(&world, 1).digest, ==, wanted[i]);
        world_resume(&world);
    }
    world_clear(&world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/climb/a climber keeps to a wall and out of it", test_wall);
    g_test_add_func("/growth/climb/a climber keeps to a column and out of it", test_column);
    g_test_add_func("/growth/climb/a climber keeps to a ball and out of it", test_ball);
    g_test_add_func("/growth/climb/a climber creeps where there is only ground", test_ground);
    g_test_add_func("/growth/climb/without support it rises no higher than its free length",
                    test_without);
    g_test_add_func("/growth/climb/what is not seen gives no hold", test_invisible);
    g_test_add_func("/growth/climb/long shoots without a hold bend down", test_sag);
    g_test_add_func("/growth/climb/a winding trunk goes around a column, to either side",
                    test_winding);
    g_test_add_func("/growth/climb/leaves turn away from the wall, tips down", test_leaves);
    g_test_add_func("/growth/climb/what does not climb is the same whatever else is said",
                    test_neutral);
    g_test_add_func("/growth/climb/the bits do not depend on threads", test_threads);
    g_test_add_func("/growth/climb/saved and resumed after each step it ends alike", test_resumed);
    return g_test_run();
}
