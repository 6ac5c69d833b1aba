// The compiled form: instructions for a stack machine whose top is kept in a register.
#pragma once

#include "frond/expr.h"

/// Instructions. `top` is the register, `next` the value below it; a binary operation takes both
/// and leaves its result in top. _C and _V take their right operand from the constants or the
/// variables instead; _REVERSED ones their left operand.
#define FR_OPS(X)                                                                                  \
    X(END)                                                                                         \
    X(CONSTANT)                                                                                    \
    X(VARIABLE)                                                                                    \
    X(EXTRA)                                                                                       \
    X(SLOT)  /* a value further down the stack */                                                  \
    X(SLIDE) /* removes values below the top */                                                    \
    X(SWAP)                                                                                        \
    X(ADD)                                                                                         \
    X(ADD_C)                                                                                       \
    X(ADD_V)                                                                                       \
    X(SUBTRACT)                                                                                    \
    X(SUBTRACT_C)                                                                                  \
    X(SUBTRACT_V)                                                                                  \
    X(SUBTRACT_REVERSED_C)                                                                         \
    X(SUBTRACT_REVERSED_V)                                                                         \
    X(MULTIPLY)                                                                                    \
    X(MULTIPLY_C)                                                                                  \
    X(MULTIPLY_V)                                                                                  \
    X(DIVIDE)                                                                                      \
    X(DIVIDE_C)                                                                                    \
    X(DIVIDE_V)                                                                                    \
    X(DIVIDE_REVERSED_C)                                                                           \
    X(DIVIDE_REVERSED_V)                                                                           \
    X(REMAINDER)                                                                                   \
    X(POWER)                                                                                       \
    X(SQUARE)                                                                                      \
    X(CUBE)                                                                                        \
    X(LESS)                                                                                        \
    X(LESS_EQUAL)                                                                                  \
    X(GREATER)                                                                                     \
    X(GREATER_EQUAL)                                                                               \
    X(EQUAL)                                                                                       \
    X(NOT_EQUAL)                                                                                   \
    X(NEGATE)                                                                                      \
    X(NOT)                                                                                         \
    X(TRUTH)                                                                                       \
    X(JUMP)                                                                                        \
    X(JUMP_IF_ZERO) /* takes the top */                                                            \
    X(CALL)                                                                                        \
    X(CURVE)                                                                                       \
    X(RANDOM)                                                                                      \
    X(RANDOM_AT) /* draw numbered by the top */                                                    \
    X(NORMAL)                                                                                      \
    X(NORMAL_AT)

typedef enum FrOp {
#define FR_OP_ID(name) FR_OP_##name,
    FR_OPS(FR_OP_ID)
#undef FR_OP_ID
        FR_OP_COUNT
} FrOp;

typedef struct FrInstruction {
    uint8_t op;        ///< FrOp
    uint8_t count;     ///< arguments of a CALL
    uint16_t argument; ///< index of what it works on, or where it jumps
} FrInstruction;

/// Values the evaluation stack holds; checked while code is made.
enum { FR_STACK_SIZE = 256 };

_Static_assert(sizeof(FrInstruction) == 4, "instructions are hashed as bytes");

struct FrExpr {
    gint references;
    FrInstruction *code;
    FrSpan *spans; ///< one per instruction
    double *constants;
    FrCurve **curves; ///< owned references
    FrSource **sources;
    uint32_t code_count, constant_count, curve_count, source_count;
    uint32_t variables; ///< bit FrVar is set if it is used
    bool is_random, uses_extra;
    char *text;
};

_Static_assert(FR_VAR_COUNT <= 32, "a bit for every variable");

/// The result of an operation on two numbers, or one: may be NaN or infinite.
double fr_operate(FrOp op, double left, double right);
