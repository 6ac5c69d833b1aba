// Rotation-minimizing frames by double reflection.
// After: Wang, Jüttler, Zheng, Liu. Computation of rotation minimizing frames. ACM Transactions
// on Graphics 27 (1), 2008. Two reflections make one rotation, so the step is one quaternion.
#include "frond/curve.h"

#include <cglm/struct.h>

#include <math.h>

// Squared lengths below these have no direction that rounding would not decide.
#define SHORTEST_STEP 1e-20f
#define SHORTEST_MIRROR 1e-10f

versors fr_frame_transport(versors frame, vec3s point0, vec3s point1, vec3s tangent1) {
    vec3s tangent0 = fr_frame_heading(frame);
    vec3s step = glms_vec3_sub(point1, point0);
    float squared = glms_vec3_dot(step, step);
    if (!(squared > SHORTEST_STEP)) {
        return fr_frame_step(fr_rotation_between(tangent0, tangent1), frame);
    }
    // First mirror: the plane halfway between the points, normal to the chord.
    vec3s mirror1 = glms_vec3_scale(step, 1 / sqrtf(squared));
    float reach = 2 * glms_vec3_dot(mirror1, tangent0);
    vec3s reflected = glms_vec3_sub(tangent0, glms_vec3_scale(mirror1, reach));
    // Second mirror: takes the reflected tangent to the tangent wanted.
    vec3s mirror2 = glms_vec3_sub(tangent1, reflected);
    squared = glms_vec3_dot(mirror2, mirror2);
    if (!(squared > SHORTEST_MIRROR)) {
        // A step sideways, of which the method can make any turn: take the smallest.
        return fr_frame_step(fr_rotation_between(tangent0, tangent1), frame);
    }
    mirror2 = glms_vec3_scale(mirror2, 1 / sqrtf(squared));
    vec3s axis = glms_vec3_cross(mirror1, mirror2);
    versors turn = {{axis.x, axis.y, axis.z, glms_vec3_dot(mirror1, mirror2)}};
    return fr_frame_step(turn, frame);
}
