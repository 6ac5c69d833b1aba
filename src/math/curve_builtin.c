// The built-in curves: plain shapes, and crown shapes by name.
// Crowns after: Weber, Penn. Creation and rendering of realistic trees. SIGGRAPH 1995. The paper's
// ratio is 1 at the base of the crown and 0 at its top; here x runs the other way, r = 1 - x. The
// conical crown is 0.2 + 0.8 r as the paper has it; other programs differ.
#include "frond/curve.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

// Rounded shapes are given by 17 points of their formula: the worst error between them is 1e-3.
#define SAMPLES 17

static double bell(double x) {
    return sin(PI * x) * sin(PI * x);
}

static double dome(double x) {
    return 4 * x * (1 - x);
}

static double s_shape(double x) {
    return x * x * (3 - 2 * x);
}

static double spherical(double x) {
    return 0.2 + 0.8 * sin(PI * (1 - x));
}

static double hemispherical(double x) {
    return 0.2 + 0.8 * sin(0.5 * PI * (1 - x));
}

// A shape of straight lines through up to three points, or sampled from a formula.
typedef struct Builtin {
    double (*formula)(double x);
    size_t count;
    double points[3][2];
} Builtin;

static const Builtin builtins[] = {
    {.count = 2, .points = {{0, 1}, {1, 1}}},
    {.count = 2, .points = {{0, 0}, {1, 1}}},
    {.count = 2, .points = {{0, 1}, {1, 0}}},
    {.formula = bell},
    {.formula = dome},
    {.formula = s_shape},
    {.count = 2, .points = {{0, 1}, {1, 0.2}}},
    {.formula = spherical},
    {.formula = hemispherical},
    {.count = 2, .points = {{0, 1}, {1, 1}}},
    {.count = 2, .points = {{0, 1}, {1, 0.5}}},
    {.count = 3, .points = {{0, 0}, {0.3, 1}, {1, 0}}},
    {.count = 2, .points = {{0, 0.2}, {1, 1}}},
    {.count = 3, .points = {{0, 0.5}, {0.3, 1}, {1, 0.5}}},
};

static const char *const names[] = {
    "flat",
    "ramp",
    "fall",
    "bell",
    "dome",
    "s",
    "conical",
    "spherical",
    "hemispherical",
    "cylindrical",
    "tapered-cylindrical",
    "flame",
    "inverse-conical",
    "tend-flame",
};

_Static_assert(G_N_ELEMENTS(names) == G_N_ELEMENTS(builtins), "a name for every built-in curve");

static bool same_name(const char *a, const char *b) {
    for (; *a != '\0' && *b != '\0'; a++, b++) {
        if (*a != *b && !(*a == '_' && *b == '-')) {
            return false;
        }
    }
    return *a == *b;
}

FrCurve *fr_curve_builtin(const char *name) {
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        if (!same_name(name, names[i])) {
            continue;
        }
        const Builtin *builtin = &builtins[i];
        if (builtin->formula == NULL) {
            return fr_curve_new(FR_CURVE_LINEAR, builtin->points, builtin->count);
        }
        double points[SAMPLES][2];
        for (int k = 0; k < SAMPLES; k++) {
            points[k][0] = (double)k / (SAMPLES - 1);
            points[k][1] = builtin->formula(points[k][0]);
        }
        return fr_curve_new(FR_CURVE_SMOOTH, points, SAMPLES);
    }
    return NULL;
}

const char *const *fr_curve_builtin_names(size_t *count) {
    *count = G_N_ELEMENTS(names);
    return names;
}
