/// @file levels.h
/// A species at three levels: plant it and it grows; six plain numbers; everything. All levels show
/// and change what the document holds.
#pragma once

#include "studio/model/document.h"

typedef enum StudioLevel {
    STUDIO_LEVEL_PLANT = 1,
    STUDIO_LEVEL_SIX,
    STUDIO_LEVEL_ALL,
} StudioLevel;

/// The `<species>` that is meant while an element is selected: of the plant around it, of the place
/// that it is, or (FR_NONE) of the plant that is shown. FR_NONE: none.
uint32_t studio_levels_species(const StudioDocument *document, uint32_t selected, uint32_t shown);
/// Whether what is selected is that species as a whole, so that the two simple levels say it all.
bool studio_levels_are_whole(const StudioDocument *document, uint32_t selected);
/// One of the six numbers; its default where it is not given.
double studio_levels_get(const StudioDocument *document, uint32_t species, const char *name);
/// Sets it, and adds the `<sliders>` if there are none yet; what is its default is not written.
/// Calls in a row for the same number are one step. False if nothing changed.
bool studio_levels_set(StudioDocument *document, uint32_t species, const char *name, double value);
