// Writes the rings in which a branch grows out of its parent.
#include "skin/sweep.h"

#include "skin/collar.h"

#include <cglm/struct.h>

// A column of a collar: where it meets the parent, and where it bends into the branch.
typedef struct FrCollarColumn {
    vec3s foot, foot_normal;
    vec3s knee;
} FrCollarColumn;

static FrCollarColumn collar_column(const FrSweep *sweep, const FrCollar *collar,
                                    const FrLimb *limb, vec3s spoke) {
    const FrPlan *plan = sweep->plan;
    if (collar->is_nested) {
        vec3s low = fr_carried_any(spoke, collar->direction, collar->along);
        float length = glms_vec3_norm(low);
        vec3s normal = glms_vec3_scale(low, length > 0.0F ? 1.0F / length : 0.0F);
        float scale = collar->parent_radius / MAX(collar->radius, 1e-12F);
        vec3s foot = glms_vec3_muladds(low, scale, collar->exit);
        // An elbow: where a tube along the one direction meets a tube along the other.
        vec3s middle = glms_vec3_center(low, spoke);
        float bend = MAX(0.5F + 0.5F * glms_vec3_dot(collar->direction, collar->along), 0.4F);
        vec3s knee = glms_vec3_muladds(middle, 1.0F / bend, collar->origin);
        return (FrCollarColumn){foot, normal, knee};
    }
    float flare = 1.0F + FR_COLLAR_FLARE * plan->detail.collar;
    FrCollarColumn column;
    fr_collar_foot(plan, collar, limb, glms_vec3_scale(spoke, flare), &column.foot,
                   &column.foot_normal);
    float up = MIN(fr_collar_distance(collar, spoke), 0.95F * collar->join);
    column.knee = glms_vec3_muladds(collar->direction, up, glms_vec3_add(collar->origin, spoke));
    return column;
}

// The rings of a collar lead from the parent's surface along a quadratic Bézier curve per column,
// tangent to the surface below and to the branch above.
static void fr_write_collar_rings(FrSweep *sweep, const FrCollar *collar, const FrRing *join) {
    const FrPlan *plan = sweep->plan;
    FrLimb limb;
    if (!collar->is_nested) {
        fr_limb_find(plan, sweep->tube, collar, &limb);
    }
    vec3s y = glms_vec3_cross(collar->direction, sweep->side);
    float least = fr_smallest_length(collar->exit, sweep->run->radius);
    float radius = MAX(collar->radius, least);
    float flat = plan->plant->nodes.flatness[sweep->tube->first];
    float per_metre = sweep->bark.rate / MAX(collar->radius, sweep->bark.thinnest);
    uint32_t columns = sweep->section->count;
    for (uint32_t i = 0; i < columns; i++) {
        const FrColumn *column = &sweep->section->columns[i];
        vec3s spoke = glms_vec3_scale(sweep->side, radius * column->x);
        spoke = glms_vec3_muladds(y, radius * column->y * flat, spoke);
        FrCollarColumn path = collar_column(sweep, collar, &limb, spoke);
        vec3s top = path.foot, top_normal = path.foot_normal;
        if (collar->has_join) {
            top = glms_vec3_muladds(join->across, column->x, join->at);
            top = glms_vec3_muladds(join->upwards, column->y, top);
            top_normal = fr_ring_normal(join, column->normal_x, column->normal_y);
        }
        for (uint32_t k = 0; k < collar->rings; k++) {
            float w = (float)k / (float)collar->rings;
            vec3s at = glms_vec3_scale(path.foot, (1.0F - w) * (1.0F - w));
            at = glms_vec3_muladds(path.knee, 2.0F * w * (1.0F - w), at);
            at = glms_vec3_muladds(top, w * w, at);
            vec3s normal = glms_vec3_scale(path.foot_normal, 1.0F - w);
            normal = glms_vec3_normalize(glms_vec3_muladds(top_normal, w, normal));
            FrVertex *out = &sweep->vertex[k * columns + i];
            fr_put(out->position, at, sweep->up);
            fr_put(out->normal, normal, sweep->up);
            out->uv[0] = sweep->bark.u + sweep->bark.around * column->u;
            out->uv[1] = join->v + per_metre * glms_vec3_distance(at, top);
        }
    }
    for (uint32_t k = 0; k < collar->rings; k++) {
        fr_ring_done(sweep, k > 0);
    }
}

// The x direction of a branch's base: towards the parent's tip, so both halves are alike.
static vec3s branch_side(const FrSweep *sweep, const FrCollar *collar) {
    vec3s axil = glms_vec3_muladds(collar->direction,
                                   -glms_vec3_dot(collar->along, collar->direction), collar->along);
    float length = glms_vec3_norm(axil);
    if (sweep->run->follows_frames || length < 1e-2F) {
        return fr_frame_side(sweep->plan->plant->nodes.frame[sweep->tube->first],
                             collar->direction);
    }
    return glms_vec3_scale(axil, 1.0F / length);
}

bool fr_start_branch(FrSweep *sweep, FrStation *station) {
    const FrPlan *plan = sweep->plan;
    FrCollar collar = fr_collar_find(plan, sweep->tube, sweep->section->count - 1);
    sweep->heading = collar.direction;
    sweep->side = branch_side(sweep, &collar);
    *station = (FrStation){
        .flatness = plan->plant->nodes.flatness[sweep->tube->first],
        .node = sweep->tube->first,
        .v = sweep->bark.v,
    };
    if (!collar.has_join) {
        station->at = collar.exit;
        station->radius = collar.radius;
        station->v = fr_v_at(sweep, collar.exit_distance);
        FrRing rim = {
            .at = collar.exit,
            .tangent = collar.direction,
            .x = sweep->side,
            .y = glms_vec3_cross(collar.direction, sweep->side),
            .flatness = station->flatness,
            .v = station->v,
        };
        fr_write_collar_rings(sweep, &collar, &rim);
        sweep->ring = rim; // an apex may follow at once, and turns its normals by it
        return false;
    }
    fr_tube_at(plan, sweep->tube, collar.join, &station->at, &station->radius);
    station->v = fr_v_at(sweep, collar.join);
    // The ring where the branch is clear is needed by those below it, so it is worked out twice.
    FrSweep ahead = *sweep;
    FrStation next = fr_next_station(&ahead, station);
    vec3s onward = glms_vec3_sub(next.at, station->at);
    float length = glms_vec3_norm(onward);
    onward = length > 0.0F ? glms_vec3_scale(onward, 1.0F / length) : collar.direction;
    FrRing join = fr_joint_ring(&ahead, station, onward, 0.0F);
    fr_write_collar_rings(sweep, &collar, &join);
    return true;
}
