/// @file pick.h
/// What is seen at a point of a picture: the axis or organ of a plant that a ray meets first.
#pragma once

#include "frond/scene.h"

typedef struct FrPick {
    uint32_t stand;     ///< of the scene
    uint32_t plant;     ///< of the scene
    uint32_t node;      ///< met, FR_NONE for an organ
    uint32_t organ;     ///< met, FR_NONE for an axis
    uint32_t component; ///< of the plant, what made it; FR_NONE
    FrKey path;         ///< of the instance
    double distance;    ///< along the ray, m
} FrPick;

/// The nearest thing that a ray from `origin` along `direction` (unit length) meets. `spread` is
/// how much wider the ray gets with each metre, so that thin twigs far away can be met: the angle
/// of a few pixels, in radians. Internodes count as cones, organs as balls about the middle of
/// their shape; obstacles and the ground are met on their surface. False if it meets nothing.
/// Linear in all internodes and organs.
FR_API bool fr_scene_pick(const FrScene *scene, const double origin[3], const double direction[3],
                          double spread, FrPick *pick);
