/// @file vector.h
/// cglm's value types, the conventions of Frond, and the few rotations cglm lacks.
///
/// Vectors are `vec3s`, rotations are unit quaternions `versors` (x, y, z, w). A frame has its
/// z axis along the growth direction (the turtle's heading H), x to the left (L) and y up on the
/// adaxial side (U); x × y = z. The world is right-handed, z up, in metres.
#pragma once

#include "frond/api.h"

#include <cglm/types-struct.h>

/// One joint of a skeleton: frame of the parent, then the local rotation, renormalized to first
/// order. Every engine and the frames pass use this same function, hence equal bits. Inline: it is
/// called once per internode, and the sums are paired so that their latencies overlap.
static inline versors fr_frame_step(versors parent, versors local) {
    const float *p = parent.raw, *l = local.raw;
    float x = (p[3] * l[0] + p[0] * l[3]) + (p[1] * l[2] - p[2] * l[1]);
    float y = (p[3] * l[1] + p[1] * l[3]) + (p[2] * l[0] - p[0] * l[2]);
    float z = (p[3] * l[2] + p[2] * l[3]) + (p[0] * l[1] - p[1] * l[0]);
    float w = (p[3] * l[3] - p[0] * l[0]) - (p[1] * l[1] + p[2] * l[2]);
    float scale = 1.5f - 0.5f * ((x * x + y * y) + (z * z + w * w));
    return (versors){{x * scale, y * scale, z * scale, w * scale}};
}

/// The frame's z axis in world coordinates.
static inline vec3s fr_frame_heading(versors frame) {
    const float *q = frame.raw;
    return (vec3s){{2 * (q[0] * q[2] + q[3] * q[1]), 2 * (q[1] * q[2] - q[3] * q[0]),
                    1 - 2 * (q[0] * q[0] + q[1] * q[1])}};
}

/// The frame's x axis.
static inline vec3s fr_frame_left(versors frame) {
    const float *q = frame.raw;
    return (vec3s){{1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] + q[3] * q[2]),
                    2 * (q[0] * q[2] - q[3] * q[1])}};
}

/// The frame's y axis.
static inline vec3s fr_frame_up(versors frame) {
    const float *q = frame.raw;
    return (vec3s){{2 * (q[0] * q[1] - q[3] * q[2]), 1 - 2 * (q[0] * q[0] + q[2] * q[2]),
                    2 * (q[1] * q[2] + q[3] * q[0])}};
}

/// The smallest rotation that takes unit vector `from` to unit vector `to`. For opposite vectors
/// a half turn about a fixed perpendicular, so the answer is always defined.
FR_API versors fr_rotation_between(vec3s from, vec3s to);
/// The frame whose z axis is the unit vector `heading` and whose y axis is as near as possible to
/// `up`.
FR_API versors fr_frame_from_heading(vec3s heading, vec3s up);
/// Rotation about a unit axis by `angle` radians.
FR_API versors fr_rotation_about(vec3s axis, float angle);
