// Passes over ten million internodes, beside plain loops over the columns they read and write.
#include "bench.h"

#include <cglm/struct.h>

enum { NODES_PER_AXIS = 20, AXES = 500000, NODES = NODES_PER_AXIS * AXES };

/// A plant as a p-graph makes it: axes one after the other, each borne by one of four times fewer
/// that came before.
static FrPlant *grow(void) {
    FrPlant *plant = fr_plant_new("bench");
    fr_plant_append_nodes(plant, NODES);
    fr_plant_append_axes(plant, AXES);
    FrNodes *nodes = &plant->nodes;
    versors bend = glms_quatv(0.05f, (vec3s){{0.6f, 0.8f, 0.0f}});
    for (uint32_t a = 0; a < AXES; a++) {
        uint32_t first = a * NODES_PER_AXIS;
        uint32_t bearer = a == 0 ? FR_NONE : (a - 1) / 4 * NODES_PER_AXIS + 4 * (a % 4) + 3;
        plant->axes.first[a] = first;
        plant->axes.last[a] = first + NODES_PER_AXIS - 1;
        plant->axes.bearer[a] = bearer;
        for (uint32_t i = first; i < first + NODES_PER_AXIS; i++) {
            nodes->parent[i] = i == first ? bearer : i - 1;
            nodes->next[i] = i + 1 < first + NODES_PER_AXIS ? i + 1 : FR_NONE;
            nodes->axis[i] = a;
            nodes->rotation[i] = bend;
            nodes->length[i] = 0.05f;
        }
    }
    return plant;
}

typedef struct Passes {
    FrPlant *plant;
    FrPlant *thinned; ///< a copy whose every eleventh axis is shed
    uint32_t *order;
} Passes;

static void frames(void *data) {
    fr_plant_update_frames(((Passes *)data)->plant, 0);
}

/// Reads and writes what the frames pass does, without thinking.
static void plain_frames(void *data) {
    FrNodes *nodes = &((Passes *)data)->plant->nodes;
    for (uint32_t i = 0; i < NODES; i++) {
        float shift = nodes->length[i] + (float)nodes->next[i];
        versors q = nodes->rotation[i];
        nodes->frame[i] = (versors){{q.x + shift, q.y + shift, q.z + shift, q.w + shift}};
        nodes->position[i] = (vec3s){{shift, shift + q.x, shift + q.y}};
    }
}

static void strahler(void *data) {
    Passes *passes = data;
    fr_plant_strahler(passes->plant, passes->order);
}

static void weibel(void *data) {
    Passes *passes = data;
    fr_plant_weibel(passes->plant, passes->order);
}

/// The plainest loop of the kind: how many internodes each one bears.
static void plain_order(void *data) {
    Passes *passes = data;
    const uint32_t *parent = passes->plant->nodes.parent;
    for (uint32_t i = 0; i < NODES; i++) {
        passes->order[i] = 1;
    }
    for (uint32_t i = NODES; i-- > 1;) {
        passes->order[parent[i]] += passes->order[i];
    }
    bench_keep(passes->order);
}

static void pipes(void *data) {
    fr_plant_pipe_radii(((Passes *)data)->plant, 2.49, 0.001);
}

static void plain_pipes(void *data) {
    Passes *passes = data;
    FrNodes *nodes = &passes->plant->nodes;
    double *sum = g_new0(double, NODES);
    for (uint32_t i = 0; i < NODES; i++) {
        sum[i] += (double)nodes->parent[i];
        nodes->radius[i] = (float)sum[i];
    }
    bench_keep(sum);
    g_free(sum);
}

static void bounds(void *data) {
    vec3s min;
    vec3s max;
    fr_plant_bounds(((Passes *)data)->plant, &min, &max);
    bench_keep(&max);
}

static void plain_bounds(void *data) {
    const FrNodes *nodes = &((Passes *)data)->plant->nodes;
    float sum[3] = {0};
    uint32_t mark = 0;
    for (uint32_t i = 0; i < NODES; i++) {
        for (int k = 0; k < 3; k++) {
            sum[k] += nodes->position[i].raw[k];
        }
        mark |= nodes->flags[i] | nodes->axis[i];
    }
    bench_keep(sum);
    bench_keep(&mark);
}

static void digest(void *data) {
    FrDigest value = fr_plant_digest(((Passes *)data)->plant);
    bench_keep(&value);
}

static void compact(void *data) {
    Passes *passes = data;
    for (uint32_t a = 0; a < passes->thinned->axes.count; a += 11) {
        passes->thinned->axes.flags[a] |= a > 0 ? FR_SHED : 0;
    }
    fr_plant_compact(passes->thinned);
}

static void tell(const char *name, double seconds, double plain, int bytes) {
    bench_tell(name, NODES / seconds, plain > 0 ? NODES / plain : 0, "nodes/s",
               "%d internodes on %d axes, %d bytes each; limit: a plain loop over these bytes",
               NODES, AXES, bytes);
}

void bench_plant(void) {
    double start = bench_now();
    Passes passes = {.plant = grow()};
    double grown = bench_now() - start;
    bench_tell("plant.append", NODES / grown, 0, "nodes/s",
               "%d internodes in one block of fresh memory, then five columns filled", NODES);
    passes.order = g_new0(uint32_t, NODES);
    tell("plant.frames", bench_shortest(5, frames, &passes),
         bench_shortest(5, plain_frames, &passes), 4 + 16 + 4 + 12 + 16);
    frames(&passes);
    tell("plant.strahler", bench_shortest(5, strahler, &passes),
         bench_shortest(5, plain_order, &passes), 4 + 4);
    tell("plant.weibel", bench_shortest(5, weibel, &passes),
         bench_shortest(5, plain_order, &passes), 4 + 4);
    tell("plant.pipe-radii", bench_shortest(3, pipes, &passes),
         bench_shortest(3, plain_pipes, &passes), 4 + 8 + 4);
    tell("plant.bounds", bench_shortest(5, bounds, &passes),
         bench_shortest(5, plain_bounds, &passes), 12 + 2 + 4);
    tell("plant.digest", bench_shortest(3, digest, &passes), 0, 44);
    passes.thinned = fr_plant_copy(passes.plant);
    tell("plant.compact", bench_shortest(1, compact, &passes), 0, 72);
    fr_plant_free(passes.thinned);
    fr_plant_free(passes.plant);
    g_free(passes.order);
}
