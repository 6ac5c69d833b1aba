/// @file sketch_panel.h
/// The mode in which branches are drawn: what was drawn, the drawing board, and the skeleton.
///
/// After: Sketch-based plant variation (2006), whose three windows these are. What is drawn is kept
/// in the document at once, a `<vary>` of the plant with a stroke more, so that undo, recovery and
/// saving know of it.
#pragma once

#include "studio/model/document.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_SKETCH_PANEL (studio_sketch_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioSketchPanel, studio_sketch_panel, STUDIO, SKETCH_PANEL, GtkBox)

/// Signal "said" (const char *text): something to tell in a few words.

/// Its commands become actions of `actions`, all called "sketch-…".
GtkWidget *studio_sketch_panel_new(GActionMap *actions);
/// How wide its first two panes are, as far as there is room.
void studio_sketch_panel_set_widths(StudioSketchPanel *panel, const int widths[2]);
void studio_sketch_panel_get_widths(StudioSketchPanel *panel, int widths[2]);
/// Begins to sketch over a plant (FR_NONE: none), or over the plant a variation is of.
void studio_sketch_panel_begin(StudioSketchPanel *panel, StudioDocument *document, uint32_t plant);
/// The document has changed.
void studio_sketch_panel_follow(StudioSketchPanel *panel);
/// Ends it: the document may go.
void studio_sketch_panel_end(StudioSketchPanel *panel);
/// Whether all that was asked for is grown and shown.
gboolean studio_sketch_panel_is_idle(StudioSketchPanel *panel);
/// What is chosen and drawn, as JSON, for tests. Free with g_free().
char *studio_sketch_panel_state(StudioSketchPanel *panel);
