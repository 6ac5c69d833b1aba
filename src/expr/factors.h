// What makes a number vary beside its range: curves it is multiplied by, key frames.
#pragma once

#include "expr/param_value.h"

enum { FR_MOST_LISTED = 64 };

/// Reads the clauses of a number behind its first `|`, which stand in `value`. NULL if wrong.
FrFactors *fr_factors_read(const FrValueText *value);
/// Adds key frames. False if their text is wrong.
bool fr_factors_read_keys(FrFactors **factors, const FrValueText *value);
/// Values that come in turn, at least one.
FrFactors *fr_factors_of_list(const double *values, uint32_t count);
/// Shares the key frames and the list of another.
void fr_factors_take_keys(FrFactors *factors, const FrFactors *other);
FrFactors *fr_factors_ref(FrFactors *factors);
void fr_factors_unref(FrFactors *factors);
/// The value of the key frames at this age, or of the list; false if there are neither.
bool fr_factors_key(const FrFactors *factors, const FrVars *vars, double *value);
/// The product of the curves along the component itself, or of all others.
double fr_factors_product(const FrFactors *factors, const FrVars *vars, bool is_along_itself);
/// True if they are the same for every instance.
bool fr_factors_are_fixed(const FrFactors *factors);
bool fr_factors_use(const FrFactors *factors, FrVar var);
/// Of all curves and what they are over.
FrDigest fr_factors_digest(FrDigest seed, const FrFactors *factors);
