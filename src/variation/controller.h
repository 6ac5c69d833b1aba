/// @file controller.h
/// Growth that senses its direction and reacts to it some joints later.
///
/// The error of a joint is the rotation vector e (in the plant's coordinates) from the direction it
/// should have to the one it has. From joint to joint
///
///     e(n+1) = e(n) − K e(n−d) − γ (e(n) − e(n−1)) + ξ(n) + b − (1 − a) t(n)
///
/// with the gain K of the reaction, its delay d, the proprioceptive γ, the random turn ξ (an AR(1)
/// process), the turn b of an indicator and the part of a stroke's turn t that was not anticipated.
/// A steady b ends in the tilt b / K. After: Streit et al. 2005, A biologically-parameterized
/// feature-based method; the proprioceptive term after Bastien et al. 2013 (PNAS 110).
#pragma once

#include "frond/variation.h"

#include <math.h>

enum {
    FR_DELAY_MAX = 8,
    FR_ERRORS = 16, ///< errors remembered, a power of two > FR_DELAY_MAX + 1
};

/// What is the same for all branches of an instance.
typedef struct FrController {
    float gain, proprioception;
    float late;        ///< part of a stroke's turns that is not anticipated
    float persistence; ///< of the random turn from joint to joint
    float innovation;  ///< standard deviation of what is new in it, radians
    float start;       ///< standard deviation of the first
    uint32_t delay;
} FrController;

/// One branch on its way to the tip.
typedef struct FrControl {
    vec3s errors[FR_ERRORS]; ///< ring, by joint
    vec3s random;            ///< ξ
    FrKey key;
    uint32_t joint;
} FrControl;

FrController fr_controller_of(const FrVaryParams *params);

/// Begins a branch: its first joint has no error.
static inline void fr_control_begin(FrControl *control, FrKey key) {
    *control = (FrControl){.key = key};
}

/// The next joint's error. `frame` is the one it should have, `drive` all that is steady or
/// foreseen: b − (1 − a) t.
vec3s fr_control_next(const FrController *controller, FrControl *control, versors frame,
                      vec3s drive);

/// The smallest turn between two unit vectors, as a rotation vector; 0 for opposite ones.
vec3s fr_turn_between(vec3s from, vec3s to);

/// The turn from `heading` towards the sum of indicators, as a rotation vector: the angle to
/// heading + indicator, but never beyond the indicator and at most a right angle.
vec3s fr_indicator_turn(vec3s heading, vec3s indicator);

/// The rotation of a rotation vector of at most π. Power series of sin and cos: exact to the last
/// bits of a float there, and without a root.
static inline versors fr_rotation_of(vec3s e) {
    float x = 0.25f * (e.x * e.x + (e.y * e.y + e.z * e.z));
    float s =
        1 + x * (-1.0f / 6 + x * (1.0f / 120 + x * (-1.0f / 5040 +
                                                    x * (1.0f / 362880 - x * (1.0f / 39916800)))));
    float c =
        1 + x * (-1.0f / 2 +
                 x * (1.0f / 24 +
                      x * (-1.0f / 720 +
                           x * (1.0f / 40320 + x * (-1.0f / 3628800 + x * (1.0f / 479001600))))));
    s *= 0.5f;
    return (versors){{s * e.x, s * e.y, s * e.z, c}};
}
