/// @file emitters.h
/// The lamps of a scene made ready to send out photons, each its share of them. Private to light.
#pragma once

#include "frond/light.h"
#include "frond/random.h"

#include <glib.h>
#include <math.h>

typedef struct FrEmitters FrEmitters;

typedef struct FrEmission {
    float origin[3], direction[3]; ///< unit
} FrEmission;

/// min … max is what suns and skies shine on.
FrEmitters *fr_emitters_new(const FrLamp *lamps, uint32_t count, vec3s min, vec3s max);
void fr_emitters_free(FrEmitters *emitters);
/// All light that all lamps give, what suns and skies send through the box included.
double fr_emitters_power(const FrEmitters *emitters);
/// Photon number `index` of `count`. Neighbours among them start at neighbouring places.
FrEmission fr_emitters_emit(const FrEmitters *emitters, FrKey key, uint64_t index, uint64_t count);
FrDigest fr_emitters_digest(const FrEmitters *emitters);

/// Two unit vectors that make a right-handed frame with the unit vector w. For vectors along an
/// axis they are along axes.
static inline void fr_frame_about(const double w[3], double u[3], double v[3]) {
    int most = fabs(w[0]) > fabs(w[1]) ? (fabs(w[0]) > fabs(w[2]) ? 0 : 2)
                                       : (fabs(w[1]) > fabs(w[2]) ? 1 : 2);
    int next = (most + 1) % 3;
    // next × w, made of unit length, is at right angles to w; `most` is never along `next`.
    double axis[3] = {0};
    axis[next] = 1.0;
    u[0] = axis[1] * w[2] - axis[2] * w[1];
    u[1] = axis[2] * w[0] - axis[0] * w[2];
    u[2] = axis[0] * w[1] - axis[1] * w[0];
    double scale = 1.0 / sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int c = 0; c < 3; c++) {
        u[c] *= scale;
    }
    v[0] = w[1] * u[2] - w[2] * u[1];
    v[1] = w[2] * u[0] - w[0] * u[2];
    v[2] = w[0] * u[1] - w[1] * u[0];
}

/// The direction at cosine z and turn 2π · t about the unit vector w.
static inline void fr_direction_about(const double w[3], double z, double t, double out[3]) {
    double u[3], v[3], sine, cosine;
    fr_frame_about(w, u, v);
    sincos(2.0 * G_PI * t, &sine, &cosine);
    double side = sqrt(fmax(0.0, 1.0 - z * z));
    for (int c = 0; c < 3; c++) {
        out[c] = side * (cosine * u[c] + sine * v[c]) + z * w[c];
    }
}
