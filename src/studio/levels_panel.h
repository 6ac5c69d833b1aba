/// @file levels_panel.h
/// Above the inspector: how much of a species is shown. Its level is kept in the settings.
#pragma once

#include "studio/model/levels.h"
#include "studio/model/settings.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_LEVELS_PANEL (studio_levels_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioLevelsPanel, studio_levels_panel, STUDIO, LEVELS_PANEL, GtkBox)

/// `inspector` shows everything: it is hidden where a simpler level says it all.
GtkWidget *studio_levels_panel_new(StudioSettings *settings, GtkWidget *inspector);
/// Shows the species that is meant while an element is selected, as studio_levels_species().
void studio_levels_panel_show(StudioLevelsPanel *panel, StudioDocument *document, uint32_t selected,
                              uint32_t shown);
/// Everything shall be seen.
void studio_levels_panel_open(StudioLevelsPanel *panel);
