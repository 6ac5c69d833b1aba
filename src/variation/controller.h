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

// Errors beyond half a turn mean nothing.
#define FR_LARGEST_ERROR 3.1f

enum {
    FR_PURPOSE_TURN = 0x76617279, ///< of random draws
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
    vec4s errors[FR_ERRORS]; ///< ring, by joint; of four numbers, to be read as they are written
    vec4s random;            ///< ξ
    FrKey key;
    uint32_t joint;
} FrControl;

FrController fr_controller_of(const FrVaryParams *params);

/// Begins a branch: its first joint has no error.
static inline void fr_control_begin(FrControl *control, FrKey key) {
    *control = (FrControl){.key = key};
}

/// A deviate of mean 0 and variance 1 from 32 random bits: the sum of two uniform ones. The joints
/// that follow filter what is random in one, so no more is needed, and it costs no logarithm.
static inline float fr_deviate(uint32_t bits) {
    int32_t sum = (int32_t)(bits & 0xffff) + (int32_t)(bits >> 16);
    return (float)(sum - 65535) * 3.7376450e-5f; // √6 / 65536
}

/// Draws the next joint's random turn, across the frame it should have.
static inline void fr_control_draw(const FrController *controller, FrControl *control,
                                   versors frame) {
    float spread = control->joint == 0 ? controller->start : controller->innovation;
    uint64_t bits = fr_random_bits(control->key, FR_PURPOSE_TURN, control->joint);
    float u = spread * fr_deviate((uint32_t)bits);
    float v = spread * fr_deviate((uint32_t)(bits >> 32));
    vec3s left = fr_frame_left(frame), up = fr_frame_up(frame);
    vec4s turn = {{u * left.x + v * up.x, u * left.y + v * up.y, u * left.z + v * up.z, 0}};
    for (int k = 0; k < 4; k++) {
        control->random.raw[k] = controller->persistence * control->random.raw[k] + turn.raw[k];
    }
}

/// The next joint's error, after its random turn was drawn. `drive` is all that is steady or
/// foreseen: b − (1 − a) t. Inline: it is done once a joint.
static inline vec4s fr_control_next(const FrController *controller, FrControl *control,
                                    vec4s drive) {
    uint32_t n = control->joint;
    vec4s last = control->errors[n % FR_ERRORS];
    vec4s before = control->errors[(n + FR_ERRORS - 1) % FR_ERRORS];
    vec4s sensed = control->errors[(n + FR_ERRORS - controller->delay) % FR_ERRORS];
    vec4s e;
    for (int k = 0; k < 4; k++) {
        float turn = last.raw[k] - before.raw[k];
        e.raw[k] =
            last.raw[k] + ((control->random.raw[k] + drive.raw[k]) -
                           (controller->gain * sensed.raw[k] + controller->proprioception * turn));
    }
    float square = e.x * e.x + (e.y * e.y + e.z * e.z);
    if (square > FR_LARGEST_ERROR * FR_LARGEST_ERROR) {
        float scale = FR_LARGEST_ERROR / sqrtf(square);
        e = (vec4s){{scale * e.x, scale * e.y, scale * e.z, 0}};
    }
    control->joint = n + 1;
    control->errors[(n + 1) % FR_ERRORS] = e;
    return e;
}

/// The smallest turn between two unit vectors, as a rotation vector; 0 for opposite ones.
vec3s fr_turn_between(vec3s from, vec3s to);

/// The turn from `heading` towards the sum of indicators, as a rotation vector: the angle to
/// heading + indicator, but never beyond the indicator and at most a right angle.
vec3s fr_indicator_turn(vec3s heading, vec3s indicator);

/// The rotation of a rotation vector of at most π. Power series of sin and cos: exact to the last
/// bits of a float there, and without a root.
static inline versors fr_rotation_of(vec4s e) {
    float x = 0.25f * (e.x * e.x + (e.y * e.y + e.z * e.z));
    float square = x * x; // in pairs, so that no term waits for all others
    float s = (1 - x * (1.0f / 6)) + square * ((1.0f / 120 - x * (1.0f / 5040)) +
                                               square * (1.0f / 362880 - x * (1.0f / 39916800)));
    float c =
        (1 - x * (1.0f / 2)) +
        square * ((1.0f / 24 - x * (1.0f / 720)) +
                  square * ((1.0f / 40320 - x * (1.0f / 3628800)) + square * (1.0f / 479001600)));
    s *= 0.5f;
    return (versors){{s * e.x, s * e.y, s * e.z, c}};
}
