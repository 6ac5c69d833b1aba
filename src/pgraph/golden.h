/// @file golden.h
/// Placing children on a section of a sphere by the golden section.
///
/// After: Lintermann, Deussen 1999, "Golden Section Placement on a Sphere", corrected: the height
/// of a zone is its area over 2πR, not over 2πR², and the angle of a child is the polar angle
/// arccos, not the elevation arcsin. Each child takes as much of the section's area as it needs;
/// with the azimuth growing by the golden angle no two get near.
#pragma once

#include "frond/api.h"

/// 2π over the golden ratio.
#define FR_GOLDEN_ANGLE 3.8832220774509327

/// Polar angle of a child with `before` of the section's area before it, 0 to 1.
double fr_golden_polar(double opening, double closing, double before);
/// Part of the area before child i of n equal ones: in the middle of its zone, or at its end.
static inline double fr_golden_before(uint32_t i, uint32_t n, bool is_end) {
    return ((double)i + (is_end ? 1.0 : 0.5)) / (double)n;
}
/// Room of a child of size `scale` among others of mean squared size `mean`.
static inline double fr_golden_area(double scale, double mean, double influence) {
    return (1.0 - influence) * mean + influence * scale * scale;
}
/// Radius of the surface whose section holds n children of this area. `section` is the section's
/// area over 2π where the radius is 1; on a sphere cos(opening) − cos(closing).
double fr_golden_radius(double n, double area, double section);
/// The same for round children of this radius that just touch their nearest.
double fr_golden_touching_radius(double n, double radius, double section);
