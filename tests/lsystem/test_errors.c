// Each kind of error: its code, its place, and step and module where it only shows in a derivation.
#include "lsystems.h"

typedef struct Kind {
    const char *text;
    uint64_t steps;
    FrStatus status;
    const char *code;
    uint32_t line, column;
    const char *says; ///< part of the message
} Kind;

#define HEAD "Lsystem: 1\nderivation length: 3\naxiom: A(1)\n"

static const Kind kinds[] = {
    {HEAD "A(x) --> F(x A(x)\nendlsystem\n", 0, FR_ERR_DOCUMENT, "syntax", 4, 14, "')'"},
    {HEAD "A(x) --> F(sni(x))\nendlsystem\n", 0, FR_ERR_DOCUMENT, "unknown-function", 4, 12, "sni"},
    {HEAD "A(x) --> F(sin(x,1))\nendlsystem\n", 0, FR_ERR_DOCUMENT, "argument-count", 4, 12,
     "here are 2"},
    {HEAD "A(x) --> F(y)\nendlsystem\n", 0, FR_OK, "unknown-name", 4, 12, "'y'"},
    {HEAD "A(x) --> F(x)A(x,1)\nendlsystem\n", 0, FR_OK, "parameter-count", 4, 1,
     "2 parameters, and no production knows that"},
    {"w : A(1)\np1 : A(x,y) -> A(x,y)\n", 0, FR_OK, "parameter-count", 1, 5, "1 parameter,"},
    {HEAD "A(x) --> FA(x-1)F(1/(x-1))\nendlsystem\n", 2, FR_OK, "division-by-zero", 4, 20,
     "(step 1, module 1)"},
    {HEAD "A(x) --> FFA(x+1)\nF --> F(1/0)\nendlsystem\n", 3, FR_OK, "division-by-zero", 5, 10,
     "by zero"},
    {HEAD "X --> X\ndecomposition\nmaximum depth: 5\nA(x) --> A(x+1)\nendlsystem\n", 1, FR_OK,
     "decomposition-depth", 7, 1, "(step 1, module 1)"},
    {HEAD "A(x) --> B\ndecomposition\nB --> C\nC --> D\nendlsystem\n", 1, FR_OK,
     "decomposition-depth", 7, 1, "(step 1, module 1)"},
    {HEAD "A(x) --> A(x)A(x)A(x)A(x)A(x)A(x)A(x)A(x)\nendlsystem\n", 30, FR_ERR_LIMIT,
     "limit-modules", 4, 1, "100000"},
    {HEAD "A(x) : { while (1) { x = x; } } 1 --> A(x)\nendlsystem\n", 1, FR_ERR_LIMIT,
     "limit-iterations", 4, 17, "the loop at step 1, module 1"},
    {"a(i) = i+i\nb(i) = a(a(a(a(i))))\nc(i) = b(b(b(b(b(b(b(b(i))))))))\n"
     "d(i) = c(c(c(c(c(c(c(c(i))))))))\ne(i) = d(d(d(d(d(d(d(d(i))))))))\n"
     "g(i) = e(e(e(e(e(e(e(e(i))))))))\nw : A\np1 : A -> B(g(1))\n",
     1, FR_ERR_DOCUMENT, "limit-calls", 6, 1, "10000"},
};

/// The first diagnostic of that code.
static const FrDiag *find(const FrDiags *diags, const char *code) {
    for (size_t i = 0; i < fr_diags_count(diags); i++) {
        if (strcmp(fr_diags_get(diags, i)->code, code) == 0) {
            return fr_diags_get(diags, i);
        }
    }
    return NULL;
}

static void check(const Kind *kind) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.modules = 100000;
    context.limits.iterations = 1000;
    FrSource *source = fr_source_new("test.l", kind->text, strlen(kind->text));
    FrLsystem *system;
    FrLderivation *derivation = NULL;
    FrStatus status = fr_lsystem_compile(source, NULL, &context, &system);
    if (status == FR_OK) {
        status = fr_lderivation_new(system, NULL, &context, &derivation);
    }
    if (status == FR_OK) {
        status = fr_lderivation_run(derivation, kind->steps, &context);
    }
    char *said = diag_text(context.diags);
    g_test_message("%s", said);
    g_assert_cmpint(status, ==, kind->status);
    const FrDiag *diag = find(context.diags, kind->code);
    g_assert_nonnull(diag);
    uint32_t line, column;
    fr_source_position(diag->span.source, diag->span.begin, &line, &column);
    g_assert_cmpuint(line, ==, kind->line);
    g_assert_cmpuint(column, ==, kind->column);
    g_assert_nonnull(strstr(diag->text, kind->says));
    g_free(said);
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

static void all_kinds(void) {
    for (size_t i = 0; i < G_N_ELEMENTS(kinds); i++) {
        check(&kinds[i]);
    }
}

static void many(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    const char text[] = HEAD "A(x) --> F(x A(x)\nA(x) --> F(sni(x))\nA(x) --> F(sin(x,1))\n"
                             "A(x --> B\nA(x) --> ]\nendlsystem\n";
    FrSource *source = fr_source_new("test.l", text, sizeof text - 1);
    FrLsystem *system;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_ERR_DOCUMENT);
    g_assert_null(system);
    g_assert_cmpuint(fr_diags_error_count(context.diags), >=, 4);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

static void counters(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    const char text[] = HEAD "A(x) : { n = n + 1; } 1 --> A(n)\nendlsystem\n";
    FrSource *source = fr_source_new("test.l", text, sizeof text - 1);
    FrLsystem *system;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(context.diags), ==, 0);
    fr_lsystem_free(system);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/errors/each kind has a code, a place, a step and a module",
                    all_kinds);
    g_test_add_func("/lsystem/errors/one run tells of many", many);
    g_test_add_func("/lsystem/errors/a variable that counts itself is known", counters);
    return g_test_run();
}
