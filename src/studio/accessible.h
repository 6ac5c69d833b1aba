/// @file accessible.h
/// What a screen reader says of a widget.
#pragma once

#include <gtk/gtk.h>

/// How much larger than usual the user wants letters to be: what is drawn by hand goes by that.
double studio_letter_scale(GtkWidget *widget);
/// Names a widget, and with it the button inside a menu button, drop-down or colour button, which
/// is what has the focus. A drop-down's name goes on with what is chosen.
void studio_name(GtkWidget *widget, const char *name);
/// Gives it a tip that is its name, too.
void studio_tell(GtkWidget *widget, const char *tip);
/// Only that button, of a widget that a label names already.
void studio_name_inside(GtkWidget *widget, const char *name);
/// Says more of a widget: what keys do in it, or what it shows just now.
void studio_describe(GtkWidget *widget, const char *words);
