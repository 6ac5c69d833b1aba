// Directions along a tube. The orientation is carried by the smallest rotation at each half joint,
// which for a polyline is the rotation-minimizing frame of Wang, Jüttler, Zheng, Liu 2008: a tube
// never twists.
#include "skin/sweep.h"

#include <cglm/struct.h>

#include <math.h>

// No joint widens the ring by more than this: a mitre of 106°.
#define MITRE_MOST (1.0F / 0.6F)

vec3s fr_carried_any(vec3s v, vec3s from, vec3s to) {
    float scale = 1.0F + glms_vec3_dot(from, to);
    if (scale < 1e-4F) {
        return v; // opposite: across the one is across the other
    }
    return glms_vec3_muladds(glms_vec3_add(from, to), -glms_vec3_dot(v, to) / scale, v);
}

vec3s fr_carried(vec3s v, vec3s from, vec3s to) {
    v = fr_carried_any(v, from, to);
    float length = glms_vec3_norm(v);
    return length > 0.5F ? glms_vec3_scale(v, 1.0F / length) : v;
}

vec3s fr_frame_side(versors frame, vec3s tangent) {
    vec3s side = fr_frame_left(frame);
    side = glms_vec3_muladds(tangent, -glms_vec3_dot(side, tangent), side);
    float length = glms_vec3_norm(side);
    if (length < 1e-3F) {
        vec3s up = fr_frame_up(frame);
        side = glms_vec3_muladds(tangent, -glms_vec3_dot(up, tangent), up);
        length = glms_vec3_norm(side);
    }
    return length > 0.0F ? glms_vec3_scale(side, 1.0F / length) : (vec3s){{1, 0, 0}};
}

// The ring at a joint lies in the plane that halves its angle, and is longer across the bend.
FrRing fr_joint_ring(FrSweep *sweep, const FrStation *station, vec3s onward, float slope) {
    vec3s tangent = glms_vec3_add(sweep->heading, onward);
    float sum = glms_vec3_norm(tangent);
    tangent = sum > 0.02F ? glms_vec3_scale(tangent, 1.0F / sum) : sweep->heading;
    FrRing ring = {
        .at = station->at,
        .tangent = tangent,
        .slope = slope,
        .flatness = station->flatness,
        .v = station->v,
    };
    ring.x = sweep->run->follows_frames
                 ? fr_frame_side(sweep->plan->plant->nodes.frame[station->node], tangent)
                 : fr_carried(sweep->side, sweep->heading, tangent);
    ring.y = glms_vec3_cross(tangent, ring.x);
    sweep->side = fr_carried(ring.x, tangent, onward);
    float floor_radius = fr_smallest_length(station->at, sweep->run->radius);
    float radius = MAX(station->radius, floor_radius);
    ring.across = glms_vec3_scale(ring.x, radius);
    ring.upwards = glms_vec3_scale(ring.y, MAX(radius * station->flatness, floor_radius));
    vec3s bend = glms_vec3_sub(onward, sweep->heading);
    float turn = glms_vec3_norm(bend);
    if (turn > 0.02F && sum > 0.02F) {
        bend = glms_vec3_scale(bend, 1.0F / turn);
        float extra = MIN(2.0F / sum, MITRE_MOST) - 1.0F;
        float along_x = glms_vec3_dot(ring.across, bend),
              along_y = glms_vec3_dot(ring.upwards, bend);
        ring.across = glms_vec3_muladds(bend, extra * along_x, ring.across);
        ring.upwards = glms_vec3_muladds(bend, extra * along_y, ring.upwards);
    }
    sweep->heading = onward;
    return ring;
}
