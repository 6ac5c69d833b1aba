/// @file things_panel.h
/// All that a document holds, as a list with indents: materials, curves, plants, scene, views.
#pragma once

#include "studio/model/counts.h"
#include "studio/model/document.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_THINGS_PANEL (studio_things_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioThingsPanel, studio_things_panel, STUDIO, THINGS_PANEL, GtkBox)

/// Signal "selected" (guint element).

GtkWidget *studio_things_panel_new(void);
/// How many there are of each plant, and how long they take (StudioPlantLoad).
void studio_things_panel_set_loads(StudioThingsPanel *panel, const GArray *loads);
void studio_things_panel_show(StudioThingsPanel *panel, StudioDocument *document,
                              uint32_t selected);
