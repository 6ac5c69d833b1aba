/// @file flags.h
/// Iteration flags: for which iterations of a multiplier a component is made.
///
///     all   2,13   !2,13   odd   even   first   last   0..4   %3=1
///
/// A list is a union of terms; an exclamation mark before it turns it round. Iterations count
/// from 0, also in lists; those left out keep their place (X1, X2 of the paper's exceptions).
#pragma once

#include "frond/diag.h"

/// Iterations from … to, both inclusive.
typedef struct FrFlagRange {
    uint32_t from, to;
} FrFlagRange;

/// Iterations i with i mod step = rest.
typedef struct FrFlagRest {
    uint32_t step, rest;
} FrFlagRest;

typedef struct FrFlags {
    GArray *ranges; ///< FrFlagRange, sorted and apart; NULL if none
    GArray *rests;  ///< FrFlagRest; NULL if none
    bool has_last;  ///< lists the last iteration, whatever its number
    bool is_inverted;
    bool is_all; ///< every iteration: nothing to ask
} FrFlags;

/// `text` NULL or empty is all. `what` names the component in the error "wrong-flags".
FrStatus fr_flags_parse(FrFlags *flags, const char *text, const char *what, FrSpan span,
                        FrDiags *diags);
void fr_flags_clear(FrFlags *flags);
/// Whether iteration i of n is made.
bool fr_flags_allow(const FrFlags *flags, uint32_t i, uint32_t n);
/// How many of n iterations are made.
uint32_t fr_flags_count(const FrFlags *flags, uint32_t n);
