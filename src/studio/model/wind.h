/// @file wind.h
/// A wind to look at: it moves the picture, not the document.
#pragma once

#include "frond/api.h"

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
