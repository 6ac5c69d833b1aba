// Growing plants: a forest along a road, the self-organizing tree of 2009, a close forest, space
// colonization, and how time grows with the number of buds. Processor time is told beside the rate,
// since a machine is seldom idle.
#include "bench.h"
#include "frond/growth.h"
#include "frond/simulation.h"

#include <math.h>

typedef struct World {
    FrContext context;
    FrSpecies species;
    FrGrowthSetup setup;
    FrGrowth *growth;
    double begin, processor; ///< when the clock was set
} World;

static World new_world(int threads) {
    World world = {.context = fr_context_default(), .species = fr_species_default()};
    world.context.pool = fr_pool_new(threads);
    world.setup.params = fr_growth_default();
    world.setup.species_count = 1;
    return world;
}

static void start_clock(World *world) {
    world->begin = bench_now();
    world->processor = bench_processor();
}

static void sow(World *world, uint32_t across, uint32_t along, double spacing) {
    world->setup.species = &world->species;
    FrStatus status = fr_growth_new(&world->setup, &world->context, &world->growth);
    FR_ASSERT(status == FR_OK);
    FrSeed *seeds = g_new0(FrSeed, across * along);
    for (uint32_t i = 0; i < across * along; i++) {
        seeds[i].at[0] = ((double)(i % across) - (across - 1) / 2.0) * spacing;
        seeds[i].at[1] = ((double)(i / across) - (along - 1) / 2.0) * spacing;
        seeds[i].id = i;
    }
    status = fr_growth_add_seeds(world->growth, seeds, across * along, &world->context);
    FR_ASSERT(status == FR_OK);
    g_free(seeds);
}

static void step(World *world, int64_t count) {
    for (int64_t i = 0; i < count; i++) {
        FrStatus status = fr_growth_step(world->growth, &world->context);
        FR_ASSERT(status == FR_OK);
    }
}

static void end(World *world) {
    fr_growth_free(world->growth);
    fr_params_clear(fr_species_table(), &world->species.params);
    fr_pool_free(world->context.pool);
}

// ---- a forest along a road --------------------------------------------------------------------

/// The steps of examples/forest-road.frond, with collision, sky, particles and shedding.
static void bench_forest(int threads) {
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(threads);
    FrDocument *document;
    FrSimulation *forest;
    FrStatus status = fr_document_load(BENCH_EXAMPLES "/forest-road.frond", &context, &document);
    FR_ASSERT(status == FR_OK);
    status = fr_simulation_new(document, -1, 0, &context, &forest);
    FR_ASSERT(status == FR_OK);
    double began = bench_now(), processor = bench_processor();
    for (uint64_t i = 0; i < fr_simulation_step_count(forest); i++) {
        status = fr_simulation_step(forest, &context);
        FR_ASSERT(status == FR_OK);
    }
    double seconds = bench_now() - began;
    processor = bench_processor() - processor;
    FrGrowthStats stats = fr_simulation_stats(forest);
    bench_tell(
        "growth.forest", (double)stats.nodes / seconds, 0, "nodes/s",
        "%d thread(s): %.2f s, %.2f s of processor; %" G_GUINT64_FORMAT
        " plants, %" G_GUINT64_FORMAT " axes, %" G_GUINT64_FORMAT " internodes, %" G_GUINT64_FORMAT
        " leaves, %" G_GUINT64_FORMAT " growing buds; %.0f bytes an internode, %.0f MB of cells",
        threads, seconds, processor, stats.plants, stats.axes, stats.nodes, stats.leaves,
        stats.active_buds, (double)stats.bytes / (double)stats.nodes, (double)stats.cells / 1e6);
    fr_simulation_free(forest);
    fr_document_free(document);
    fr_pool_free(context.pool);
}

// ---- self-organizing trees --------------------------------------------------------------------

/// The constants of Palubicki et al.'s own program, 16 iterations.
static World palubicki(int threads) {
    World world = new_world(threads);
    bool is_known = fr_species_preset("self-organizing", &world.species.params);
    FR_ASSERT(is_known);
    FrGrowthParams *params = &world.setup.params;
    params->light = FR_GROWTH_SHADOWS;
    params->shadow_cell = 200.0 / 201;
    params->min = (vec3s){{-100, -100, 0}};
    params->max = (vec3s){{100, 100, 200}};
    return world;
}

static void bench_palubicki(int threads) {
    static const double published[] = {1,    9,     28,    72,    180,    441,    1053,   2501,
                                       5867, 13676, 31163, 68732, 143753, 273481, 450285, 642195};
    World world = palubicki(threads);
    double worst = 0, seconds = 0, processor = 0;
    sow(&world, 1, 1, 1);
    for (int i = 0; i < 16; i++) {
        start_clock(&world);
        step(&world, 1);
        seconds += bench_now() - world.begin;
        processor += bench_processor() - world.processor;
        double count = (double)fr_growth_stats(world.growth).nodes;
        worst = MAX(worst, fabs(count / published[i] - 1));
    }
    FrGrowthStats stats = fr_growth_stats(world.growth);
    bench_tell("growth.palu16", (double)stats.nodes / seconds, 0, "nodes/s",
               "%d thread(s): %.2f s, %.2f s of processor; %" G_GUINT64_FORMAT
               " internodes; counts of 16 iterations within %.1f %% of the authors' program",
               threads, seconds, processor, stats.nodes, 100 * worst);
    end(&world);
}

/// 12 × 12 seedlings 0.6 m apart, internodes and cells of 2 cm, 14 steps, with collision and sky.
/// The published run, which has neither, makes 792 934 internodes with a vigour of 2 for each unit
/// of light. Here buds are stopped and shaded, so `vigour` is what makes as many of them.
static void bench_close_forest(int threads) {
    World world = new_world(threads);
    FrSpeciesParams *params = &world.species.params;
    bool is_known = fr_species_preset("self-organizing", params);
    FR_ASSERT(is_known);
    params->step = 0.02;
    params->favour = params->favour_old = 0.5;
    params->vigour = 2.3515;
    params->vigour_base = 1;
    params->branching_angle = G_PI / 4;
    params->collide = true;
    params->box = 1;
    params->trials = 2;
    params->leaves = 1;
    params->leaf_life = 2;
    params->leaf_light = 0;
    params->foliage = 0.0001;
    params->turning = FR_TURN_SUM;
    params->phototropism = 0.2;
    params->gravitropism = 0.1;
    world.setup.params.min = (vec3s){{-4, -4, 0}};
    world.setup.params.max = (vec3s){{4, 4, 4}};
    world.setup.params.cell = 0.02;
    uint64_t born = 0;
    double seconds = 0, processor = 0;
    sow(&world, 12, 12, 0.6);
    for (int i = 0; i < 14; i++) {
        start_clock(&world);
        step(&world, 1);
        seconds += bench_now() - world.begin;
        processor += bench_processor() - world.processor;
        born += fr_growth_stats(world.growth).born;
    }
    FrGrowthStats stats = fr_growth_stats(world.growth);
    bench_tell("growth.forest144", (double)born / seconds, 0, "nodes/s",
               "%d thread(s): %.2f s, %.2f s of processor; %" G_GUINT64_FORMAT
               " internodes made, %" G_GUINT64_FORMAT " alive, with collision and sky",
               threads, seconds, processor, born, stats.nodes);
    end(&world);
}

// ---- space colonization -----------------------------------------------------------------------

static FrParticle *ball_of(uint32_t count) {
    FrParticle *particles = g_new(FrParticle, count);
    for (uint32_t i = 0; i < count; i++) {
        FrKey key = fr_key_child(fr_key_root(7), i);
        double at[3], squared = 2;
        for (uint32_t k = 0; squared > 1; k += 3) {
            squared = 0;
            for (uint32_t axis = 0; axis < 3; axis++) {
                at[axis] = fr_random_signed(key, 0, k + axis);
                squared += at[axis] * at[axis];
            }
        }
        particles[i] =
            (FrParticle){.at = {{(float)at[0], (float)at[1], (float)at[2]}}, .w = 1, .kill = -1};
    }
    return particles;
}

/// N attractors in the unit ball, spacing s: step 0.7 s, kill 1.4 s, influence 6 s.
static void bench_colonize(uint32_t count) {
    World world = new_world(1);
    FrSpeciesParams *params = &world.species.params;
    double spacing = cbrt(4.18879 / count);
    params->fate = FR_FATE_COLONIZE;
    params->step = 0.7 * spacing;
    params->kill = 1.4 * spacing;
    params->influence = 6 * spacing;
    params->step_ratio = 1;
    params->length_noise = params->wander = params->gravitropism = params->search = 0;
    params->collide = false;
    params->leaves = 0;
    world.setup.params.light = FR_GROWTH_FULL;
    world.setup.params.min = (vec3s){{-2, -2, -2}};
    world.setup.params.max = (vec3s){{2, 2, 2}};
    world.setup.species = &world.species;
    FrParticle *particles = ball_of(count);
    start_clock(&world);
    FrStatus status = fr_growth_new(&world.setup, &world.context, &world.growth);
    FR_ASSERT(status == FR_OK);
    status = fr_growth_add_particles(world.growth, particles, count, &world.context);
    FR_ASSERT(status == FR_OK);
    FrSeed root = {.at = {0, 0, -1}};
    status = fr_growth_add_seeds(world.growth, &root, 1, &world.context);
    FR_ASSERT(status == FR_OK);
    int steps = (int)ceil(2.15 / params->step) + 6;
    step(&world, steps);
    double seconds = bench_now() - world.begin, processor = bench_processor() - world.processor;
    FrGrowthStats stats = fr_growth_stats(world.growth);
    bench_tell("growth.colonize", (double)stats.nodes / seconds, 0, "nodes/s",
               "%u attractors: %.4f s, %.4f s of processor on one thread; %" G_GUINT64_FORMAT
               " nodes in %d steps, %" G_GUINT64_FORMAT " attractors left",
               count, seconds, processor, stats.nodes, steps, stats.particles);
    g_free(particles);
    end(&world);
}

// ---- growth with numbers ----------------------------------------------------------------------

/// Time of the tenth step of 10 … 10 000 trees against their growing buds; the slope of the line
/// through the logarithms.
static void bench_scaling(void) {
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    GString *work = g_string_new(NULL);
    for (uint32_t side = 3, k = 0; k < 4; k++) {
        static const uint32_t sides[] = {3, 10, 32, 100};
        side = sides[k];
        World world = new_world(1);
        world.species.params.dormancy = 0;
        world.species.params.auxin_reach = 1;
        world.species.params.model = FR_MODEL_OPEN;
        world.setup.params.cell = 0.05;
        sow(&world, side, side, 1.9);
        step(&world, 9);
        double buds = (double)fr_growth_stats(world.growth).active_buds;
        start_clock(&world);
        step(&world, 1);
        double seconds = bench_processor() - world.processor;
        double x = log(buds), y = log(seconds);
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
        g_string_append_printf(work, "%u trees %.0f buds %.2g s; ", side * side, buds, seconds);
        end(&world);
    }
    double exponent = (4 * sum_xy - sum_x * sum_y) / (4 * sum_xx - sum_x * sum_x);
    bench_tell("growth.exponent", exponent, 0, "", "of time per step over buds: %s", work->str);
    g_string_free(work, TRUE);
}

void bench_growth(void) {
    bench_forest(1);
    bench_forest(2);
    bench_palubicki(1);
    bench_close_forest(1);
    for (uint32_t count = 1000; count <= 1000000; count *= 10) {
        bench_colonize(count);
    }
    bench_scaling();
}
