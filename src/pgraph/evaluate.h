/// @file evaluate.h
/// Values of parameters for one instance, and what went wrong in their expressions.
#pragma once

#include "frond/number.h"

/// What becomes larger is made no larger, and is told with this code, as a fault of its scale.
#define FR_LARGEST_SCALE 1e9
#define FR_OUTGROWN "outgrown"

/// The first instance at which a parameter had no value.
typedef struct FrValueFault {
    uint32_t component, parameter;
    uint64_t instance;
    FrExprFault fault;
} FrValueFault;

/// One worker's: the variables of the instance it is at, and the faults it met.
typedef struct FrEvaluator {
    FrVars vars;
    uint32_t component;
    uint64_t instance;
    GHashTable *faults; ///< component and parameter → FrValueFault; one per worker
} FrEvaluator;

GHashTable *fr_value_faults_new(void);
/// Takes note of an expression that had no value.
void fr_value_note(FrEvaluator *evaluator, uint32_t component, uint32_t parameter,
                   const FrExprFault *fault);
/// The slow path of fr_value().
double fr_value_varying(FrEvaluator *evaluator, const FrNumber *number, uint32_t parameter);

/// A parameter's value, in SI units. A constant one costs a load.
static inline double fr_value(FrEvaluator *evaluator, const FrNumber *number, uint32_t parameter) {
    return number->is_constant ? number->constant : fr_value_varying(evaluator, number, parameter);
}
