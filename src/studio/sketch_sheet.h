/// @file sketch_sheet.h
/// A contact sheet: instances of a plant side by side, of which one is chosen.
#pragma once

#include "studio/model/camera.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_SKETCH_SHEET (studio_sketch_sheet_get_type())
G_DECLARE_FINAL_TYPE(StudioSketchSheet, studio_sketch_sheet, STUDIO, SKETCH_SHEET, GtkWidget)

/// Signal "chosen" (guint index), "opened" (guint index): twice clicked, or Enter.

GtkWidget *studio_sketch_sheet_new(void);
/// Shows instances: arrays of StudioLine (a reference is taken).
void studio_sketch_sheet_show(StudioSketchSheet *sheet, GPtrArray *instances, guint64 first_seed);
void studio_sketch_sheet_choose(StudioSketchSheet *sheet, guint index);
/// From where they are seen: angles alone count.
void studio_sketch_sheet_see(StudioSketchSheet *sheet, const StudioCamera *camera);
