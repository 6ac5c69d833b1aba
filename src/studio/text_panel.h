/// @file text_panel.h
/// The text of the document, or of the L-system in it, with what is wrong underlined.
#pragma once

#include "studio/model/document.h"

#include <gtk/gtk.h>

#define STUDIO_TYPE_TEXT_PANEL (studio_text_panel_get_type())
G_DECLARE_FINAL_TYPE(StudioTextPanel, studio_text_panel, STUDIO, TEXT_PANEL, GtkBox)

/// `language`: of its highlighting, "xml" or "frond-lsystem".
GtkWidget *studio_text_panel_new(const char *language);
/// Shows the text as it is now, of the whole document or (not FR_NONE) within an element; what the
/// user types changes the document.
void studio_text_panel_show(StudioTextPanel *panel, StudioDocument *document, uint32_t element,
                            const FrDiags *diags);
/// The document goes: nothing more is said to it.
void studio_text_panel_forget(StudioTextPanel *panel);
/// Marks bytes of the document and scrolls to them, without the cursor; `begin` FR_NONE: none.
void studio_text_panel_mark(StudioTextPanel *panel, uint32_t begin, uint32_t end);
/// Puts the cursor at a byte.
void studio_text_panel_go(StudioTextPanel *panel, uint32_t offset);
