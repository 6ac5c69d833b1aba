/// @file scene/pick_solid.h
/// Where a ray meets an obstacle or the ground. Private to scene.
#pragma once

#include "frond/plant.h"

/// How far along a ray (unit length, in the plant's coordinates) it meets an organ's surface from
/// outside; INFINITY: never. Cones count as cylinders.
double fr_pick_solid(const FrPlant *plant, uint32_t organ, const double origin[3],
                     const double direction[3]);
