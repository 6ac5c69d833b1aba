/// @file values.h
/// Texts of attributes as handles move them: numbers on sliders, points of curves.
#pragma once

#include "frond/param.h"

/// Whether a text is one plain number.
bool studio_value_is_number(const char *text, double *value);
/// Whether a text is so many plain numbers with commas between them.
bool studio_numbers_read(const char *text, int count, double *numbers);
/// A number with no more digits than a handle needs for a span. Free with g_free().
char *studio_value_text(double value, double span);
/// A number as short as a narrow field needs it: to six digits, where it has more behind its point.
/// All other texts stay as they are. Free with g_free().
char *studio_value_short(const char *text);
/// "x, y, z", each as above. Free with g_free().
char *studio_vector_text(const double at[3], double span);
/// A length in m with the unit that suits it: "5 mm", "20 cm", "1 m", "2 km". Free with g_free().
char *studio_length_text(double length);
/// A count in groups of three digits: 207 000. Free with g_free().
char *studio_count_text(uint64_t count);
/// The same with what is counted: "1 leaf", "12 leaves". Free with g_free().
char *studio_count_words(uint64_t count, const char *one, const char *many);
/// What it means, its range and its default. Free with g_free().
char *studio_value_tip(const FrParam *param);
/// What a slider runs over: the hard range where that is of a handy size, else some range about the
/// value and the default.
void studio_value_range(const FrParam *param, double value, double *min, double *max);
/// The step of a key or a notch for such a range.
double studio_value_step(const FrParam *param, double min, double max);

/// The points "x,y x,y …" of a text (double[2]); NULL if it is something else.
GArray *studio_points_read(const char *text);
/// Those of a built-in curve, or NULL. Free with g_free().
char *studio_points_of_shape(const char *name);
/// Free with g_free().
char *studio_points_write(const GArray *points);
/// Moves a point; of a curve (`is_function`) it stays between its neighbours, the ends keep x.
void studio_points_move(GArray *points, guint index, double x, double y, bool is_function);
/// Adds a point where it belongs: between its neighbours in x, or on the nearest side of an
/// outline. Returns its index.
guint studio_points_add(GArray *points, double x, double y, bool is_function);
