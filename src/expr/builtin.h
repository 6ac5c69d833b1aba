// The functions and constants every expression knows.
#pragma once

#include "frond/api.h"

#include <stdint.h>

/// What the generator makes of a call.
typedef enum FrBuiltinKind {
    FR_BUILTIN_FUNCTION,  ///< a call of `function`
    FR_BUILTIN_RANDOM,    ///< a draw, numbered by place or by argument
    FR_BUILTIN_NORMAL,    ///< the same, normally distributed
    FR_BUILTIN_SELECT,    ///< ?: as a function
    FR_BUILTIN_POWER,     ///< ^ as a function
    FR_BUILTIN_REMAINDER, ///< % as a function
    FR_BUILTIN_CURVE,     ///< a named curve
} FrBuiltinKind;

typedef struct FrBuiltin {
    const char *name;
    FrBuiltinKind kind;
    uint8_t fewest, most; ///< arguments
    double (*function)(const double *arguments, unsigned count);
} FrBuiltin;

/// No function has more arguments.
enum { FR_MOST_ARGUMENTS = 16 };

extern const FrBuiltin fr_builtins[];
extern const uint32_t fr_builtin_count;

/// pi, e or phi.
bool fr_builtin_constant(const char *name, double *value);
/// Its index in fr_builtins, or FR_NONE.
uint32_t fr_builtin_find(const char *name);

/// What % gives: like the divisor in sign, so that angles wrap evenly through 0.
double fr_remainder(double dividend, double divisor);
