/// @file viewport_private.h
/// What the files of the viewport share.
#pragma once

#include "studio/viewport.h"

struct _StudioViewport {
    GtkGLArea parent;
    StudioRenderer *renderer;
    char *error;
    StudioCamera camera;
    StudioDisplay display;
    bool is_framed; // the first view has been framed
    bool is_dragging, is_moving, was_done;
    bool is_taken;        // the drag belongs to a handler of "press"
    GHashTable *overlays; // name → StudioOverlay
    double drag_x, drag_y;
    gint64 moved; // when it moved last
    gint64 drawn; // when it was drawn last
    guint tick;
    gint64 *stamp; // where the time of the next picture goes; NULL: nowhere
};

/// Something is to be drawn, perhaps in several frames.
void studio_viewport_wake(StudioViewport *viewport);

// viewport_input.c

void studio_viewport_add_signals(GType type);
void studio_viewport_add_controllers(StudioViewport *viewport);
