/// @file param_row.h
/// A row of the inspector: one parameter with what its kind of value is best set by.
#pragma once

#include "frond/param.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_PARAM_ROW (studio_param_row_get_type())
G_DECLARE_FINAL_TYPE(StudioParamRow, studio_param_row, STUDIO, PARAM_ROW, GtkBox)

/// Signals:
///   "set" (const char *value, gboolean is_drag)   NULL: back to the default
///   "sealed" ()                                   a drag is over
///   "follow" (const char *id)                     what the value names shall be shown
///   "key" (double value, gboolean is_drag)        a key frame is set at the age; NAN: of what is
///   "unkey" ()                                    the key frame at the age is removed

GtkWidget *studio_param_row_new(const FrParam *param);
const FrParam *studio_param_row_param(StudioParamRow *row);
/// The attribute's name, borrowed.
const char *studio_param_row_attribute(StudioParamRow *row);
/// Shows a value; NULL: it is not given.
void studio_param_row_show(StudioParamRow *row, const char *value);
/// The age that key frames are set at, in years; NAN: there are none.
void studio_param_row_set_age(StudioParamRow *row, double age);
/// Puts a widget beside the value.
void studio_param_row_put(StudioParamRow *row, GtkWidget *widget);
/// What the document gives, borrowed; NULL: nothing.
const char *studio_param_row_value(StudioParamRow *row);
/// How the points of a curve are joined (FrCurveKind).
void studio_param_row_set_curve_kind(StudioParamRow *row, int kind);
/// Underlines bytes [begin, end) of the value, with what is wrong; NULL: nothing.
void studio_param_row_mark(StudioParamRow *row, const char *message, int begin, int end);
/// Whether the document gives the value.
gboolean studio_param_row_is_given(StudioParamRow *row);
/// Whether its name or meaning has such a word.
gboolean studio_param_row_matches(StudioParamRow *row, const char *words);
