/// @file wind.h
/// A wind to look at, which moves the picture, and that of a plant's `<nurbs>`, which bends it.
#pragma once

#include "studio/model/document.h"

typedef struct StudioWind {
    double strength;  ///< 0 to 1: how far the tops give way, at most a quarter of the height
    double direction; ///< degrees, towards where it blows, from north clockwise
    double speed;     ///< of its gusts, 1 is that of a breeze
    double phase;     ///< of its gusts; goes on with time
} StudioWind;

StudioWind studio_wind_default(void);
/// Goes on for so many seconds; after a pause it goes on from where it was.
void studio_wind_advance(StudioWind *wind, double seconds);
/// What the shaders take: x and y in parts of the height, phase, height in metres.
void studio_wind_gust(const StudioWind *wind, double height, float gust[4]);

/// The wind that a plant's `<nurbs>` is bent by: its strength along the ground, and towards where
/// it blows, in degrees from north clockwise. False if it has none, or one that is no number.
bool studio_wind_read(const StudioDocument *document, uint32_t plant, double *strength,
                      double *direction);
/// Sets it where studio_wind_read() can; what of it blows up or down stays. Calls in a row are one
/// step. False if nothing changed.
bool studio_wind_write(StudioDocument *document, uint32_t plant, double strength, double direction);
