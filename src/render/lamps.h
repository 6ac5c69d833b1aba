/// @file lamps.h
/// Lamps of a scene as the path tracer sees them: rectangles and balls that shine. Private to
/// render. Coordinates are those of the world.
#pragma once

#include "frond/light.h"
#include "frond/surroundings.h"

typedef struct FrShiningLamp {
    bool is_area;
    vec3s at;      ///< a corner of the area; the middle of the ball
    vec3s side[2]; ///< of the area
    vec3s axis;    ///< unit; where the area or the cone points to
    float cosine;  ///< balls: of half the cone's opening; −1 shines all around
    float radius;  ///< of the ball
    float area;    ///< m², as seen from in front
    float chance;  ///< with which it is chosen
    vec3s radiance;
} FrShiningLamp;

typedef struct FrLampSet {
    FrShiningLamp *lamps;
    uint32_t count;
    vec3s power; ///< of all together, of the solar constant on a square metre
} FrLampSet;

/// What a point gets to see of a lamp.
typedef struct FrLampSight {
    vec3s direction;
    float distance;
    vec3s radiance; ///< black: nothing
    float density;  ///< with which fr_lamps_sample() looks there, per steradian
} FrLampSight;

/// `origin` is the world's.
FrLampSet fr_lamps_new(const FrSurroundings *surroundings, const double origin[3]);
/// What the lamps bring to the walls of a light room of that size, thrown to and fro by them, on
/// the whole.
vec3s fr_lamps_light(const FrLampSet *set, vec3s size);
void fr_lamps_clear(FrLampSet *set);
/// Looks from a point to a point of a lamp.
FrLampSight fr_lamps_sample(const FrLampSet *set, vec3s point, float choice, float u, float v);
/// The lamp that a ray meets within `far`; radiance black if none, or its dark side.
bool fr_lamps_meet(const FrLampSet *set, vec3s origin, vec3s direction, float far,
                   FrLampSight *sight);
