/// @file number.h
/// A number that may vary from child to child: a range with a function and a variance.
///
/// Text form, the value of an attribute:
///
///     45                 always 45
///     80..30             from 80 for the first child to 30 for the last
///     45 ~ 5             45 plus or minus up to 5 at random
///     80..30 ~ 5 : t^2   the range walked by a function of t, i, n, depth, x, rand() …
///     80..30 : crown     the same by a named or built-in curve of t
///     = 3 + 2*i          the value itself as an expression (short for 0..1 : 3 + 2*i)
///     45 | parent crown  times the curve at the place on the parent
///     45 ~ 5 | depth 0,1 3,0.5 | season fall      … and by more: any variable and a curve over it
///     keys 0,10 5,80     10 at age 0, 80 at age 5; `~` and `|` may follow
///     list 10 20 40      the values in turn: number i mod 3; `~` and `|` may follow
///
/// The value is `(v·C₁·C₂… + variance·r)·S`, with `v = from + f(t)·(to − from)`, the curves C over
/// variables of the instance, S over its own length (`self`), and r uniform in [−1, 1) and keyed by
/// the instance's path; clamped to the parameter's hard range, in SI units (degrees become
/// radians). What is not written is neutral.
#pragma once

#include "frond/expr.h"

/// Curves that a number is multiplied by, and its key frames.
typedef struct FrFactors FrFactors;

typedef struct FrNumber {
    double from, to, variance; ///< in the unit of the document
    FrExpr *function;          ///< owned; NULL: f(t) = t
    FrFactors *factors;        ///< owned; NULL: none
    double scale;              ///< document unit → SI: π/180 for degrees, else 1
    double min, max;           ///< hard range, in the unit of the document
    bool is_constant;          ///< then `constant` is the value for every instance
    double constant;           ///< SI
} FrNumber;

/// A constant number given in the document's unit.
FR_API FrNumber fr_number_constant(double value, double scale);
FR_API FrNumber fr_number_copy(const FrNumber *number);
FR_API void fr_number_clear(FrNumber *number);
/// Parses the text form. Wrong text leaves `number` as it was.
FR_API FrStatus fr_number_parse(FrNumber *number, const char *text, FrSpan span, double scale,
                                double min, double max, const FrScope *scope, FrDiags *diags);
/// Whether the value depends on the variable.
FR_API bool fr_number_uses(const FrNumber *number, FrVar var);
/// The digest of all that its values depend on, continued from `seed`.
FR_API FrDigest fr_number_digest(FrDigest seed, const FrNumber *number);
/// The slow path of fr_number_eval().
FR_API double fr_number_eval_varying(const FrNumber *number, FrVars *vars, uint32_t purpose,
                                     FrExprFault *fault);

/// The value for one instance, in SI units, always finite and within the hard range. Sets
/// `vars->purpose` and `vars->value[FR_VAR_v]`; `purpose` is the parameter's index in its table.
static inline double fr_number_eval(const FrNumber *number, FrVars *vars, uint32_t purpose,
                                    FrExprFault *fault) {
    return number->is_constant ? number->constant
                               : fr_number_eval_varying(number, vars, purpose, fault);
}
