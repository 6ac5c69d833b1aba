// Rotation-minimizing frames by double reflection.
// After: Wang, Jüttler, Zheng, Liu. Computation of rotation minimizing frames. ACM Transactions
// on Graphics 27 (1), 2008. Two reflections make one rotation, so the step is one quaternion.
#include "frond/curve.h"

#include <cglm/struct.h>

#include <math.h>

// Squared lengths below this have no direction.
#define TINY 1e-20f

versors fr_frame_transport(versors frame, vec3s point0, vec3s point1, vec3s tangent1) {
    vec3s tangent0 = fr_frame_heading(frame);
    vec3s step = glms_vec3_sub(point1, point0);
    float squared = glms_vec3_dot(step, step);
    if (!(squared > TINY)) {
        return fr_frame_step(fr_rotation_between(tangent0, tangent1), frame);
    }
    // First mirror: the plane halfway between the points, normal to the chord.
    vec3s mirror1 = glms_vec3_scale(step, 1 / sqrtf(squared));
    float reach = 2 * glms_vec3_dot(mirror1, tangent0);
    vec3s reflected = glms_vec3_sub(tangent0, glms_vec3_scale(mirror1, reach));
    // Second mirror: takes the reflected tangent to the tangent wanted.
    vec3s mirror2 = glms_vec3_sub(tangent1, reflected);
    squared = glms_vec3_dot(mirror2, mirror2);
    if (!(squared > TINY)) {
        // The frame moved sideways: mirror its y axis, which leaves the other two in place.
        vec3s side = fr_frame_up(frame);
        reach = 2 * glms_vec3_dot(mirror1, side);
        mirror2 = glms_vec3_sub(side, glms_vec3_scale(mirror1, reach));
        squared = glms_vec3_dot(mirror2, mirror2);
    }
    mirror2 = glms_vec3_scale(mirror2, 1 / sqrtf(squared));
    vec3s axis = glms_vec3_cross(mirror1, mirror2);
    versors turn = {{axis.x, axis.y, axis.z, glms_vec3_dot(mirror1, mirror2)}};
    return fr_frame_step(turn, frame);
}
