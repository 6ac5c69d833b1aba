// A photon at a surface.
#include "light/scatter.h"

#include "light/emitters.h"

enum { PURPOSE_CHOICE = 2, PURPOSE_DIRECTION = 3 };

// Lambert's law: the cosine's square is even in [0, 1).
static void scatter_diffuse(const double axis[3], FrKey key, float direction[3]) {
    double out[3];
    fr_direction_about(axis, sqrt(1.0 - fr_random(key, PURPOSE_DIRECTION, 0)),
                       fr_random(key, PURPOSE_DIRECTION, 1), out);
    for (int c = 0; c < 3; c++) {
        direction[c] = (float)out[c];
    }
}

static void mirror(const double axis[3], float direction[3]) {
    double along = 0.0, length = 0.0;
    double out[3];
    for (int c = 0; c < 3; c++) {
        along += (double)direction[c] * axis[c];
    }
    for (int c = 0; c < 3; c++) {
        out[c] = (double)direction[c] - 2.0 * along * axis[c];
        length += out[c] * out[c];
    }
    for (int c = 0; c < 3; c++) {
        direction[c] = (float)(out[c] / sqrt(length));
    }
}

bool fr_scatter(const FrOptics *optics, const double normal[3], FrKey key, float direction[3]) {
    double choice = fr_random(key, PURPOSE_CHOICE, 0);
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    double axis[3], behind[3];
    for (int c = 0; c < 3; c++) {
        axis[c] = normal[c] / length;
        behind[c] = -axis[c];
    }
    if ((choice -= (double)optics->diffuse) < 0.0) {
        scatter_diffuse(axis, key, direction);
    } else if ((choice -= (double)optics->specular) < 0.0) {
        mirror(axis, direction);
    } else if ((choice -= (double)optics->transmit_diffuse) < 0.0) {
        scatter_diffuse(behind, key, direction);
    } else if ((choice -= (double)optics->transmit_specular) >= 0.0) {
        return false;
    }
    return true;
}
