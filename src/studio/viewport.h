/// @file viewport.h
/// The picture of the plants: a GtkGLArea that is turned, moved and zoomed with the pointer.
#pragma once

#include "studio/view/renderer.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_VIEWPORT (studio_viewport_get_type())
G_DECLARE_FINAL_TYPE(StudioViewport, studio_viewport, STUDIO, VIEWPORT, GtkGLArea)

/// Signals:
///   "ready" ()                 it can take views now
///   "clicked" (double x, y)    a point of the picture was clicked, in −1 to 1
///   "drawn" ()                 the fine picture is done
///   "woken" ()                 another picture is to be drawn: the view or its size may differ
///   "press" (double x, double y, guint modifiers) → gboolean
///                              the main button goes down; the first handler that returns TRUE
///                              gets what follows, and the view does not turn:
///   "drag" (double x, double y, guint modifiers)     moved with the button held
///   "release" (double x, double y, gboolean moved)   up again; whether there was a drag
///   "hover" (double x, double y)                     the pointer moves with no button held

GtkWidget *studio_viewport_new(void);
/// Whether views can be taken: it has a context of OpenGL.
bool studio_viewport_is_ready(StudioViewport *viewport);
/// Why it never will be; NULL: it will.
const char *studio_viewport_error(StudioViewport *viewport);
/// Sends a view to the graphics card. The first one is framed.
void studio_viewport_take(StudioViewport *viewport, const StudioView *view);
/// The next view is of another document: it is framed.
void studio_viewport_forget(StudioViewport *viewport);
void studio_viewport_add_picture(StudioViewport *viewport, const StudioPicture *picture);
StudioDisplay *studio_viewport_display(StudioViewport *viewport);
/// The display has changed.
void studio_viewport_update(StudioViewport *viewport);
StudioCamera *studio_viewport_camera(StudioViewport *viewport);
void studio_viewport_frame_all(StudioViewport *viewport);
/// Shows a box.
void studio_viewport_frame(StudioViewport *viewport, const double min[3], const double max[3]);
/// Looks as a view of the document does.
void studio_viewport_see(StudioViewport *viewport, const FrViewParams *view);
/// The view as a picture of that size, in pixels: fine, without marks over it; with `is_clear` it
/// has alpha, and only the plants are seen. Blocks until it is drawn. NULL: the graphics card
/// cannot.
FrImage *studio_viewport_picture(StudioViewport *viewport, int width, int height, bool is_clear);
/// Goes by the given part of its height or by angles, as the pointer does.
void studio_viewport_move(StudioViewport *viewport, double azimuth, double elevation, double zoom);
/// The overlay of that name becomes this, which is the viewport's from then on; NULL: it goes.
/// Layers are drawn in the order of their names. The picture below is not drawn again.
void studio_viewport_set_overlay(StudioViewport *viewport, const char *name,
                                 StudioOverlay *overlay);
/// `*stamp` becomes the time, g_get_monotonic_time(), when the next picture has been drawn.
void studio_viewport_stamp(StudioViewport *viewport, gint64 *stamp);
/// Marks lines, pairs of points, as what was picked: the overlay "picked".
void studio_viewport_highlight(StudioViewport *viewport, const float (*points)[3], uint32_t count);
/// The box around everything that stands; min > max if there is nothing.
void studio_viewport_bounds(StudioViewport *viewport, double min[3], double max[3]);
/// Width over height of the picture.
double studio_viewport_aspect(StudioViewport *viewport);
/// Whether the fine picture of what it holds is shown, or there never will be one in the wind.
bool studio_viewport_is_done(StudioViewport *viewport);
StudioPace studio_viewport_pace(StudioViewport *viewport);
StudioAmount studio_viewport_amount(StudioViewport *viewport);
