/// @file atmosphere.h
/// The light of a clear or hazy sky. Private to render.
#pragma once

#include "frond/vector.h"

/// A planet's air: scattering and absorption by height, and tables for one turbidity.
typedef struct FrAtmosphere FrAtmosphere;

/// `turbidity` is Linke's: how many atmospheres of clean, dry air would dim the sun as much. 1: no
/// haze, 3: a clear day.
FrAtmosphere *fr_atmosphere_new(double turbidity);
void fr_atmosphere_free(FrAtmosphere *atmosphere);
/// Part of the sun's light that reaches an observer at the ground; `sun_height` is the sine of the
/// sun's elevation.
vec3s fr_atmosphere_sunlight(const FrAtmosphere *atmosphere, double sun_height);
/// Radiance from `direction` (unit, z ≥ 0) at the ground for a sun of irradiance 1 outside the
/// atmosphere. Thread-safe.
vec3s fr_atmosphere_radiance(const FrAtmosphere *atmosphere, vec3s direction, vec3s sun);
