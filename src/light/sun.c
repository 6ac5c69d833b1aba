// The sun's place after Meeus 1998, Astronomical Algorithms, chapters 7, 12, 13 and 25 (lower
// accuracy), and its path over a day: the declination is kept, the hour angle runs. Sunlight after
// Meinel, Meinel 1976, Applied Solar Energy.
#include "frond/daylight.h"

#include <glib.h>
#include <math.h>

#define DEGREE (G_PI / 180.0)

static double julian_day(int year, int month, double day) {
    if (month <= 2) {
        year--;
        month += 12;
    }
    double century = floor(year / 100.0);
    double leap = 2.0 - century + floor(century / 4.0);
    return floor(365.25 * (year + 4716)) + floor(30.6001 * (month + 1)) + day + leap - 1524.5;
}

/// A direction on the celestial sphere, seen from `latitude` at an hour angle (west positive).
static void place_of(double latitude, double declination, double hour, double place[3]) {
    place[0] = -cos(declination) * sin(hour);
    place[1] = sin(declination) * cos(latitude) - cos(declination) * cos(hour) * sin(latitude);
    place[2] = sin(declination) * sin(latitude) + cos(declination) * cos(hour) * cos(latitude);
}

FrSunPosition fr_light_sun(int year, int month, double day, double latitude, double longitude) {
    double t = (julian_day(year, month, day) - 2451545.0) / 36525.0;
    double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
    double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * DEGREE;
    double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * sin(anomaly) +
                    (0.019993 - t * 0.000101) * sin(2 * anomaly) + 0.000289 * sin(3 * anomaly);
    double node = (125.04 - 1934.136 * t) * DEGREE;
    double apparent = (mean_longitude + centre - 0.00569 - 0.00478 * sin(node)) * DEGREE;
    double obliquity = (23.4392911 - t * (0.0130042 + t * 1.64e-7) + 0.00256 * cos(node)) * DEGREE;
    double declination = asin(sin(obliquity) * sin(apparent));
    double ascension = atan2(cos(obliquity) * sin(apparent), cos(apparent));
    double sidereal = (280.46061837 + 360.98564736629 * 36525.0 * t + t * t * 0.000387933) * DEGREE;
    double place[3];
    place_of(latitude, declination, sidereal + longitude - ascension, place);
    double azimuth = atan2(place[0], place[1]);
    return (FrSunPosition){.azimuth = azimuth < 0 ? azimuth + 2 * G_PI : azimuth,
                           .elevation = atan2(place[2], hypot(place[0], place[1])),
                           .declination = declination};
}

vec3s fr_light_sun_direction(double azimuth, double elevation) {
    return (vec3s){{(float)(sin(azimuth) * cos(elevation)), (float)(cos(azimuth) * cos(elevation)),
                    (float)sin(elevation)}};
}

FrSunPath fr_light_sun_path(double latitude, double azimuth, double elevation) {
    double sine = sin(elevation) * sin(latitude) + cos(elevation) * cos(azimuth) * cos(latitude);
    return (FrSunPath){.latitude = latitude, .declination = asin(fmin(fmax(sine, -1.0), 1.0))};
}

size_t fr_light_sun_places(FrSunPath path, size_t count, vec3s *directions) {
    // The sun rises where sin φ sin δ + cos φ cos δ cos H = 0.
    double across = cos(path.latitude) * cos(path.declination);
    double along = sin(path.latitude) * sin(path.declination);
    if (along + across <= 0) {
        return 0;
    }
    double half_day = along >= across ? G_PI : acos(fmax(-along / across, -1.0));
    for (size_t i = 0; i < count; i++) {
        double hour = half_day * (2.0 * ((double)i + 0.5) / (double)count - 1.0);
        double place[3];
        place_of(path.latitude, path.declination, hour, place);
        directions[i] = (vec3s){{(float)place[0], (float)place[1], (float)fmax(place[2], 0.0)}};
    }
    return count;
}

/// How much air light passes, 1 from the zenith: Kasten, Young 1989, Revised Optical Air Mass
/// Tables.
static double air_mass(double elevation) {
    double degrees = elevation / DEGREE;
    return 1.0 / (sin(elevation) + 0.50572 * pow(degrees + 6.07995, -1.6364));
}

double fr_light_sunlight(double elevation) {
    if (!(elevation > 0)) {
        return 0;
    }
    return 1.353 * pow(0.7, pow(air_mass(elevation), 0.678));
}
