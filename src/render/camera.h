/// @file camera.h
/// A pinhole camera that frames a world by itself. Private to render.
#pragma once

#include "render/world.h"

typedef struct FrCamera {
    vec3s origin;
    vec3s right, up, forward;      ///< unit
    float half_width, half_height; ///< of the picture one metre ahead
    float distance;                ///< to the middle of what is framed
} FrCamera;

/// A camera for a picture of `aspect` (width over height). `view` may be NULL: then the height of
/// the plants decides from how high they are seen.
FrCamera fr_camera_frame(const FrWorld *world, const FrViewParams *view, float aspect);
/// The unit direction through a point of the picture; (0, 0) is its top left, (1, 1) its bottom
/// right corner.
vec3s fr_camera_direction(const FrCamera *camera, float x, float y);
