// A day's light as lamps: the sun at evenly spread times, each for its share of the day, and the
// sky. A clear sky brings to level ground a tenth of what its sun brings to a surface that faces it
// (Meinel, Meinel 1976); one without visible sun as much as a tenth of the sun in the zenith, which
// falls in from everywhere.
#include "frond/daylight.h"

#include <cglm/struct.h>
#include <glib.h>
#include <math.h>

#define SKY_PART 0.1

static FrLamp sky_lamp(FrSkyKind sky, double power, vec3s sun) {
    return (FrLamp){.kind = FR_LAMP_SKY, .power = power, .sky = sky, .sun = sun};
}

/// Suns, and their skies if those are clear.
static size_t add_suns(FrSkyKind sky, const vec3s *places, size_t count, double sun_strength,
                       double sky_strength, FrLamp *lamps) {
    size_t written = 0;
    for (size_t i = 0; i < count; i++) {
        double light = fr_light_sunlight(asin((double)places[i].z)) / (double)count;
        lamps[written++] = (FrLamp){.kind = FR_LAMP_SUN,
                                    .power = sun_strength * light,
                                    .direction = glms_vec3_negate(places[i])};
        if (sky == FR_SKY_CLEAR) {
            lamps[written++] = sky_lamp(sky, sky_strength * SKY_PART * light, places[i]);
        }
    }
    return written;
}

/// The lamps for these places of the sun.
static size_t add_lamps(FrSkyKind sky, const vec3s *places, size_t count, double sun_strength,
                        double sky_strength, FrLamp *lamps) {
    if (sky == FR_SKY_OVERCAST) {
        count = 0;
    }
    size_t written = add_suns(sky, places, count, sun_strength, sky_strength, lamps);
    if (sky != FR_SKY_CLEAR) {
        double even = sky_strength * SKY_PART * fr_light_sunlight(G_PI_2);
        lamps[written++] = sky_lamp(sky, even, (vec3s){{0, 0, 1}});
    }
    return written;
}

size_t fr_light_sun_and_sky(FrSkyKind sky, double azimuth, double elevation, double sun_strength,
                            double sky_strength, FrLamp *lamps) {
    vec3s place = fr_light_sun_direction(azimuth, elevation);
    return add_lamps(sky, &place, elevation > 0 ? 1 : 0, sun_strength, sky_strength, lamps);
}

size_t fr_light_day(FrSkyKind sky, FrSunPath path, size_t count, double sun_strength,
                    double sky_strength, FrLamp *lamps) {
    vec3s *places = g_new(vec3s, count);
    size_t risen = count == 0 ? 0 : fr_light_sun_places(path, count, places);
    size_t written = add_lamps(sky, places, risen, sun_strength, sky_strength, lamps);
    g_free(places);
    return written;
}
