/// @file target.h
/// Framebuffers to draw to and to read from.
#pragma once

#include <epoxy/gl.h>

typedef struct StudioTarget {
    GLuint frame, colour, depth; ///< `colour` is 0 for one of depths alone
    int width, height;
} StudioTarget;

/// Makes it as large as that, with colours.
void studio_target_resize(StudioTarget *target, int width, int height);
/// A map of depths to compare with: a shadow.
void studio_target_make_shadow(StudioTarget *target, int width, int height);
void studio_target_clear(StudioTarget *target);
/// What follows is drawn to it, with depths.
void studio_target_open(const StudioTarget *target);
