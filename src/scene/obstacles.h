/// @file obstacles.h
/// Obstacles of a document as a plant. Private to scene.
#pragma once

#include "frond/scene.h"

/// A plant without nodes whose organs are the obstacles; at most FrLimits.organs of them.
FR_MUST_USE FrStatus fr_obstacles_plant(const FrSurroundings *surroundings,
                                        const FrContext *context, FrPlant **plant);
