/// @file sketch_view.h
/// A plant's skeleton in space, which is turned with the pointer, or painted over.
#pragma once

#include "studio/model/camera.h"
#include "studio/model/sketch_lines.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_SKETCH_VIEW (studio_sketch_view_get_type())
G_DECLARE_FINAL_TYPE(StudioSketchView, studio_sketch_view, STUDIO, SKETCH_VIEW, GtkWidget)

/// What the pen does over a view.
typedef enum StudioPenPhase { STUDIO_PEN_DOWN, STUDIO_PEN_MOVES, STUDIO_PEN_UP } StudioPenPhase;

/// Signals:
///   "pen" (int phase, double x, double y)    in pixels of the widget, while it is painted over
///   "turned" ()                              it is seen from elsewhere
///   "key" (guint keyval, gboolean *is_taken) a key that it does not know itself

/// `label`: its accessible name.
GtkWidget *studio_sketch_view_new(const char *label);
/// Lines of two layers (StudioLine; references are taken; NULL: none).
void studio_sketch_view_set_lines(StudioSketchView *view, GArray *below, GArray *above);
/// Whether the first button paints; else it turns. The others always turn.
void studio_sketch_view_set_painting(StudioSketchView *view, gboolean is_painting);
/// Shows all of its lines; from then on until the user zooms or moves it, …
void studio_sketch_view_frame(StudioSketchView *view);
/// … all of them are shown again.
void studio_sketch_view_keep_framed(StudioSketchView *view);
StudioCamera *studio_sketch_view_camera(StudioSketchView *view);
/// How it is seen now.
StudioLens studio_sketch_view_lens(StudioSketchView *view);
