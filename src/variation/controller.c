// The delayed sense-and-react controller and the bound of its stability.
#include "variation/controller.h"

#define HALF_TURN 3.14159265358979323846
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
