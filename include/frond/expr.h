/// @file expr.h
/// The expression language of component functions and L-system productions.
///
/// Text is compiled once and evaluated millions of times. Evaluation is pure and total: it never
/// gives NaN or infinity. Where mathematics would (1/0, log(-1), overflow) the result of that
/// operation is 0, the neutral value, and the evaluation remembers which operation it was.
/// Syntax, operators, functions and built-in constants: docs/expressions.md.
#pragma once

#include "frond/context.h"
#include "frond/curve.h"
#include "frond/random.h"

/// Variables that engines provide. X(name, meaning)
#define FR_VARS(X)                                                                                 \
    X(t, "place of this child among its siblings, i/(n-1), 0 where n is 1")                        \
    X(i, "iteration number, from 0")                                                               \
    X(n, "number of children of the multiplier")                                                   \
    X(i1, "iteration number of the next multiplier outside")                                       \
    X(n1, "number of children of the next multiplier outside")                                     \
    X(i2, "iteration number of the second multiplier outside")                                     \
    X(n2, "number of children of the second multiplier outside")                                   \
    X(depth, "generation within a recursion, from 0")                                              \
    X(order, "branch order: 0 for the main stem")                                                  \
    X(x, "position along the parent, 0 at its base, 1 at its tip")                                 \
    X(s, "position along this component itself, 0 to 1")                                           \
    X(v, "the value before the function is applied: from + t (to - from)")                         \
    X(height, "height above the ground, m")                                                        \
    X(age, "age of the component by its own clock, years")                                         \
    X(time, "time of the plant's clock, years")                                                    \
    X(season, "season, 0 to 1 from spring to winter")                                              \
    X(health, "health of the plant, 1 is well")                                                    \
    X(px, "place in the plant along its x axis, m")                                                \
    X(py, "place in the plant along its y axis, m")                                                \
    X(pz, "place in the plant along its z axis, m")                                                \
    X(light, "light here relative to full light, 0 to 1")

typedef enum FrVar {
#define FR_VAR_ID(name, meaning) FR_VAR_##name,
    FR_VARS(FR_VAR_ID)
#undef FR_VAR_ID
        FR_VAR_COUNT
} FrVar;

/// Values of the variables for one evaluation, and the key of its random draws.
typedef struct FrVars {
    double value[FR_VAR_COUNT];
    FrKey key;        ///< path key of the instance
    uint32_t purpose; ///< id of the parameter; separates its rand() from that of others
} FrVars;

/// Names an expression may use besides built-in ones: user functions, named curves and extra
/// variables (parameters of a production). Filled once, then only read.
typedef struct FrScope FrScope;

FR_API FrScope *fr_scope_new(void);
/// A scope that also knows the curves and functions of `outer`, which must live longer.
FR_API FrScope *fr_scope_new_within(const FrScope *outer);
FR_API void fr_scope_free(FrScope *scope);
/// Takes a reference. False if the name is taken.
FR_API bool fr_scope_add_curve(FrScope *scope, const char *name, FrCurve *curve);
/// A name for a number, as a slider gives it. False if the name is taken: by a variable, a
/// constant, a function, a curve or another number.
FR_API bool fr_scope_add_value(FrScope *scope, const char *name, double value);
/// The number of that name; false if there is none.
FR_API bool fr_scope_value(const FrScope *scope, const char *name, double *value);
/// `parameters` are names separated by spaces or commas; `body` may call what was added before.
FR_API FrStatus fr_scope_add_function(FrScope *scope, const char *name, const char *parameters,
                                      const char *body, FrSpan span, FrDiags *diags);
/// A curve of the scope, else a built-in one; a new reference, or NULL.
FR_API FrCurve *fr_scope_curve(const FrScope *scope, const char *name);

/// A compiled expression. Immutable, reference counted, thread-safe.
typedef struct FrExpr FrExpr;

/// Which operation of an evaluation had no value. {0} means all went well.
typedef struct FrExprFault {
    const char *code; ///< "division-by-zero", "not-a-number", "overflow"; NULL if none
    FrSpan span;      ///< the operation in the expression's text
} FrExprFault;

/// Compiles `text` (which is at `span`). NULL and diagnostics if it is wrong.
/// `scope` may be NULL. Cost: linear in the text; nesting and size are limited.
FR_API FrExpr *fr_expr_compile(const char *text, FrSpan span, const FrScope *scope, FrDiags *diags);
/// As above with `count` extra variables, whose values fr_expr_eval_with() takes by index.
FR_API FrExpr *fr_expr_compile_with(const char *text, FrSpan span, const FrScope *scope,
                                    const char *const *names, size_t count, FrDiags *diags);
FR_API FrExpr *fr_expr_ref(FrExpr *expr);
FR_API void fr_expr_unref(FrExpr *expr);
/// Always finite. `fault` may be NULL; it is written only if an operation had no value and
/// `fault->code` was NULL.
FR_API double fr_expr_eval(const FrExpr *expr, const FrVars *vars, FrExprFault *fault);
FR_API double fr_expr_eval_with(const FrExpr *expr, const FrVars *vars, const double *extra,
                                FrExprFault *fault);
/// True and its value if the expression needs no variable and no random number.
FR_API bool fr_expr_is_constant(const FrExpr *expr, double *value);
/// True if the value depends on the named variable.
FR_API bool fr_expr_uses(const FrExpr *expr, FrVar var);
/// True if rand(), gauss() or rnd() is used.
FR_API bool fr_expr_is_random(const FrExpr *expr);
/// The text it was compiled from.
FR_API const char *fr_expr_text(const FrExpr *expr);
/// The digest of what it computes, with the functions and curves it calls, continued from `seed`:
/// where it is equal, so are all values. The text and its place are no part of it.
FR_API FrDigest fr_expr_digest(FrDigest seed, const FrExpr *expr);
/// Writes the warning for a fault; `what` says which parameter of which component.
FR_API void fr_expr_report_fault(const FrExprFault *fault, const char *what, FrDiags *diags);
