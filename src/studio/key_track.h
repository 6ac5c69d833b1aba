/// @file key_track.h
/// Key frames as marks on a line of time: they are gone to by a click, dragged, and removed.
#pragma once

#include <gtk/gtk.h>

#define STUDIO_TYPE_KEY_TRACK (studio_key_track_get_type())
G_DECLARE_FINAL_TYPE(StudioKeyTrack, studio_key_track, STUDIO, KEY_TRACK, GtkWidget)

/// Signals, times in years:
///   "go" (double time)                the clock shall show it
///   "move" (double from, double to)   a key is dragged; where it has come to is told by
///                                     studio_key_track_hold()
///   "dropped" ()                      a drag is over
///   "remove" (double time)

GtkWidget *studio_key_track_new(void);
/// Shows keys at times (double, in order), and which of them is now; `span` years are from end to
/// end, `inset` pixels at either end of the line lie outside.
void studio_key_track_show(StudioKeyTrack *track, const GArray *times, double now, double span,
                           double inset);
/// The key that is dragged is at this time now.
void studio_key_track_hold(StudioKeyTrack *track, double time);
/// The key before (direction −1) or behind (1) a time; NAN: there is none.
double studio_key_track_next(StudioKeyTrack *track, double time, int direction);
