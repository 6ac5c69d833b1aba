/// @file string_panel.h
/// The string of the L-system that is shown, below its text: modules and what they drew are shown
/// in each other's place when one is pointed at. It is derived off the main thread.
#pragma once

#include "studio/window.h"

typedef struct StudioStringPanel StudioStringPanel;

/// Listens to the window's viewport, which must be there.
StudioStringPanel *studio_string_panel_new(StudioWindow *window);
void studio_string_panel_free(StudioStringPanel *panel);
GtkWidget *studio_string_panel_widget(StudioStringPanel *panel);
/// The document, the plant or the page has changed.
void studio_string_panel_update(StudioStringPanel *panel);
/// Other plants are shown in the picture.
void studio_string_panel_match(StudioStringPanel *panel);
/// Whether the string of what the document says now is shown.
bool studio_string_panel_is_idle(const StudioStringPanel *panel);
/// What is pointed at, for tests: its text and the production that made it; NULL: nothing. Free
/// with g_free().
char *studio_string_panel_state(const StudioStringPanel *panel);
