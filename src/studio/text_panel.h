/// @file text_panel.h
/// The text of the document, or of the L-system in it, with what is wrong underlined.
#pragma once

#include "studio/model/document.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_TEXT_PANEL (studio_text_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioTextPanel, studio_text_panel, STUDIO, TEXT_PANEL, GtkBox)

GtkWidget *studio_text_panel_new(void);
/// Shows the text as it is now; what the user types changes the document.
void studio_text_panel_show(StudioTextPanel *panel, StudioDocument *document, const FrDiags *diags);
/// Puts the cursor at a byte.
void studio_text_panel_go(StudioTextPanel *panel, uint32_t offset);
