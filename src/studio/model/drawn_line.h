/// @file drawn_line.h
/// Lines drawn by hand: a few points instead of many.
#pragma once

#include <glib.h>

/// The points (double[3]) of a line without those that are nearer than `tolerance` to the line
/// through the others. Free with g_array_unref().
GArray *studio_line_simplify(const GArray *points, double tolerance);
/// From points (radius, height: double[2]) drawn along one side of an axis to an outline that an
/// envelope may be: none below the ground, from the lower end to the upper one. Free with
/// g_array_unref().
GArray *studio_line_to_outline(const GArray *points, double tolerance);
