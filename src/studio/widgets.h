/// @file widgets.h
/// Buttons and gestures that many parts of the window have alike.
#pragma once

#include <gtk/gtk.h>

/// A button with an icon that does an action ("win.undo"); its tip is its name, too.
GtkWidget *studio_action_button(const char *icon, const char *action, const char *tip);
/// A flat button with an icon; its tip is its name, too.
GtkWidget *studio_flat_button(const char *icon, const char *tip);
/// One that is small beside the value of a row.
GtkWidget *studio_row_button(const char *icon, const char *tip);
/// One at the end of a bar, found by its tip in the style and when the program is driven.
GtkWidget *studio_bar_button(GtkWidget *bar, const char *icon, const char *tip, GCallback clicked,
                             void *data);

/// Lets Escape close a window.
void studio_close_on_escape(GtkWidget *window);

/// Listens to drags with the first button of the pointer; the callbacks are those of
/// GtkGestureDrag.
GtkGesture *studio_listen_to_drags(GtkWidget *widget, GCallback begin, GCallback update,
                                   GCallback end, void *data);
/// The file or folder that was chosen; NULL: none was, or it is not on this computer. Free with
/// g_free().
char *studio_chosen_path(GtkNativeDialog *chooser, int response);

/// Listens to the button of the pointer that asks for a menu; `pressed` as of GtkGestureClick.
void studio_listen_for_menu(GtkWidget *widget, GCallback pressed, void *data);
