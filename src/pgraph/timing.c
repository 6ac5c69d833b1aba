#include "pgraph/timing.h"

#include "base/clocks.h"

enum { EVERY = 32, EVERY_GRAFT = 8, TRIES = 16 };

static const double no_wait = 5e-6; // s that the two clocks may differ by

void fr_timing_begin(FrExpansion *expansion, int workers) {
    uint32_t components = MAX(fr_pgraph_count(expansion->graph), 1);
    expansion->timers = g_new(FrTimer, workers);
    for (int worker = 0; worker < workers; worker++) {
        expansion->timers[worker] =
            (FrTimer){g_new0(double, components), g_new0(uint64_t, components),
                      g_new0(double, components), g_new0(uint64_t, components)};
    }
    double began = fr_clock_now();
    for (int i = 1; i < TRIES; i++) {
        fr_clock_now();
    }
    expansion->tick = (fr_clock_now() - began) / TRIES;
}

void fr_timing_end(FrExpansion *expansion, int workers, double *each) {
    for (uint32_t c = 0; c < fr_pgraph_count(expansion->graph); c++) {
        double seconds = 0, grafted = 0;
        uint64_t rows = 0, grafts = 0;
        for (int worker = 0; worker < workers; worker++) {
            seconds += expansion->timers[worker].seconds[c];
            rows += expansion->timers[worker].rows[c];
            grafted += expansion->timers[worker].grafted[c];
            grafts += expansion->timers[worker].grafts[c];
        }
        each[c] = rows > 0 ? MAX(seconds, 0) / (double)rows : each[c];
        each[c] += grafts > 0 ? grafted / (double)grafts : 0;
    }
    for (int worker = 0; worker < workers; worker++) {
        g_free(expansion->timers[worker].seconds);
        g_free(expansion->timers[worker].rows);
        g_free(expansion->timers[worker].grafted);
        g_free(expansion->timers[worker].grafts);
    }
    g_clear_pointer(&expansion->timers, g_free);
}

double fr_graft_begin(const FrExpansion *expansion, size_t number) {
    return expansion->timers != NULL && number % EVERY_GRAFT == 0 ? fr_clock_worked() : 0;
}

void fr_graft_end(const FrExpansion *expansion, uint32_t component, int worker, double began) {
    if (began > 0) {
        expansion->timers[worker].grafted[component] += fr_clock_worked() - began;
        expansion->timers[worker].grafts[component]++;
    }
}

FrLap fr_lap_begin(const FrExpansion *expansion, size_t begin, size_t grain, int worker) {
    FrLap lap = {.component = FR_NONE, .longest_of = FR_NONE};
    if (expansion->timers != NULL && begin / grain % EVERY == 0) {
        lap.timer = &expansion->timers[worker];
        lap.tick = expansion->tick;
        lap.worked = fr_clock_worked();
        lap.began = lap.since = fr_clock_now();
    }
    return lap;
}

void fr_lap_turn(FrLap *lap, uint32_t component) {
    double time = fr_clock_now();
    if (lap->component != FR_NONE) {
        double took = time - lap->since - lap->tick;
        lap->timer->seconds[lap->component] += took;
        if (took > lap->longest) {
            lap->longest = took;
            lap->longest_of = lap->component;
        }
    }
    lap->component = component;
    lap->since = time;
}

void fr_lap_end(FrLap *lap) {
    if (lap->timer == NULL) {
        return;
    }
    fr_lap_turn(lap, FR_NONE);
    double waited = lap->since - lap->began - (fr_clock_worked() - lap->worked);
    if (waited > no_wait && lap->longest_of != FR_NONE) {
        lap->timer->seconds[lap->longest_of] -= MIN(waited, lap->longest);
    }
}
