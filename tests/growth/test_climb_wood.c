/// Climbers on trees that grow beside them.
#include "growing.h"
#include "growth/climbing.h"

enum { IVY, TREE, KINDS, STEPS = 28 };

/// A tree of one thick trunk, and ivies beside it.
typedef struct Grove {
    World world;
    FrSpecies kinds[KINDS];
} Grove;

static void set(FrSpecies *species, const char *name, const char *value) {
    const FrParam *row = fr_params_find(fr_species_table(), name);
    g_assert_nonnull(row);
    g_assert_cmpint(
        fr_params_set(fr_species_table(), &species->params, row, value, (FrSpan){0}, NULL, NULL),
        ==, FR_OK);
}

static void grove_init(Grove *grove) {
    world_init(&grove->world);
    grove->kinds[IVY] = grove->world.species;
    grove->kinds[TREE] = fr_species_default();
    g_assert_true(fr_species_preset("ivy", &grove->kinds[IVY].params));
    set(&grove->kinds[TREE], "model", "open");
    set(&grove->kinds[TREE], "step", "0.3");
    set(&grove->kinds[TREE], "auxin-reach", "1");
    set(&grove->kinds[TREE], "shed", "none");
    set(&grove->kinds[TREE], "tip-radius", "0.005");
    FrGrowthSetup *setup = &grove->world.setup;
    setup->species = grove->kinds;
    setup->species_count = KINDS;
    setup->params.min = (vec3s){{-5, -5, -1}};
    setup->params.max = (vec3s){{5, 5, 6}};
    setup->params.cell = 0.02;
    setup->params.light = FR_GROWTH_FULL;
}

static const FrSeed seeds[3] = {{.id = 1, .at = {0, 0, 0}, .species = TREE},
                                {.id = 2, .at = {0.25, 0, 0}, .species = IVY},
                                {.id = 3, .at = {-0.1, 0.22, 0}, .species = IVY}};

static void grove_clear(Grove *grove) {
    fr_params_clear(fr_species_table(), &grove->kinds[TREE].params);
    grove->world.species = grove->kinds[IVY];
    world_clear(&grove->world);
}

// ---- on the bark ------------------------------------------------------------------------------

/// The internodes of a plant as they are drawn: cones between nodes.
static FrStem *stems_of(const World *world, uint32_t index, uint32_t *count) {
    FrPlant *plant = world_plant(world, index);
    const FrSeed seed = fr_growth_seed(world->growth, index);
    *count = plant->nodes.count;
    FrStem *stems = g_new0(FrStem, *count + 1);
    for (uint32_t i = 0; i < *count; i++) {
        vec3s to = plant->nodes.position[i];
        vec3s along = fr_frame_heading(plant->nodes.frame[i]);
        uint32_t parent = plant->nodes.parent[i];
        bool is_first = parent == FR_NONE || plant->nodes.axis[parent] != plant->nodes.axis[i];
        for (int r = 0; r < 3; r++) {
            stems[i].to[r] = (double)to.raw[r] + seed.at[r];
            stems[i].from[r] = stems[i].to[r] - (double)(along.raw[r] * plant->nodes.length[i]);
        }
        stems[i].radius[1] = (double)plant->nodes.radius[i];
        stems[i].radius[0] = is_first ? stems[i].radius[1] : (double)plant->nodes.radius[parent];
    }
    fr_plant_free(plant);
    return stems;
}

/// Distance from a stem, worked out for each in turn; only those that climbers feel.
static double from_bark(const FrStem *stems, uint32_t count, double thinnest, const double at[3]) {
    double least = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double along = 0, square = 0, off = 0;
        for (int r = 0; r < 3; r++) {
            double d = stems[i].to[r] - stems[i].from[r];
            along += d * (at[r] - stems[i].from[r]);
            square += d * d;
        }
        double t = CLAMP(along / square, 0, 1);
        for (int r = 0; r < 3; r++) {
            double d = at[r] - (stems[i].from[r] + t * (stems[i].to[r] - stems[i].from[r]));
            off += d * d;
        }
        double radius = stems[i].radius[0] + t * (stems[i].radius[1] - stems[i].radius[0]);
        least = radius >= thinnest ? fmin(least, sqrt(off) - radius) : least;
    }
    return least;
}

static void test_touches(void) {
    Grove grove;
    grove_init(&grove);
    world_sow(&grove.world, seeds, 3);
    world_step(&grove.world, STEPS);
    uint32_t count, held = 0, nodes = 0;
    FrStem *bark = stems_of(&grove.world, 0, &count);
    const FrSpeciesParams *params = &grove.kinds[IVY].params;
    for (uint32_t p = 1; p < 3; p++) {
        const FrGrownPlant *ivy = &grove.world.growth->plants[p];
        float *radii = fr_growth_radii_of(grove.world.growth, ivy);
        for (uint32_t i = 0; i < ivy->nodes.count; i++) {
            vec3s tip = fr_grown_tip(ivy, i);
            double at[3] = {(double)tip.x, (double)tip.y, (double)tip.z};
            double off = from_bark(bark, count, params->climb_wood, at);
            g_assert_cmpfloat(off, >, (double)radii[i] - 5e-4);
            held += off < (double)radii[i] + 0.01;
            nodes++;
        }
        g_free(radii);
    }
    g_assert_cmpuint(nodes, >, 150);
    g_assert_cmpuint(held, >, nodes / 2);
    g_free(bark);
    grove_clear(&grove);
}

/// The first drawn part above an ivy's first internode, which comes out of the ground wherever the
/// trunk has come to since.
static uint32_t first_above(const World *world, uint32_t index) {
    FrPlant *plant = world_plant(world, index);
    vec3s first = world->growth->plants[index].nodes.at[0];
    uint32_t i = 0;
    while (glms_vec3_distance(plant->nodes.position[i], first) > 1e-4f) {
        i++;
    }
    fr_plant_free(plant);
    return i + 1;
}

/// Middle lines of all that is drawn of the ivies, and how deep in bark they lie at most.
static void test_outside(void) {
    Grove grove;
    grove_init(&grove);
    world_sow(&grove.world, seeds, 3);
    world_step(&grove.world, STEPS);
    uint32_t count, parts;
    FrStem *bark = stems_of(&grove.world, 0, &count);
    double deepest = 0;
    for (uint32_t p = 1; p < 3; p++) {
        FrStem *stems = stems_of(&grove.world, p, &parts);
        for (uint32_t i = first_above(&grove.world, p); i < parts; i++) {
            for (int k = 0; k <= 4; k++) {
                double at[3];
                for (int r = 0; r < 3; r++) {
                    at[r] = stems[i].from[r] + k / 4.0 * (stems[i].to[r] - stems[i].from[r]);
                }
                deepest = fmax(deepest, -from_bark(bark, count, 0.02, at));
            }
        }
        g_free(stems);
    }
    g_test_message("deepest %g m", deepest);
    g_assert_cmpfloat(deepest, <, 0.01);
    g_free(bark);
    grove_clear(&grove);
}

static void test_leaves(void) {
    Grove grove;
    grove_init(&grove);
    world_sow(&grove.world, seeds, 3);
    world_step(&grove.world, STEPS);
    const FrGrowth *growth = grove.world.growth;
    FrPlant *plant = world_plant(&grove.world, 1);
    uint32_t outward = 0, on_bark = 0;
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        uint32_t node = plant->organs.node[i];
        versors frame = glms_quat_mul(plant->nodes.frame[node], plant->organs.rotation[i]);
        vec3s tip = plant->nodes.position[node];
        const FrSeed seed = fr_growth_seed(growth, 1);
        double at[3] = {(double)tip.x + seed.at[0], (double)tip.y + seed.at[1], (double)tip.z};
        FrBark bark = fr_stems_near(growth->bark, at, 0.05, 0.02);
        if (bark.distance < 0.05) {
            vec3s away = {{(float)bark.outward[0], (float)bark.outward[1], (float)bark.outward[2]}};
            outward += glms_vec3_dot(fr_frame_up(frame), away) > 0.8f;
            on_bark++;
        }
    }
    g_assert_cmpuint(on_bark, >, 50);
    g_assert_cmpuint(outward, ==, on_bark);
    fr_plant_free(plant);
    grove_clear(&grove);
}

// ---- what holds -------------------------------------------------------------------------------

static double highest(const World *world, uint32_t index) {
    const FrGrownPlant *plant = &world->growth->plants[index];
    double most = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        most = fmax(most, (double)plant->nodes.at[i].z);
    }
    return most;
}

/// How high the first ivy comes beside a tree.
static double climbed(const char *thinnest) {
    Grove grove;
    grove_init(&grove);
    set(&grove.kinds[IVY], "climb-wood", thinnest);
    world_sow(&grove.world, seeds, 2);
    world_step(&grove.world, STEPS + 10);
    double most = highest(&grove.world, 1);
    grove_clear(&grove);
    return most;
}

static void test_thickness(void) {
    g_assert_cmpfloat(climbed("0.02"), >, 0.7);
    g_assert_cmpfloat(climbed("1000"), <, 0.5);
}

static void test_each_other(void) {
    Grove grove;
    grove_init(&grove);
    set(&grove.kinds[IVY], "tip-radius", "0.03");
    world_sow(&grove.world, seeds + 1, 2);
    world_step(&grove.world, STEPS);
    double free_length = grove.kinds[IVY].params.climb_free;
    g_assert_cmpfloat(highest(&grove.world, 0), <, free_length);
    g_assert_cmpfloat(highest(&grove.world, 1), <, free_length);
    grove_clear(&grove);
}

static void test_cells(void) {
    Grove grove;
    grove_init(&grove);
    world_sow(&grove.world, seeds, 2);
    world_step(&grove.world, STEPS);
    const FrGrownPlant *ivy = &grove.world.growth->plants[1];
    for (uint32_t i = 0; i < ivy->nodes.count; i++) {
        vec3s tip = fr_grown_tip(ivy, i);
        double at[3] = {(double)tip.x, (double)tip.y, (double)tip.z};
        g_assert_true(fr_growth_is_taken(grove.world.growth, at));
    }
    grove_clear(&grove);
}

// ---- the same bits ----------------------------------------------------------------------------

/// In shadows, which must move with what casts them.
static void grow(int threads, const FrSeed *order, bool is_resumed, FrDigest *digests) {
    Grove grove;
    grove_init(&grove);
    grove.world.setup.params.light = FR_GROWTH_SHADOWS;
    grove.world.context.pool = fr_pool_new(threads);
    world_sow(&grove.world, order, 3);
    for (int i = 0; i < STEPS; i++) {
        digests[i] = world_step(&grove.world, 1).digest;
        if (is_resumed) {
            world_resume(&grove.world);
        }
    }
    fr_pool_free(grove.world.context.pool);
    grove_clear(&grove);
}

static void test_bits(void) {
    static const FrSeed turned[3] = {{.id = 3, .at = {-0.1, 0.22, 0}, .species = IVY},
                                     {.id = 1, .at = {0, 0, 0}, .species = TREE},
                                     {.id = 2, .at = {0.25, 0, 0}, .species = IVY}};
    FrDigest one[STEPS], other[STEPS];
    grow(1, seeds, false, one);
    for (int threads = 2; threads <= 8; threads = threads == 3 ? 8 : threads + 1) {
        grow(threads, seeds, false, other);
        g_assert_true(memcmp(one, other, sizeof one) == 0);
    }
    grow(2, turned, false, other);
    g_assert_true(memcmp(one, other, sizeof one) == 0);
    grow(1, seeds, true, other);
    g_assert_true(memcmp(one, other, sizeof one) == 0);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/growth/climb/ivy touches the bark of a tree that thickens", test_touches);
    g_test_add_func("/growth/climb/no shoot is drawn through a trunk", test_outside);
    g_test_add_func("/growth/climb/leaves on bark look away from it", test_leaves);
    g_test_add_func("/growth/climb/wood gives hold only where it is thick enough", test_thickness);
    g_test_add_func("/growth/climb/climbers do not hold on to each other", test_each_other);
    g_test_add_func("/growth/climb/cells go with the wood that bark carries outward", test_cells);
    g_test_add_func("/growth/climb/on trees, threads, order and resuming change no bit", test_bits);
    return g_test_run();
}
