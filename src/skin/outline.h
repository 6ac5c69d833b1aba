// The outline of a blade as half widths along its midrib.
#pragma once

#include "frond/plant.h"

enum { FR_OUTLINE_FINE = 256 };

/// Half widths at even steps from base to tip, in parts of the blade's width.
typedef struct FrOutline {
    double left[FR_OUTLINE_FINE + 1], right[FR_OUTLINE_FINE + 1];
    double area;  ///< of the whole blade, for length and width 1
    double least; ///< half width of its base
} FrOutline;

/// `profile` FR_NONE is an ellipse.
void fr_outline_init(FrOutline *outline, const FrPlant *plant, uint32_t profile);

/// Makes the base no narrower than the petiole it stands on, of the same area.
void fr_outline_thicken(FrOutline *outline, const FrBlade *blade);

/// Cuts a blade whose margin is lobed.
void fr_outline_lobe(FrOutline *outline, const FrBlade *blade);

/// A row of a blade's mesh.
typedef struct FrOutlineRow {
    double along;       ///< 0 base to 1 tip
    double left, right; ///< ≥ 0
} FrOutlineRow;

/// Puts `segments` + 1 rows where the outline bends most and widens them all alike so that the
/// blade keeps its area.
void fr_outline_rows(const FrOutline *outline, uint32_t segments, FrOutlineRow *rows);
