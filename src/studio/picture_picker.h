/// @file picture_picker.h
/// A button that shows the picture that an attribute names and lets another be chosen.
#pragma once

#include <gtk/gtk.h>

#define STUDIO_TYPE_PICTURE_PICKER (studio_picture_picker_get_type())
G_DECLARE_FINAL_TYPE(StudioPicturePicker, studio_picture_picker, STUDIO, PICTURE_PICKER, GtkBox)

/// Signals:
///   "chosen" (const char *file)   as the document names it
GtkWidget *studio_picture_picker_new(void);
/// Shows the file that a document in that folder (NULL: nowhere) names; NULL: none.
void studio_picture_picker_show(StudioPicturePicker *picker, const char *folder, const char *file);
