/// @file window.h
/// A window: one document, or the welcome page until there is one.
#pragma once

#include "studio/model/document.h"
#include "studio/model/recovery.h"
#include "studio/model/settings.h"

#include <adwaita.h>

#define STUDIO_TYPE_WINDOW (studio_window_get_type())
G_DECLARE_FINAL_TYPE(StudioWindow, studio_window, STUDIO, WINDOW, AdwApplicationWindow)

/// `settings` must outlive it.
StudioWindow *studio_window_new(AdwApplication *application, StudioSettings *settings);
/// Takes a document; the one it had must have been closed.
void studio_window_take(StudioWindow *window, StudioDocument *document);
/// Opens a file here if the window is empty, else in a new window. False if it cannot be read; then
/// a message says why.
bool studio_window_open(StudioWindow *window, const char *path);
/// NULL: the welcome page.
StudioDocument *studio_window_document(StudioWindow *window);
/// Whether all that was asked for is built, painted and drawn.
bool studio_window_is_idle(StudioWindow *window);
/// Shows a short message.
void studio_window_say(StudioWindow *window, const char *format, ...) G_GNUC_PRINTF(2, 3);
