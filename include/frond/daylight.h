/// @file daylight.h
/// The sun by date and latitude, its path over a day, and the lamps that a day of sun and sky
/// makes.
///
/// The world has x to the east, y to the north, z up. Azimuths count from north clockwise.
#pragma once

#include "frond/light.h"

/// Where the sun stands. Radians.
typedef struct FrSunPosition {
    double azimuth, elevation; ///< of the middle of its disc, without refraction
    double declination;        ///< apparent
} FrSunPosition;

/// The sun's way over one day: a circle about the axis of the Earth. Radians.
typedef struct FrSunPath {
    double latitude, declination;
} FrSunPath;

/// The sun at a moment of universal time: `day` 1.5 is noon of the first. Years of the Gregorian
/// calendar. Latitude to the north and longitude to the east in radians. Good to 0.01 degrees from
/// 1900 to 2100.
FR_API FrSunPosition fr_light_sun(int year, int month, double day, double latitude,
                                  double longitude);
/// The direction to the sun.
FR_API vec3s fr_light_sun_direction(double azimuth, double elevation);
/// The path of a sun that stands there at some time of the day.
FR_API FrSunPath fr_light_sun_path(double latitude, double azimuth, double elevation);
/// Directions to the path's places at `count` evenly spread times between sunrise and sunset.
/// Returns 0 and writes nothing if the sun does not rise, else `count`.
FR_API size_t fr_light_sun_places(FrSunPath path, size_t count, vec3s *directions);
/// What the sun brings to a square metre that faces it under a clear sky, kW; 0 below the horizon.
FR_API double fr_light_sunlight(double elevation);

/// The lamps of the mean hour of a day, in kW per square metre: suns along the path and a sky,
/// times their strengths. Under an overcast sky there are no suns; a clear one has as many skies as
/// suns, each brightest about its own. `count` is how many places the sun has. Writes at most 2
/// `count` lamps, and one more where the sun does not rise; returns how many.
FR_API size_t fr_light_day(FrSkyKind sky, FrSunPath path, size_t count, double sun_strength,
                           double sky_strength, FrLamp *lamps);
/// The lamps of one moment, at most 2, in the same terms. A sun below the horizon is left out.
FR_API size_t fr_light_sun_and_sky(FrSkyKind sky, double azimuth, double elevation,
                                   double sun_strength, double sky_strength, FrLamp *lamps);
