/// @file messages.h
/// Where actions tell what they did: a line over a part of the window, which goes by itself.
#pragma once

#include <gtk/gtk.h>

typedef struct StudioMessages StudioMessages;

/// Messages over a widget, above its lower edge.
StudioMessages *studio_messages_new(GtkWidget *under);
/// They are no longer told; the widgets stay with the window. NULL: nothing happens.
void studio_messages_free(StudioMessages *messages);
/// What is put into the window in place of the widget under them. Borrowed.
GtkWidget *studio_messages_widget(const StudioMessages *messages);

/// Tells a line for some seconds, in place of the last one; with a button that undoes where
/// `can_undo`.
void studio_messages_say(StudioMessages *messages, const char *text, bool can_undo);
/// Whether messages go only for others from now on: for who reads slowly, as a program on a busy
/// machine.
void studio_messages_stay(StudioMessages *messages, gboolean stays);
/// Takes the button away, as it would undo something else now.
void studio_messages_forget_undo(StudioMessages *messages);
/// What is told now; NULL: nothing. Borrowed.
const char *studio_messages_said(const StudioMessages *messages);
