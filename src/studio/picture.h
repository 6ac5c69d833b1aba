/// @file picture.h
/// Pictures of what is on the screen.
#pragma once

#include <gtk/gtk.h>

/// Writes a PNG of a widget as it looks now. False if it cannot.
gboolean studio_picture_save(GtkWidget *widget, const char *path);
/// The colour that a widget shows at a pixel. False if there is none.
gboolean studio_picture_colour(GtkWidget *widget, int x, int y, uint8_t colour[3]);
