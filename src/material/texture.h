/// @file texture.h
/// Pictures made by the program: what every kind of texture is handed and what they share.
///
/// A kind paints a field of FrTexel; from it come the colour, normal and roughness maps. A colour
/// is painted under transparent texels too, so filtering never mixes in a foreign one.
#pragma once

#include "frond/material.h"

/// One pixel before it becomes bytes.
typedef struct FrTexel {
    float colour[3]; ///< linear light, 0 to 1
    float alpha;     ///< 0 to 1
    float height;    ///< of the picture's side
    float roughness; ///< 0 to 1; multiplied by the material's roughness
} FrTexel;

/// A square field of texels, rows from the top.
typedef struct FrTexture {
    int size;
    bool is_tiled;  ///< opposite edges meet
    bool has_alpha; ///< the picture has holes
    FrTexel *texels;
    const FrMaterialParams *params;
    const FrContext *context;
    FrKey key;
} FrTexture;

/// Does one row; rows are done in any order on all threads, so a row writes only to itself.
typedef void (*FrTextureRowFn)(FrTexture *texture, int row, void *data);
void fr_texture_rows(FrTexture *texture, FrTextureRowFn row, void *data);

/// The texel at (x, y), which wraps around if the texture is tiled and is clamped otherwise.
const FrTexel *fr_texture_at(const FrTexture *texture, int x, int y);

/// Unit normal of the height field at a texel: x right, y up, z out of the picture.
vec3s fr_texture_normal(const FrTexture *texture, int x, int y);

// ---- the kinds, each in its own file ----------------------------------------------------------

void fr_texture_leaf(FrTexture *texture);
void fr_texture_petal(FrTexture *texture);
void fr_texture_bark_furrowed(FrTexture *texture);
void fr_texture_bark_smooth(FrTexture *texture);
void fr_texture_bark_plated(FrTexture *texture);

/// Makes all three maps of the texture that `params` describe.
FR_MUST_USE FrStatus fr_texture_make(const FrMaterialParams *params, const char *name, FrSpan span,
                                     const FrContext *context, FrImage *maps[FR_MAP_COUNT]);

// ---- colour -----------------------------------------------------------------------------------

vec3s fr_colour_linear(vec3s srgb);
float fr_colour_srgb(float linear);
vec3s fr_colour_mix(vec3s a, vec3s b, float t);
vec3s fr_colour_scale(vec3s colour, float factor);
/// `colour` brightened (> 1) or darkened and made more (> 1) or less saturated.
vec3s fr_colour_adjust(vec3s colour, float brightness, float saturation);
/// `params->colour` in linear light, or `typical` (sRGB) if that is left white.
vec3s fr_texture_base_colour(const FrMaterialParams *params, vec3s typical);
/// `params->second_colour` in linear light; false if that is left black.
bool fr_texture_second_colour(const FrMaterialParams *params, vec3s *second);
