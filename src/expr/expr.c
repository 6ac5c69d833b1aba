// The life of an expression.
#include "frond/expr.h"

#include "expr/tree.h"

#include <string.h>

static FrExpr *finish(FrTree *tree, const char *text, FrDiags *diags) {
    if (tree == NULL) {
        return NULL;
    }
    FrExpr *expr = fr_code_generate(tree, diags);
    if (expr != NULL) {
        expr->text = g_strdup(text);
    }
    fr_tree_free(tree);
    return expr;
}

FrExpr *fr_expr_compile(const char *text, FrSpan span, const FrScope *scope, FrDiags *diags) {
    return fr_expr_compile_with(text, span, scope, NULL, 0, diags);
}

FrExpr *fr_expr_compile_with(const char *text, FrSpan span, const FrScope *scope,
                             const char *const *names, size_t count, FrDiags *diags) {
    return finish(fr_tree_parse(text, span, scope, names, count, diags), text, diags);
}

FrExpr *fr_expr_of_curve(FrCurve *curve, const char *text, FrSpan span) {
    return finish(fr_tree_curve(curve, span), text, NULL);
}

FrExpr *fr_expr_ref(FrExpr *expr) {
    g_atomic_int_inc(&expr->references);
    return expr;
}

void fr_expr_unref(FrExpr *expr) {
    if (expr == NULL || !g_atomic_int_dec_and_test(&expr->references)) {
        return;
    }
    for (uint32_t i = 0; i < expr->curve_count; i++) {
        fr_curve_unref(expr->curves[i]);
    }
    for (uint32_t i = 0; i < expr->source_count; i++) {
        fr_source_unref(expr->sources[i]);
    }
    g_free(expr->code);
    g_free(expr->spans);
    g_free(expr->constants);
    g_free(expr->curves);
    g_free(expr->sources);
    g_free(expr->text);
    g_free(expr);
}

bool fr_expr_is_constant(const FrExpr *expr, double *value) {
    if (expr->variables != 0 || expr->is_random || expr->uses_extra) {
        return false;
    }
    const FrVars none = {0};
    *value = fr_expr_eval(expr, &none, NULL);
    return true;
}

bool fr_expr_uses(const FrExpr *expr, FrVar var) {
    return (expr->variables >> var & 1) != 0;
}

bool fr_expr_is_random(const FrExpr *expr) {
    return expr->is_random;
}

const char *fr_expr_text(const FrExpr *expr) {
    return expr->text;
}

FrDigest fr_expr_digest(FrDigest seed, const FrExpr *expr) {
    FrDigest digest = fr_digest(seed, expr->code, expr->code_count * sizeof *expr->code);
    digest = fr_digest(digest, expr->constants, expr->constant_count * sizeof *expr->constants);
    for (uint32_t i = 0; i < expr->curve_count; i++) {
        digest = fr_curve_digest(digest, expr->curves[i]);
    }
    return digest;
}

void fr_expr_report_fault(const FrExprFault *fault, const char *what, FrDiags *diags) {
    if (fault->code == NULL) {
        return;
    }
    const char *why = strcmp(fault->code, "division-by-zero") == 0 ? "divides by zero"
                      : strcmp(fault->code, "overflow") == 0
                          ? "gives a number too large to hold"
                          : "has no value for what it is given (as log(-1) has none)";
    fr_diags_add(diags, FR_WARNING, fault->code, fault->span, "%s: this %s; 0 is used instead",
                 what, why);
}
