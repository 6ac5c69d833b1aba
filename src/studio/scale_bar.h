/// @file scale_bar.h
/// How large things are in the picture: a bar of a plain length in its lower left corner, for what
/// is as far away as the point that the view turns about.
#pragma once

#include "studio/viewport.h"

/// Adds one over the picture. It is not there where a palette or a bar at the lower edge needs its
/// place.
void studio_scale_bar_add(GtkOverlay *overlay, StudioViewport *viewport);
