// Generalized cylinders: a section swept along a chain of nodes.
// Bloomenthal. Modeling the Mighty Maple. SIGGRAPH 1985.
#include "skin/tube.h"

#include "skin/sweep.h"

#include <cglm/struct.h>

static bool is_past_end(const FrSweep *sweep) {
    return sweep->node == FR_NONE && !sweep->is_before_tip;
}

static void start_free(FrSweep *sweep, FrStation *station) {
    const FrNodes *nodes = &sweep->plan->plant->nodes;
    uint32_t node = sweep->tube->first;
    *station = fr_station_at(sweep, node, sweep->bark.v);
    station->at = fr_tube_origin(sweep->plan, sweep->tube);
    station->radius = fr_tube_base_radius(sweep->plan, sweep->tube);
    sweep->heading = fr_frame_heading(nodes->frame[node]);
    sweep->side = fr_frame_side(nodes->frame[node], sweep->heading);
}

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
        *is_written = !fr_start_branch(sweep, &station);
    } else if (tube->start == FR_START_JOINT && sweep->has_ring) {
        FrRing ring = sweep->ring;
        ring.v = sweep->v;
        fr_write_ring(sweep, &ring, false);
        station = fr_station_at(sweep, tube->from, sweep->v);
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
    FrRing first = {0};
    float slope = 0.0F;
    bool is_tip = false;
    while (!is_past_end(sweep)) {
        FrStation next = fr_next_station(sweep, &station);
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
            FrRing ring = fr_joint_ring(sweep, &station, halved, mean);
            fr_write_ring(sweep, &ring, has_band);
            first = may_turn ? ring : first;
        }
        if (is_written || may_turn) {
            sweep->side = fr_carried(sweep->side, sweep->heading, onward);
            sweep->heading = onward;
        }
        slope = slope_out;
        has_band = has_slope = true;
        is_written = may_turn = false;
        station = next;
    }
    if (is_tip) {
        fr_write_apex(sweep, &station, slope);
    } else {
        FrRing ring = fr_joint_ring(sweep, &station, tube_end_heading(sweep), slope);
        fr_write_ring(sweep, &ring, has_band);
    }
    fr_write_ends(sweep, &first);
}

// A ring exactly in the frame of its node, whatever the angle.
static void write_point_set(FrSweep *sweep, FrStation station, bool has_band) {
    versors frame = sweep->plan->plant->nodes.frame[station.node];
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
    fr_write_ring(sweep, &ring, has_band);
}

static void sweep_point_sets(FrSweep *sweep) {
    const FrTube *tube = sweep->tube;
    // The first set is where the axis begins, or the last one of the axis it goes on from.
    bool is_joint = tube->start == FR_START_JOINT;
    FrStation base = fr_station_at(sweep, is_joint ? tube->from : tube->first, sweep->v);
    base.at = fr_tube_origin(sweep->plan, tube);
    base.radius = fr_tube_base_radius(sweep->plan, tube);
    write_point_set(sweep, base, false);
    FrRing first = sweep->ring;
    for (uint32_t node = tube->first;; node = fr_plan_next(sweep->plan, node)) {
        if (sweep->plan->keep[node]) {
            write_point_set(sweep, fr_station_at(sweep, node, sweep->v), true);
        }
        if (node == tube->last) {
            break;
        }
    }
    fr_write_ends(sweep, &first);
}

// Points the sweep at a tube. Bark goes on from the tube before it in the run.
static void take_tube(FrSweep *sweep, const FrTube *tube, const FrSlab *slab) {
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
    sweep->vertex = slab->vertices + tube->first_vertex;
    sweep->index = slab->indices + tube->first_index;
    sweep->count = (uint32_t)tube->first_vertex;
}

void fr_write_run(const FrPlan *plan, const FrRun *run, FrUpAxis up, const FrSlab *slabs,
                  FrBox *boxes, FrDeformNote *notes) {
    FrSweep sweep = {.plan = plan, .run = run, .up = up};
    if (run->finish != FR_NONE) {
        const FrTube *base = &g_array_index(plan->tubes, FrTube, run->first_tube);
        sweep.finish = &g_array_index(plan->plant->finishes, FrFinish, run->finish);
        sweep.foot = fr_tube_base_radius(plan, base);
        sweep.key = plan->plant->axes.path[base->axis];
    }
    for (uint32_t i = 0; i < run->tube_count; i++) {
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, run->first_tube + i);
        FrBox *box = &boxes[run->first_tube + i];
        *box = fr_box_empty();
        if (tube->rings == 0) {
            sweep.has_ring = false;
            continue;
        }
        take_tube(&sweep, tube, &slabs[tube->slot]);
        FrVertex *vertices = sweep.vertex;
        uint32_t *indices = sweep.index;
        if (tube->is_point_sets) {
            sweep_point_sets(&sweep);
        } else {
            sweep_stations(&sweep);
        }
        FR_ASSERT((uint64_t)(sweep.vertex - vertices) == tube->vertices);
        FR_ASSERT((uint64_t)(sweep.index - indices) == tube->indices);
        if (tube->scope != FR_NONE) {
            fr_deform_vertices(plan, tube->scope, up, vertices, tube->vertices, indices,
                               tube->indices, notes);
        }
        fr_box_widen(box, vertices, tube->vertices);
    }
}
