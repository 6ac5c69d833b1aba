// Rotations that take one direction to another.
// The half-vector form stays accurate up to opposite directions, where cross and dot product
// both lose their digits.
#include "frond/vector.h"

#include <cglm/struct.h>

#include <math.h>

// Below this squared length of from + to the two count as opposite.
#define OPPOSITE 1e-12f

// A unit vector perpendicular to unit `v`, made with the world axis farthest from it.
static vec3s perpendicular(vec3s v) {
    float x = fabsf(v.x), y = fabsf(v.y), z = fabsf(v.z);
    vec3s axis = x <= y && x <= z ? (vec3s){{1, 0, 0}}
                 : y <= z         ? (vec3s){{0, 1, 0}}
                                  : (vec3s){{0, 0, 1}};
    return glms_vec3_normalize(glms_vec3_cross(v, axis));
}

versors fr_rotation_between(vec3s from, vec3s to) {
    vec3s half = glms_vec3_add(from, to);
    float squared = glms_vec3_dot(half, half);
    if (!(squared > OPPOSITE)) {
        vec3s axis = perpendicular(from);
        return (versors){{axis.x, axis.y, axis.z, 0}};
    }
    half = glms_vec3_scale(half, 1 / sqrtf(squared));
    vec3s axis = glms_vec3_cross(from, half);
    return (versors){{axis.x, axis.y, axis.z, glms_vec3_dot(from, half)}};
}

versors fr_frame_from_heading(vec3s heading, vec3s up) {
    versors swing = fr_rotation_between((vec3s){{0, 0, 1}}, heading);
    vec3s left = fr_frame_left(swing);
    vec3s forward = fr_frame_up(swing);
    // A turn about the heading brings y as near to `up` as it goes.
    float along_left = glms_vec3_dot(up, left);
    float along_forward = glms_vec3_dot(up, forward);
    if (!(along_left * along_left + along_forward * along_forward > OPPOSITE)) {
        return swing;
    }
    float half_angle = 0.5f * atan2f(-along_left, along_forward);
    return fr_frame_step(swing, (versors){{0, 0, sinf(half_angle), cosf(half_angle)}});
}

versors fr_rotation_about(vec3s axis, float angle) {
    float sine = sinf(0.5f * angle);
    return (versors){{axis.x * sine, axis.y * sine, axis.z * sine, cosf(0.5f * angle)}};
}
