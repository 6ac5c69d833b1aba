/// @file light_field.h
/// Where the light comes from all over a box: answers on a grid, for those who ask often and at
/// places they cannot tell in advance.
#pragma once

#include "frond/light.h"

/// A box in the coordinates of a plant. Between the points of the grid directions are mixed.
typedef struct FrLightField {
    vec3s origin;      ///< the first point
    float cell;        ///< m, between two points
    uint32_t count[3]; ///< points along x, y, z, ≥ 2
    vec3s *towards;    ///< by point, x fastest: to the light, unit; 0 where there is none
} FrLightField;

/// Where a plant stands: scaled, turned by `turn` radians about z, then moved to `at`.
typedef struct FrLightPlace {
    double at[3];
    double turn, scale;
} FrLightPlace;

/// Asks `light` for the directions in the box from `min` to `max`, with `cells` cells along its
/// longest side (1 to 256).
FR_API FR_MUST_USE FrStatus fr_light_field_new(FrLight *light, const FrLightPlace *place, vec3s min,
                                               vec3s max, uint32_t cells, const FrContext *context,
                                               FrLightField **field);
FR_API void fr_light_field_free(FrLightField *field);
/// To the light, at most unit; outside as at the nearest point of the box.
FR_API vec3s fr_light_field_at(const FrLightField *field, vec3s at);
