/// @file time_strip.h
/// The strip below the picture: the clock of the plants, or the steps of an L-system.
#pragma once

#include "studio/model/document.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_TIME_STRIP (studio_time_strip_get_type())
G_DECLARE_FINAL_TYPE(StudioTimeStrip, studio_time_strip, STUDIO, TIME_STRIP, GtkBox)

/// Signals:
///   "time" (double years)    the clocks of all plants shall show it; NAN: as the document says
///   "step" (gint64 step)     plants that grow bud by bud shall be at it

GtkWidget *studio_time_strip_new(void);
/// For the plant of a document, which the steps of an L-system change; FR_NONE: none, and it hides.
/// `element` is what is selected (FR_NONE: nothing): its key frames are shown.
void studio_time_strip_show(StudioTimeStrip *strip, StudioDocument *document, uint32_t plant,
                            uint32_t element);
/// Another document comes: the clock shows what it says.
void studio_time_strip_reset(StudioTimeStrip *strip);
/// The plants grow bud by bud, are at a step, and the document asks for so many.
void studio_time_strip_show_growth(StudioTimeStrip *strip, uint64_t step, uint64_t count);
/// The picture of the last moment is there: a clock that runs may go on.
void studio_time_strip_continue(StudioTimeStrip *strip);
