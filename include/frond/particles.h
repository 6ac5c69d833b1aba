/// @file particles.h
/// Attraction particles in a grid, so that what is near a point is found without looking at all.
///
/// Coordinates stand in columns, sorted by cell, then by place: the order does not depend on the
/// order in which they were given, and what is near lies in few straight runs.
#pragma once

#include "frond/context.h"
#include "frond/vector.h"

/// Something that buds grow towards.
typedef struct FrParticle {
    vec3s at;        ///< where it is, or, with w = 0, the direction in which it lies
    float w;         ///< 1 a place, 0 a direction at infinity
    float influence; ///< m; 0: that of the species
    float kill;      ///< m; < 0: that of the species
} FrParticle;

typedef struct FrParticles {
    uint32_t count;      ///< places
    uint32_t dead_count; ///< of these
    float *x, *y, *z;
    float *influence, *kill; ///< as of FrParticle
    float widest_influence, widest_kill;
    bool has_own; ///< some have an influence or a kill radius of their own
    uint8_t *is_dead;
    FrParticle *directions; ///< those with w other than 1
    uint32_t direction_count;
    float origin[3], cell, inverse; ///< lowest corner, width of cells, m, and cells a metre
    int size[3];                    ///< cells along each axis
    uint32_t *start;                ///< first particle of each cell, x fastest; two more at the end
} FrParticles;

/// Particles [begin, end) of the columns.
typedef struct FrRun {
    uint32_t begin, end;
} FrRun;

enum { FR_MAX_RUNS = 1024 };

/// `reach` is the radius that is mostly asked for, m. NULL if it was cancelled.
FR_API FrParticles *fr_particles_new(const FrParticle *particles, uint32_t count, float reach,
                                     const FrProgress *progress);
FR_API void fr_particles_free(FrParticles *particles);
/// Takes the dead out; kept[i] becomes the old index of particle i, for as many as are left.
FR_API void fr_particles_compact(FrParticles *particles, uint32_t *kept);
/// Runs that hold all within `radius` of a point, and some more. At most FR_MAX_RUNS; cells so much
/// smaller than the radius are not made.
FR_API uint32_t fr_particles_near(const FrParticles *particles, vec3s at, float radius,
                                  FrRun *runs);
/// Those that live. Free with g_free().
FR_API FrParticle *fr_particles_living(const FrParticles *particles, uint32_t *count);
/// Kills what is within `radius` (or within the particle's own kill radius) of a point. Returns how
/// many. Several threads may do so at once.
FR_API uint32_t fr_particles_kill(FrParticles *particles, vec3s at, float radius);
/// True if any that lives is so near.
FR_API bool fr_particles_reach(const FrParticles *particles, vec3s at, float radius);
