// What the parts of leaves as surfaces share.
#pragma once

#include "skin/nurbs.h"

#include "skin/blade.h"
#include "skin/outline.h"

/// Where a row of a half blade meets its margin.
typedef struct FrNurbsMargin {
    double at[3];
    double along; ///< of the outline there
} FrNurbsMargin;

/// Rows of control points across a blade.
typedef struct FrNurbsRows {
    FrOutlineRow *rows;          ///< from where on the midrib, and how wide; owned
    double *at;                  ///< parameters along the blade, 0 to 1; owned
    FrNurbsMargin (*margins)[2]; ///< left and right; owned; NULL: straight across
    uint32_t count;
} FrNurbsRows;

void fr_nurbs_rows_clear(FrNurbsRows *rows);
/// Rows with the corners of all teeth, of a blade with these rows.
void fr_nurbs_toothed(const FrBladeForm *form, const FrOutlineRow *base, uint32_t base_count,
                      FrNurbsRows *rows);
/// A tube along a path, closed if blades are solids.
void fr_nurbs_stalk(GArray *forms, FrNurbsPath *path, const FrNurbsParams *params);
/// Petiole and halves of a blade that is no compound leaf.
void fr_nurbs_blade(GArray *forms, const FrPlant *plant, const FrBlade *blade,
                    const FrNurbsParams *params);
/// Petiole, rachis and leaflets.
void fr_nurbs_compound(GArray *forms, const FrPlant *plant, const FrBlade *blade,
                       const FrNurbsParams *params);
