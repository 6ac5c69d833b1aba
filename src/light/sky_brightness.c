// The skies of the Commission Internationale de l'Éclairage: overcast (Moon, Spencer 1942) and
// clear (CIE 1973, Standardization of luminance distribution on clear skies).
#include "frond/light.h"

#include <cglm/struct.h>
#include <math.h>

// Brightest about the sun, which stands `angle` away.
static double clear_glow(double angle) {
    double cosine = cos(angle);
    return 0.91 + 10.0 * exp(-3.0 * angle) + 0.45 * cosine * cosine;
}

static double clear(vec3s direction, vec3s sun) {
    double toward = CLAMP((double)glms_vec3_dot(direction, sun), -1.0, 1.0);
    double zenith = CLAMP((double)sun.z, -1.0, 1.0);
    double haze = 1.0 - exp(-0.32 / fmax((double)direction.z, 1e-6));
    return clear_glow(acos(toward)) * haze / (clear_glow(acos(zenith)) * (1.0 - exp(-0.32)));
}

double fr_lamp_sky_brightness(const FrLamp *lamp, vec3s direction) {
    if (!(direction.z > 0.0f)) {
        return 0.0;
    }
    switch (lamp->sky) {
    case FR_SKY_UNIFORM:
        return 1.0;
    case FR_SKY_OVERCAST:
        return (1.0 + 2.0 * (double)direction.z) / 3.0;
    case FR_SKY_CLEAR:
        return clear(direction, glms_vec3_normalize(lamp->sun));
    }
    return 0.0;
}
