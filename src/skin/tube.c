// Generalized cylinders: a section swept along a chain of nodes.
// Bloomenthal. Modeling the Mighty Maple. SIGGRAPH 1985.
// Orientation is carried by the smallest rotation at each half joint, which for a polyline is the
// rotation-minimizing frame of Wang, Jüttler, Zheng, Liu 2008: a tube never twists.
//
// For a round section a vertex is an affine function of its column's (x, y, u): eight floats in,
// eight floats out, the same four coefficient vectors for the whole ring.
#include "skin/tube.h"

#include "skin/bark.h"
#include "skin/collar.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

// No joint widens the ring by more than this: a mitre of 106°.
#define MITRE_MOST (1.0F / 0.6F)

/// Where a ring stands before it has a direction.
typedef struct FrStation {
    vec3s at;
    float radius, flatness;
    float v;
    uint32_t node; ///< whose frame turns it
} FrStation;

/// A ring ready to be written.
typedef struct FrRing {
    vec3s at;
    vec3s tangent, x, y;   ///< unit
    vec3s across, upwards; ///< x and y times the radii, stretched at joints
    float slope;           ///< of the radius
    float flatness;
    float v;
} FrRing;

/// What goes along a run.
typedef struct FrSweep {
    const FrPlan *plan;
    const FrRun *run;
    const FrTube *tube;
    const FrSection *section;
    FrUpAxis up;
    FrBark bark;
    vec3s heading; ///< of the band that was last, and …
    vec3s side;    ///< … the x direction carried along it; both unit
    FrRing ring;   ///< the last one written
    bool has_ring;
    uint32_t node;      ///< the next to be looked at; FR_NONE: past the end
    bool is_before_tip; ///< only the tip is left, after its shoulder
    float radius;       ///< at the node before
    float v;            ///< there
    FrVertex *vertex;
    uint32_t *index;
    uint32_t count; ///< of vertices so far, from the part's first
} FrSweep;

// ---- writing -----------------------------------------------------------------------------------

static void put(float out[3], vec3s v, FrUpAxis up) {
    v = fr_upright(v, up);
    memcpy(out, v.raw, sizeof v.raw);
}

static void set_coefficients(float out[8], vec3s position, vec3s normal, float u, float v,
                             FrUpAxis up) {
    put(out, position, up);
    put(out + 3, normal, up);
    out[6] = u;
    out[7] = v;
}

static void write_round(const FrSweep *sweep, const FrRing *ring) {
    float scale = 1.0F / sqrtf(1.0F + ring->slope * ring->slope);
    float base[8], by_x[8], by_y[8];
    set_coefficients(base, ring->at, glms_vec3_scale(ring->tangent, -ring->slope * scale),
                     sweep->bark.u, ring->v, sweep->up);
    set_coefficients(by_x, ring->across, glms_vec3_scale(ring->x, scale), 0, 0, sweep->up);
    set_coefficients(by_y, ring->upwards, glms_vec3_scale(ring->y, scale), 0, 0, sweep->up);
    const float by_u[8] = {0, 0, 0, 0, 0, 0, sweep->bark.around, 0};
    const FrColumn *column = sweep->section->columns;
    float *restrict out = (float *)sweep->vertex;
    for (uint32_t i = 0; i < sweep->section->count; i++, column++, out += 8) {
        float x = column->x, y = column->y, u = column->u;
        for (int k = 0; k < 8; k++) {
            out[k] = base[k] + x * by_x[k] + y * by_y[k] + u * by_u[k];
        }
    }
}

static vec3s profile_normal(const FrRing *ring, float x, float y) {
    vec3s normal = glms_vec3_scale(ring->tangent, -ring->slope);
    normal = glms_vec3_muladds(ring->x, x, normal);
    normal = glms_vec3_muladds(ring->y, y / MAX(ring->flatness, 1e-3F), normal);
    float length = glms_vec3_norm(normal);
    return length > 0.0F ? glms_vec3_scale(normal, 1.0F / length) : ring->x;
}

static void write_profile(const FrSweep *sweep, const FrRing *ring) {
    const FrColumn *column = sweep->section->columns;
    FrVertex *out = sweep->vertex;
    for (uint32_t i = 0; i < sweep->section->count; i++, column++, out++) {
        vec3s at = glms_vec3_muladds(ring->across, column->x, ring->at);
        put(out->position, glms_vec3_muladds(ring->upwards, column->y, at), sweep->up);
        put(out->normal, profile_normal(ring, column->normal_x, column->normal_y), sweep->up);
        out->uv[0] = sweep->bark.u + sweep->bark.around * column->u;
        out->uv[1] = ring->v;
    }
}

// Quads between the last two rings written.
static void write_band(FrSweep *sweep) {
    uint32_t columns = sweep->section->count;
    uint32_t b = sweep->count - columns, a = b - columns;
    uint32_t *restrict index = sweep->index;
    for (uint32_t i = 0; i + 1 < columns; i++, index += 6) {
        index[0] = a + i;
        index[1] = a + i + 1;
        index[2] = b + i + 1;
        index[3] = a + i;
        index[4] = b + i + 1;
        index[5] = b + i;
    }
    sweep->index = index;
}

static void ring_done(FrSweep *sweep, bool has_band) {
    sweep->vertex += sweep->section->count;
    sweep->count += sweep->section->count;
    if (has_band) {
        write_band(sweep);
    }
}

static void write_ring(FrSweep *sweep, const FrRing *ring, bool has_band) {
    if (sweep->section->is_round && ring->flatness == 1.0F) {
        write_round(sweep, ring);
    } else {
        write_profile(sweep, ring);
    }
    ring_done(sweep, has_band);
    sweep->ring = *ring;
    sweep->has_ring = true;
}

// Closes a ring: `facing` 1 towards the tip, −1 towards the base.
static void write_cap(FrSweep *sweep, const FrRing *ring, const FrVertex *rim, float facing) {
    const FrSection *section = sweep->section;
    if (!sweep->plan->detail.caps || !section->is_closed) {
        return;
    }
    const float *tile = sweep->plan->tiles[sweep->tube->slot];
    float radius = glms_vec3_norm(ring->across);
    uint32_t points = section->count - 1;
    for (uint32_t i = 0; i < points; i++) {
        FrVertex *out = &sweep->vertex[i];
        memcpy(out->position, rim[i].position, sizeof out->position);
        put(out->normal, glms_vec3_scale(ring->tangent, facing), sweep->up);
        out->uv[0] = sweep->bark.u + section->columns[i].x * radius / tile[0];
        out->uv[1] = ring->v - section->columns[i].y * radius / tile[1];
    }
    for (uint32_t i = 0; i < 3 * (points - 2); i += 3) {
        bool is_front = facing > 0.0F;
        *sweep->index++ = sweep->count + section->cap[i];
        *sweep->index++ = sweep->count + section->cap[i + (is_front ? 1 : 2)];
        *sweep->index++ = sweep->count + section->cap[i + (is_front ? 2 : 1)];
    }
    sweep->vertex += points;
    sweep->count += points;
}

// One vertex for every side, so that each keeps its own normal and its own u at the very tip.
static void write_apex(FrSweep *sweep, const FrStation *tip, float slope) {
    const FrColumn *column = sweep->section->columns;
    uint32_t sides = sweep->section->count - 1, rim = sweep->count - sweep->section->count;
    FrRing ring = sweep->ring;
    ring.slope = slope;
    for (uint32_t i = 0; i < sides; i++, column++) {
        FrVertex *out = &sweep->vertex[i];
        put(out->position, tip->at, sweep->up);
        float x = column[0].normal_x + column[1].normal_x;
        float y = column[0].normal_y + column[1].normal_y;
        float length = MAX(sqrtf(x * x + y * y), 1e-6F);
        vec3s normal = profile_normal(&ring, x / length, y / length);
        put(out->normal, normal, sweep->up);
        out->uv[0] = sweep->bark.u + sweep->bark.around * 0.5F * (column[0].u + column[1].u);
        out->uv[1] = tip->v;
        *sweep->index++ = rim + i;
        *sweep->index++ = rim + i + 1;
        *sweep->index++ = sweep->count + i;
    }
    sweep->vertex += sides;
    sweep->count += sides;
}

// ---- directions --------------------------------------------------------------------------------

// Turns `v`, which is across unit `from`, by the smallest rotation from `from` to `to`.
static vec3s carried_any(vec3s v, vec3s from, vec3s to) {
    float scale = 1.0F + glms_vec3_dot(from, to);
    if (scale < 1e-4F) {
        return v; // opposite: across the one is across the other
    }
    return glms_vec3_muladds(glms_vec3_add(from, to), -glms_vec3_dot(v, to) / scale, v);
}

// The same for a unit vector, without drifting from length 1.
static vec3s carried(vec3s v, vec3s from, vec3s to) {
    v = carried_any(v, from, to);
    float length = glms_vec3_norm(v);
    return length > 0.5F ? glms_vec3_scale(v, 1.0F / length) : v;
}

// The x direction of `frame`, made perpendicular to `tangent`.
static vec3s frame_side(versors frame, vec3s tangent) {
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
static FrRing joint_ring(FrSweep *sweep, const FrStation *station, vec3s onward, float slope) {
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
                 ? frame_side(sweep->plan->plant->nodes.frame[station->node], tangent)
                 : carried(sweep->side, sweep->heading, tangent);
    ring.y = glms_vec3_cross(tangent, ring.x);
    sweep->side = carried(ring.x, tangent, onward);
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

// ---- stations ----------------------------------------------------------------------------------

static FrStation station_at(const FrSweep *sweep, uint32_t node, float v) {
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

// The node of the tube after `from` where a ring stands, its shoulder or its last.
static FrStation next_station(FrSweep *sweep, const FrStation *from) {
    const FrTube *tube = sweep->tube;
    if (sweep->is_before_tip) {
        sweep->is_before_tip = false;
        return station_at(sweep, tube->last, sweep->v);
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
    FrStation station = station_at(sweep, node, sweep->v);
    if (node != tube->last) {
        sweep->node = fr_plan_next(sweep->plan, node);
        return station;
    }
    sweep->node = FR_NONE;
    sweep->is_before_tip = tube->has_shoulder;
    return tube->has_shoulder ? shoulder(from, &station) : station;
}

static bool is_past_end(const FrSweep *sweep) {
    return sweep->node == FR_NONE && !sweep->is_before_tip;
}

static float v_at(const FrSweep *sweep, float distance) {
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

// ---- starts ------------------------------------------------------------------------------------

// A column of a collar: where it meets the parent, and where it bends into the branch.
typedef struct FrCollarColumn {
    vec3s foot, foot_normal;
    vec3s knee;
} FrCollarColumn;

static FrCollarColumn collar_column(const FrSweep *sweep, const FrCollar *collar,
                                    const FrLimb *limb, vec3s spoke) {
    const FrPlan *plan = sweep->plan;
    if (collar->is_nested) {
        vec3s low = carried_any(spoke, collar->direction, collar->along);
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
static void write_collar(FrSweep *sweep, const FrCollar *collar, const FrRing *join) {
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
            top_normal = profile_normal(join, column->normal_x, column->normal_y);
        }
        for (uint32_t k = 0; k < collar->rings; k++) {
            float w = (float)k / (float)collar->rings;
            vec3s at = glms_vec3_scale(path.foot, (1.0F - w) * (1.0F - w));
            at = glms_vec3_muladds(path.knee, 2.0F * w * (1.0F - w), at);
            at = glms_vec3_muladds(top, w * w, at);
            vec3s normal = glms_vec3_scale(path.foot_normal, 1.0F - w);
            normal = glms_vec3_normalize(glms_vec3_muladds(top_normal, w, normal));
            FrVertex *out = &sweep->vertex[k * columns + i];
            put(out->position, at, sweep->up);
            put(out->normal, normal, sweep->up);
            out->uv[0] = sweep->bark.u + sweep->bark.around * column->u;
            out->uv[1] = join->v + per_metre * glms_vec3_distance(at, top);
        }
    }
    for (uint32_t k = 0; k < collar->rings; k++) {
        ring_done(sweep, k > 0);
    }
}

// The x direction of a branch's base: towards the parent's tip, so both halves are alike.
static vec3s branch_side(const FrSweep *sweep, const FrCollar *collar) {
    vec3s axil = glms_vec3_muladds(collar->direction,
                                   -glms_vec3_dot(collar->along, collar->direction), collar->along);
    float length = glms_vec3_norm(axil);
    if (sweep->run->follows_frames || length < 1e-2F) {
        return frame_side(sweep->plan->plant->nodes.frame[sweep->tube->first], collar->direction);
    }
    return glms_vec3_scale(axil, 1.0F / length);
}

// Writes what comes before the first station; sets `station` to it. False if the station's ring
// has been written too.
static bool start_branch(FrSweep *sweep, FrStation *station) {
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
        station->v = v_at(sweep, collar.exit_distance);
        FrRing rim = {
            .at = collar.exit,
            .tangent = collar.direction,
            .x = sweep->side,
            .y = glms_vec3_cross(collar.direction, sweep->side),
            .flatness = station->flatness,
            .v = station->v,
        };
        write_collar(sweep, &collar, &rim);
        sweep->ring = rim; // an apex may follow at once, and turns its normals by it
        return false;
    }
    fr_tube_at(plan, sweep->tube, collar.join, &station->at, &station->radius);
    station->v = v_at(sweep, collar.join);
    // The ring where the branch is clear is needed by those below it, so it is worked out twice.
    FrSweep ahead = *sweep;
    FrStation next = next_station(&ahead, station);
    vec3s onward = glms_vec3_sub(next.at, station->at);
    float length = glms_vec3_norm(onward);
    onward = length > 0.0F ? glms_vec3_scale(onward, 1.0F / length) : collar.direction;
    FrRing join = joint_ring(&ahead, station, onward, 0.0F);
    write_collar(sweep, &collar, &join);
    return true;
}

static void start_free(FrSweep *sweep, FrStation *station) {
    const FrNodes *nodes = &sweep->plan->plant->nodes;
    uint32_t node = sweep->tube->first;
    *station = station_at(sweep, node, sweep->bark.v);
    station->at = fr_tube_origin(sweep->plan, sweep->tube);
    station->radius = fr_tube_base_radius(sweep->plan, sweep->tube);
    sweep->heading = fr_frame_heading(nodes->frame[node]);
    sweep->side = frame_side(nodes->frame[node], sweep->heading);
}

// ---- sweeping ----------------------------------------------------------------------------------

static vec3s tube_end_heading(const FrSweep *sweep) {
    uint32_t next =
        sweep->tube->end == FR_END_OPEN ? fr_plan_next(sweep->plan, sweep->tube->last) : FR_NONE;
    return next == FR_NONE ? sweep->heading
                           : fr_frame_heading(sweep->plan->plant->nodes.frame[next]);
}

// Begins a tube: the first station, and what of it is written already.
static FrStation start_tube(FrSweep *sweep, bool *is_written) {
    const FrTube *tube = sweep->tube;
    FrStation station;
    *is_written = false;
    if (tube->start == FR_START_BRANCH) {
        *is_written = !start_branch(sweep, &station);
    } else if (tube->start == FR_START_JOINT && sweep->has_ring) {
        FrRing ring = sweep->ring;
        ring.v = sweep->v;
        write_ring(sweep, &ring, false);
        station = station_at(sweep, tube->from, sweep->v);
        *is_written = true;
    } else {
        start_free(sweep, &station);
    }
    return station;
}

static void sweep_stations(FrSweep *sweep) {
    const FrTube *tube = sweep->tube;
    bool is_written = false, has_slope = false;
    FrStation station = start_tube(sweep, &is_written);
    bool has_band = is_written || tube->collar_rings > 0;
    bool may_turn = !has_band && tube->start != FR_START_BRANCH;
    const FrVertex *first_rim = sweep->vertex;
    FrRing first = {0};
    float slope = 0.0F;
    bool is_tip = false;
    while (!is_past_end(sweep)) {
        FrStation next = next_station(sweep, &station);
        is_tip = is_past_end(sweep) && tube->end == FR_END_POINT;
        vec3s step = glms_vec3_sub(next.at, station.at);
        float length = glms_vec3_norm(step);
        vec3s onward = length > 0.0F ? glms_vec3_scale(step, 1.0F / length) : sweep->heading;
        float rise = (is_tip ? 0.0F : next.radius) - station.radius;
        float slope_out = length > 0.0F ? MIN(MAX(rise / length, -8.0F), 8.0F) : 0.0F;
        if (!is_written) {
            float mean = has_slope ? 0.5F * (slope + slope_out) : slope_out;
            // A free base is cut across its first internode: flat on the ground.
            vec3s halved = may_turn ? sweep->heading : onward;
            FrRing ring = joint_ring(sweep, &station, halved, mean);
            write_ring(sweep, &ring, has_band);
            first = may_turn ? ring : first;
        }
        if (is_written || may_turn) {
            sweep->side = carried(sweep->side, sweep->heading, onward);
            sweep->heading = onward;
        }
        slope = slope_out;
        has_band = has_slope = true;
        is_written = may_turn = false;
        station = next;
    }
    if (is_tip) {
        write_apex(sweep, &station, slope);
    } else {
        FrRing ring = joint_ring(sweep, &station, tube_end_heading(sweep), slope);
        write_ring(sweep, &ring, has_band);
    }
    if (tube->end == FR_END_FLAT) {
        write_cap(sweep, &sweep->ring, sweep->vertex - sweep->section->count, 1.0F);
    }
    if (tube->start == FR_START_FREE) {
        write_cap(sweep, &first, first_rim, -1.0F);
    }
}

// A ring exactly in the frame of its node, whatever the angle.
static void write_point_set(FrSweep *sweep, uint32_t node, bool has_band) {
    FrStation station = station_at(sweep, node, sweep->v);
    versors frame = sweep->plan->plant->nodes.frame[node];
    float least = fr_smallest_length(station.at, sweep->run->radius);
    float radius = MAX(station.radius, least);
    FrRing ring = {
        .at = station.at,
        .tangent = fr_frame_heading(frame),
        .x = fr_frame_left(frame),
        .y = fr_frame_up(frame),
        .flatness = station.flatness,
    };
    ring.across = glms_vec3_scale(ring.x, radius);
    ring.upwards = glms_vec3_scale(ring.y, MAX(radius * station.flatness, least));
    if (has_band) {
        float length = glms_vec3_distance(station.at, sweep->ring.at);
        float before = glms_vec3_norm(sweep->ring.across);
        ring.slope = MIN(MAX((radius - before) / MAX(length, least), -8.0F), 8.0F);
        sweep->v -= fr_bark_along(&sweep->bark, length, before, radius);
    }
    ring.v = sweep->v;
    write_ring(sweep, &ring, has_band);
}

static void sweep_point_sets(FrSweep *sweep) {
    const FrTube *tube = sweep->tube;
    const FrVertex *first_rim = sweep->vertex;
    bool has_band = tube->start == FR_START_JOINT;
    FrRing first = {0};
    if (has_band) {
        write_point_set(sweep, tube->from, false);
    }
    for (uint32_t node = tube->first;; node = fr_plan_next(sweep->plan, node)) {
        if (sweep->plan->keep[node]) {
            write_point_set(sweep, node, has_band);
            first = has_band ? first : sweep->ring;
            has_band = true;
        }
        if (node == tube->last) {
            break;
        }
    }
    if (tube->end == FR_END_FLAT) {
        write_cap(sweep, &sweep->ring, sweep->vertex - sweep->section->count, 1.0F);
    }
    if (tube->start == FR_START_FREE) {
        write_cap(sweep, &first, first_rim, -1.0F);
    }
}

// Points the sweep at a tube. Bark goes on from the tube before it in the run.
static void take_tube(FrSweep *sweep, const FrTube *tube, const FrMesh *mesh,
                      const FrMeshPart *part) {
    const FrPlan *plan = sweep->plan;
    FrBark before = sweep->bark;
    sweep->tube = tube;
    sweep->section = &plan->sections[tube->section];
    sweep->bark = fr_bark_for(plan, tube->axis, tube->slot, fr_tube_base_radius(plan, tube));
    if (tube->start == FR_START_JOINT && sweep->has_ring) {
        sweep->bark.u = before.u;
    } else {
        sweep->v = sweep->bark.v;
        sweep->has_ring = false;
    }
    sweep->node = tube->first;
    sweep->is_before_tip = false;
    sweep->radius = fr_tube_base_radius(plan, tube);
    sweep->vertex = mesh->vertices + part->first_vertex + tube->first_vertex;
    sweep->index = mesh->indices + part->first_index + tube->first_index;
    sweep->count = (uint32_t)tube->first_vertex;
}

void fr_write_run(const FrPlan *plan, const FrRun *run, FrUpAxis up, FrMesh *mesh,
                  const uint32_t *part_of, FrBox *boxes) {
    FrSweep sweep = {.plan = plan, .run = run, .up = up};
    for (uint32_t i = 0; i < run->tube_count; i++) {
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, run->first_tube + i);
        if (tube->rings == 0) {
            sweep.has_ring = false;
            continue;
        }
        const FrMeshPart *part = &mesh->parts[part_of[tube->slot]];
        take_tube(&sweep, tube, mesh, part);
        const FrVertex *vertices = sweep.vertex;
        const uint32_t *indices = sweep.index;
        if (tube->is_point_sets) {
            sweep_point_sets(&sweep);
        } else {
            sweep_stations(&sweep);
        }
        FR_ASSERT((uint64_t)(sweep.vertex - vertices) == tube->vertices);
        FR_ASSERT((uint64_t)(sweep.index - indices) == tube->indices);
        fr_box_widen(&boxes[tube->slot], vertices, tube->vertices);
    }
}
