/// @file ecosystem.h
/// What a document says of plants that grow bud by bud: their species, the world they grow in, and
/// particles that draw them.
#pragma once

#include "frond/growth.h"
#include "frond/mesh_file.h"
#include "frond/variation.h"

/// A `<particles>`: attraction particles that are strewn by hand.
#define FR_PARTICLES_PARAMS(X)                                                                     \
    X(CHOICE, shape, "ball", 0, 0, "", "ball box brush direction",                                 \
      "fills a ball or a box, or is drawn with a brush along the points x,y,z of its text; or "    \
      "all lie far away in a direction")                                                           \
    X(INTEGER, number, "500", 0, 10000000, "", "", "how many")                                     \
    X(VECTOR, at, "0, 0, 5", -1000000, 1000000, "m", "", "the middle of a ball or a box")          \
    X(VECTOR, size, "4, 4, 4", 0.0001, 1000000, "m", "", "extent of a ball or a box")              \
    X(REAL, radius, "0.5", 0.0001, 100000, "m", "", "of the brush, times the pressure")            \
    X(VECTOR, direction, "0, 0, 1", -1000, 1000, "", "", "where those of a direction lie")         \
    X(REAL, influence, "0", 0, 100000, "m", "",                                                    \
      "from how far they draw buds; 0: as the species says")                                       \
    X(REAL, kill, "-1", -1, 100000, "m", "", "how near they are reached; -1: as the species says") \
    X(INTEGER, seed, "1", 0, 4294967295.0, "", "", "of their places")

enum { FR_PARTICLES_BALL, FR_PARTICLES_BOX, FR_PARTICLES_BRUSH, FR_PARTICLES_DIRECTION };

typedef struct FrParticlesDef {
    FR_PARTICLES_PARAMS(FR_PARAM_FIELD)
    FrStroke *along; ///< of a brush, owned; else NULL
    FrSpan span;
} FrParticlesDef;

FR_API const FrParamTable *fr_particles_table(void);

/// A `<species>`, with its `<order>`s and `<sliders>`.
typedef struct FrSpeciesDef {
    FrSpeciesParams params; ///< before the sliders
    FrSpeciesSliders sliders;
    FrOrderParams orders[FR_MAX_ORDERS];
    uint32_t order_count;
    FrMaterial *bark, *leaf; ///< borrowed from the document; NULL: plain ones
    FrMeshFile *envelope;    ///< closed, owned; NULL: what the parameters say
    FrSpan span;
} FrSpeciesDef;

/// A `<growth>`.
typedef struct FrGrowthDef {
    FrGrowthParams params;
    GPtrArray *particles; ///< FrParticlesDef *
    FrSpan span;          ///< of the element, or of the document
} FrGrowthDef;
