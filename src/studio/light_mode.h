/// @file light_mode.h
/// Light in a window: its page, its marks in the picture, lamps that are dragged.
#pragma once

#include "studio/window.h"

typedef struct StudioLightMode StudioLightMode;

/// Adds its actions to the window and listens to its viewport, which must be there.
StudioLightMode *studio_light_mode_new(StudioWindow *window);
/// The builder must be gone.
void studio_light_mode_free(StudioLightMode *mode);
/// The page.
GtkWidget *studio_light_mode_panel(StudioLightMode *mode);
/// The window has a builder, which has no request yet.
void studio_light_mode_watch(StudioLightMode *mode);
/// The document, the selection, the page or the plants have changed.
void studio_light_mode_update(StudioLightMode *mode);
/// Takes what was seen.
void studio_light_mode_collect(StudioLightMode *mode);
