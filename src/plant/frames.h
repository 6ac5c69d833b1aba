/// @file frames.h
/// One step of the frames pass, shared with the one-by-one builder so that both give equal bits.
#pragma once

#include "frond/plant.h"

/// `point` turned by the unit quaternion `q`.
static inline vec3s fr_turned(versors q, vec3s point) {
    // p + 2w (u × p) + 2 u × (u × p), u the imaginary part.
    float tx = 2.0f * (q.y * point.z - q.z * point.y);
    float ty = 2.0f * (q.z * point.x - q.x * point.z);
    float tz = 2.0f * (q.x * point.y - q.y * point.x);
    return (vec3s){{point.x + q.w * tx + (q.y * tz - q.z * ty),
                    point.y + q.w * ty + (q.z * tx - q.x * tz),
                    point.z + q.w * tz + (q.x * ty - q.y * tx)}};
}

/// `start` plus `length` along the z axis of `frame`.
static inline vec3s fr_advanced(vec3s start, versors frame, float length) {
    vec3s heading = fr_frame_heading(frame);
    return (vec3s){
        {start.x + length * heading.x, start.y + length * heading.y, start.z + length * heading.z}};
}

/// Brings position and frame of one node up to date from its parent's.
static inline void fr_update_frame(FrNodes *nodes, const FrAxes *axes, uint32_t node) {
    static const versors identity = {{0.0f, 0.0f, 0.0f, 1.0f}};
    uint32_t parent = nodes->parent[node];
    uint32_t axis = nodes->axis[node];
    versors frame = identity;
    vec3s start;
    if (parent != FR_NONE) {
        frame = nodes->frame[parent];
        start = nodes->position[parent];
        if (nodes->axis[parent] != axis) {
            vec3s offset = fr_turned(frame, axes->offset[axis]);
            start = (vec3s){{start.x + offset.x, start.y + offset.y, start.z + offset.z}};
        }
    } else {
        start = axes->offset[axis];
    }
    frame = fr_frame_step(frame, nodes->rotation[node]);
    nodes->frame[node] = frame;
    nodes->position[node] = fr_advanced(start, frame, nodes->length[node]);
}
