/// @file lsystem/companion.h
/// Files that a view names: functions, contours, curves, surfaces.
#pragma once

#include "lsystem/view.h"

/// Reads at most `most` numbers from a line, whatever words stand between; returns how many.
int fr_lcompanion_numbers(const char *line, double *numbers, int most);
/// One function (.func) or a set of them (.fset); appends FrLspline. False if there is none.
bool fr_lcompanion_functions(FrSource *source, GArray *functions);
/// A contour or curve (.con); appends FrLcontour.
bool fr_lcompanion_contour(FrSource *source, GArray *contours, int id);
/// Bézier patches (.s); appends FrLsurface. `s` and `t`: quads a side, 0: as the file says.
bool fr_lcompanion_patches(FrSource *source, GArray *surfaces, char symbol, double size, int s,
                           int t);
/// Triangles (tsurface); appends FrLsurface.
bool fr_lcompanion_triangles(FrSource *source, GArray *surfaces, char symbol, double size);
