// Positions and frames from local rotations and lengths.
//
// A frame depends on the one before it on its axis, so along one axis the processor mostly waits.
// Four axes that do not bear each other are therefore walked abreast, one in each lane of a vector:
// twice as fast, and, as every lane does what fr_update_frame() does, bit for bit the same. More
// lanes win nothing: then memory is what is waited for, whose next rows are asked for ahead of
// time.
#include "plant/frames.h"

#include "math/lanes.h"

#include <string.h>

// Rows asked for ahead are so many behind those at work, and asked for in every so many steps: a
// line of a cache holds four rotations.
enum { ABREAST = 4, AHEAD = 100, STEPS_PER_LINE = 4 };

typedef FrRow Lanes;

/// Nodes begin … end−1 follow each other on one axis.
typedef struct Run {
    uint32_t begin, end;
} Run;

/// Frames and tips of four nodes, a coordinate a vector.
typedef struct Abreast {
    Lanes q[4];
    Lanes tip[3];
} Abreast;

/// The next node of each lane: fr_frame_step() and fr_advanced() on vectors.
static void step(Abreast *s, const Lanes l[4], Lanes length) {
    const Lanes *p = s->q;
    Lanes x = (p[3] * l[0] + p[0] * l[3]) + (p[1] * l[2] - p[2] * l[1]);
    Lanes y = (p[3] * l[1] + p[1] * l[3]) + (p[2] * l[0] - p[0] * l[2]);
    Lanes z = (p[3] * l[2] + p[2] * l[3]) + (p[0] * l[1] - p[1] * l[0]);
    Lanes w = (p[3] * l[3] - p[0] * l[0]) - (p[1] * l[1] + p[2] * l[2]);
    Lanes scale = 1.5f - 0.5f * ((x * x + y * y) + (z * z + w * w));
    Lanes *q = s->q;
    q[0] = x * scale;
    q[1] = y * scale;
    q[2] = z * scale;
    q[3] = w * scale;
    s->tip[0] += length * (2 * (q[0] * q[2] + q[3] * q[1]));
    s->tip[1] += length * (2 * (q[1] * q[2] - q[3] * q[0]));
    s->tip[2] += length * (1 - 2 * (q[0] * q[0] + q[1] * q[1]));
}

/// Writes the node of each lane that has not passed the end of its run.
static void store(FrNodes *nodes, const Abreast *state, const Run *run, uint32_t steps) {
    Lanes frame[4] = {state->q[0], state->q[1], state->q[2], state->q[3]};
    Lanes tip[4] = {state->tip[0], state->tip[1], state->tip[2], state->tip[2]};
    fr_rows_transpose(frame);
    fr_rows_transpose(tip);
    for (int k = 0; k < ABREAST; k++) {
        uint32_t node = run[k].begin + steps;
        if (node < run[k].end) {
            memcpy(&nodes->frame[node], &frame[k], sizeof(versors));
            memcpy(&nodes->position[node], &tip[k], sizeof(vec3s));
        }
    }
}

/// The first node of each run comes from its bearer, one by one; here the lanes take over.
static void start(Abreast *state, const FrNodes *nodes, const Run *run) {
    Lanes frame[4];
    Lanes tip[4] = {0};
    for (int k = 0; k < ABREAST; k++) {
        memcpy(&frame[k], &nodes->frame[run[k].begin], sizeof(versors));
        memcpy(&tip[k], &nodes->position[run[k].begin], sizeof(vec3s));
    }
    fr_rows_transpose(frame);
    fr_rows_transpose(tip);
    memcpy(state->q, frame, sizeof state->q);
    memcpy(state->tip, tip, sizeof state->tip);
}

/// The next node of every lane, `steps` behind the beginnings of the runs.
static inline void advance(Abreast *state, FrNodes *nodes, const Run *run, uint32_t steps) {
    Lanes rotation[4];
    Lanes length;
    for (int k = 0; k < ABREAST; k++) {
        // A lane past its end works on its last node once more; that is not stored.
        uint32_t from = MIN(run[k].begin + steps, run[k].end - 1);
        memcpy(&rotation[k], &nodes->rotation[from], sizeof(versors));
        length[k] = nodes->length[from];
        if (steps % STEPS_PER_LINE == 1) {
            uint32_t later = MIN(from + AHEAD, nodes->count - 1);
            __builtin_prefetch(&nodes->rotation[later]);
            __builtin_prefetch(&nodes->frame[later], 1);
            __builtin_prefetch(&nodes->position[later], 1);
        }
    }
    fr_rows_transpose(rotation);
    step(state, rotation, length);
    store(nodes, state, run, steps);
}

/// The length of the second longest run: until there at least two lanes have work.
static uint32_t second_length(const Run run[ABREAST]) {
    uint32_t longest = 0;
    uint32_t second = 0;
    for (int k = 0; k < ABREAST; k++) {
        uint32_t length = run[k].end - run[k].begin;
        second = MAX(second, MIN(length, longest));
        longest = MAX(longest, length);
    }
    return second;
}

/// Four runs whose bearers are done.
static void walk_abreast(FrPlant *plant, const Run run[ABREAST]) {
    FrNodes *nodes = &plant->nodes;
    for (int k = 0; k < ABREAST; k++) {
        fr_update_frame(nodes, &plant->axes, run[k].begin);
    }
    Abreast state;
    start(&state, nodes, run);
    uint32_t steps = second_length(run);
    for (uint32_t s = 1; s < steps; s++) {
        advance(&state, nodes, run, s);
    }
    for (int k = 0; k < ABREAST; k++) {
        for (uint32_t i = run[k].begin + steps; i < run[k].end; i++) {
            fr_update_frame(nodes, &plant->axes, i);
        }
    }
}

static Run run_from(const FrNodes *nodes, uint32_t begin) {
    uint32_t end = begin + 1;
    while (end < nodes->count && nodes->next[end - 1] == end) {
        end++;
    }
    return (Run){begin, end};
}

void fr_plant_update_frames(FrPlant *plant, uint32_t first) {
    FrNodes *nodes = &plant->nodes;
    Run run[ABREAST];
    int count = 0;
    for (uint32_t i = first; i < nodes->count;) {
        Run next = run_from(nodes, i);
        uint32_t bearer = nodes->parent[i];
        if (count > 0 && bearer != FR_NONE && bearer >= run[0].begin) {
            // Borne by one of those that wait: these first, one after the other.
            for (uint32_t k = run[0].begin; k < i; k++) {
                fr_update_frame(nodes, &plant->axes, k);
            }
            count = 0;
        }
        run[count++] = next;
        i = next.end;
        if (count == ABREAST) {
            walk_abreast(plant, run);
            count = 0;
        }
    }
    for (uint32_t k = count > 0 ? run[0].begin : nodes->count; k < nodes->count; k++) {
        fr_update_frame(nodes, &plant->axes, k);
    }
}

vec3s fr_plant_axis_origin(const FrPlant *plant, uint32_t axis) {
    uint32_t bearer = plant->axes.bearer[axis];
    vec3s offset = plant->axes.offset[axis];
    if (bearer == FR_NONE) {
        return offset;
    }
    vec3s tip = plant->nodes.position[bearer];
    offset = fr_turned(plant->nodes.frame[bearer], offset);
    return (vec3s){{tip.x + offset.x, tip.y + offset.y, tip.z + offset.z}};
}

void fr_plant_organ_pose(const FrPlant *plant, uint32_t organ, vec3s *position, versors *rotation) {
    uint32_t node = plant->organs.node[organ];
    vec3s offset = plant->organs.offset[organ];
    if (node == FR_NONE) {
        *position = offset;
        *rotation = plant->organs.rotation[organ];
        return;
    }
    versors frame = plant->nodes.frame[node];
    vec3s tip = plant->nodes.position[node];
    offset = fr_turned(frame, offset);
    *position = (vec3s){{tip.x + offset.x, tip.y + offset.y, tip.z + offset.z}};
    *rotation = fr_frame_step(frame, plant->organs.rotation[organ]);
}
