// The delayed sense-and-react controller and the bound of its stability.
#include "variation/controller.h"

#include <cglm/struct.h>

#define HALF_TURN 3.14159265358979323846
// Errors beyond half a turn mean nothing.
#define LARGEST_ERROR 3.1f

enum { PURPOSE_TURN = 0x76617279 };

/// On the unit circle λ = exp(iw) the characteristic equation reads (λ − 1)(1 + γ/λ) = −K λ^−d:
/// where the arguments of both sides agree, errors swing for ever with the gain that the moduli
/// give. This is the argument but for its constant; it rises with w, for its derivative is at least
/// d + 1/2 − γ/(1 + γ).
static double phase(uint32_t delay, double proprioception, double w) {
    return (delay + 0.5) * w - atan2(proprioception * sin(w), 1 + proprioception * cos(w));
}

/// The gain that swings for ever with the frequency at which the phase is `wanted`.
static double swinging_gain(uint32_t delay, double proprioception, double wanted) {
    double low = 0, high = HALF_TURN;
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        bool is_below = phase(delay, proprioception, middle) < wanted;
        low = is_below ? middle : low;
        high = is_below ? high : middle;
    }
    double real = 1 + proprioception * cos(high), imaginary = proprioception * sin(high);
    return 2 * sin(0.5 * high) * sqrt(real * real + imaginary * imaginary);
}

double fr_vary_gain_limit(uint32_t delay, double proprioception) {
    double least = 2;
    for (uint32_t k = 0; 2 * k <= delay; k++) {
        double wanted = (0.5 + 2 * k) * HALF_TURN;
        least = fmin(least, swinging_gain(delay, proprioception, wanted));
    }
    return least;
}

double fr_vary_calm_limit(uint32_t delay) {
    return delay == 0 ? 1 : pow(delay, delay) / pow(delay + 1.0, delay + 1.0);
}

FrController fr_controller_of(const FrVaryParams *params) {
    FR_ASSERT(params->delay >= 0 && params->delay <= FR_DELAY_MAX);
    uint32_t delay = (uint32_t)params->delay;
    double gain = params->feedback * fr_vary_gain_limit(delay, params->proprioception);
    double innovation = params->scatter * sqrt(1 - params->persistence * params->persistence);
    return (FrController){.gain = (float)gain,
                          .proprioception = (float)params->proprioception,
                          .late = (float)(1 - params->anticipation),
                          .persistence = (float)params->persistence,
                          .innovation = (float)innovation,
                          .start = (float)params->scatter,
                          .delay = delay};
}

/// A deviate of mean 0 and variance 1 from 64 random bits: the sum of four uniform ones. What is
/// random in a joint is filtered by the next ones, so no more is needed, and it costs no logarithm.
static float deviate(uint64_t bits) {
    int32_t sum = (int32_t)(bits & 0xffff) + (int32_t)(bits >> 16 & 0xffff) +
                  (int32_t)(bits >> 32 & 0xffff) + (int32_t)(bits >> 48);
    return (float)(sum - 131070) * 2.6429142e-5f; // √3 / 65536
}

vec3s fr_control_next(const FrController *controller, FrControl *control, versors frame,
                      vec3s drive) {
    uint32_t n = control->joint;
    vec3s last = control->errors[n % FR_ERRORS];
    vec3s before = control->errors[(n + FR_ERRORS - 1) % FR_ERRORS];
    vec3s sensed = control->errors[(n + FR_ERRORS - controller->delay) % FR_ERRORS];
    float spread = n == 0 ? controller->start : controller->innovation;
    if (spread > 0) {
        float u = spread * deviate(fr_random_bits(control->key, PURPOSE_TURN, 2 * n));
        float v = spread * deviate(fr_random_bits(control->key, PURPOSE_TURN, 2 * n + 1));
        vec3s left = fr_frame_left(frame), up = fr_frame_up(frame);
        for (int k = 0; k < 3; k++) {
            control->random.raw[k] = controller->persistence * control->random.raw[k] +
                                     (u * left.raw[k] + v * up.raw[k]);
        }
    }
    vec3s e;
    for (int k = 0; k < 3; k++) {
        float turn = last.raw[k] - before.raw[k];
        e.raw[k] =
            last.raw[k] + ((control->random.raw[k] + drive.raw[k]) -
                           (controller->gain * sensed.raw[k] + controller->proprioception * turn));
    }
    float square = e.x * e.x + (e.y * e.y + e.z * e.z);
    if (square > LARGEST_ERROR * LARGEST_ERROR) {
        e = glms_vec3_scale(e, LARGEST_ERROR / sqrtf(square));
    }
    control->joint = n + 1;
    control->errors[(n + 1) % FR_ERRORS] = e;
    return e;
}

vec3s fr_turn_between(vec3s from, vec3s to) {
    vec3s axis = glms_vec3_cross(from, to);
    float across = glms_vec3_norm(axis);
    if (!(across > 1e-12f)) {
        return (vec3s){{0, 0, 0}};
    }
    return glms_vec3_scale(axis, atan2f(across, glms_vec3_dot(from, to)) / across);
}

vec3s fr_indicator_turn(vec3s heading, vec3s indicator) {
    float along = glms_vec3_dot(heading, indicator);
    vec3s axis = glms_vec3_cross(heading, indicator);
    float across = glms_vec3_norm(axis);
    if (!(across > 1e-12f)) {
        return (vec3s){{0, 0, 0}};
    }
    float angle = atan2f(across, 1 + fmaxf(along, 0));
    return glms_vec3_scale(axis, angle / across);
}
