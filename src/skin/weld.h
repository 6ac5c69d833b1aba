// What welding is made of. Private to skin.
#pragma once

#include "skin/patch.h"

// ---- weld_snap.c: places on the triangles of a tube ---------------------------------------------

/// The rings of a tube as they were written: a lattice of quads, each of two triangles.
typedef struct FrWeldGrid {
    FrVertex *vertices;
    uint32_t columns, rings; ///< vertices of a ring, the first of them twice
    float around;            ///< bark from the first to the last of them
    FrBox *bands;            ///< around the quads between two rings; owned
} FrWeldGrid;

/// A place on it.
typedef struct FrWeldFoot {
    float x, y; ///< columns and rings from the first
    FrVertex vertex;
} FrWeldFoot;

void fr_weld_grid_init(FrWeldGrid *grid, FrVertex *vertices, uint32_t columns, uint32_t rings);
void fr_weld_grid_clear(FrWeldGrid *grid);
/// The vertex of a column, which may be less than 0 or go around more than once: bark goes on.
FrVertex fr_weld_grid_vertex(const FrWeldGrid *grid, int32_t column, uint32_t ring);
/// The place nearest to a point.
FrWeldFoot fr_weld_snap(const FrWeldGrid *grid, const float point[3]);

// ---- weld_strip.c: between two rings -----------------------------------------------------------

/// A point of a ring of points, where it is and where the surface unrolled has it.
typedef struct FrWeldPoint {
    vec3s at;
    float x, y;
} FrWeldPoint;

/// Points of both rings of a strip at most.
enum { FR_WELD_MOST = 192 };

/// Fills what is between a ring and one within it, both counter-clockwise, with triangles. A corner
/// is an index into `outer`, or of `inner` with `outer_count` added. Answers how many triangles, 0
/// if there is no way without turning one over.
uint32_t fr_weld_strip(const FrWeldPoint *outer, uint32_t outer_count, const FrWeldPoint *inner,
                       uint32_t inner_count, uint32_t (*triangles)[3]);
