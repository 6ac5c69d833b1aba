/// @file graph_panel.h
/// The p-graph: components as boxes, links as wires, a toolbox to drag components from.
#pragma once

#include "studio/model/graph.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_GRAPH_PANEL (studio_graph_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioGraphPanel, studio_graph_panel, STUDIO, GRAPH_PANEL, GtkWidget)

/// Signal "selected" (guint element).

GtkWidget *studio_graph_panel_new(void);
/// Shows the graph of a plant (FR_NONE: none), which it edits.
void studio_graph_panel_show(StudioGraphPanel *panel, StudioDocument *document, uint32_t plant,
                             uint32_t selected);
/// How many instances each component has, and how long they take (StudioCount); copied.
void studio_graph_panel_set_counts(StudioGraphPanel *panel, const GArray *counts);
/// What a component may have and take, as in studio_load_of().
void studio_graph_panel_set_budget(StudioGraphPanel *panel, StudioBudget budget);
/// Where in the panel the box of a component is ("box:stem"), its first repeat at the end of a
/// recursion ("again:stem") or a tool ("tool:leaf").
gboolean studio_graph_panel_where(StudioGraphPanel *panel, const char *name, graphene_rect_t *box);
