/// @file short_entry.h
/// An entry for values that shows a long number with fewer digits until it is edited.
#pragma once

#include <gtk/gtk.h>

/// A GtkEntry.
GtkWidget *studio_short_entry_new(void);
/// Shows a value: whole if the entry has the focus.
void studio_short_entry_show(GtkWidget *entry, const char *value);
/// What was typed or shown, whole. It lasts until the entry shows something else.
const char *studio_short_entry_text(GtkWidget *entry);
