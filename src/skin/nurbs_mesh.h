// Triangles of a rational skin: what nurbs_mesh.c plans and its writers write.
#pragma once

#include "skin/mesh.h"
#include "skin/nurbs.h"
#include "skin/sweep.h"

/// Sides of a surface that are shrunk to a point.
enum { FR_SHRUNK_V0 = 1, FR_SHRUNK_V1 = 2, FR_SHRUNK_U0 = 4, FR_SHRUNK_U1 = 8 };

/// The grid of a surface and its place in the mesh.
typedef struct FrNurbsTile {
    const FrNurbsPiece *piece;
    uint64_t steps; ///< where its steps along u, then v, are kept
    uint32_t points_u, points_v;
    uint32_t vertices, triangles;       ///< 0: written with the tile before it
    uint64_t first_vertex, first_index; ///< in its part
    uint32_t slot;                      ///< material + 1; of organs as many slots later
    uint8_t shrunk;
    bool is_thick; ///< the right half of a blade that is written as a solid, with the left one
    FrBox box;
} FrNurbsTile;

/// Scratch of a worker, grown as needed.
typedef struct FrNurbsGrid {
    double *u, *v;
    double (*points)[3], (*normals)[3], (*blended)[2];
    uint32_t parameters;
    size_t room;
} FrNurbsGrid;

typedef struct FrNurbsMeshing {
    const FrPlant *plant;
    const FrNurbsParams *params;
    FrNurbsSkin *skin;
    FrNurbsTile *tiles; ///< by piece
    uint64_t *shells;   ///< the first piece of each shell, and an end
    uint64_t shell_count;
    uint8_t *steps;
    FrNurbsFineness fineness;
    FrUpAxis up;
    float (*bark_tiles)[2]; ///< by slot: width and height of a tile of bark
    uint32_t slots;         ///< materials + 1
    FrNurbsGrid *grids;     ///< by worker
    FrMesh *mesh;
    uint32_t *part_of; ///< by slot of wood, then of organs; FR_NONE
} FrNurbsMeshing;

/// Fills the grid with the tile's points, normals and picture coordinates.
void fr_nurbs_fill(const FrNurbsMeshing *meshing, const FrNurbsTile *tile, FrNurbsGrid *grid);
/// True if a corner of the grid's cell is a corner of a triangle that has an area.
bool fr_nurbs_corners(const FrNurbsTile *tile, uint32_t i, uint32_t j, bool is_upper,
                      uint32_t corners[3][2]);
void fr_nurbs_put_vertex(FrNurbsMeshing *meshing, FrNurbsTile *tile, FrVertex *vertex,
                         const double at[3], const double normal[3], float u, float v);
/// Writes the tile of one surface.
void fr_nurbs_write_tile(FrNurbsMeshing *meshing, FrNurbsTile *tile, FrNurbsGrid *grid);

// ---- nurbs_thick.c -----------------------------------------------------------------------------

/// Counts the vertices and triangles of a blade of that thickness, right half first.
void fr_nurbs_count_thick(FrNurbsTile halves[2]);
void fr_nurbs_write_thick(FrNurbsMeshing *meshing, FrNurbsTile halves[2], FrNurbsGrid *grid);
