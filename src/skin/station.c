// Steps along the nodes of a tube from one ring to the next, adding up bark.
#include "skin/sweep.h"

#include <cglm/struct.h>

FrStation fr_station_at(const FrSweep *sweep, uint32_t node, float v) {
    const FrNodes *nodes = &sweep->plan->plant->nodes;
    return (FrStation){
        .at = nodes->position[node],
        .radius = nodes->radius[node],
        .flatness = nodes->flatness[node],
        .v = v,
        .node = node,
    };
}

// A blunt tip keeps its thickness until shortly before its end.
static FrStation shoulder(const FrStation *from, const FrStation *tip) {
    float part = fr_shoulder_part(from->at, tip->at, tip->radius);
    FrStation station = *tip;
    station.at = glms_vec3_muladds(glms_vec3_sub(tip->at, from->at), part, from->at);
    station.radius = from->radius + part * (tip->radius - from->radius);
    station.v = from->v + part * (tip->v - from->v);
    return station;
}

FrStation fr_next_station(FrSweep *sweep, const FrStation *from) {
    const FrTube *tube = sweep->tube;
    if (sweep->is_before_tip) {
        sweep->is_before_tip = false;
        return fr_station_at(sweep, tube->last, sweep->v);
    }
    const FrNodes *nodes = &sweep->plan->plant->nodes;
    uint32_t node = sweep->node;
    for (;;) {
        sweep->v -=
            fr_bark_along(&sweep->bark, nodes->length[node], sweep->radius, nodes->radius[node]);
        sweep->radius = nodes->radius[node];
        if (sweep->plan->keep[node] || node == tube->last) {
            break;
        }
        node = fr_plan_next(sweep->plan, node);
    }
    FrStation station = fr_station_at(sweep, node, sweep->v);
    if (node != tube->last) {
        sweep->node = fr_plan_next(sweep->plan, node);
        return station;
    }
    sweep->node = FR_NONE;
    sweep->is_before_tip = tube->has_shoulder;
    return tube->has_shoulder ? shoulder(from, &station) : station;
}

float fr_v_at(const FrSweep *sweep, float distance) {
    const FrNodes *nodes = &sweep->plan->plant->nodes;
    float v = sweep->bark.v, radius = fr_tube_base_radius(sweep->plan, sweep->tube);
    for (uint32_t node = sweep->tube->first; distance > 0.0F;
         node = fr_plan_next(sweep->plan, node)) {
        float length = nodes->length[node], part = length > distance ? distance / length : 1.0F;
        float end = radius + part * (nodes->radius[node] - radius);
        v -= fr_bark_along(&sweep->bark, part * length, radius, end);
        distance -= length;
        radius = end;
        if (node == sweep->tube->last) {
            break;
        }
    }
    return v;
}
