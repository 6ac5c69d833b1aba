/// The rules of growth one by one; E numbers are those of docs/paper-2.md.
#include "growing.h"
#include "growth/engine.h"

static void plain(World *world) {
    world_init(world);
    world_set(world, "model", "open");
    world_set(world, "wander", "0");
    world_set(world, "length-noise", "0");
    world_set(world, "shed", "none");
}

// ---- direction and length ---------------------------------------------------------------------

static void test_tilted_gravity(void) {
    World world;
    plain(&world);
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
    plain(&world);
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
    plain(&world);
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
    plain(&world);
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

// ---- light ------------------------------------------------------------------------------------

/// A flat obstacle of two triangles.
static FrGrowthObstacle sheet(const vec3s corners[4]) {
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    return (FrGrowthObstacle){
        .positions = corners, .vertex_count = 4, .indices = indices, .index_count = 6};
}

static FrLiveBud look(const FrGrowthObstacle *obstacle) {
    World world;
    plain(&world);
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
    FrGrowthObstacle above = sheet(plate);
    g_assert_cmpfloat(look(&above).light, <, 0.12f);
    vec3s wall[4] = {{{0.5f, -19, 0}}, {{0.5f, 19, 0}}, {{0.5f, 19, 29}}, {{0.5f, -19, 29}}};
    FrGrowthObstacle beside = sheet(wall);
    FrLiveBud bud = look(&beside);
    g_assert_cmpfloat(bud.light, >, 0.4f);
    g_assert_cmpfloat(bud.light, <, 0.6f);
    g_assert_cmpfloat(bud.brightest.x, <, -0.3f);
}

// ---- space ------------------------------------------------------------------------------------

static void test_envelope(void) {
    World world;
    plain(&world);
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
    plain(&world);
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

static void compete(World *world, const FrLiveBudAt *buds, uint32_t count) {
    g_assert_cmpint(fr_growth_compete(world->growth, buds, count, &world->context), ==, FR_OK);
}

/// E14.
static void test_apices(void) {
    World world;
    plain(&world);
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

// ---- branching --------------------------------------------------------------------------------

static void test_leeuwenberg(void) {
    World world;
    world_init(&world);
    world_set(&world, "model", "leeuwenberg");
    world_set(&world, "collide", "no");
    world.setup.params.light = FR_GROWTH_FULL;
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
    world_init(&world);
    world_set(&world, "model", "rauh");
    world_set(&world, "collide", "no");
    world_set(&world, "shed", "none");
    world.setup.params.light = FR_GROWTH_FULL;
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

/// E16.
static void test_auxin_reach(void) {
    uint64_t last = UINT64_MAX;
    for (int reach = 1; reach <= 6; reach++) {
        World world;
        plain(&world);
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
        plain(&world);
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

// ---- shedding, wood, leaves -------------------------------------------------------------------

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

// ---- particles --------------------------------------------------------------------------------

/// E11: a direction at infinity draws every bud; a place draws those near it, and dies when
/// reached.
static void test_particles(void) {
    World world;
    plain(&world);
    world_set(&world, "step", "0.3");
    world_set(&world, "influence", "2.4");
    world_set(&world, "kill", "0.6");
    world_set(&world, "laterals", "0");
    world_set(&world, "attraction", "2");
    world_set(&world, "gravitropism", "0");
    world_set(&world, "phototropism", "0");
    world_sow_one(&world);
    FrParticle particles[2] = {{.at = {{1, 0, 1}}, .w = 1, .kill = -1},
                               {.at = {{9, 9, 9}}, .w = 1, .kill = -1}};
    g_assert_cmpint(fr_growth_add_particles(world.growth, particles, 2, &world.context), ==, FR_OK);
    uint64_t count;
    bool *is_active;
    FrParticle *left = fr_growth_particles(world.growth, &count, &is_active);
    g_assert_cmpuint(count, ==, 2);
    g_assert_cmpint(is_active[0] + is_active[1], ==, 1);
    g_free(left);
    g_free(is_active);
    FrGrowthStats stats = world_step(&world, 7);
    g_assert_cmpuint(stats.particles, ==, 1); // one has been reached, one is far away
    const FrGrownNodes *nodes = &world.growth->plants[0].nodes;
    g_assert_cmpfloat(nodes->at[nodes->count - 1].x, >, 0.4f);
    world_clear(&world);
}

/// Mean angle between one internode of an axis and the next, with so many particles in the crown.
static double irregularity(const char *particles) {
    World world;
    plain(&world);
    world_set(&world, "envelope", "1,0 1.5,1 1,3 0,5");
    world_set(&world, "particles", particles);
    world_set(&world, "particle-mean", "nearest");
    world_set(&world, "dormancy", "0");
    world_set(&world, "auxin-reach", "1");
    world_set(&world, "influence", "0.6");
    world_set(&world, "kill", "0.2");
    world_set(&world, "gravitropism", "0");
    world_set(&world, "phototropism", "0");
    world_set(&world, "trials", "1");
    world.setup.params.light = FR_GROWTH_FULL;
    world_sow_one(&world);
    world_step(&world, 10);
    const FrGrownPlant *plant = &world.growth->plants[0];
    double turns = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        uint32_t parent = plant->nodes.parent[i];
        if (parent != FR_NONE && plant->nodes.axis[parent] == plant->nodes.axis[i]) {
            vec3s before = glms_vec3_sub(fr_grown_tip(plant, parent), fr_grown_base(plant, parent));
            vec3s after = glms_vec3_sub(fr_grown_tip(plant, i), fr_grown_base(plant, i));
            turns += (double)glms_vec3_angle(before, after);
            count++;
        }
    }
    g_assert_cmpuint(count, >, 50);
    world_clear(&world);
    return turns / count;
}

/// E11.
static void test_irregular(void) {
    double none = irregularity("0"), some = irregularity("30"), many = irregularity("300");
    g_test_message("turns of %g, %g and %g", none, some, many);
    g_assert_cmpfloat(none, <, 0.005);
    g_assert_cmpfloat(some, >, none + 0.02);
    g_assert_cmpfloat(many, >, some + 0.02);
}

/// The published rule: what is reached takes the bud along.
static void test_particle_and_bud(void) {
    World world;
    plain(&world);
    world_set(&world, "laterals", "0");
    world_set(&world, "particle-rule", "bud");
    world_set(&world, "step", "0.3");
    world_set(&world, "influence", "2.4");
    world_set(&world, "kill", "0.6");
    world_sow_one(&world);
    FrParticle particle = {.at = {{0, 0, 1}}, .w = 1, .kill = -1};
    g_assert_cmpint(fr_growth_add_particles(world.growth, &particle, 1, &world.context), ==, FR_OK);
    FrGrowthStats stats = world_step(&world, 6);
    g_assert_cmpuint(stats.particles, ==, 0);
    g_assert_cmpuint(stats.active_buds, ==, 0);
    g_assert_cmpuint(stats.nodes, <, 5);
    world_clear(&world);
}

static void grow_colony(int threads, bool is_resumed, FrDigest *digests, int steps) {
    World world;
    world_init(&world);
    bool is_known = fr_species_preset("vase", &world.species.params);
    g_assert_true(is_known);
    world.context.pool = fr_pool_new(threads);
    FrSeed seeds[2] = {{.id = 4}, {.at = {1.5, 0, 0}, .id = 9}};
    world_sow(&world, seeds, 2);
    for (int i = 0; i < steps; i++) {
        digests[i] = world_step(&world, 1).digest;
        if (is_resumed) {
            GBytes *bytes = fr_growth_save(world.growth);
            gsize size;
            const void *data = g_bytes_get_data(bytes, &size);
            g_assert_cmpint(
                fr_growth_restore(world.growth, data, size, (FrSpan){0}, &world.context), ==,
                FR_OK);
            g_bytes_unref(bytes);
        }
    }
    g_assert_cmpuint(fr_growth_stats(world.growth).axes, >, 60);
    fr_pool_free(world.context.pool);
    world_clear(&world);
}

static void test_colony(void) {
    enum { STEPS = 50 };
    FrDigest wanted[STEPS], digests[STEPS];
    grow_colony(1, false, wanted, STEPS);
    grow_colony(3, true, digests, STEPS);
    for (int i = 0; i < STEPS; i++) {
        g_assert_cmpuint(digests[i], ==, wanted[i]);
    }
}

// ---- vigour -----------------------------------------------------------------------------------

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

/// Cancelled after light and particles have changed what buds know, and have killed.
static void test_cancelled(void) {
    World world;
    world_init(&world);
    world_set(&world, "particle-rule", "bud");
    world_set(&world, "kill", "0.5");
    world_sow_one(&world);
    world_step(&world, 6);
    FrGrowthStats before = fr_growth_stats(world.growth);
    const FrLiveBud *bud = &world.growth->plants[0].buds[0];
    FrParticle near = {.at = fr_bud_world(&world.growth->plants[0], bud), .w = 1, .kill = -1};
    g_assert_cmpint(fr_growth_add_particles(world.growth, &near, 1, &world.context), ==, FR_OK);
    world.growth->params.light = FR_GROWTH_FULL;
    world.context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(world.context.progress);
    g_assert_cmpint(fr_growth_sense(world.growth, &world.context), ==, FR_CANCELLED);
    FrGrowthStats after = fr_growth_stats(world.growth);
    g_assert_cmpuint(after.digest, ==, before.digest);
    g_assert_cmpuint(after.particles, ==, 1);
    fr_progress_free(world.context.progress);
    world.context.progress = NULL;
    g_assert_cmpint(fr_growth_sense(world.growth, &world.context), ==, FR_OK);
    after = fr_growth_stats(world.growth);
    g_assert_cmpuint(after.digest, !=, before.digest);
    world_clear(&world);
}

/// What is wrong with a setup is known without an arena of cells and particles.
static void test_checked(void) {
    World world;
    world_init(&world);
    world.context.limits.bytes = 1000;
    world.setup.params.particles = 1000000;
    const FrSeed seeds[2] = {{.id = 1}, {.at = {100, 0, 0}, .id = 2}};
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(world.context.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(world.context.diags, 0)->code, ==, "seed-place");
    world.context.limits.plants = 1;
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_ERR_LIMIT);
    world.context.limits.plants = 2;
    world.setup.params.cell = 0.0001;
    g_assert_cmpint(fr_growth_check(&world.setup, seeds, 2, &world.context), ==, FR_ERR_DOCUMENT);
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
        plain(&world);
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

/// Leaves that face the light do so, wherever it comes from.
static void test_lit_leaves(void) {
    World world;
    plain(&world);
    world_set(&world, "leaf-facing", "lit");
    vec3s wall[4] = {{{0.3f, -19, 0}}, {{0.3f, 19, 0}}, {{0.3f, 19, 29}}, {{0.3f, -19, 29}}};
    FrGrowthObstacle beside = sheet(wall);
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
    g_test_add_func("/growth/rules/E08 a trunk stands against gravity", test_tilted_gravity);
    g_test_add_func("/growth/rules/E12 branches rise with gravitropism", test_gravitropism);
    g_test_add_func("/growth/rules/E09 internodes are longer in shade", test_search);
    g_test_add_func("/growth/rules/a part of the way is turned, the more the more it draws",
                    test_part);
    g_test_add_func("/growth/rules/E07 a plate darkens, a wall halves, the sky lights", test_light);
    g_test_add_func("/growth/rules/E04 no internode leaves its envelope", test_envelope);
    g_test_add_func("/growth/rules/E02 E13 no internode meets an obstacle's triangles",
                    test_obstacle);
    g_test_add_func("/growth/rules/E14 of apices that face each other one rests", test_apices);
    g_test_add_func("/growth/rules/E15 Leeuwenberg: no axis outlives its module", test_leeuwenberg);
    g_test_add_func("/growth/rules/E15 Rauh: one trunk, tiers at the ends of units", test_rauh);
    g_test_add_func("/growth/rules/every architectural model grows", test_models);
    g_test_add_func("/growth/rules/E16 the further auxin reaches, the fewer branches",
                    test_auxin_reach);
    g_test_add_func("/growth/rules/the more auxin, the fewer buds wake", test_auxin_chance);
    g_test_add_func("/growth/rules/E10 no branch keeps so many dark buds", test_shed);
    g_test_add_func("/growth/rules/E19 forks keep the area, trunks never thin", test_wood);
    g_test_add_func("/growth/rules/E20 level leaves are level", test_level_leaves);
    g_test_add_func("/growth/rules/leaves that face the light turn from a wall", test_lit_leaves);
    g_test_add_func("/growth/rules/a seed beside its envelope is told at its place",
                    test_beside_envelope);
    g_test_add_func("/growth/rules/E11 particles draw buds and die when reached", test_particles);
    g_test_add_func("/growth/rules/E11 the more particles, the less regular", test_irregular);
    g_test_add_func("/growth/rules/E11 by the published rule the bud dies too",
                    test_particle_and_bud);
    g_test_add_func("/growth/rules/space is colonized alike by any threads and after resuming",
                    test_colony);
    g_test_add_func("/growth/rules/the constants of 2009 give the counts of 2009", test_palubicki);
    g_test_add_func("/growth/rules/vigour is shared out at forks", test_flux);
    g_test_add_func("/growth/rules/vigour is shared out by rank", test_priority);
    g_test_add_func(
        "/growth/rules/a step that is cancelled before plants change leaves all as it was",
        test_cancelled);
    g_test_add_func("/growth/rules/a setup is checked without making its world", test_checked);
    g_test_add_func("/growth/rules/every shipped species grows", test_presets);
    return g_test_run();
}
