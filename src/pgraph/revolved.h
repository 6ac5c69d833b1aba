/// @file revolved.h
/// A surface of revolution, cut into zones by their area: where the golden section of a Phyllotaxis
/// puts its children.
///
/// Instead of a sphere's zones, whose area goes with their height, the area 2π ∫ r ds of any
/// outline is cumulated piece by piece; within a straight piece it is a quadratic that is inverted
/// exactly.
#pragma once

#include "pgraph/params.h"

typedef struct FrRevolved FrRevolved;

typedef struct FrRevolvedPoint {
    double radius, height; ///< from the axis, along it
    double polar;          ///< angle between the axis and the surface's outer side, radians
} FrRevolvedPoint;

/// The surface of a phyllotaxis, for radius 1.
FrRevolved *fr_revolved_new(const FrPhyllotaxisParams *params);
void fr_revolved_free(FrRevolved *revolved);
/// Its area between start and end, over 2π.
double fr_revolved_area(const FrRevolved *revolved);
/// The point that has the share `before` (0 to 1) of the area before it.
FrRevolvedPoint fr_revolved_at(const FrRevolved *revolved, double before);

typedef struct FrOutlinePoint {
    double radius, height;
} FrOutlinePoint;

/// Points of an outline, never left of the axis; on a smooth curve through them if
/// wanted. Free with g_array_unref(); elements are FrOutlinePoint, at least two.
GArray *fr_outline_points(const double (*points)[2], size_t count, bool is_smooth);
