/// @file lsystem/vm.h
/// Evaluates compiled code. Values are doubles on a small stack.
#pragma once

#include "lsystem/program.h"

#define FR_LSTACK 256

/// What went wrong while evaluating. The first places are kept, in the order of the string.
typedef struct FrLfault {
    const char *code; ///< of the diagnostic; static
    uint32_t place;   ///< index of the code; with FR_LPLACE_PRODUCTION of the production
    uint64_t module;  ///< being rewritten
} FrLfault;

#define FR_LFAULTS 32
#define FR_LPLACE_PRODUCTION UINT32_C(0x80000000)
#define FR_LPLACE_AXIOM UINT32_C(0x7FFFFFFF)

typedef struct FrLrandom {
    uint64_t state; ///< 48 bits
    double spare;   ///< second value of nran()
    bool has_spare, is_seeded;
} FrLrandom;

/// A reading of numbers by a format: fscanf().
typedef struct FrLscan {
    struct FrLfile *file; ///< NULL: there is none
    const char *format;   ///< what is left of it
    uint32_t count;       ///< numbers so far
    bool has_failed, is_at_end;
} FrLscan;

/// State of an evaluation. One for each thread; impure code only runs on the first.
typedef struct FrLmachine {
    const FrLsystem *system;
    const FrLview *view;
    double *variables; ///< of the instance at work
    uint32_t *out;     ///< words that PUT writes to
    FrLrandom random;  ///< stream B
    uint64_t loops, most_loops;
    uint64_t module; ///< at work, for faults
    FrLfault faults[FR_LFAULTS];
    uint32_t fault_count;
    GPtrArray *files; ///< FrLfile *, some NULL: opened and not closed; borrowed
    FrLscan scan;
    int64_t *set_length; ///< SetDerivationLength writes here
    uint64_t length;
    bool is_stopped;  ///< by stop()
    bool is_endless;  ///< the limit of loops was reached
    FrLfault endless; ///< by which loop, at which module
    void (*print)(void *user, const char *text);
    void *print_user;
} FrLmachine;

/// Runs the code at `code` to its end; the value on top of the stack, 0 if there is none.
double fr_lmachine_run(FrLmachine *machine, uint32_t code);
/// The value of an operator of two numbers, for folding too. `is_fault` may be NULL.
double fr_lmachine_binary(FrLop op, double a, double b, bool *is_fault);
void fr_lmachine_fault(FrLmachine *machine, const char *code, uint32_t place);
/// A production of a decomposition or homomorphism would go deeper than it may.
void fr_lmachine_fault_depth(FrLmachine *machine, const char *code,
                             const FrLproduction *production);
/// Calls a built-in function that stands at `place`.
double fr_lbuiltin_call(FrLmachine *machine, uint32_t function, const double *arguments,
                        uint32_t count, uint32_t place);

// ---- the two streams of random numbers, bit for bit those of cpfg -----------------------------

#define FR_LSTREAM_START UINT64_C(0x330E)

/// The next number in [0, 1).
static inline double fr_lrandom_next(uint64_t *state) {
    *state = (UINT64_C(0x5DEECE66D) * *state + 0xB) & ((UINT64_C(1) << 48) - 1);
    return (double)*state * 0x1.0p-48;
}
/// The state after `count` more numbers.
uint64_t fr_lrandom_skip(uint64_t state, uint64_t count);
/// Seed 0 leaves the stream as it is before any seeding.
static inline uint64_t fr_lrandom_seed_a(int64_t seed) {
    return seed == 0 ? 0 : ((uint64_t)seed & 0xFFFF) | UINT64_C(155) << 32;
}
static inline uint64_t fr_lrandom_seed_b(int64_t seed) {
    return FR_LSTREAM_START | ((uint64_t)seed & 0xFFFFFFFF) << 16;
}
