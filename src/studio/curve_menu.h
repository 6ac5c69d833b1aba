/// @file curve_menu.h
/// What is done to a curve as a whole: it is copied, pasted, or begun as one of the built-in
/// shapes.
#pragma once

#include "studio/curve_box.h"

/// A button with the menu, which a right click on the box opens, too.
GtkWidget *studio_curve_menu_new(StudioCurveBox *box);
