// Instances of a tree of 100 000 internodes, beside one frames pass over the same tree.
#include "bench.h"

#include <cglm/struct.h>

enum { NODES_PER_AXIS = 20, AXES = 5000, NODES = NODES_PER_AXIS * AXES, RUNS = 10 };

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
        plant->axes.path[a] = fr_key_child(1, a);
        for (uint32_t i = first; i < first + NODES_PER_AXIS; i++) {
            nodes->parent[i] = i == first ? bearer : i - 1;
            nodes->next[i] = i + 1 < first + NODES_PER_AXIS ? i + 1 : FR_NONE;
            nodes->axis[i] = a;
            nodes->rotation[i] = bend;
            nodes->length[i] = 0.05f;
        }
    }
    fr_plant_update_frames(plant, 0);
    return plant;
}

typedef struct Work {
    FrPlant *base, *instance;
    FrVaryPlan *plan;
    uint64_t seed;
} Work;

static void frames(void *data) {
    for (int i = 0; i < RUNS; i++) {
        fr_plant_update_frames(((Work *)data)->base, 0);
    }
}

static void rewrite(void *data) {
    Work *work = data;
    for (int i = 0; i < RUNS; i++) {
        fr_vary_into(work->plan, work->seed++, work->instance);
    }
}

static void make(void *data) {
    Work *work = data;
    for (int i = 0; i < RUNS; i++) {
        fr_plant_free(fr_vary_instance(work->plan, work->seed++));
    }
}

static void measure(Work *work, const char *rewrite_name, const char *make_name, const char *what) {
    double pass = bench_shortest(10, frames, work);
    double rewritten = bench_shortest(10, rewrite, work), made = bench_shortest(10, make, work);
    bench_tell(rewrite_name, RUNS / rewritten, RUNS / pass, "instances/s",
               "%d internodes on %d axes, %s, over one before; limit: a frames pass", NODES, AXES,
               what);
    bench_tell(make_name, RUNS / made, RUNS / pass, "instances/s",
               "the same, copied from the base first; limit: a frames pass");
}

void bench_variation(void) {
    FrVaryParams params;
    fr_params_init(fr_vary_table(), &params);
    FrVary *vary = fr_vary_new(&params);
    FrContext context = fr_context_default();
    Work work = {.base = grow(), .seed = 1};
    work.instance = fr_plant_copy(work.base);
    for (int pushed = 0; pushed < 2; pushed++) {
        if (pushed == 1) {
            fr_vary_add_indicator(vary, (vec3s){{1, 0, 0}}, "", FR_APPLY_BOTH, (FrSpan){0});
        }
        FrStatus status = fr_vary_prepare(vary, work.base, &context, &work.plan);
        FR_ASSERT(status == FR_OK);
        measure(&work, pushed == 1 ? "variation.wind-over" : "variation.over",
                pushed == 1 ? "variation.wind" : "variation.instance",
                pushed == 1 ? "random turns and wind" : "random turns");
        fr_vary_plan_free(work.plan);
    }
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(work.instance);
    fr_plant_free(work.base);
}
