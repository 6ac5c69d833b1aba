/// @file vein_growth.h
/// One stage of vein growth towards auxin sources.
#pragma once

#include "material/vein_grid.h"
#include "material/venation.h"

/// A place where auxin is made.
typedef struct FrAuxin {
    float x, y;
} FrAuxin;

/// Grows veins in steps of `step` towards `sources` until each is reached or given up.
/// `grid` holds all veins so far; `spacing` is the least distance between sources. In closed
/// venation several veins may reach one source and are joined there.
void fr_veins_grow(FrVenation *venation, const FrVeinGrid *grid, const FrAuxin *sources,
                   uint32_t count, float spacing, float step, bool is_closed);
