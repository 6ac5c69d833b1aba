/// @file pace.h
/// How much may be drawn while a view moves, by how long the last pictures took: machines differ a
/// hundredfold. Fewer pixels make room for triangles before crowns get thin; light is worked out
/// for pixels only where there is time for it, else for vertices.
#pragma once

#include "frond/api.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct StudioPacing {
    double triangles; ///< about so many may be drawn
    double scale;     ///< of the picture's sides, 0.5 to 1
    bool is_plain;    ///< light for vertices only
    double rich_from; ///< triangles that are possible before light is for pixels
} StudioPacing;

/// Of a machine that is not known yet.
StudioPacing studio_pacing_new(void);
/// A picture of so many triangles has taken that long.
void studio_pacing_learn(StudioPacing *pacing, double seconds, uint64_t triangles);
