/// @file fork.h
/// The limbs of a stem that forks.
#pragma once

#include "pgraph/stem.h"

/// Finds the limbs of a stem that has been measured but for them; leaves `limbs` NULL if it does
/// not fork. The evaluator's variables are those of the stem.
void fr_stem_fork(FrStem *stem, FrEvaluator *evaluator);
/// Leaves of the limbs what has grown up to `reach` of the stem.
void fr_stem_grow_limbs(FrStem *stem);
