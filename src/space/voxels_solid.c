// Obstacles into voxels: every cell that a triangle touches, by the separating axes of a triangle
// and a box (Akenine-Möller 2001, Fast 3D Triangle-Box Overlap Testing). Bricks that a triangle
// does not touch are skipped as a whole.
#include "frond/voxels.h"

#include <math.h>

enum { AXES = 13 }; // 3 of the box, 9 across its and the triangle's edges, the normal

/// A triangle in cells, by its shadow on every axis that may separate it from a box.
typedef struct Triangle {
    double axis[AXES][3];
    double low[AXES], high[AXES]; ///< of its shadow
    double reach[AXES];           ///< half the shadow of a box, over half its width
} Triangle;

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/// The shadows of a triangle on its axes.
static void cast(Triangle *triangle, const double corner[3][3]) {
    for (int k = 0; k < AXES; k++) {
        const double *axis = triangle->axis[k];
        triangle->low[k] = INFINITY;
        triangle->high[k] = -INFINITY;
        triangle->reach[k] = fabs(axis[0]) + fabs(axis[1]) + fabs(axis[2]);
        for (int i = 0; i < 3; i++) {
            double along = axis[0] * corner[i][0] + axis[1] * corner[i][1] + axis[2] * corner[i][2];
            triangle->low[k] = MIN(triangle->low[k], along);
            triangle->high[k] = MAX(triangle->high[k], along);
        }
    }
}

static Triangle triangle_of(const double corner[3][3]) {
    Triangle triangle;
    double edge[3][3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            edge[i][k] = corner[(i + 1) % 3][k] - corner[i][k];
        }
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            triangle.axis[k][i] = k == i;
        }
    }
    cross(edge[0], edge[1], triangle.axis[3]);
    for (int k = 0; k < 9; k++) {
        cross(triangle.axis[k / 3], edge[k % 3], triangle.axis[4 + k]);
    }
    cast(&triangle, corner);
    return triangle;
}

/// True if a cube of half width `half` about `middle` touches the triangle: no axis separates them.
static bool touches(const Triangle *triangle, const double middle[3], double half) {
    for (int k = 0; k < AXES; k++) {
        const double *axis = triangle->axis[k];
        double at = axis[0] * middle[0] + axis[1] * middle[1] + axis[2] * middle[2];
        double reach = half * triangle->reach[k];
        if (triangle->low[k] - at > reach || triangle->high[k] - at < -reach) {
            return false;
        }
    }
    return true;
}

// A little more than half a cell, so that rounding leaves no gaps.
#define HALF (0.5 + 1e-6)

/// False if there is no memory.
static bool fill_brick(FrVoxels *voxels, const Triangle *triangle, const int brick[3],
                       bool is_ground) {
    FrBrick *into = NULL;
    for (int z = 0; z < 8; z++) {
        for (int y = 0; y < 8; y++) {
            for (int x = 0; x < 8; x++) {
                int at[3] = {brick[0] * 8 + x, brick[1] * 8 + y, brick[2] * 8 + z};
                double middle[3] = {at[0] + 0.5, at[1] + 0.5, at[2] + 0.5};
                if (!touches(triangle, middle, HALF)) {
                    continue;
                }
                if (into == NULL) {
                    FrCell cell = {{(int16_t)at[0], (int16_t)at[1], (int16_t)at[2]}};
                    into = fr_voxels_make(voxels, cell);
                    if (into == NULL) {
                        return false;
                    }
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
    return true;
}

/// The bricks that a triangle may touch, none of them beyond `end`; false if there are none.
static bool bricks_of(const FrVoxels *voxels, const Triangle *triangle, const double end[3],
                      int from[3], int to[3]) {
    enum { MARGIN = 8 }; // cells beyond the end that a tip looks at
    for (int k = 0; k < 3; k++) {
        double low = floor((triangle->low[k] - 0.001) / 8);
        double high = floor((triangle->high[k] + 0.001) / 8);
        double most = ((end[k] - voxels->origin[k]) / voxels->cell + MARGIN) / 8;
        most = fmin(floor(most), FR_VOXELS_WIDTH / 8 - 1);
        if (!(high >= 0) || !(low <= most)) {
            return false;
        }
        from[k] = (int)fmax(low, 0);
        to[k] = (int)fmin(high, most);
    }
    return true;
}

static FrStatus add_triangle(FrVoxels *voxels, const Triangle *triangle,
                             const FrVoxelSurface *surface, const double end[3],
                             const FrContext *context) {
    int from[3], to[3];
    if (!bricks_of(voxels, triangle, end, from, to)) {
        return FR_OK;
    }
    int brick[3];
    for (brick[2] = from[2]; brick[2] <= to[2]; brick[2]++) {
        for (brick[1] = from[1]; brick[1] <= to[1]; brick[1]++) {
            FrStatus status = fr_voxels_check(voxels, 0, surface->span, context);
            if (status != FR_OK) {
                return status;
            }
            for (brick[0] = from[0]; brick[0] <= to[0]; brick[0]++) {
                double middle[3];
                for (int k = 0; k < 3; k++) {
                    middle[k] = brick[k] * 8 + 4;
                }
                if (touches(triangle, middle, 4 + 1e-3) &&
                    !fill_brick(voxels, triangle, brick, surface->is_ground)) {
                    fr_diags_add(context->diags, FR_ERROR, "out-of-memory", surface->span,
                                 "there is no memory for what is solid in the arena");
                    return FR_ERR_MACHINE;
                }
            }
        }
    }
    return FR_OK;
}

/// In cells.
static void corners_of(const FrVoxelSurface *surface, uint32_t first, const double origin[3],
                       double width, double corner[3][3]) {
    for (uint32_t c = 0; c < 3; c++) {
        for (int k = 0; k < 3; k++) {
            double at = (double)surface->positions[surface->indices[first + c]].raw[k];
            corner[c][k] = (at - origin[k]) / width;
        }
    }
}

FrStatus fr_voxels_add_triangles(FrVoxels *voxels, const FrVoxelSurface *surface,
                                 const double end[3], const FrContext *context) {
    FrStatus status = FR_OK;
    for (uint32_t i = 0; i + 2 < surface->index_count && status == FR_OK; i += 3) {
        double corner[3][3];
        corners_of(surface, i, voxels->origin, voxels->cell, corner);
        Triangle triangle = triangle_of((const double(*)[3])corner);
        status = add_triangle(voxels, &triangle, surface, end, context);
    }
    return status;
}

bool fr_voxels_touches(const FrVoxelSurface *surface, const double origin[3], double width,
                       FrCell cell) {
    double middle[3] = {cell.at[0] + 0.5, cell.at[1] + 0.5, cell.at[2] + 0.5};
    bool is_touched = false;
    for (uint32_t i = 0; i + 2 < surface->index_count && !is_touched; i += 3) {
        double corner[3][3];
        corners_of(surface, i, origin, width, corner);
        Triangle triangle = triangle_of((const double(*)[3])corner);
        is_touched = touches(&triangle, middle, HALF);
    }
    return is_touched;
}
