/// @file obstacles.h
/// Obstacles of a document as a plant. Private to scene.
#pragma once

#include "frond/scene.h"
#include "frond/terrain.h"

/// A plant without nodes whose organs are the visible obstacles, at most FrLimits.organs of them,
/// and the ground, if `hills` is not NULL. NULL if there are none.
FR_MUST_USE FrStatus fr_obstacles_plant(const FrSurroundings *surroundings, const FrHills *hills,
                                        const FrContext *context, FrPlant **plant);
/// One obstacle alone, visible or not.
FR_MUST_USE FrStatus fr_obstacle_plant(const FrObstacle *obstacle, const FrContext *context,
                                       FrPlant **plant);
