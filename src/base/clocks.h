/// @file clocks.h
/// The time, for who measures how long work takes.
#pragma once

#include <time.h>

static inline double fr_clock_read(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/// Seconds that go on whatever happens.
static inline double fr_clock_now(void) {
    return fr_clock_read(CLOCK_MONOTONIC);
}

/// Seconds that this thread has worked. Asks the kernel, which takes some ten times as long and
/// slows what comes next.
static inline double fr_clock_worked(void) {
    return fr_clock_read(CLOCK_THREAD_CPUTIME_ID);
}
