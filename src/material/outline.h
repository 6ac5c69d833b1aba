/// @file outline.h
/// The margin of a leaf or petal in its picture.
///
/// Everything about a blade is computed in blade space: x across, 0 on the midrib; y along, 0 at
/// the base, 1 at the tip; x reaches ±aspect/2 where the picture ends. A picture is square though
/// blades are not; in this space distances and angles are those of a typical blade.
#pragma once

#include "material/texture.h"

typedef struct FrOutline {
    float (*points)[2]; ///< of the right half, from base to tip: x, y; ends on the midrib
    int count;
    float aspect; ///< full width over length of a typical blade
    float length; ///< of the right half's margin
    float *arc;   ///< length of the margin up to each point
} FrOutline;

/// The margin of `params->outline`, or an ellipse.
FrOutline *fr_outline_new(const FrMaterialParams *params, float aspect);
void fr_outline_free(FrOutline *outline);

/// Where a place is relative to the margin.
typedef struct FrMargin {
    float distance; ///< to the margin, > 0 inside
    float arc;      ///< of the nearest point of the margin, 0 base to 1 tip
} FrMargin;

FrMargin fr_outline_at(const FrOutline *outline, float x, float y);
/// Half width at height `y`: the margin's outermost x there, 0 beyond its ends.
float fr_outline_half_width(const FrOutline *outline, float y);
/// The margin seen from every texel of one row.
void fr_outline_row(const FrOutline *outline, int size, int row, FrMargin *margins);

/// Blade space of a texel's centre.
static inline float fr_blade_x(const FrOutline *outline, int size, float column) {
    return ((column + 0.5f) / (float)size - 0.5f) * outline->aspect;
}
static inline float fr_blade_y(int size, float row) {
    return 1.0f - (row + 0.5f) / (float)size;
}
/// A texel's mean extent in blade space: the width over which edges are smoothed.
static inline float fr_blade_texel(const FrOutline *outline, int size) {
    return 0.5f * (1.0f + outline->aspect) / (float)size;
}

/// How far the blade is painted beyond its outline (see material.h).
#define FR_OUTLINE_BLEED 0.008f
/// Alpha of a place: the margin with its teeth cut in, smoothed over one texel.
float fr_outline_alpha(const FrOutline *outline, const FrMaterialParams *params, FrMargin margin,
                       float texel);
