/// @file scene/swept.h
/// Solids drawn along lines. Private to scene.
#pragma once

#include "frond/scene.h"

/// The closed surface of an obstacle that is drawn along a line, in its own coordinates.
FR_MUST_USE FrStatus fr_swept_mesh(const FrObstacle *obstacle, const FrContext *context,
                                   FrMeshFile **mesh);
