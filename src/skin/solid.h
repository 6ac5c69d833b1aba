// One watertight solid of many closed surfaces that stand in one another. Private to skin.
#pragma once

#include "frond/nurbs_skin.h"
#include "skin/closed.h"

/// Whose solid is wanted.
typedef struct FrSolidAsk {
    const FrNurbsParams *params; ///< cells are `voxel` wide
    const char *plant;           ///< its name
    FrSpan span;                 ///< where the settings are written
    const FrContext *context;
} FrSolidAsk;

/// Replaces a mesh by the outer surface of all that is inside one of its closed surfaces, on a
/// lattice: every edge has two triangles. Open surfaces are left out with a warning.
/// FR_ERR_LIMIT if it would have too many triangles, FR_ERR_DOCUMENT if nothing would be left of
/// what there is.
FR_MUST_USE FrStatus fr_solid_of(FrMesh **mesh, const FrSolidAsk *ask);

// ---- solid_lines.c: where lines of the lattice go into the solid and out of it -----------------

/// The directions of lines: along x, y, z and the diagonals of faces and cells.
enum { FR_SOLID_WAYS = 7 };

/// Where a line passes the surface.
typedef struct FrCrossing {
    int32_t line[2]; ///< which line of its way
    double at;       ///< along it, in cells
    bool goes_in;
} FrCrossing;

typedef struct FrSolidLines {
    FrCrossing *crossings; ///< by lines, then along them; in and out by turns; owned
    size_t count;
} FrSolidLines;

/// Steps of a way in the lattice: 0 or 1 along x, y and z.
extern const int fr_solid_steps[FR_SOLID_WAYS][3];
/// The line of a way that passes a point of the lattice, and where on it the point is.
void fr_solid_line(int way, const int32_t point[3], int32_t line[2], int32_t *at);
/// Finds all crossings of a way. `corners` are of triangles, three each, in cells.
FrSolidLines fr_solid_lines(int way, const double (*corners)[3], size_t triangles);
/// Crossings of one line, and how many.
const FrCrossing *fr_solid_find(const FrSolidLines *lines, const int32_t line[2], size_t *count);
