/// @file shading.h
/// The light of a scene for pictures that trace no paths, such as those of a graphics card: exposed
/// and balanced as fr_render() would, but for a picture that is neither bright nor dark.
///
/// Radiances are those of a white matt surface, in the units that the tone curve takes: 0.18 is mid
/// grey. A surface multiplies them by its reflectance.
#pragma once

#include "frond/scene.h"

enum { FR_SHADING_TERMS = 9, FR_SHADING_LAMPS = 8 };

/// A lamp as the point that it looks like from afar. At a distance d it brings intensity / d² to a
/// surface that faces it.
typedef struct FrShadingLamp {
    vec3s at;
    vec3s axis;      ///< unit; where an area or a cone points to
    vec3s intensity; ///< m²; of an area straight before it
    float cosine;    ///< of half the cone's opening; −1 shines all around
    float near;      ///< m: its size; nearer than that it is no brighter
    bool is_area;    ///< shines by the cosine to its axis
} FrShadingLamp;

typedef struct FrShading {
    vec3s to_sun;                ///< unit; below the horizon it brings nothing
    vec3s sun;                   ///< of a surface that faces the sun
    vec3s sky[FR_SHADING_TERMS]; ///< of sky and ground; see fr_shading_sky()
    uint32_t lamp_count;
    FrShadingLamp lamps[FR_SHADING_LAMPS]; ///< those that are brightest in the middle of the scene
} FrShading;

/// Takes about 8 ms of one processor. A scene without any light is shown by that of a clear day.
FR_API FrShading fr_shading_of(const FrScene *scene, const FrContext *context);
/// All that fr_shading_of() depends on but the plants: while it stays, so may the shading.
FR_API FrDigest fr_shading_digest(const FrScene *scene);
/// What sky and ground bring to a surface with that unit normal:
///
///     s0 + s1 y + s2 z + s3 x + s4 xy + s5 yz + s6 (3z² − 1) + s7 xz + s8 (x² − y²)
FR_API vec3s fr_shading_sky(const FrShading *shading, vec3s normal);
