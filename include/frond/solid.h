/// @file solid.h
/// What a surface of triangles encloses, as cells of a grid.
#pragma once

#include "frond/vector.h"

/// Cells of a grid: cell (i, j, k) begins at origin + (i, j, k) · cell.
typedef struct FrCellGrid {
    double origin[3];
    double cell;       ///< m, > 0
    int64_t counts[3]; ///< cells along each axis, each at most 2³¹
    int64_t first[3];  ///< cells before these are left out
} FrCellGrid;

/// Cells `first` … `last` along x of a row.
typedef void (*FrCellRunFn)(void *data, int64_t first, int64_t last, int64_t y, int64_t z);

/// Calls `run` for all cells whose middle the surface winds around, by rising z, y and x. Rows in
/// which the surface is open enclose nothing. `indices` are three a triangle; which way they turn
/// has no say as long as they turn alike. Cost: triangles and rows they are seen in along x.
FR_API void fr_solid_cells(const vec3s *positions, const uint32_t *indices, uint32_t index_count,
                           const FrCellGrid *grid, FrCellRunFn run, void *data);

/// A place in double precision.
typedef struct FrPoint3 {
    double at[3];
} FrPoint3;

/// Sets is_held[i] where the surface winds around points[i]; leaves the others as they are. Rows
/// and turns as for cells. Cost: the points in the surface's box, sorted, and triangles times the
/// points whose y they span.
FR_API void fr_solid_holds(const vec3s *positions, const uint32_t *indices, uint32_t index_count,
                           const FrPoint3 *points, uint32_t count, bool *is_held);
