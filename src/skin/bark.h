// Texture coordinates of bark.
//
// Around a stem lies a whole number of tiles, as near to the wanted width as that allows, at least
// one; it stays the same from base to tip. Along, a tile is as tall for its width as the material
// wants (conformal): thinner stems have smaller tiles, so pictures neither stretch nor jump. Below
// a fifth of the base radius tiles shrink no further. v is 0 at the base and falls towards the tip:
// pictures (whose v points down) stand upright, and growth never shifts them.
#pragma once

#include "skin/plan.h"

#include <math.h>

typedef struct FrBark {
    float u, v;     ///< at the base
    float around;   ///< tiles
    float rate;     ///< tiles along per metre, times the radius
    float thinnest; ///< m, radius below which tiles stop shrinking
} FrBark;

static inline FrBark fr_bark_for(const FrPlan *plan, uint32_t axis, uint32_t slot, float radius) {
    const float *tile = plan->tiles[slot];
    float around = floorf((float)(2.0 * G_PI) * radius / tile[0] + 0.5F);
    FrBark bark = {.around = around >= 1.0F ? around : 1.0F, .thinnest = MAX(0.2F * radius, 1e-6F)};
    bark.rate = bark.around * tile[0] / ((float)(2.0 * G_PI) * tile[1]);
    if (plan->plant->axes.bearer[axis] != FR_NONE) {
        // Branches begin anywhere in the picture, each where its path says.
        FrKey path = plan->plant->axes.path[axis];
        bark.u = (float)fr_random(path, 0, 0);
        bark.v = (float)fr_random(path, 0, 1);
    }
    return bark;
}

/// Tiles along a stretch whose radius goes from a to b: ∫ rate / r ds by Simpson's rule.
static inline float fr_bark_along(const FrBark *bark, float length, float a, float b) {
    a = MAX(a, bark->thinnest);
    b = MAX(b, bark->thinnest);
    return bark->rate * length * (1.0F / a + 8.0F / (a + b) + 1.0F / b) / 6.0F;
}
