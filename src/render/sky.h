/// @file sky.h
/// Light from outside the scene: a sun disc and a table of the sky's radiance. Private to render.
///
/// The table has rows of equal height in z = −1 … 1 and columns of equal azimuth, so all its cells
/// subtend the same solid angle (Lambert's equal-area cylinder). Directions are drawn from blocks
/// of 4 × 4 cells: a table that stays in the cache is worth more than a finer one.
#pragma once

#include "frond/context.h"
#include "frond/scene.h"

typedef struct FrSky {
    uint32_t columns, rows; ///< columns a multiple of 4, rows of 8; the upper half is at rows / 2
    vec3s *radiance;        ///< by cell
    float *row_cdf;         ///< rows / 4 + 1
    float *column_cdf;      ///< (columns / 4 + 1) for each row of blocks
    float *block_density;   ///< probability density by block, per steradian
    vec3s sun_direction;    ///< unit, to the sun
    vec3s sun_irradiance;   ///< on a surface that faces the sun
    float sun_cosine;       ///< of the disc's angular radius
    vec3s flat_irradiance;  ///< of sun and sky together on open level ground
} FrSky;

/// The sky of the scene's parameters. With a ground nothing comes from below the horizon.
FrSky *fr_sky_new(const FrSceneParams *params, bool has_ground, const FrContext *context);
/// The same in few cells, made in a 64th of the time: for what falls onto matt surfaces.
FrSky *fr_sky_new_coarse(const FrSceneParams *params, bool has_ground, const FrContext *context);
/// The same radiance from everywhere above, and from below if `is_sphere`; no sun.
FrSky *fr_sky_new_uniform(vec3s radiance, bool is_sphere);
void fr_sky_free(FrSky *sky);
/// Replaces the sun: `irradiance` at normal incidence.
void fr_sky_set_sun(FrSky *sky, vec3s direction, vec3s irradiance);
/// Radiance of the sky without the sun's disc.
vec3s fr_sky_radiance(const FrSky *sky, vec3s direction);
/// Radiance of the sun's disc if `direction` meets it, else black.
vec3s fr_sky_sun_radiance(const FrSky *sky, vec3s direction);
/// A direction with probability by its radiance; `density` is that of fr_sky_density().
vec3s fr_sky_sample(const FrSky *sky, float u, float v, float *density);
/// Probability density of fr_sky_sample(), per steradian.
float fr_sky_density(const FrSky *sky, vec3s direction);
/// A direction to a point of the sun's disc.
vec3s fr_sky_sample_sun(const FrSky *sky, float u, float v);
