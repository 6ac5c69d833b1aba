/// @file sky.h
/// How much of the sky buds see.
#pragma once

#include "growth/engine.h"

enum { FR_MAX_VIEWS = 64 };

/// Directions to sun and sky, and how bright each is.
typedef struct FrSky {
    vec3s direction[FR_MAX_VIEWS]; ///< unit, upwards
    float weight[FR_MAX_VIEWS];    ///< sum 1
    uint32_t count;
} FrSky;

/// What shades: columns of squares that face every view.
typedef struct FrShades {
    float *x, *y, *z;
    float *side;    ///< m
    uint32_t *hash; ///< of its own, for chance
    uint32_t count;
} FrShades;

FrSky fr_sky_of(const FrGrowth *growth);
/// Light and brightest direction of buds.
void fr_sky_look(FrGrowth *growth, const FrSky *sky, const FrShades *shades,
                 const FrLiveBudAt *buds, uint32_t count, const FrContext *context);
