/// @file curve_box.h
/// A curve or an outline that is drawn by its points: click adds one, a drag moves it, a drag out
/// of the box or Delete removes it, arrow keys move it.
#pragma once

#include <gtk/gtk.h>

#define STUDIO_TYPE_CURVE_BOX (studio_curve_box_get_type())
G_DECLARE_FINAL_TYPE(StudioCurveBox, studio_curve_box, STUDIO, CURVE_BOX, GtkWidget)

/// Signal "edited" (const char *points, gboolean is_drag).

/// `is_function`: a curve y(x); else an outline.
GtkWidget *studio_curve_box_new(gboolean is_function);
/// Shows points "x,y x,y …"; any other text shows nothing.
void studio_curve_box_show(StudioCurveBox *box, const char *points, int kind);
/// The points as text; NULL: there are none. Free with g_free().
char *studio_curve_box_text(StudioCurveBox *box);
/// Takes points as if they were drawn. False: the text is something else.
gboolean studio_curve_box_put(StudioCurveBox *box, const char *points);
gboolean studio_curve_box_is_function(StudioCurveBox *box);
