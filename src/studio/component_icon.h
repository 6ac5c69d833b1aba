/// @file component_icon.h
/// A sign for each kind of component.
#pragma once

#include "frond/pgraph.h"

#include <cairo.h>

/// Draws within a square of `size` at the origin, in the colour that is set.
void studio_component_icon(cairo_t *cairo, FrComponentKind kind, double size);
/// Red, green, blue of its family: stems, blades, multipliers, what acts on all.
void studio_component_colour(FrComponentKind kind, double colour[3]);
