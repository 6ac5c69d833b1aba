// Surfaces of single patches whose control points are places of the turtle: @PS clears a patch and
// chooses its basis, @PC sets a control point, @PD draws (bicubic Bézier, uniform B-spline or
// cardinal patches; Foley et al. 1990, section 11.3).
#include "lsystem/build.h"

#include <math.h>

#define MOST_PATCHES 1000
#define MOST_QUADS 32

static FrLpatch *find_patch(FrLturtle *turtle, double id) {
    if (!(id >= 0 && id < 1e6)) {
        return NULL;
    }
    for (guint i = 0; i < turtle->patches->len; i++) {
        FrLpatch *patch = &g_array_index(turtle->patches, FrLpatch, i);
        if (patch->id == (int)id) {
            return patch;
        }
    }
    FrLpatch patch = {.id = (int)id, .basis = 1};
    if (turtle->patches->len == MOST_PATCHES) {
        return NULL;
    }
    g_array_append_val(turtle->patches, patch);
    return &g_array_index(turtle->patches, FrLpatch, turtle->patches->len - 1);
}

/// Weights of four control points at t.
static void weights(int basis, double t, double w[4]) {
    double u = 1 - t, t2 = t * t, t3 = t2 * t;
    if (basis == 2) {
        w[0] = u * u * u / 6;
        w[1] = (3 * t3 - 6 * t2 + 4) / 6;
        w[2] = (-3 * t3 + 3 * t2 + 3 * t + 1) / 6;
        w[3] = t3 / 6;
    } else if (basis == 3) {
        w[0] = (-t3 + 2 * t2 - t) / 2;
        w[1] = (3 * t3 - 5 * t2 + 2) / 2;
        w[2] = (-3 * t3 + 4 * t2 + t) / 2;
        w[3] = (t3 - t2) / 2;
    } else {
        w[0] = u * u * u;
        w[1] = 3 * t * u * u;
        w[2] = 3 * t2 * u;
        w[3] = t3;
    }
}

static void point_at(const FrLpatch *patch, double s, double t, double out[3]) {
    double a[4], b[4];
    weights(patch->basis, s, a);
    weights(patch->basis, t, b);
    out[0] = out[1] = out[2] = 0;
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            for (int k = 0; k < 3; k++) {
                out[k] += a[row] * b[column] * patch->points[4 * row + column][k];
            }
        }
    }
}

static void draw(FrLturtle *turtle, const FrLpatch *patch, uint32_t s, uint32_t t) {
    uint32_t count = 6 * s * t, filled = 0;
    double(*corners)[3] = g_malloc_n(count, sizeof *corners);
    for (uint32_t i = 0; i < s; i++) {
        for (uint32_t j = 0; j < t; j++) {
            static const int order[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
            for (int c = 0; c < 6; c++, filled++) {
                point_at(patch, (double)(i + (uint32_t)order[c][0]) / s,
                         (double)(j + (uint32_t)order[c][1]) / t, corners[filled]);
            }
        }
    }
    fr_lbuilder_triangles(turtle->builder, &turtle->pose, (const double(*)[3])corners, count);
    turtle->status = MAX(turtle->status, turtle->builder->status);
    g_free(corners);
}

void fr_lturtle_patch(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpatch *patch = find_patch(turtle, fr_lturtle_value(module, 0, 0));
    if (patch == NULL || turtle->builder == NULL) {
        return;
    }
    double first = fr_lturtle_value(module, 1, symbol == 'D' ? 4 : symbol == 'S' ? 1 : 0);
    double second = fr_lturtle_value(module, 2, symbol == 'D' ? first : 0);
    if (symbol == 'S') {
        *patch = (FrLpatch){.id = patch->id, .basis = first == 2 ? 2 : first == 3 ? 3 : 1};
    } else if (symbol == 'C' && first >= 0 && first < 4 && second >= 0 && second < 4) {
        unsigned at = 4 * (unsigned)first + (unsigned)second;
        memcpy(patch->points[at], turtle->pose.position, sizeof patch->points[at]);
        patch->is_set |= (uint16_t)(1U << at);
    } else if (symbol == 'D' && patch->is_set == 0xFFFF) {
        draw(turtle, patch, (uint32_t)CLAMP(first, 1, MOST_QUADS),
             (uint32_t)CLAMP(second, 1, MOST_QUADS));
    }
}
