/// @file vein_grid.h
/// Points in the plane sorted into square cells, for queries by distance.
#pragma once

#include <glib.h>
#include <stdint.h>

typedef struct FrVeinGrid {
    float cell, left;
    int columns, rows;
    int32_t *first; ///< per cell, −1 if empty
    GArray *points; ///< FrGridPoint, in the order added
} FrVeinGrid;

typedef struct FrGridPoint {
    float x, y;
    int32_t next; ///< in the same cell
} FrGridPoint;

/// Covers x from −half_width to half_width and y from 0 to 1; points beyond go to the rim's cells.
void fr_vein_grid_init(FrVeinGrid *grid, float half_width, float cell);
void fr_vein_grid_clear(FrVeinGrid *grid);
void fr_vein_grid_add(FrVeinGrid *grid, float x, float y);
/// Calls `visit` for every point within `radius`.
void fr_vein_grid_visit(const FrVeinGrid *grid, float x, float y, float radius,
                        void (*visit)(void *data, uint32_t point, float distance), void *data);
/// The nearest point within `radius`, the first added among equals; UINT32_MAX if there is none.
uint32_t fr_vein_grid_nearest(const FrVeinGrid *grid, float x, float y, float radius);
