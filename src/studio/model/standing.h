/// @file standing.h
/// What of a scene can be moved, turned and made larger by handles: places, areas, rows, obstacles,
/// particles and the ground. Lamps have marks of their own.
#pragma once

#include "studio/model/document.h"

/// Where an element stands, in the document's coordinates.
typedef struct StudioStanding {
    double at[3]; ///< m; of a row the middle of its points
    double turn;  ///< degrees about the vertical
    double scale; ///< of a place its own; of others a factor: 1 as read
    bool can_turn, can_scale;
    bool is_on_ground; ///< z counts from the ground
} StudioStanding;

/// False if the element does not stand anywhere, or by an expression.
bool studio_standing_read(const StudioDocument *document, uint32_t element,
                          StudioStanding *standing);
/// The other part of a road: an obstacle along the same line, of which one cannot be seen and keeps
/// plants off the other. FR_NONE: there is none.
uint32_t studio_standing_twin(const StudioDocument *document, uint32_t element);
/// Moves it, and its twin, from where it stands by `from` to `to`, which differ by a drag. With a
/// `key` calls in a row are one step. False if nothing changed.
bool studio_standing_move(StudioDocument *document, uint32_t element, const StudioStanding *from,
                          const StudioStanding *to, const char *key);
