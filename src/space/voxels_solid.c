// Obstacles into voxels: every cell that a triangle touches, by the separating axes of a triangle
// and a box (Akenine-Möller 2001, Fast 3D Triangle-Box Overlap Testing). Bricks that a triangle
// does not touch are skipped as a whole.
#include "frond/voxels.h"

#include <math.h>

/// A triangle in cells.
typedef struct Triangle {
    double corner[3][3];
    double low[3], high[3];
} Triangle;

/// True if `axis` separates the triangle from a cube of half width `half` about `middle`.
static bool separates(const Triangle *triangle, const double axis[3], const double middle[3],
                      double half) {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < 3; i++) {
        double along = 0;
        for (int k = 0; k < 3; k++) {
            along += axis[k] * (triangle->corner[i][k] - middle[k]);
        }
        low = fmin(low, along);
        high = fmax(high, along);
    }
    double reach = half * (fabs(axis[0]) + fabs(axis[1]) + fabs(axis[2]));
    return low > reach || high < -reach;
}

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static bool touches(const Triangle *triangle, const double middle[3], double half) {
    double edge[3][3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            edge[i][k] = triangle->corner[(i + 1) % 3][k] - triangle->corner[i][k];
        }
    }
    for (int k = 0; k < 3; k++) {
        double axis[3] = {k == 0, k == 1, k == 2};
        if (separates(triangle, axis, middle, half)) {
            return false;
        }
        for (int i = 0; i < 3; i++) {
            double both[3];
            cross(axis, edge[i], both);
            if (separates(triangle, both, middle, half)) {
                return false;
            }
        }
    }
    double normal[3];
    cross(edge[0], edge[1], normal);
    return !separates(triangle, normal, middle, half);
}

// A little more than half a cell, so that rounding leaves no gaps.
#define HALF (0.5 + 1e-6)

static void fill_brick(FrVoxels *voxels, const Triangle *triangle, const int brick[3],
                       bool is_ground) {
    FrBrick *into = NULL;
    for (int z = 0; z < 8; z++) {
        for (int y = 0; y < 8; y++) {
            for (int x = 0; x < 8; x++) {
                int at[3] = {brick[0] * 8 + x, brick[1] * 8 + y, brick[2] * 8 + z};
                double middle[3] = {at[0] + 0.5, at[1] + 0.5, at[2] + 0.5};
                bool is_beside = false;
                for (int k = 0; k < 3; k++) {
                    is_beside |=
                        triangle->high[k] < middle[k] - HALF || triangle->low[k] > middle[k] + HALF;
                }
                if (is_beside || !touches(triangle, middle, HALF)) {
                    continue;
                }
                if (into == NULL) {
                    FrCell cell = {{(int16_t)at[0], (int16_t)at[1], (int16_t)at[2]}};
                    into = fr_voxels_make(voxels, cell);
                }
                uint64_t bit = UINT64_C(1) << (y * 8 + x);
                bool was_solid = into->solid[z] & bit;
                into->taken[z] |= bit;
                into->solid[z] |= bit;
                if (!is_ground) {
                    into->ground[z] &= ~bit;
                } else if (!was_solid) {
                    into->ground[z] |= bit;
                }
            }
        }
    }
}

static void add_triangle(FrVoxels *voxels, const Triangle *triangle, bool is_ground) {
    int from[3], to[3];
    for (int k = 0; k < 3; k++) {
        double low = floor((triangle->low[k] - 0.001) / 8);
        double high = floor((triangle->high[k] + 0.001) / 8);
        if (!(high >= 0) || !(low < FR_VOXELS_WIDTH / 8)) {
            return;
        }
        from[k] = (int)fmax(low, 0);
        to[k] = (int)fmin(high, FR_VOXELS_WIDTH / 8 - 1);
    }
    int brick[3];
    for (brick[2] = from[2]; brick[2] <= to[2]; brick[2]++) {
        for (brick[1] = from[1]; brick[1] <= to[1]; brick[1]++) {
            for (brick[0] = from[0]; brick[0] <= to[0]; brick[0]++) {
                double middle[3];
                for (int k = 0; k < 3; k++) {
                    middle[k] = brick[k] * 8 + 4;
                }
                if (touches(triangle, middle, 4 + 1e-3)) {
                    fill_brick(voxels, triangle, brick, is_ground);
                }
            }
        }
    }
}

void fr_voxels_add_triangles(FrVoxels *voxels, const vec3s *positions, const uint32_t *indices,
                             uint32_t index_count, bool is_ground) {
    for (uint32_t i = 0; i + 2 < index_count; i += 3) {
        Triangle triangle;
        for (int k = 0; k < 3; k++) {
            triangle.low[k] = INFINITY;
            triangle.high[k] = -INFINITY;
            for (int corner = 0; corner < 3; corner++) {
                double at = (double)positions[indices[i + (uint32_t)corner]].raw[k];
                triangle.corner[corner][k] = (at - voxels->origin[k]) / voxels->cell;
                triangle.low[k] = fmin(triangle.low[k], triangle.corner[corner][k]);
                triangle.high[k] = fmax(triangle.high[k], triangle.corner[corner][k]);
            }
        }
        add_triangle(voxels, &triangle, is_ground);
    }
}
