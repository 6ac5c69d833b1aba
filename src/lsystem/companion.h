/// @file lsystem/companion.h
/// Files that a view names: functions, contours, curves, surfaces.
#pragma once

#include "lsystem/view.h"

/// Reads at most `most` numbers from a line, whatever words stand between; returns how many.
int fr_lcompanion_numbers(const char *line, double *numbers, int most);
/// One function (.func) or a set of them (.fset); appends FrLspline. False if there is none.
/// `samples` is for files that do not say how many.
bool fr_lcompanion_functions(FrSource *source, GArray *functions, int samples);
/// A contour (.con), or with samples > 0 a curve; appends FrLcontour.
bool fr_lcompanion_contour(FrSource *source, GArray *contours, int id, int samples);
/// The value at x of the function with these control points, as cpfg finds it.
double fr_lspline_value(const double (*points)[3], uint32_t count, double x);
/// The point of a curve at its parameter t, from 0 to 1.
void fr_lcurve_point(const FrLcontour *curve, double t, double out[3]);
/// Bézier patches (.s); appends FrLsurface. `s` and `t`: quads a side, 0: as the file says.
bool fr_lcompanion_patches(FrSource *source, GArray *surfaces, char symbol, double size, int s,
                           int t);
/// The cross-section of a surface half way along its heading, as points (left, −up) of a radius of
/// 1 where the surface is as wide as a line; NULL if there are fewer than 3. Free with g_free().
double (*fr_lcompanion_section(const FrLsurface *surface, uint32_t *count))[2];
/// Triangles (tsurface); appends FrLsurface.
bool fr_lcompanion_triangles(FrSource *source, GArray *surfaces, char symbol, double size);
