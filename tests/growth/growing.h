/// @file growing.h
/// What the tests of growth share: worlds of one species and steps that must succeed.
#pragma once

#include "frond/growth.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

typedef struct World {
    FrContext context;
    FrSpecies species;
    FrGrowthSetup setup;
    FrGrowth *growth;
} World;

/// The defaults, an arena of 40 × 40 × 30 m, one thread; nothing is grown yet.
static inline void world_init(World *world) {
    world->context = fr_context_default();
    world->context.diags = fr_diags_new();
    world->species = fr_species_default();
    world->setup = (FrGrowthSetup){
        .params = fr_growth_default(), .species = &world->species, .species_count = 1};
    world->setup.params.min = (vec3s){{-20, -20, 0}};
    world->setup.params.max = (vec3s){{20, 20, 30}};
    world->growth = NULL;
}

static inline void world_set(World *world, const char *name, const char *value) {
    const FrParam *row = fr_params_find(fr_species_table(), name);
    g_assert_nonnull(row);
    g_assert_cmpint(fr_params_set(fr_species_table(), &world->species.params, row, value,
                                  (FrSpan){0}, NULL, NULL),
                    ==, FR_OK);
}

/// The same for a plant without chance in its directions and lengths, which drops nothing.
static inline void world_init_plain(World *world) {
    world_init(world);
    world_set(world, "model", "open");
    world_set(world, "wander", "0");
    world_set(world, "length-noise", "0");
    world_set(world, "shed", "none");
}

/// A flat obstacle of two triangles; `corners` is borrowed.
static inline FrGrowthObstacle world_sheet(const vec3s corners[4]) {
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    return (FrGrowthObstacle){
        .positions = corners, .vertex_count = 4, .indices = indices, .index_count = 6};
}

static inline void world_sow(World *world, const FrSeed *seeds, uint32_t count) {
    g_assert_cmpint(fr_growth_new(&world->setup, &world->context, &world->growth), ==, FR_OK);
    g_assert_cmpint(fr_growth_add_seeds(world->growth, seeds, count, &world->context), ==, FR_OK);
}

static inline void world_sow_one(World *world) {
    world_sow(world, &(FrSeed){.id = 1}, 1);
}

static inline FrGrowthStats world_step(World *world, int count) {
    for (int i = 0; i < count; i++) {
        g_assert_cmpint(fr_growth_step(world->growth, &world->context), ==, FR_OK);
    }
    return fr_growth_stats(world->growth);
}

/// Saves what has grown, and takes it up in a new growth of the same setup.
static inline void world_resume(World *world) {
    GBytes *bytes = fr_growth_save(world->growth);
    fr_growth_free(world->growth);
    g_assert_cmpint(fr_growth_new(&world->setup, &world->context, &world->growth), ==, FR_OK);
    gsize size;
    const void *data = g_bytes_get_data(bytes, &size);
    g_assert_cmpint(fr_growth_restore(world->growth, data, size, (FrSpan){0}, &world->context), ==,
                    FR_OK);
    g_bytes_unref(bytes);
}

static inline FrPlant *world_plant(const World *world, uint32_t index) {
    FrPlant *plant;
    g_assert_cmpint(fr_growth_plant(world->growth, index, &world->context, &plant), ==, FR_OK);
    return plant;
}

static inline void world_clear(World *world) {
    fr_growth_free(world->growth);
    fr_params_clear(fr_species_table(), &world->species.params);
    fr_diags_free(world->context.diags);
}
