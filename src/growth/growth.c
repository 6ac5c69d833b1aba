// The world of a growth: made, changed, counted.
#include "growth/climbing.h"
#include "growth/propose.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

static vec3s up_of(const FrGrowthParams *params) {
    vec3s up = glms_vec3_negate(params->gravity);
    return glms_vec3_norm(up) > 0 ? glms_vec3_normalize(up) : (vec3s){{0, 0, 1}};
}

/// Cells that the longest internode of a species may cross.
static double cells_crossed(double cell, const FrSpeciesParams *species) {
    return sqrt(3) * fr_growth_longest(species) / cell + 4;
}

/// Width of the cells that the setup asks for.
static double cell_of(const FrGrowthSetup *setup) {
    const FrGrowthParams *params = &setup->params;
    double shortest = INFINITY, widest = 0;
    for (uint32_t i = 0; i < setup->species_count; i++) {
        const FrSpeciesParams *species = &setup->species[i].params;
        bool takes_cells = species->collide && !setup->species[i].is_absent;
        double least = takes_cells ? species->step : INFINITY;
        shortest = MIN(shortest, least);
    }
    for (int axis = 0; axis < 3; axis++) {
        widest = MAX(widest, (double)params->max.raw[axis] - (double)params->min.raw[axis]);
    }
    double fits = widest / (FR_VOXELS_WIDTH - 1);
    double wanted = isfinite(shortest) ? shortest / 8 : fits;
    return params->cell > 0 ? params->cell : MAX(MAX(wanted, fits), 0.0001);
}

static FrStatus check_setup(const FrGrowthSetup *setup, double cell, const FrContext *context) {
    const FrGrowthParams *params = &setup->params;
    for (int axis = 0; axis < 3; axis++) {
        double size = (double)params->max.raw[axis] - (double)params->min.raw[axis];
        if (!(size > 0) || size / cell >= FR_VOXELS_WIDTH) {
            fr_diags_add(context->diags, FR_ERROR, "arena-cells", (FrSpan){0},
                         "the arena is %g m wide, but must be above 0 and below %d cells of %g m",
                         size, FR_VOXELS_WIDTH, cell);
            return FR_ERR_DOCUMENT;
        }
    }
    for (uint32_t i = 0; i < setup->species_count && setup->species != NULL; i++) {
        const FrSpeciesParams *species = &setup->species[i].params;
        if (species->collide && !setup->species[i].is_absent &&
            cells_crossed(cell, species) > FR_WALK_CELLS) {
            fr_diags_add(context->diags, FR_ERROR, "cell-step", (FrSpan){0},
                         "internodes of '%s' may become %g m long, which is too much for cells of "
                         "%g m; make `cell` larger or `collide` no",
                         setup->species[i].name == NULL ? "?" : setup->species[i].name,
                         fr_growth_longest(species), cell);
            return FR_ERR_DOCUMENT;
        }
    }
    return FR_OK;
}

/// Tells of plants whose branches would be in each other's way as soon as they begin: half the box
/// of a tip is longer than an internode in full light. Up to a fifth longer plants of every model
/// grew in trials; beyond, whole plants ended with their first branches.
static void tell_wide_cells(const FrGrowthSetup *setup, double cell, const FrContext *context) {
    const double borne = 1.2;
    for (uint32_t i = 0; i < setup->species_count; i++) {
        const FrSpeciesParams *species = &setup->species[i].params;
        double internode =
            species->step * CLAMP(1 - species->search, species->min_length, species->max_length);
        if (species->collide && !setup->species[i].is_absent &&
            (double)species->box / 2 * cell > borne * internode) {
            fr_diags_add(
                context->diags, FR_WARNING, "wide-cells", (FrSpan){0},
                "'%s' may hardly grow: around each tip %d cells of %g m must be free, but its "
                "internodes are %g m long in full light; make %s smaller",
                setup->species[i].name == NULL ? "?" : setup->species[i].name, (int)species->box,
                cell, internode, setup->params.cell > 0 ? "`cell`" : "the arena");
        }
    }
}

static void tell_suns(const FrGrowthParams *params, const FrContext *context) {
    if (params->light == FR_GROWTH_VIEWS && params->suns > params->views) {
        fr_diags_add(context->diags, FR_WARNING, "suns-views", (FrSpan){0},
                     "suns is %d, but there are %d views: all of them lie on the path of the sun, "
                     "and none looks at the sky",
                     (int)params->suns, (int)params->views);
    }
}

static void take_species(FrGrowth *growth, const FrGrowthSetup *setup) {
    growth->species_count = setup->species_count;
    uint32_t most = 1;
    fr_shadows_free(growth->shadows); // made anew as the parameters say
    growth->shadows = NULL;
    fr_colony_free(growth->colony);
    growth->colony = NULL;
    growth->species = g_new(FrReadySpecies, setup->species_count);
    for (uint32_t i = 0; i < setup->species_count; i++) {
        growth->species[i] = fr_species_make_ready(&setup->species[i]);
        const FrSpeciesParams *params = &growth->species[i].params;
        if (params->collide && !setup->species[i].is_absent) {
            most = MAX(most, (uint32_t)cells_crossed(growth->voxels->cell, params));
        }
    }
    growth->step_stride = fr_path_stride(most);
}

static void drop_species(FrGrowth *growth) {
    for (uint32_t i = 0; i < growth->species_count; i++) {
        fr_species_clear_ready(&growth->species[i]);
    }
    g_free(growth->species);
}

static void drop_obstacles(FrGrowth *growth) {
    for (uint32_t i = 0; i < growth->obstacle_count; i++) {
        g_free((void *)growth->obstacles[i].positions);
        g_free((void *)growth->obstacles[i].indices);
    }
    fr_distance_free(growth->support);
    fr_distance_free(growth->support_ground);
    g_free(growth->obstacles);
    g_free(growth->suns);
}

/// Obstacles are solid: their surface, and what it encloses within the arena.
FrStatus fr_growth_stand_obstacles(FrGrowth *growth, const FrContext *context) {
    double end[3];
    for (int axis = 0; axis < 3; axis++) {
        end[axis] = (double)growth->params.max.raw[axis];
    }
    FrStatus status = FR_OK;
    for (uint32_t i = 0; i < growth->obstacle_count && status == FR_OK; i++) {
        const FrGrowthObstacle *obstacle = &growth->obstacles[i];
        const FrVoxelSurface surface = {obstacle->positions, obstacle->indices,
                                        obstacle->index_count, obstacle->is_ground, obstacle->span};
        status = fr_voxels_add_triangles(growth->voxels, &surface, end, context);
        if (status == FR_OK) {
            status = fr_voxels_fill(growth->voxels, &surface, end, context);
        }
    }
    return status;
}

static void take_obstacles(FrGrowth *growth, const FrGrowthSetup *setup) {
    growth->obstacle_count = setup->obstacle_count;
    growth->obstacles = g_new(FrGrowthObstacle, setup->obstacle_count);
    for (uint32_t i = 0; i < setup->obstacle_count; i++) {
        const FrGrowthObstacle *from = &setup->obstacles[i];
        FrGrowthObstacle *own = &growth->obstacles[i];
        *own = *from;
        own->positions = g_memdup2(from->positions, from->vertex_count * sizeof(vec3s));
        own->indices = g_memdup2(from->indices, from->index_count * sizeof(uint32_t));
    }
}

/// Copies what the setup says and stands the obstacles.
static FrStatus take_setup(FrGrowth *growth, const FrGrowthSetup *setup, const FrContext *context) {
    growth->params = setup->params;
    growth->up = up_of(&setup->params);
    growth->light = setup->light;
    growth->lamps = setup->lamps;
    growth->lamp_count = setup->lamp_count;
    growth->suns = setup->suns == NULL
                       ? NULL
                       : g_memdup2(setup->suns, (size_t)setup->params.suns * sizeof(vec3s));
    if (setup->species != NULL) {
        take_species(growth, setup);
    }
    take_obstacles(growth, setup);
    FrStatus status = fr_growth_take_supports(growth, context);
    return status == FR_OK ? fr_growth_stand_obstacles(growth, context) : status;
}

FrStatus fr_growth_new(const FrGrowthSetup *setup, const FrContext *context, FrGrowth **growth) {
    *growth = NULL;
    double cell = cell_of(setup);
    FrStatus status = check_setup(setup, cell, context);
    if (status != FR_OK) {
        return status;
    }
    tell_wide_cells(setup, cell, context);
    tell_suns(&setup->params, context);
    FrGrowth *made = g_new0(FrGrowth, 1);
    made->history = g_ptr_array_new_with_free_func((GDestroyNotify)g_bytes_unref);
    double origin[3];
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = (double)setup->params.min.raw[axis];
    }
    made->voxels = fr_voxels_new(origin, cell);
    status = take_setup(made, setup, context);
    if (status == FR_OK) {
        status = fr_growth_strew_particles(made, context);
    }
    if (status != FR_OK) {
        fr_growth_free(made);
        return status;
    }
    *growth = made;
    return FR_OK;
}

void fr_growth_drop_state(FrGrowth *growth) {
    for (uint32_t i = 0; i < growth->plant_count; i++) {
        fr_grown_clear(&growth->plants[i]);
    }
    fr_voxels_free(growth->voxels);
    fr_particles_free(growth->particles);
    fr_shadows_free(growth->shadows);
    fr_colony_free(growth->colony);
    g_free(growth->plants);
    g_free(growth->owners);
}

void fr_growth_free(FrGrowth *growth) {
    if (growth == NULL) {
        return;
    }
    fr_growth_drop_state(growth);
    fr_other_scene_free(growth->other_scene);
    fr_stems_free(growth->bark);
    drop_species(growth);
    drop_obstacles(growth);
    fr_scratch_clear(&growth->live_memory);
    fr_scratch_clear(&growth->proposal_memory);
    fr_scratch_clear(&growth->shade_memory);
    fr_scratch_clear(&growth->sky_memory);
    fr_scratch_clear(&growth->known_memory);
    for (int i = 0; i < growth->scratch_count; i++) {
        fr_scratch_clear(&growth->scratch[i]);
        fr_scratch_clear(&growth->drop_scratch[i]);
        g_array_free(growth->fallen[i], TRUE);
    }
    g_free(growth->scratch);
    g_free(growth->drop_scratch);
    g_free(growth->fallen);
    g_ptr_array_free(growth->history, TRUE);
    g_free(growth);
}

FrStatus fr_growth_change(FrGrowth *growth, const FrGrowthSetup *setup, const FrContext *context) {
    FrStatus status = check_setup(setup, growth->voxels->cell, context);
    if (status != FR_OK) {
        return status;
    }
    FR_ASSERT(setup->species_count == growth->species_count);
    FrGrowth old = *growth;
    fr_voxels_clear_solid(growth->voxels);
    status = take_setup(growth, setup, context);
    if (status != FR_OK) {
        FrGrowth failed = *growth;
        *growth = old;
        old = failed;
        fr_voxels_clear_solid(growth->voxels);
        FrContext unlimited = fr_context_default(); // they stood there before
        unlimited.limits.bytes = UINT64_MAX;
        FrStatus again = fr_growth_stand_obstacles(growth, &unlimited);
        FR_ASSERT(again == FR_OK);
    } else {
        growth->is_world_new = true;
        growth->older_states = growth->history->len;
    }
    if (setup->species != NULL) {
        drop_species(&old);
    }
    drop_obstacles(&old);
    fr_growth_find_bark(growth, context);
    return status;
}

vec3s fr_bud_world(const FrGrownPlant *plant, const FrLiveBud *bud) {
    return fr_grown_tip(plant, bud->node);
}

FrStatus fr_growth_check(const FrGrowthSetup *setup, const FrSeed *seeds, uint32_t count,
                         const FrContext *context) {
    FrStatus status = check_setup(setup, cell_of(setup), context);
    if (status == FR_OK) {
        status = fr_growth_limit_plants(count, context);
    }
    if (status == FR_OK) {
        tell_wide_cells(setup, cell_of(setup), context);
        tell_suns(&setup->params, context);
        fr_seeds_check(setup, cell_of(setup), up_of(&setup->params), seeds, count, context);
    }
    return status;
}

void fr_growth_reserve_owners(FrGrowth *growth, uint32_t count) {
    if (count > growth->owner_capacity) {
        growth->owner_capacity = MAX(1024, count + count / 2);
        growth->owners = g_renew(FrOwner, growth->owners, growth->owner_capacity);
    }
}

static void count_plant(const FrGrowth *growth, const FrGrownPlant *plant, FrGrowthStats *stats) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    stats->plants += plant->place == FR_PLACE_FREE;
    for (uint32_t i = 0; i < plant->axis_count; i++) {
        stats->axes += plant->axes[i].first != FR_NONE;
    }
    stats->nodes += plant->nodes.count;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        stats->leaves += fr_grown_is_leafy(growth, plant, i) ? (uint64_t)params->leaves : 0;
    }
    for (uint32_t i = 0; i < plant->bud_count; i++) {
        stats->active_buds += plant->buds[i].state == FR_LIVE_GROWING;
        stats->dormant_buds += plant->buds[i].state == FR_LIVE_ASLEEP;
    }
    stats->born += plant->born;
    stats->shed += plant->shed;
    stats->collisions += plant->collisions;
    stats->contested += plant->contested;
    stats->digest += fr_grown_digest(plant); // a sum: the order of seeds has no say
    stats->bytes += fr_grown_bytes(plant);
}

typedef struct Counting {
    const FrGrowth *growth;
    FrGrowthStats *parts; ///< by worker
} Counting;

static void count_range(void *data, size_t begin, size_t end, int worker) {
    const Counting *counting = data;
    for (size_t p = begin; p < end; p++) {
        count_plant(counting->growth, &counting->growth->plants[p], &counting->parts[worker]);
    }
}

/// Whole numbers all: their order has no say.
static void add_part(FrGrowthStats *stats, const FrGrowthStats *part) {
    stats->plants += part->plants;
    stats->axes += part->axes;
    stats->nodes += part->nodes;
    stats->leaves += part->leaves;
    stats->active_buds += part->active_buds;
    stats->dormant_buds += part->dormant_buds;
    stats->born += part->born;
    stats->shed += part->shed;
    stats->collisions += part->collisions;
    stats->contested += part->contested;
    stats->digest += part->digest;
    stats->bytes += part->bytes;
}

FrGrowthStats fr_growth_stats_on(const FrGrowth *growth, FrPool *pool) {
    FrGrowthStats stats = {.step = growth->step,
                           .seconds = growth->seconds,
                           .light_seconds = growth->light_seconds,
                           .cells = growth->voxels->bytes};
    if (growth->particles != NULL) {
        stats.particles = growth->particles->count - growth->particles->dead_count;
    }
    int threads = fr_pool_threads(pool);
    Counting counting = {growth, g_new0(FrGrowthStats, threads)};
    fr_parallel_for(pool, growth->plant_count, 1, count_range, &counting, NULL);
    for (int worker = 0; worker < threads; worker++) {
        add_part(&stats, &counting.parts[worker]);
    }
    g_free(counting.parts);
    return stats;
}

FrGrowthStats fr_growth_stats(const FrGrowth *growth) {
    return fr_growth_stats_on(growth, NULL);
}

uint64_t fr_growth_step_count(const FrGrowth *growth) {
    return growth->step;
}

uint32_t fr_growth_plant_count(const FrGrowth *growth) {
    return growth->plant_count;
}

bool fr_growth_is_alive(const FrGrowth *growth, uint32_t plant) {
    FR_ASSERT(plant < growth->plant_count);
    const FrGrownPlant *of = &growth->plants[plant];
    bool is_alive = false;
    for (uint32_t i = 0; i < of->bud_count && !is_alive; i++) {
        is_alive = of->buds[i].state == FR_LIVE_GROWING;
    }
    return is_alive;
}

FrSeed fr_growth_seed(const FrGrowth *growth, uint32_t plant) {
    FR_ASSERT(plant < growth->plant_count);
    return growth->plants[plant].seed;
}

double (*fr_growth_spread(const FrGrowth *growth, double apart))[2] {
    uint32_t count = growth->plant_count;
    double(*shifts)[2] = g_malloc0_n((gsize)count + 1, sizeof *shifts), middle[2] = {0, 0};
    for (uint32_t i = 0; i < 2 * count; i++) {
        middle[i % 2] += growth->plants[i / 2].seed.at[i % 2] / count;
    }
    for (uint32_t i = 0; i < 2 * count; i++) {
        shifts[i / 2][i % 2] = apart * (growth->plants[i / 2].seed.at[i % 2] - middle[i % 2]);
    }
    return shifts;
}

bool fr_growth_is_taken(const FrGrowth *growth, const double point[3]) {
    FrCell cell;
    return fr_voxels_cell(growth->voxels, point, &cell) &&
           fr_voxels_owner(growth->voxels, cell) != FR_VOXEL_FREE;
}
