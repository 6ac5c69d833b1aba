#include "skin/took.h"

#include "base/clocks.h"
#include "skin/kept_state.h"

#include <math.h>
#include <string.h>

enum { EVERY = 32, TRIES = 8 };

static const double no_wait = 5e-6; // s that the two clocks may differ by

void fr_took_init(FrPlan *plan) {
    plan->took = g_new0(float, (size_t)plan->runs->len + 1);
    double last = fr_clock_now(), tick = INFINITY; // the least: others may come between
    for (int i = 0; i < TRIES; i++) {
        double now = fr_clock_now();
        tick = fmin(tick, now - last);
        last = now;
    }
    plan->tick = tick;
}

FrTook fr_took_begin(const FrPlan *plan, size_t begin) {
    FrTook group = {.tick = plan->tick};
    if (plan->took != NULL && begin / FR_RUN_GRAIN % EVERY == 0) {
        group.took = plan->took;
        group.worked = fr_clock_worked();
        group.began = group.since = fr_clock_now();
    }
    return group;
}

void fr_took_run(FrTook *group, size_t run, bool is_new) {
    if (group->took == NULL) {
        return;
    }
    double now = fr_clock_now();
    float took = (float)fmax(now - group->since - group->tick, 0);
    if (is_new) {
        group->took[run] += took;
    }
    if (is_new && took > group->longest) {
        group->longest = took;
        group->longest_run = run;
    }
    group->since = now;
}

void fr_took_end(FrTook *group) {
    if (group->took == NULL) {
        return;
    }
    double waited = group->since - group->began - (fr_clock_worked() - group->worked);
    if (waited > no_wait) {
        group->took[group->longest_run] -= fminf((float)waited, group->longest);
    }
}

// What is known of a component.
typedef struct Share {
    uint64_t vertices, timed; ///< of all its runs; of those that were timed
    double seconds;           ///< of these
} Share;

static void add_run(Share *share, const FrPlan *plan, uint32_t run) {
    const FrRun *tubes = &g_array_index(plan->runs, FrRun, run);
    uint64_t vertices = 0;
    for (uint32_t k = 0; k < tubes->tube_count; k++) {
        vertices += g_array_index(plan->tubes, FrTube, tubes->first_tube + k).vertices;
    }
    share->vertices += vertices;
    if (plan->took[run] > 0) {
        share->timed += vertices;
        share->seconds += (double)plan->took[run];
    }
}

void fr_skin_seconds(const FrSkin *skin, const FrPlant *plant, double *seconds) {
    guint components = plant->components->len;
    memset(seconds, 0, components * sizeof *seconds);
    if (skin->state == NULL) {
        return;
    }
    const FrPlan *plan = &skin->state->job.wood->plan;
    Share *shares = g_new0(Share, (size_t)components + 1), all = {0};
    for (uint32_t i = 0; i < plan->runs->len; i++) {
        const FrRun *run = &g_array_index(plan->runs, FrRun, i);
        uint32_t axis = g_array_index(plan->tubes, FrTube, run->first_tube).axis;
        uint32_t component = plant->axes.component[axis];
        add_run(&shares[MIN(component, components)], plan, i);
        add_run(&all, plan, i);
    }
    double usual = all.timed > 0 ? all.seconds / (double)all.timed : 0;
    for (guint c = 0; c < components; c++) {
        double each = shares[c].timed > 0 ? shares[c].seconds / (double)shares[c].timed : usual;
        seconds[c] = each * (double)shares[c].vertices;
    }
    g_free(shares);
}
