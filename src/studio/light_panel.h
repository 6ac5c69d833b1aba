/// @file light_panel.h
/// The page of light: lamps, sun and probe as a list, and what of the light is shown.
#pragma once

#include "studio/model/document.h"
#include "studio/model/light_layer.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_LIGHT_PANEL (studio_light_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioLightPanel, studio_light_panel, STUDIO, LIGHT_PANEL, GtkBox)

/// Signals:
///   "selected" (guint element)
///   "slice" (double part)       where a slice lies, 0 to 1
///   "photons" (guint photons)   whose rays are shown
/// All else is done by actions of the window.

GtkWidget *studio_light_panel_new(void);
void studio_light_panel_show(StudioLightPanel *panel, StudioDocument *document, uint32_t selected);
/// Shows what is wished.
void studio_light_panel_set_wish(StudioLightPanel *panel, const StudioLightWish *wish);
/// Tells what was seen, and what there is to be seen.
void studio_light_panel_set_sight(StudioLightPanel *panel, const StudioSight *sight);
