/// @file took.h
/// How long runs of tubes take to measure and to write, by a sample of them.
///
/// Every 32nd group of runs, the first always, is timed run by run. What the clock itself takes is
/// taken off, and so is the time that the thread had to wait for others: it is taken from the
/// longest run. From the vertices of a component's runs that were timed follows what all take.
#pragma once

#include "skin/plan.h"

enum { FR_RUN_GRAIN = 16 }; // runs of a group

/// A group of runs on its way.
typedef struct FrTook {
    float *took;          ///< by run; NULL: it is not timed
    double began, worked; ///< s, of the clock and of the thread, when it began
    double since, tick;   ///< s
    float longest;        ///< s
    size_t longest_run;
} FrTook;

/// Wants to know it of a plan whose runs are found.
void fr_took_init(FrPlan *plan);
/// Begins with runs from `begin` on.
FrTook fr_took_begin(const FrPlan *plan, size_t begin);
/// That run is done; `is_new`: else it was there.
void fr_took_run(FrTook *group, size_t run, bool is_new);
void fr_took_end(FrTook *group);
