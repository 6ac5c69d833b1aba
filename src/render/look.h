/// @file look.h
/// A material as the renderer reads it: pictures to sample and numbers in linear light. Private to
/// render.
#pragma once

#include "frond/material.h"
#include "render/bsdf.h"

/// Decoded values of all 8-bit steps of sRGB.
typedef struct FrDecoder {
    float linear[256];
} FrDecoder;

typedef struct FrLook {
    const FrImage *colour;    ///< borrowed from the material; NULL
    const FrImage *normal;    ///< borrowed; NULL
    const FrImage *roughness; ///< borrowed; NULL
    vec3s tint;               ///< linear
    float roughness_factor, translucency, relief;
    float mirror, clear; ///< parts of the light, and of the other light
    float cutoff;        ///< of alpha, in 0 … 255
    bool is_foliage;     ///< seen from both sides, pictures do not repeat
    bool has_holes;
} FrLook;

void fr_decoder_init(FrDecoder *decoder);
/// `material` may be NULL: a plain default for wood or foliage.
FR_MUST_USE FrStatus fr_look_init(FrLook *look, FrMaterial *material, bool is_foliage,
                                  const FrContext *context);
bool fr_look_is_hole(const FrLook *look, float u, float v);
/// Base colour, linear.
vec3s fr_look_colour(const FrLook *look, const FrDecoder *decoder, float u, float v);
/// Normal in the frame (along u, along −v, out of the surface), not unit.
vec3s fr_look_normal(const FrLook *look, float u, float v);
/// Fills everything but the normals. `is_upper` tells the side of a blade that is seen.
void fr_look_scattering(const FrLook *look, const FrDecoder *decoder, float u, float v,
                        bool is_upper, FrBsdf *bsdf);
