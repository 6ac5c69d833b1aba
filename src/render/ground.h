/// @file ground.h
/// Level ground at z = 0 without end: matt earth, unevenly coloured and slightly rough. Private to
/// render.
#pragma once

#include "frond/random.h"
#include "frond/vector.h"

typedef struct FrGround {
    vec3s colour;     ///< linear, the mean
    FrKey key;        ///< of its noise
    float *height;    ///< a tile of noise in −1 … 1, GROUND_CELLS a side
    float variation;  ///< 0: the same colour and level everywhere
    float haze;       ///< m: distance at which it turns into the horizon; INFINITY: never
    double origin[2]; ///< of the renderer's coordinates in the world, so that patches stay in place
} FrGround;

typedef struct FrGroundPoint {
    vec3s colour, normal; ///< linear; of unit length
} FrGroundPoint;

FrGround *fr_ground_new(vec3s colour, float variation);
void fr_ground_free(FrGround *ground);
FrGroundPoint fr_ground_at(const FrGround *ground, float x, float y);
