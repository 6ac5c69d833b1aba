#include "studio/model/wind.h"

#include <math.h>

// The tops give way by so much of the height at most.
static const double farthest = 0.27;
// A pause of the picture is none of the wind, s.
static const double longest_step = 0.1;
// Phases repeat, or they would lose their digits; a multiple of no gust's own length.
static const double round_trip = 3600;

StudioWind studio_wind_default(void) {
    return (StudioWind){.strength = 0.3, .direction = 68, .speed = 1};
}

void studio_wind_advance(StudioWind *wind, double seconds) {
    wind->phase =
        fmod(wind->phase + wind->speed * fmin(fmax(seconds, 0), longest_step), round_trip);
}

void studio_wind_gust(const StudioWind *wind, double height, float gust[4]) {
    double turn = wind->direction * (3.14159265358979323846 / 180);
    gust[0] = (float)(farthest * wind->strength * sin(turn));
    gust[1] = (float)(farthest * wind->strength * cos(turn));
    gust[2] = (float)wind->phase;
    gust[3] = (float)height;
}
