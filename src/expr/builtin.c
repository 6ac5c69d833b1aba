#include "expr/builtin.h"

#include "frond/noise.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846
#define E 2.71828182845904523536
#define GOLDEN_RATIO 1.61803398874989484820

// Every function may return NaN or an infinity; the evaluator turns them into faults.

static double degrees_sine(double degrees) {
    // Whole quarter turns are exact.
    double turn = fr_remainder(degrees, 360);
    return turn == 0 || turn == 180 ? 0 : turn == 90 ? 1 : turn == 270 ? -1 : sin(turn * PI / 180);
}

static double smoothstep(double low, double high, double x) {
    if (!(low < high) && !(high < low)) {
        return x < low ? 0 : 1;
    }
    double u = (x - low) / (high - low);
    u = u < 0 ? 0 : u > 1 ? 1 : u;
    return u * u * (3 - 2 * u);
}

// Noise does not depend on the instance, so that neighbours agree on it. Which noise it is, is
// part of the language.
static double noise(const double *place, unsigned count) {
    const FrKey key = UINT64_C(0x46726f6e64);
    return count == 1   ? fr_noise1(key, place[0])
           : count == 2 ? fr_noise2(key, place[0], place[1])
                        : fr_noise3(key, place[0], place[1], place[2]);
}

static double least(const double *values, unsigned count) {
    double least = values[0];
    for (unsigned i = 1; i < count; i++) {
        least = values[i] < least ? values[i] : least;
    }
    return least;
}

static double greatest(const double *values, unsigned count) {
    double greatest = values[0];
    for (unsigned i = 1; i < count; i++) {
        greatest = values[i] > greatest ? values[i] : greatest;
    }
    return greatest;
}

double fr_remainder(double dividend, double divisor) {
    double rest = fmod(dividend, divisor);
    return rest != 0 && (rest < 0) != (divisor < 0) ? rest + divisor : rest;
}

// The plain functions: name, fewest and most arguments, value. FUNCTION(name, fewest, most, …)
#define FUNCTIONS(FUNCTION)                                                                        \
    FUNCTION(sin, 1, 1, sin(a[0]))                                                                 \
    FUNCTION(cos, 1, 1, cos(a[0]))                                                                 \
    FUNCTION(tan, 1, 1, tan(a[0]))                                                                 \
    FUNCTION(sind, 1, 1, degrees_sine(a[0]))                                                       \
    FUNCTION(cosd, 1, 1, degrees_sine(a[0] + 90))                                                  \
    FUNCTION(asin, 1, 1, asin(a[0]))                                                               \
    FUNCTION(acos, 1, 1, acos(a[0]))                                                               \
    FUNCTION(atan, 1, 1, atan(a[0]))                                                               \
    FUNCTION(atan2, 2, 2, atan2(a[0], a[1]))                                                       \
    FUNCTION(exp, 1, 1, exp(a[0]))                                                                 \
    FUNCTION(log, 1, 1, a[0] > 0 ? log(a[0]) : NAN)                                                \
    FUNCTION(sqrt, 1, 1, sqrt(a[0]))                                                               \
    FUNCTION(abs, 1, 1, fabs(a[0]))                                                                \
    FUNCTION(sign, 1, 1, a[0] > 0 ? 1 : a[0] < 0 ? -1 : 0)                                         \
    FUNCTION(floor, 1, 1, floor(a[0]))                                                             \
    FUNCTION(ceil, 1, 1, ceil(a[0]))                                                               \
    FUNCTION(round, 1, 1, round(a[0]))                                                             \
    FUNCTION(frac, 1, 1, a[0] - floor(a[0]))                                                       \
    FUNCTION(min, 1, FR_MOST_ARGUMENTS, least(a, count))                                           \
    FUNCTION(max, 1, FR_MOST_ARGUMENTS, greatest(a, count))                                        \
    FUNCTION(clamp, 3, 3, a[0]<a[1] ? a[1] : a[0]> a[2] ? a[2] : a[0])                             \
    FUNCTION(mix, 3, 3, a[0] + (a[1] - a[0]) * a[2])                                               \
    FUNCTION(step, 2, 2, a[1] < a[0] ? 0 : 1)                                                      \
    FUNCTION(smoothstep, 3, 3, smoothstep(a[0], a[1], a[2]))                                       \
    FUNCTION(noise, 1, 3, noise(a, count))

#define DEFINE(name, fewest, most, value)                                                          \
    static double call_##name(const double *a, unsigned count) {                                   \
        (void)count;                                                                               \
        return value;                                                                              \
    }
FUNCTIONS(DEFINE)
#undef DEFINE

const FrBuiltin fr_builtins[] = {
#define ROW(name, fewest, most, value) {#name, FR_BUILTIN_FUNCTION, fewest, most, call_##name},
    FUNCTIONS(ROW)
#undef ROW
        {"pow", FR_BUILTIN_POWER, 2, 2, NULL},
    {"mod", FR_BUILTIN_REMAINDER, 2, 2, NULL},
    {"select", FR_BUILTIN_SELECT, 3, 3, NULL},
    {"rand", FR_BUILTIN_RANDOM, 0, 1, NULL},
    {"rnd", FR_BUILTIN_RANDOM, 0, 1, NULL},
    {"gauss", FR_BUILTIN_NORMAL, 0, 1, NULL},
    {"curve", FR_BUILTIN_CURVE, 2, 2, NULL},
};

const uint32_t fr_builtin_count = sizeof fr_builtins / sizeof fr_builtins[0];

bool fr_builtin_constant(const char *name, double *value) {
    *value = strcmp(name, "pi") == 0 ? PI : strcmp(name, "e") == 0 ? E : GOLDEN_RATIO;
    return *value != GOLDEN_RATIO || strcmp(name, "phi") == 0;
}

uint32_t fr_builtin_find(const char *name) {
    for (uint32_t i = 0; i < fr_builtin_count; i++) {
        if (strcmp(fr_builtins[i].name, name) == 0) {
            return i;
        }
    }
    return FR_NONE;
}
