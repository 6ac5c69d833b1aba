// Rotations that take one direction to another, accurate also where the two are nearly opposite.
#include "frond/vector.h"

#include <cglm/struct.h>

#include <math.h>

// Below this sine of the angle between them two directions count as opposite.
#define OPPOSITE 1e-6f

// A unit vector perpendicular to unit `v`, made with the world axis farthest from it.
static vec3s perpendicular(vec3s v) {
    float x = fabsf(v.x), y = fabsf(v.y), z = fabsf(v.z);
    vec3s axis = x <= y && x <= z ? (vec3s){{1, 0, 0}}
                 : y <= z         ? (vec3s){{0, 1, 0}}
                                  : (vec3s){{0, 0, 1}};
    return glms_vec3_normalize(glms_vec3_cross(v, axis));
}

// The formula of the other half loses its digits here: the sine of the half angle keeps them.
static versors rotation_beyond_right_angle(vec3s from, vec3s cross, float cosine) {
    // Across so small a sine the rounding of the cross product leans towards `from`.
    vec3s axis = glms_vec3_sub(cross, glms_vec3_scale(from, glms_vec3_dot(cross, from)));
    float length = glms_vec3_norm(axis);
    if (!(length > OPPOSITE)) {
        axis = perpendicular(from);
        return (versors){{axis.x, axis.y, axis.z, 0}};
    }
    float half_sine = sqrtf(0.5f * (1 - cosine));
    axis = glms_vec3_scale(axis, half_sine / length);
    return glms_quat_normalize((versors){{axis.x, axis.y, axis.z, 0.5f * length / half_sine}});
}

versors fr_rotation_between(vec3s from, vec3s to) {
    vec3s cross = glms_vec3_cross(from, to);
    float cosine = glms_vec3_dot(from, to);
    if (cosine < 0) {
        return rotation_beyond_right_angle(from, cross, cosine);
    }
    return glms_quat_normalize((versors){{cross.x, cross.y, cross.z, 1 + cosine}});
}

versors fr_frame_from_heading(vec3s heading, vec3s up) {
    versors swing = fr_rotation_between((vec3s){{0, 0, 1}}, heading);
    vec3s left = fr_frame_left(swing);
    vec3s forward = fr_frame_up(swing);
    // A turn about the heading brings y as near to `up` as it goes.
    float along_left = glms_vec3_dot(up, left);
    float along_forward = glms_vec3_dot(up, forward);
    if (!(along_left * along_left + along_forward * along_forward > OPPOSITE * OPPOSITE)) {
        return swing;
    }
    float half_angle = 0.5f * atan2f(-along_left, along_forward);
    return fr_frame_step(swing, (versors){{0, 0, sinf(half_angle), cosf(half_angle)}});
}

versors fr_rotation_about(vec3s axis, float angle) {
    float sine = sinf(0.5f * angle);
    return (versors){{axis.x * sine, axis.y * sine, axis.z * sine, cosf(0.5f * angle)}};
}
