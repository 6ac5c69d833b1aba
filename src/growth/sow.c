// How plants begin: seeds that have a place at once, others when their place becomes free.
#include "growth/climbing.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

/// The one bud that a plant begins with.
static void begin_plant(const FrGrowth *growth, FrGrownPlant *plant) {
    plant->key = fr_key_child(fr_key_root((uint64_t)growth->params.seed), plant->seed.id);
    uint32_t axis = fr_grown_add_axis(plant, FR_NONE, 0, plant->key);
    FrLiveBud *bud = fr_grown_add_bud(plant);
    bud->key = plant->key;
    bud->node = FR_NONE;
    bud->axis = axis;
    bud->direction = growth->up;
    versors frame = fr_frame_from_heading(growth->up, (vec3s){{0, 1, 0}});
    float around = (float)(2 * G_PI * fr_random(plant->key, FR_CHANCE_BIRTH, 0));
    bud->side = glms_vec3_add(glms_vec3_scale(fr_frame_left(frame), cosf(around)),
                              glms_vec3_scale(fr_frame_up(frame), sinf(around)));
    bud->light = 1;
    bud->state = FR_LIVE_GROWING;
}

/// As far as places of seeds ask for it.
static FrGrowthSetup setup_of(const FrGrowth *growth) {
    return (FrGrowthSetup){.params = growth->params,
                           .obstacles = growth->obstacles,
                           .obstacle_count = growth->obstacle_count};
}

/// Which seeds have no place among the obstacles that stand. The caller frees it.
static bool *find_left_out(const FrGrowth *growth, const FrSeed *seeds, uint32_t count) {
    const FrGrowthSetup setup = setup_of(growth);
    return fr_seeds_find_left_out(&setup, growth->voxels->origin, growth->voxels->cell, growth->up,
                                  seeds, count);
}

/// Begins a plant, and fills its envelope if that has not been done.
static FrStatus sow(const FrGrowth *growth, FrGrownPlant *plant, GArray *particles,
                    const FrContext *context) {
    bool is_filled = plant->place != FR_PLACE_NONE;
    plant->place = FR_PLACE_FREE;
    begin_plant(growth, plant);
    return is_filled ? FR_OK : fr_growth_fill_envelope(growth, plant, particles, context);
}

static FrStatus add_particles(FrGrowth *growth, const GArray *particles, const FrContext *context) {
    return fr_growth_add_particles(growth, (const FrParticle *)(const void *)particles->data,
                                   particles->len, context);
}

// ---- seeds that are added ---------------------------------------------------------------------

FrStatus fr_growth_limit_plants(uint64_t count, const FrContext *context) {
    return fr_limit_check(count, context->limits.plants, "plants", "the growth", (FrSpan){0},
                          context->diags);
}

/// Only the first plants stay.
static void keep_plants(FrGrowth *growth, uint32_t count) {
    for (uint32_t i = count; i < growth->plant_count; i++) {
        fr_grown_clear(&growth->plants[i]);
    }
    growth->plant_count = count;
}

FrStatus fr_growth_add_seeds(FrGrowth *growth, const FrSeed *seeds, uint32_t count,
                             const FrContext *context) {
    FrStatus status = fr_growth_limit_plants(fr_count_add(growth->plant_count, count), context);
    if (status != FR_OK || count == 0) {
        return status;
    }
    fr_colony_free(growth->colony); // made anew with the new seeds
    growth->colony = NULL;
    uint32_t first = growth->plant_count;
    growth->plants = g_renew(FrGrownPlant, growth->plants, first + count);
    memset(growth->plants + first, 0, count * sizeof *growth->plants);
    growth->plant_count += count;
    FrMisplaced outside = {0}, hindered = {0};
    uint32_t left_out = 0;
    const FrGrowthSetup setup = setup_of(growth);
    bool *is_hindered = fr_seeds_find_hindered(&setup, growth->species, growth->voxels->cell,
                                               growth->up, seeds, count);
    bool *is_left_out = find_left_out(growth, seeds, count);
    bool *come_within =
        fr_species_come_within(&growth->params, growth->species, growth->species_count, growth->up);
    GArray *particles = g_array_new(FALSE, FALSE, sizeof(FrParticle));
    for (uint32_t i = 0; i < count && status == FR_OK; i++) {
        FrGrownPlant *plant = &growth->plants[first + i];
        FR_ASSERT(seeds[i].species < growth->species_count);
        plant->seed = seeds[i];
        plant->seed.span = (FrSpan){0};
        plant->place = FR_PLACE_NONE;
        if (is_left_out[i]) {
            left_out++;
            continue;
        }
        if (!come_within[seeds[i].species]) {
            fr_misplaced_note(&outside, &seeds[i]);
        } else if (is_hindered[i]) {
            fr_misplaced_note(&hindered, &seeds[i]);
        }
        status = sow(growth, plant, particles, context);
    }
    if (status == FR_OK) {
        status = add_particles(growth, particles, context);
    }
    g_array_free(particles, TRUE);
    if (status != FR_OK) {
        keep_plants(growth, first);
    } else {
        fr_growth_find_bark(growth, context);
        const FrSowing sowing = {&setup, growth->voxels->origin, growth->voxels->cell, growth->up};
        fr_seeds_tell_left_out(&sowing, seeds, count, is_left_out, left_out == growth->plant_count,
                               context);
        fr_misplaced_tell_outside(&outside, count, context);
        fr_misplaced_tell_hindered(&hindered, count, context);
        fr_seeds_tell_crowded(growth->species, growth->voxels->cell, seeds, count, context);
    }
    g_free(is_hindered);
    g_free(is_left_out);
    g_free(come_within);
    return status;
}

// ---- seeds that wait --------------------------------------------------------------------------

bool fr_growth_is_waiting(const FrGrowth *growth, uint32_t plant) {
    FR_ASSERT(plant < growth->plant_count);
    return growth->plants[plant].place != FR_PLACE_FREE;
}

/// True until it has made its first internode.
static bool is_seed(const FrGrownPlant *plant) {
    return plant->place != FR_PLACE_FREE ||
           (!plant->is_dead && plant->axis_count == 1 && plant->axes[0].internodes == 0);
}

bool fr_growth_has_waiting(const FrGrowth *growth) {
    bool has_any = false;
    for (uint32_t i = 0; i < growth->plant_count && growth->is_world_new && !has_any; i++) {
        has_any = is_seed(&growth->plants[i]);
    }
    return has_any;
}

/// A seed whose place is taken waits; one that waits, or has found no way, begins.
static FrStatus look_again(const FrGrowth *growth, FrGrownPlant *plant, bool has_place,
                           GArray *particles, const FrContext *context) {
    bool was_free = plant->place == FR_PLACE_FREE;
    bool colonizes = fr_species_of(growth, plant)->params.fate == FR_FATE_COLONIZE;
    if (has_place && was_free && (plant->bud_count > 0 || colonizes)) {
        return FR_OK;
    }
    if (was_free) {
        plant->place = FR_PLACE_LOST;
        plant->axis_count = plant->bud_count = 0;
    }
    return has_place ? sow(growth, plant, particles, context) : FR_OK;
}

FrStatus fr_growth_sow_waiting(FrGrowth *growth, const FrContext *context) {
    fr_colony_free(growth->colony);
    growth->colony = NULL;
    FrSeed *seeds = g_new(FrSeed, growth->plant_count);
    uint32_t *plants = g_new(uint32_t, growth->plant_count), count = 0;
    for (uint32_t i = 0; i < growth->plant_count; i++) {
        if (is_seed(&growth->plants[i])) {
            seeds[count] = growth->plants[i].seed;
            plants[count++] = i;
        }
    }
    bool *is_left_out = find_left_out(growth, seeds, count);
    GArray *particles = g_array_new(FALSE, FALSE, sizeof(FrParticle));
    FrStatus status = FR_OK;
    for (uint32_t i = 0; i < count && status == FR_OK; i++) {
        status =
            look_again(growth, &growth->plants[plants[i]], !is_left_out[i], particles, context);
    }
    if (status == FR_OK && particles->len > 0) {
        status = add_particles(growth, particles, context);
    }
    g_array_free(particles, TRUE);
    g_free(is_left_out);
    g_free(plants);
    g_free(seeds);
    growth->is_world_new = false;
    return status;
}
