/// @file growth.h
/// Plants that grow bud by bud and compete for light and space (Beneš, Andrysco, Šťava 2009,
/// Interactive Modeling of Virtual Ecosystems, with the rules of later work beside the published).
///
///     fr_growth_new(&setup, &context, &growth);
///     fr_growth_add_seeds(growth, seeds, count, &context);
///     for (…) fr_growth_step(growth, &context);          look; change the setup; go on
///     fr_growth_plant(growth, i, &context, &plant);
///
/// A step treats the buds of all plants at once and in no order: the outcome is the same, bit for
/// bit, for any number of threads, for seeds in another order, and after saving and restoring.
/// World coordinates, z up, metres.
#pragma once

#include "frond/light.h"
#include "frond/particles.h"
#include "frond/species.h"

/// A `<growth>`: the world that plants grow in.
#define FR_GROWTH_PARAMS(X)                                                                        \
    X(INTEGER, steps, "14", 0, 100000, "", "", "of growth")                                        \
    X(VECTOR, min, "-100, -100, 0", -1000000, 1000000, "m", "", "lowest corner of the arena")      \
    X(VECTOR, max, "100, 100, 60", -1000000, 1000000, "m", "", "highest corner of the arena")      \
    X(VECTOR, gravity, "0, 0, -1", -1000, 1000, "", "", "direction in which things fall")          \
    X(REAL, cell, "0", 0, 100, "m", "",                                                            \
      "width of the cells that branches occupy; 0: an eighth of the shortest internode of a "      \
      "trunk, or wider in a wide arena")                                                           \
    X(CHOICE, light, "views", 0, 0, "", "views shadows full",                                      \
      "buds see sun and sky, or stand in shadows cast downwards, or all have full light")          \
    X(INTEGER, views, "20", 1, 64, "", "", "views: directions of the sky")                         \
    X(INTEGER, suns, "0", 0, 60, "", "", "views: so many of them lie on the path of the sun")      \
    X(SWITCH, overcast, "no", 0, 1, "", "", "views: the sky is brighter above")                    \
    X(INTEGER, resolution, "512", 16, 8192, "", "", "views: pixels across the plants")             \
    X(REAL, shadow_strength, "0.441", 0.001, 1000, "", "", "shadows: light taken by a bud …")      \
    X(REAL, shadow_fade, "6.31", 1.01, 1000, "", "", "… falls by this factor for each cell")       \
    X(INTEGER, shadow_depth, "6", 1, 32, "", "", "shadows: cells that they reach down")            \
    X(CHOICE, shadow_form, "times", 0, 0, "", "times minus",                                       \
      "shadows: light is multiplied, or the shadow is taken away from it")                         \
    X(REAL, shadow_jitter, "0.05", 0, 0.9, "", "", "shadows: unevenness of the light, by chance")  \
    X(REAL, shadow_reach, "1.6", 0.1, 16, "", "", "shadows: cells to where it is compared")        \
    X(REAL, shadow_cell, "0.5", 0.001, 100, "m", "", "shadows: width of their cells")              \
    X(INTEGER, particles, "0", 0, 10000000, "", "", "attraction particles all over the arena")     \
    X(INTEGER, seed, "1", 0, 1000000000, "", "", "of what is left to chance besides the plants")   \
    X(INTEGER, history, "0", 0, 1000, "", "", "steps that can be undone")

enum { FR_SHADOW_TIMES, FR_SHADOW_MINUS };
enum { FR_GROWTH_VIEWS, FR_GROWTH_SHADOWS, FR_GROWTH_FULL };

typedef struct FrGrowthParams {
    FR_GROWTH_PARAMS(FR_PARAM_FIELD)
} FrGrowthParams;

FR_API const FrParamTable *fr_growth_table(void);
FR_API FrGrowthParams fr_growth_default(void);

/// Something solid that stands in the way of branches and light.
typedef struct FrGrowthObstacle {
    const vec3s *positions;
    uint32_t vertex_count;
    const uint32_t *indices; ///< three a triangle
    uint32_t index_count;
    bool is_ground; ///< the first internode of a plant grows through it
    bool is_clear;  ///< it takes no light
    FrSpan span;    ///< where a document asks for it, for diagnostics; borrowed
} FrGrowthObstacle;

/// Everything that a growth stands on. Copied; what it points to is copied too where it is not
/// said to be borrowed.
typedef struct FrGrowthSetup {
    FrGrowthParams params;
    const FrSpecies *species; ///< what they point to is borrowed as long as the growth lives; NULL
                              ///< for fr_growth_change(): they stay as they are
    uint32_t species_count;
    const FrGrowthObstacle *obstacles;
    uint32_t obstacle_count;
    const vec3s *suns; ///< unit directions to places of the sun, params.suns of them; NULL: a path
                       ///< through the zenith from east to west
    /// Another light than that of the parameters, borrowed; NULL: none. Before each step its scene
    /// is set to the obstacles, to leaves and lamps; a bud's light is the answer's intensity.
    FrLight *light;
    const FrLamp *lamps; ///< for `light`, borrowed
    uint32_t lamp_count;
} FrGrowthSetup;

/// One plant to be.
typedef struct FrSeed {
    double at[3];     ///< m
    uint64_t id;      ///< of its own among all seeds; all chance in the plant depends on it
    uint32_t species; ///< index
    FrSpan span;      ///< where a document places it, for diagnostics; borrowed and not kept
} FrSeed;

/// What a step has done and what there is after it.
typedef struct FrGrowthStats {
    uint64_t step; ///< from 1; 0 before the first
    uint64_t plants, axes, nodes;
    uint64_t leaves;      ///< that would be drawn
    uint64_t active_buds; ///< growing
    uint64_t dormant_buds;
    uint64_t born;       ///< internodes of this step
    uint64_t shed;       ///< internodes that fell in this step
    uint64_t collisions; ///< buds that found no free way
    uint64_t contested;  ///< … because another bud of the same step had it
    uint64_t particles;  ///< still alive
    uint64_t cells;      ///< bytes of the occupied space
    uint64_t bytes;      ///< of the plants' columns
    double seconds, light_seconds;
    FrDigest digest; ///< of all plants; the order of seeds has no say
} FrGrowthStats;

typedef struct FrGrowth FrGrowth;

/// What fr_growth_new() and fr_growth_add_seeds() would find wrong, as far as it is known without
/// cutting the obstacles into cells and strewing particles: a seed that an obstacle only touches is
/// not told.
FR_API FR_MUST_USE FrStatus fr_growth_check(const FrGrowthSetup *setup, const FrSeed *seeds,
                                            uint32_t count, const FrContext *context);
/// An empty world. FR_ERR_LIMIT if it would take too much memory; then *growth is NULL.
FR_API FR_MUST_USE FrStatus fr_growth_new(const FrGrowthSetup *setup, const FrContext *context,
                                          FrGrowth **growth);
FR_API void fr_growth_free(FrGrowth *growth);
/// Changes the world or the species in the middle: plants stay as they have grown. Cells and the
/// lowest corner of the arena stay as they were, and there must be as many species. On failure all
/// stays as it was.
FR_API FR_MUST_USE FrStatus fr_growth_change(FrGrowth *growth, const FrGrowthSetup *setup,
                                             const FrContext *context);
/// Adds plants of one bud each. A seed outside the arena or inside an obstacle waits, with a
/// warning, and begins with the first step after a change that makes its place free; the plants
/// keep the numbers of their seeds. Others tell of seeds from which no trunk comes to its envelope,
/// and of those below something that is nearer than a first internode is long.
FR_API FR_MUST_USE FrStatus fr_growth_add_seeds(FrGrowth *growth, const FrSeed *seeds,
                                                uint32_t count, const FrContext *context);
FR_API FR_MUST_USE FrStatus fr_growth_add_particles(FrGrowth *growth, const FrParticle *particles,
                                                    uint64_t count, const FrContext *context);
/// One step of all plants. FR_CANCELLED or FR_ERR_LIMIT leave the state of before the step. It can
/// be cancelled until plants begin to change: through light, particles and competition.
FR_API FR_MUST_USE FrStatus fr_growth_step(FrGrowth *growth, const FrContext *context);
/// Back to before the last step, as often as `history` allows. False if there is nothing to undo.
FR_API bool fr_growth_undo(FrGrowth *growth);
/// It reads all plants, for their digest.
FR_API FrGrowthStats fr_growth_stats(const FrGrowth *growth);
/// The same on all threads of a pool.
FR_API FrGrowthStats fr_growth_stats_on(const FrGrowth *growth, FrPool *pool);
/// Steps so far.
FR_API uint64_t fr_growth_step_count(const FrGrowth *growth);

FR_API uint32_t fr_growth_plant_count(const FrGrowth *growth);
/// True if its seed waits for a place to stand.
FR_API bool fr_growth_is_waiting(const FrGrowth *growth, uint32_t plant);
/// True if a plant has a growing bud.
FR_API bool fr_growth_is_alive(const FrGrowth *growth, uint32_t plant);
/// Tells, for each species, how many plants have made no internode in the steps so far, but those
/// that fr_growth_add_seeds() has told. `seeds` are all seeds, for their places in a document.
FR_API void fr_growth_tell_bare(const FrGrowth *growth, const FrSeed *seeds,
                                const FrContext *context);
/// Volume of a plant's wood, m³: its internodes as cylinders.
FR_API double fr_growth_wood(const FrGrowth *growth, uint32_t plant);
FR_API FrSeed fr_growth_seed(const FrGrowth *growth, uint32_t plant);
/// How far each plant is moved, x and y, to stand `apart` times farther from the middle of all; as
/// many as there are plants. Free with g_free().
FR_API double (*fr_growth_spread(const FrGrowth *growth, double apart))[2];
/// A grown plant relative to its seed: axes, radii, leaves, buds. Axes of order i are of component
/// `order-i`.
FR_API FR_MUST_USE FrStatus fr_growth_plant(const FrGrowth *growth, uint32_t plant,
                                            const FrContext *context, FrPlant **grown);
/// Particles that are left, and whether each draws a bud now. Free with g_free().
FR_API FrParticle *fr_growth_particles(const FrGrowth *growth, uint64_t *count, bool **is_active);
/// A bud that grows or sleeps, as it was at the end of the last step.
typedef struct FrGrowthBud {
    vec3s at, direction; ///< direction: unit, of its last internode or of the one to come
    vec3s towards;       ///< to the light, unit; 0 where it was not looked for
    float light;         ///< 0 to 1
    uint32_t plant;
    bool is_growing;
} FrGrowthBud;
/// All buds (FrGrowthBud), plant by plant. Free with g_array_unref().
FR_API GArray *fr_growth_buds(const FrGrowth *growth);
/// A cube of occupied space.
typedef struct FrGrowthCell {
    double min[3], width;
    uint32_t plant; ///< whose branch is in it; FR_NONE: an obstacle, or several in one cube
} FrGrowthCell;
/// The cells that branches and obstacles occupy, the ground left out (FrGrowthCell). Where they are
/// more than `most`, cubes of 8, 16, 32 … cells that hold any. Free with g_array_unref().
FR_API GArray *fr_growth_cells(const FrGrowth *growth, uint32_t most);
/// True if a cell at this point is taken by a branch or an obstacle.
FR_API bool fr_growth_is_taken(const FrGrowth *growth, const double point[3]);

/// The whole state but the setup. Free with g_bytes_unref().
FR_API GBytes *fr_growth_save(const FrGrowth *growth);
/// Makes the saved state that of a growth of the same setup. FR_ERR_DOCUMENT with a diagnostic at
/// `span` if the bytes are no such state; then all stays as it was.
FR_API FR_MUST_USE FrStatus fr_growth_restore(FrGrowth *growth, const void *bytes, size_t size,
                                              FrSpan span, const FrContext *context);
