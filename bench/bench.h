/// @file bench.h
/// How a benchmark measures and tells: a rate, the work it was measured on, and what the machine
/// could do at best with the same bytes in the same run.
#pragma once

#include "frond/frond.h"

/// One measurement. `limit` is the machine's own rate for the same work, 0 where there is none.
typedef struct BenchResult {
    const char *name; ///< "plant.frames"
    double value;     ///< in `unit`
    double limit;
    const char *unit; ///< "nodes/s"
    char *work;       ///< what was done, in words and numbers
} BenchResult;

/// Adds a measurement; `value` and `limit` are rates.
void bench_tell(const char *name, double value, double limit, const char *unit,
                const char *work_format, ...) FR_PRINTF(5, 6);

double bench_now(void);
/// Processor time of all threads, s. Unlike the clock on the wall it is little disturbed by other
/// programs.
double bench_processor(void);

/// The shortest of `repeats` runs, in seconds.
double bench_shortest(int repeats, void (*run)(void *data), void *data);

/// Keeps the compiler from leaving out work whose result nobody reads.
static inline void bench_keep(const void *data) {
    __asm__ volatile("" : : "r"(data) : "memory");
}

/// The benchmarks, one a file.
void bench_plant(void);
void bench_expr(void);
void bench_pgraph(void);
void bench_growth(void);
void bench_lsystem(void);
void bench_skin(void);
void bench_rebuild(void);
void bench_variation(void);
void bench_nurbs(void);
void bench_density(void);
void bench_light(void);
void bench_io(void);
