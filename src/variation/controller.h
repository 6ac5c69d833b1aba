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
#include "math/lanes.h"

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

/// Branches on their way to the tip, one a lane.
typedef struct FrControl {
    FrLanes3 errors[FR_ERRORS]; ///< ring, by joint
    FrLanes3 random;            ///< ξ
    FrKey key[FR_LANES];
    uint32_t joint;
} FrControl;

FrController fr_controller_of(const FrVaryParams *params);

/// Two deviates of mean 0 and variance 1 from the random bits of each lane: sums of two uniform
/// ones of 16 bits. The joints that follow filter what is random in one, so no more is needed, and
/// it costs no logarithm.
static inline void fr_deviates(const uint64_t bits[FR_LANES], FrLanes *u, FrLanes *v) {
    FrLaneBits low, high;
    for (int k = 0; k < FR_LANES; k++) {
        low[k] = (uint32_t)bits[k];
        high[k] = (uint32_t)(bits[k] >> 32);
    }
    low = (low & 0xffff) + (low >> 16);
    high = (high & 0xffff) + (high >> 16);
    const float scale = 3.7376450e-5f; // √6 / 65536
    *u = (__builtin_convertvector((FrLaneMask)low, FrLanes) - 65535) * scale;
    *v = (__builtin_convertvector((FrLaneMask)high, FrLanes) - 65535) * scale;
}

/// Draws the next joint's random turn, across the frame it should have.
static inline void fr_control_draw(const FrController *controller, FrControl *control,
                                   FrLanes4 frame) {
    uint64_t bits[FR_LANES];
    for (int k = 0; k < FR_LANES; k++) {
        bits[k] = fr_random_bits(control->key[k], FR_PURPOSE_TURN, control->joint);
    }
    FrLanes u, v;
    fr_deviates(bits, &u, &v);
    float spread = control->joint == 0 ? controller->start : controller->innovation;
    FrLanes3 turn = fr_lanes3_add(fr_lanes3_scale(fr_lanes_left(frame), u * spread),
                                  fr_lanes3_scale(fr_lanes_up(frame), v * spread));
    FrLanes persistence = controller->persistence - (FrLanes){0};
    control->random = fr_lanes3_add(fr_lanes3_scale(control->random, persistence), turn);
}

/// One coordinate of the next error.
static inline FrLanes fr_control_step(const FrController *controller, FrLanes last, FrLanes before,
                                      FrLanes sensed, FrLanes random, FrLanes drive) {
    return last + ((random + drive) -
                   (controller->gain * sensed + controller->proprioception * (last - before)));
}

/// The next joint's error, after its random turn was drawn. `drive` is all that is steady or
/// foreseen: b − (1 − a) t. Inline: it is done once a joint.
static inline FrLanes3 fr_control_next(const FrController *controller, FrControl *control,
                                       FrLanes3 drive) {
    uint32_t n = control->joint;
    const FrLanes3 *last = &control->errors[n % FR_ERRORS];
    const FrLanes3 *before = &control->errors[(n + FR_ERRORS - 1) % FR_ERRORS];
    const FrLanes3 *sensed = &control->errors[(n + FR_ERRORS - controller->delay) % FR_ERRORS];
    const FrLanes3 *random = &control->random;
    FrLanes3 e = {
        fr_control_step(controller, last->x, before->x, sensed->x, random->x, drive.x),
        fr_control_step(controller, last->y, before->y, sensed->y, random->y, drive.y),
        fr_control_step(controller, last->z, before->z, sensed->z, random->z, drive.z),
    };
    FrLanes square = fr_lanes3_dot(e, e);
    FrLaneMask is_beyond = square > FR_LARGEST_ERROR * FR_LARGEST_ERROR;
    if (fr_lanes_any(is_beyond)) {
        FrLanes scale = FR_LARGEST_ERROR / fr_lanes_sqrt(square);
        e = fr_lanes3_scale(e, fr_lanes_select(is_beyond, scale, 1 - (FrLanes){0}));
    }
    control->joint = n + 1;
    control->errors[(n + 1) % FR_ERRORS] = e;
    return e;
}

/// The smallest turns between unit vectors, as rotation vectors; 0 for opposite ones.
static inline FrLanes3 fr_turn_between(FrLanes3 from, FrLanes3 to) {
    FrLanes3 axis = fr_lanes3_cross(from, to);
    FrLanes across = fr_lanes_sqrt(fr_lanes3_dot(axis, axis));
    FrLanes scale = fr_lanes_angle_over(across, fr_lanes3_dot(from, to));
    return fr_lanes3_scale(axis, fr_lanes_select(across > 1e-12f, scale, (FrLanes){0}));
}

/// The turns from headings towards sums of indicators, as rotation vectors: the angle to
/// heading + indicator, but never beyond the indicator and at most a right angle.
static inline FrLanes3 fr_indicator_turn(FrLanes3 heading, FrLanes3 indicator) {
    FrLanes along = fr_lanes3_dot(heading, indicator);
    FrLanes3 axis = fr_lanes3_cross(heading, indicator);
    FrLanes across = fr_lanes_sqrt(fr_lanes3_dot(axis, axis));
    FrLanes ahead = 1 + fr_lanes_select(along > 0, along, (FrLanes){0});
    return fr_lanes3_scale(axis, fr_lanes_angle_over(across, ahead));
}

/// The rotations of rotation vectors of at most π. Power series of sin and cos: exact to the last
/// bits of a float there, and without a root.
static inline FrLanes4 fr_rotation_of(FrLanes3 e) {
    FrLanes x = 0.25f * fr_lanes3_dot(e, e);
    FrLanes square = x * x; // in pairs, so that no term waits for all others
    FrLanes s = (1 - x * (1.0f / 6)) + square * ((1.0f / 120 - x * (1.0f / 5040)) +
                                                 square * (1.0f / 362880 - x * (1.0f / 39916800)));
    FrLanes c =
        (1 - x * (1.0f / 2)) +
        square * ((1.0f / 24 - x * (1.0f / 720)) +
                  square * ((1.0f / 40320 - x * (1.0f / 3628800)) + square * (1.0f / 479001600)));
    s *= 0.5f;
    return (FrLanes4){s * e.x, s * e.y, s * e.z, c};
}
