/// @file timing.h
/// How long the instances of each component take to make, by a sample of them.
///
/// Every 32nd group of rows of a level, the first always, is timed component by component: the
/// clock is read wherever a row is of another component than the one before. From that follows what
/// an instance takes, and from their number all of them. What the clock itself takes is taken off,
/// and so is the time that the thread had to wait for others: it is taken from the longest stretch.
#pragma once

#include "pgraph/instance.h"

/// Of one worker.
typedef struct FrTimer {
    double *seconds;  ///< by component
    uint64_t *rows;   ///< of these, that were there
    double *grafted;  ///< s that grafts took to grow, by component, of every 8th …
    uint64_t *grafts; ///< … and how many these are
} FrTimer;

/// One group of rows on its way.
typedef struct FrLap {
    FrTimer *timer; ///< NULL: it is not timed
    uint32_t component;
    double began, worked; ///< s, of the clock and of the thread, when the group began
    double since;         ///< s
    double tick;          ///< s that reading the clock takes
    double longest;       ///< stretch of one component, s
    uint32_t longest_of;
} FrLap;

/// Timers for the workers of a build; owned by the expansion.
void fr_timing_begin(FrExpansion *expansion, int workers);
/// Frees the timers. `each` (a value a component) receives what an instance takes in seconds; what
/// was not made stays as it is.
void fr_timing_end(FrExpansion *expansion, int workers, double *each);

/// Begins a graft, the one with that number of its batch; 0: it is not timed.
double fr_graft_begin(const FrExpansion *expansion, size_t number);
/// It is there, or has failed.
void fr_graft_end(const FrExpansion *expansion, uint32_t component, int worker, double began);

/// Begins rows from `begin` on, which are `grain` at a time.
FrLap fr_lap_begin(const FrExpansion *expansion, size_t begin, size_t grain, int worker);
/// What takes time from now on is of that component; FR_NONE: of none.
void fr_lap_turn(FrLap *lap, uint32_t component);
void fr_lap_end(FrLap *lap);

/// What takes time from now on is of the instance in that row; of none if it is taken over.
static inline void fr_lap_row(FrLap *lap, const FrExpansion *expansion, uint32_t row) {
    if (lap->timer != NULL) {
        uint32_t component = expansion->level.twin[row] != FR_NONE
                                 ? FR_NONE
                                 : fr_instance_stage(expansion, row)->component;
        if (component != lap->component) {
            fr_lap_turn(lap, component);
        }
    }
}

/// The instance in that row is there; it counts once.
static inline void fr_lap_count(FrLap *lap, const FrExpansion *expansion, uint32_t row) {
    if (lap->timer != NULL && lap->component != FR_NONE && !expansion->level.is_absent[row]) {
        lap->timer->rows[lap->component]++;
    }
}
