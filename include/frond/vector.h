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
/// order. Every engine and the frames pass use this same function, hence equal bits.
FR_API versors fr_frame_step(versors parent, versors local);
/// The frame's z axis in world coordinates.
FR_API vec3s fr_frame_heading(versors frame);
FR_API vec3s fr_frame_left(versors frame);
FR_API vec3s fr_frame_up(versors frame);
/// The smallest rotation that takes unit vector `from` to unit vector `to`. For opposite vectors
/// a half turn about a fixed perpendicular, so the answer is always defined.
FR_API versors fr_rotation_between(vec3s from, vec3s to);
/// The frame whose z axis is the unit vector `heading` and whose y axis is as near as possible to
/// `up`.
FR_API versors fr_frame_from_heading(vec3s heading, vec3s up);
/// Rotation about a unit axis by `angle` radians.
FR_API versors fr_rotation_about(vec3s axis, float angle);
