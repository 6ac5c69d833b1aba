// Code to value. Each instruction ends by jumping straight to the next one's label (threaded code,
// Bell 1973), which gives the processor a branch to predict per instruction instead of one in all.
// The check of each result costs a well predicted branch and nothing on the critical path.
#include "expr/builtin.h"
#include "expr/code.h"

#include <float.h>
#include <math.h>

static bool is_finite(double value) {
    return fabs(value) <= DBL_MAX;
}

double fr_operate(FrOp op, double left, double right) {
    switch (op) {
    case FR_OP_ADD:
        return left + right;
    case FR_OP_SUBTRACT:
        return left - right;
    case FR_OP_MULTIPLY:
        return left * right;
    case FR_OP_DIVIDE:
        return left / right;
    case FR_OP_REMAINDER:
        return fr_remainder(left, right);
    case FR_OP_POWER:
        return pow(left, right);
    case FR_OP_LESS:
        return left < right;
    case FR_OP_LESS_EQUAL:
        return left <= right;
    case FR_OP_GREATER:
        return left > right;
    case FR_OP_GREATER_EQUAL:
        return left >= right;
    case FR_OP_EQUAL:
        return left == right;
    case FR_OP_NOT_EQUAL:
        return left != right;
    case FR_OP_NEGATE:
        return -left;
    case FR_OP_NOT:
        return left == 0;
    case FR_OP_TRUTH:
        return left != 0;
    default:
        return NAN;
    }
}

static const char *fault_code(FrOp op, double left, double right, double result) {
    bool divides = op == FR_OP_DIVIDE || op == FR_OP_REMAINDER;
    if ((divides && right == 0) || (op == FR_OP_POWER && left == 0 && right < 0)) {
        return "division-by-zero";
    }
    return isnan(result) ? "not-a-number" : "overflow";
}

// The neutral value of an operation that has none, and a note of which it was.
__attribute__((noinline, cold)) static double fault(const FrExpr *expr, const FrInstruction *at,
                                                    FrOp op, double left, double right,
                                                    double result, FrExprFault *out) {
    if (out != NULL && out->code == NULL) {
        out->code = fault_code(op, left, right, result);
        out->span = expr->spans[at - expr->code];
    }
    return 0;
}

// The key of a numbered draw; any number is a number.
static FrKey numbered(FrKey key, double number) {
    double whole = floor(number);
    return fr_key_child(key, fabs(whole) < 0x1p62 ? (uint64_t)(int64_t)whole : 0);
}

double fr_expr_eval(const FrExpr *expr, const FrVars *vars, FrExprFault *out) {
    return fr_expr_eval_with(expr, vars, NULL, out);
}

// Long because it is the interpreter: one short paragraph per instruction.
double fr_expr_eval_with(const FrExpr *expr, const FrVars *vars, const double *extra,
                         FrExprFault *out) {
    static const void *const labels[] = {
#define LABEL(name) &&do_##name,
        FR_OPS(LABEL)
#undef LABEL
    };
    double stack[FR_STACK_SIZE];
    double *below = stack; // where the top goes when something is put on it
    double top = 0;
    const FrInstruction *at = expr->code;
    const double *constants = expr->constants;
    const double *variables = vars->value;

// The empty statement differs from place to place, which keeps gcc from folding the jumps of all
// instructions back into one that no processor predicts.
#define NEXT                                                                                       \
    do {                                                                                           \
        at++;                                                                                      \
        __asm__ volatile("" : : "i"(__COUNTER__));                                                 \
        goto *labels[at->op];                                                                      \
    } while (0)
#define PUSH(value)                                                                                \
    do {                                                                                           \
        *below++ = top;                                                                            \
        top = (value);                                                                             \
    } while (0)
// A result that may have no value.
#define CHECKED(op_, left_, right_, result)                                                        \
    do {                                                                                           \
        FrOp op = (op_);                                                                           \
        double left = (left_), right = (right_), value = (result);                                 \
        (void)right;                                                                               \
        top = is_finite(value) ? value : fault(expr, at, op, left, right, value, out);             \
    } while (0)
// The three forms of an operation.
#define BINARY(name, sign)                                                                         \
    do_##name : CHECKED(FR_OP_##name, *--below, top, left sign right);                             \
    NEXT;                                                                                          \
    do_##name##_C : CHECKED(FR_OP_##name, top, constants[at->argument], left sign right);          \
    NEXT;                                                                                          \
    do_##name##_V : CHECKED(FR_OP_##name, top, variables[at->argument], left sign right);          \
    NEXT;
#define REVERSED(name, sign)                                                                       \
    do_##name##_REVERSED_C : CHECKED(FR_OP_##name, constants[at->argument], top, left sign right); \
    NEXT;                                                                                          \
    do_##name##_REVERSED_V : CHECKED(FR_OP_##name, variables[at->argument], top, left sign right); \
    NEXT;
#define COMPARE(name, sign)                                                                        \
    do_##name : top = *--below sign top;                                                           \
    NEXT;

    goto *labels[at->op];
    // clang-format off
    BINARY(ADD, +)
    BINARY(SUBTRACT, -)
    BINARY(MULTIPLY, *)
    BINARY(DIVIDE, /)
    REVERSED(SUBTRACT, -)
    REVERSED(DIVIDE, /)
    COMPARE(LESS, <)
    COMPARE(LESS_EQUAL, <=)
    COMPARE(GREATER, >)
    COMPARE(GREATER_EQUAL, >=)
    COMPARE(EQUAL, ==)
    COMPARE(NOT_EQUAL, !=)
    // clang-format on

do_CONSTANT:
    PUSH(constants[at->argument]);
    NEXT;
do_VARIABLE:
    PUSH(variables[at->argument]);
    NEXT;
do_EXTRA:
    PUSH(extra[at->argument]);
    NEXT;
do_SLOT:
    *below++ = top;
    top = stack[at->argument];
    NEXT;
do_SLIDE:
    below -= at->argument;
    NEXT;
do_SWAP : {
    double under = below[-1];
    below[-1] = top;
    top = under;
    NEXT;
}
do_REMAINDER:
    CHECKED(FR_OP_REMAINDER, *--below, top, fr_remainder(left, right));
    NEXT;
do_POWER:
    CHECKED(FR_OP_POWER, *--below, top, pow(left, right));
    NEXT;
do_SQUARE:
    CHECKED(FR_OP_SQUARE, top, 0, left * left);
    NEXT;
do_CUBE:
    CHECKED(FR_OP_CUBE, top, 0, left * left * left);
    NEXT;
do_NEGATE:
    top = -top;
    NEXT;
do_NOT:
    top = top == 0;
    NEXT;
do_TRUTH:
    top = top != 0;
    NEXT;
do_JUMP:
    at = expr->code + at->argument;
    goto *labels[at->op];
do_JUMP_IF_ZERO : {
    bool is_zero = top == 0;
    top = *--below;
    at = is_zero ? expr->code + at->argument : at + 1;
    goto *labels[at->op];
}
do_CALL:
    *below = top;
    below -= at->count - 1;
    CHECKED(FR_OP_CALL, *below, 0, fr_builtins[at->argument].function(below, at->count));
    NEXT;
do_CURVE:
    CHECKED(FR_OP_CURVE, top, 0, fr_curve_eval(expr->curves[at->argument], left));
    NEXT;
do_RANDOM:
    PUSH(fr_random(vars->key, vars->purpose, 2u * at->argument));
    NEXT;
do_NORMAL:
    PUSH(fr_random_normal(vars->key, vars->purpose, at->argument));
    NEXT;
do_RANDOM_AT:
    top = fr_random(numbered(vars->key, top), vars->purpose, 2);
    NEXT;
do_NORMAL_AT:
    top = fr_random_normal(numbered(vars->key, top), vars->purpose, 0);
    NEXT;
do_END:
    // Only a variable that was itself without a value can have come through.
    return is_finite(top) ? top : fault(expr, at, FR_OP_END, top, 0, top, out);
}
