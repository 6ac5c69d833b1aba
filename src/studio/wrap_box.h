/// @file wrap_box.h
/// Widgets side by side in as many rows as the width there is asks for. It would like to have them
/// all in one row; a GtkFlowBox asks for the width of one widget.
#pragma once

#include <gtk/gtk.h>

#define STUDIO_TYPE_WRAP_BOX (studio_wrap_box_get_type())
G_DECLARE_FINAL_TYPE(StudioWrapBox, studio_wrap_box, STUDIO, WRAP_BOX, GtkWidget)

/// `gap`: in pixels, between widgets and between rows.
GtkWidget *studio_wrap_box_new(int gap);
void studio_wrap_box_append(StudioWrapBox *box, GtkWidget *child);
