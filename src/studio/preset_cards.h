/// @file preset_cards.h
/// All presets as cards with their pictures: the user's, which can be renamed and removed, and
/// those that come with the program.
#pragma once

#include <gtk/gtk.h>

#define STUDIO_TYPE_PRESET_CARDS (studio_preset_cards_get_type())
G_DECLARE_FINAL_TYPE(StudioPresetCards, studio_preset_cards, STUDIO, PRESET_CARDS, GtkBox)

/// Signal "chosen" (const char *name).

GtkWidget *studio_preset_cards_new(void);
