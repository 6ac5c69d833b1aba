/// @file lsystem/spline.h
/// Spans of generalized cylinders.
#pragma once

#include "lsystem/build.h"

/// Draws the curve from the last control point to `target` in so many strips; a B-spline moves
/// `target` to where its curve ends.
void fr_lspline_draw(FrLturtle *turtle, FrLtube *spline, FrLpoint *target, uint32_t strips);
