/// @file scene_single.h
/// One plant of a row or an area by itself: left out, or made a place of its own. All others stay
/// as they are. Numbers are those of FrStand, from 0.
#pragma once

#include "studio/model/document.h"

/// Whether an element places many plants at once.
bool studio_is_spread(const StudioDocument *document, uint32_t element);
/// Leaves plants out. `key` as in scene_edit.h. False if nothing changed.
bool studio_leave_out(StudioDocument *document, uint32_t element, const uint32_t *numbers,
                      size_t count, const char *key);
/// Leaves a plant out and places the same one where it stood: the last place of the scene is that.
/// False if there is no such plant, or the document is not right.
bool studio_release(StudioDocument *document, uint32_t element, uint32_t number);
