/// @file views_menu.h
/// The views that a document keeps: listed, gone to, kept and removed; and what is selected,
/// framed.
#pragma once

#include "studio/window.h"

/// A button that opens their list. Adds the actions save-view and go-view, which take a name, and
/// frame-all.
GtkWidget *studio_views_button_new(StudioWindow *window);
/// Shows what is selected; false: nothing that stands anywhere is.
bool studio_frame_selected(StudioWindow *window);
