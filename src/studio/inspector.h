/// @file inspector.h
/// Everything that can be set of one element: a row for each parameter of its table.
#pragma once

#include "frond/pgraph.h"
#include "studio/swatches.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_INSPECTOR (studio_inspector_get_type())
G_DECLARE_FINAL_TYPE(StudioInspector, studio_inspector, STUDIO, INSPECTOR, GtkBox)

GtkWidget *studio_inspector_new(void);
/// Shows an element (FR_NONE: none) of a document, which it edits. Key frames are those at the time
/// of studio_inspector_set_time().
void studio_inspector_show(StudioInspector *inspector, StudioDocument *document, uint32_t element,
                           const FrDiags *diags);
/// What the clock of the plants shows, in years; NAN: as the document says.
void studio_inspector_set_time(StudioInspector *inspector, double time);
/// How materials look there; pictures are handed to it.
StudioSwatches *studio_inspector_swatches(StudioInspector *inspector);
/// Marks what is wrong.
void studio_inspector_set_diags(StudioInspector *inspector, const FrDiags *diags);
/// Brings the row of an attribute into view and gives it the keyboard.
void studio_inspector_reveal(StudioInspector *inspector, const char *attribute);
