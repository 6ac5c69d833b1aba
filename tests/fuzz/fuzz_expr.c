// Expressions and numbers from any text: compiling gives an expression or a diagnostic, and
// evaluating gives a finite value. Lines before the last define functions, `name parameters =
// body`; the last line is the expression.
#include "fuzz.h"

#include "frond/number.h"

#include <math.h>
#include <string.h>

static void define_function(FrScope *scope, char *line, FrSpan span, FrDiags *diags) {
    char *body = strchr(line, '=');
    if (body == NULL) {
        return;
    }
    *body++ = 0;
    char *parameters = strchr(line, ' ');
    if (parameters != NULL) {
        *parameters++ = 0;
    }
    // A status here only says what the diagnostics say.
    (void)fr_scope_add_function(scope, line, parameters != NULL ? parameters : "", body, span,
                                diags);
}

// Values that sit on edges.
static FrVars edge_vars(int round) {
    static const double EDGES[] = {0, 1, -1, 0.5, 1e300, -1e300, 1e-300, 3};
    FrVars vars = {.key = fr_key_root((uint64_t)round), .purpose = 1};
    for (size_t i = 0; i < FR_VAR_COUNT; i++) {
        vars.value[i] = EDGES[(i + (size_t)round) % G_N_ELEMENTS(EDGES)];
    }
    return vars;
}

static void evaluate(const char *text, FrSpan span, const FrScope *scope, FrDiags *diags) {
    FrExpr *expr = fr_expr_compile(text, span, scope, diags);
    if (expr == NULL) {
        FR_ASSERT(fr_diags_error_count(diags) > 0);
        return;
    }
    for (int round = 0; round < 8; round++) {
        FrVars vars = edge_vars(round);
        FrExprFault fault = {0};
        double value = fr_expr_eval(expr, &vars, &fault);
        FR_ASSERT(isfinite(value));
        double again = fr_expr_eval(expr, &vars, NULL);
        FR_ASSERT(memcmp(&value, &again, sizeof value) == 0);
        if (fault.code != NULL) {
            fr_expr_report_fault(&fault, "the test", diags);
        }
    }
    double constant = 0;
    FR_ASSERT(!fr_expr_is_constant(expr, &constant) || isfinite(constant));
    fr_expr_unref(expr);
}

static void parse_number(const char *text, FrSpan span, const FrScope *scope, FrDiags *diags) {
    FrNumber number = fr_number_constant(1, 1);
    FrStatus status = fr_number_parse(&number, text, span, 1, -1000, 1000, scope, diags);
    FR_ASSERT(status == FR_OK || fr_diags_error_count(diags) > 0);
    for (int round = 0; round < 8; round++) {
        FrVars vars = edge_vars(round);
        double value = fr_number_eval(&number, &vars, 1, NULL);
        FR_ASSERT(-1000 <= value && value <= 1000);
    }
    fr_number_clear(&number);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size > 1 << 20) {
        return 0;
    }
    FrSource *source = fr_source_new("input", (const char *)data, size);
    FrSpan span = {source, 0, (uint32_t)size};
    FrDiags *diags = fr_diags_new();
    FrScope *scope = fr_scope_new();
    char **lines = g_strsplit(fr_source_text(source, NULL), "\n", -1);
    guint count = g_strv_length(lines);
    for (guint i = 0; i + 1 < count; i++) {
        define_function(scope, lines[i], span, diags);
    }
    const char *last = count > 0 ? lines[count - 1] : "";
    evaluate(last, span, scope, diags);
    parse_number(last, span, scope, diags);
    GString *out = g_string_new(NULL);
    fr_diags_print(diags, out);
    fr_diags_print_json(diags, out);
    g_string_free(out, TRUE);
    g_strfreev(lines);
    fr_scope_free(scope);
    fr_diags_free(diags);
    fr_source_unref(source);
    return 0;
}
