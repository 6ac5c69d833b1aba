/// @file shadows.h
/// Shadow voxels (Palubicki, Horel, Longay, Runions, Lane, Měch, Prusinkiewicz 2009,
/// Self-organizing Tree Models for Image Synthesis): every leaf or bud darkens a pyramid of voxels
/// below it. The cheapest answer to how much light there is.
///
/// Voxels hold whole numbers, so what was cast can be taken back exactly, in any order. A voxel
/// holds 30 000 shadows of its own and more.
#pragma once

#include "frond/digest.h"
#include "frond/light.h"

typedef enum FrShadowForm {
    FR_SHADOWS_SUBTRACT, ///< layer q below takes a·b^−q from the light (the paper)
    FR_SHADOWS_MULTIPLY, ///< a voxel at distance d loses the part a·b^−d of its light, in the
                         ///< layers 1 … depth − 1 (the program of the paper's authors)
} FrShadowForm;

typedef struct FrShadowSettings {
    FrShadowForm form;
    double a, b;      ///< strength, > 0, and how fast it fades, > 1
    double full;      ///< FR_SHADOWS_SUBTRACT: light of a place without shadow, > 0
    int depth;        ///< layers of the pyramid, 1 to 64
    int spread;       ///< voxels by which each layer is wider than the one above, 0 to 4
    double cell;      ///< width of a voxel, m
    double origin[3]; ///< lowest corner, m
    int cells[3];     ///< voxels along x, y, z, ≥ 1
    double jitter;    ///< part of the light that voxels lack at most, by chance, below 1
    uint64_t seed;    ///< of that chance
} FrShadowSettings;

/// What a place receives.
typedef struct FrShadowSample {
    float light;     ///< 0 to 1, full light
    vec3s direction; ///< unit, to where it grows lighter; up where it is even
    float slope;     ///< how much lighter, per voxel
} FrShadowSample;

typedef struct FrShadows FrShadows;

/// a = 0.441, b = 6.31, depth 6, spread 1, multiplied, 201³ voxels over 201 m about the origin and
/// from it upwards.
FR_API FrShadowSettings fr_shadows_default(void);
/// Unshaded voxels. FR_ERR_LIMIT if they would take more than FrLimits.bytes; then *shadows is
/// NULL.
FR_API FR_MUST_USE FrStatus fr_shadows_new(const FrShadowSettings *settings,
                                           const FrContext *context, FrShadows **shadows);
FR_API void fr_shadows_free(FrShadows *shadows);
/// Casts the shadows of `count` points, or takes them back if `is_taken`. Points outside cast into
/// what lies below them inside. The same for any number of threads.
FR_API void fr_shadows_cast(FrShadows *shadows, const vec3s *points, size_t count, bool is_taken,
                            const FrContext *context);
/// Light at a point, interpolated between the middles of voxels; full light outside. `radius` in
/// voxels is how far around it the direction is looked for. With FR_SHADOWS_SUBTRACT a point is
/// taken to have cast a shadow on its own voxel, which is not counted.
FR_API FrShadowSample fr_shadows_at(const FrShadows *shadows, vec3s point, double radius);
/// The light alone.
FR_API float fr_shadows_light(const FrShadows *shadows, vec3s point);
/// Works out the light of all voxels, so that asking becomes some ten times as fast until the next
/// shadow is cast. Takes as much memory again.
FR_API void fr_shadows_settle(FrShadows *shadows, const FrContext *context);
FR_API FrDigest fr_shadows_digest(const FrShadows *shadows);

// ---- as a backend of light --------------------------------------------------------------------

typedef struct FrShadowLightSettings {
    FrShadowForm form;
    double a, b; ///< as of FrShadowSettings
    double full;
    int64_t depth;
    double cell;   ///< m; made wider where the scene would need more than `cells`
    int64_t cells; ///< at most so many voxels
    FrSpan span;   ///< where a document asks for them, for messages
} FrShadowLightSettings;

/// The constants of fr_shadows_default(), voxels of 0.2 m, at most 8 million of them.
FR_API FrShadowLightSettings fr_shadow_light_default(void);
/// A backend of shadow voxels. Surfaces cast a shadow for every cell² of their area in a voxel, at
/// least one. Light falls from above, whatever sun or sky there is; without both it is dark, for
/// point, spot and area lamps are not asked. Confidence is four times the slope, at most 1; where
/// nothing shades it is 0, as light comes from everywhere alike.
FR_API FrLight *fr_shadow_light_new(const FrShadowLightSettings *settings);
