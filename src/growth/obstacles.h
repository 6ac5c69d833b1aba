/// @file obstacles.h
/// Many obstacles as one surface. Private to the layers above.
#pragma once

#include "frond/distance.h"
#include "frond/growth.h"

/// True for an obstacle that is wanted.
typedef bool (*FrObstacleIs)(const FrGrowthObstacle *obstacle);

/// The surfaces of all wanted obstacles put into order as one, NULL if there are none. FR_ERR_LIMIT
/// if `what` takes too much memory.
FR_MUST_USE FrStatus fr_obstacles_join(const FrGrowthObstacle *obstacles, uint32_t count,
                                       FrObstacleIs is_wanted, const char *what,
                                       const FrContext *context, FrDistance **joined);
