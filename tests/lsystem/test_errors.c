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
    {HEAD "A(x) --> F[+A(x)\nendlsystem\n", 0, FR_OK, "bracket", 4, 1, "no ']' ends it"},
    {HEAD "A(x) --> F]+A(x)\nendlsystem\n", 0, FR_OK, "bracket", 4, 1, "no '['"},
    {"Lsystem: 1\nseed: 1\naxiom: A\nA --> B : -5\nA --> C : 1\nendlsystem\n", 1, FR_OK,
     "negative-weight", 4, 12, "(step 1, module 1)"},
    {"w : F[A\np1 : A -> F\n", 0, FR_OK, "bracket", 1, 5, "no ']' ends it"},
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
    {HEAD "A(x) --> A(x)A(x)A(x)A(x)A(x)A(x)A(x)A(x)\nendlsystem\n", 30, FR_ERR_LIMIT,
     "limit-modules", 4, 1, "(step 6, module 12501)"},
    {HEAD "A(x) : {n = 1;} 1 --> A(x)A(x)A(x)A(x)A(x)A(x)A(x)A(x)\nendlsystem\n", 30, FR_ERR_LIMIT,
     "limit-modules", 4, 1, "(step 6, module 12501)"},
    {HEAD "A(x) --> A(x)A(x)A(x)\ndecomposition\nmaximum depth: 40\nA(x) --> A(x)A(x)\n"
          "endlsystem\n",
     1, FR_ERR_LIMIT, "limit-modules", 7, 1, "(step 1, module 1)"},
    {HEAD "A(x) --> A(x)\ndecomposition\nmaximum depth: 1000000000\nA(x) --> A(x+1)\nendlsystem\n",
     1, FR_ERR_LIMIT, "limit-depth", 7, 1, "(step 1, module 1) asks for 4097"},
    {"Lsystem: 1\nderivation length: 3000000000\naxiom: A\nA --> A\nendlsystem\n", 0, FR_ERR_LIMIT,
     "limit-steps", 2, 20, "the derivation length asks for 3000000000;"},
    {"Lsystem: 1\nderivation length: 1.0e18\naxiom: A\nA --> A\nendlsystem\n", 0, FR_ERR_LIMIT,
     "limit-steps", 2, 20, "asks for over 10^19;"},
    {"Lsystem: 1\nderivation length: 2-5\naxiom: A\nA --> A\nendlsystem\n", 1, FR_OK,
     "negative-length", 2, 21, "is negative; no step"},
    {HEAD "A(x) : { SetDerivationLength(0-x); } 1 --> A(x)\nendlsystem\n", 1, FR_OK,
     "negative-length", 4, 10, "(step 1, module 1)"},
    {HEAD "A(x) --> A(x)\n  /* and\nendlsystem\n", 0, FR_ERR_DOCUMENT, "comment", 5, 3,
     "begins here"},
    {"w : A\n/* p1 : A -> B\n", 0, FR_ERR_DOCUMENT, "comment", 2, 1, "no '*/'"},
    {"#if   1/0\n#endif\nw : A\n", 0, FR_ERR_DOCUMENT, "directive", 1, 1, "condition: 1/0"},
    {"f(x) = f(x+1)\nw : A\np1 : A -> B(f(1))\n", 0, FR_ERR_DOCUMENT, "recursive-call", 1, 8,
     "'f' cannot call itself"},
    {HEAD "A(x) --> A(exp(x*1000))\nendlsystem\n", 2, FR_OK, "no-number", 4, 12,
     "(step 1, module 1)"},
    {HEAD "A(x) --> A(x)?(5,1)F$\nendlsystem\n", 0, FR_OK, "unknown-call", 4, 1, "does nothing"},
    {HEAD "A(x) --> A(x)?(x+4,1)F$\nendlsystem\nLsystem: 2\naxiom: F\nF --> F\nendlsystem\n", 2,
     FR_OK, "unknown-call", 4, 1, "(step 2, module 2)"},
    {HEAD "B --> B\nA(x) --> ?(2)A(x)$\nendlsystem\nLsystem: 2\naxiom: F\nF --> F\n"
          "A(x) --> ?(2)F$\nendlsystem\n",
     3, FR_OK, "recursive-call", 10, 1, "cannot call itself"},
    {HEAD "A(x) --> A(x)\nendlsystem\nLsystem: 2\naxiom: F\nF --> F\nendlsystem\n"
          "Lsystem: 2\naxiom: F\nF --> F\nendlsystem\n",
     0, FR_OK, "duplicate-label", 10, 10, "2 already"},
    {"w : F\nbrackets: round\np1 : F -> F(+F)F\n", 0, FR_ERR_DOCUMENT, "syntax", 2, 1,
     "before the axiom"},
    {"Lsystem 1\naxiom: A\nA --> A\nendlsystem\n", 0, FR_ERR_DOCUMENT, "syntax", 1, 1,
     "begins with 'Lsystem:'"},
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

/// How many errors there are in a text that is not one of ours.
static void check_error_count(const char *text, guint count) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("test.l", text, strlen(text));
    FrLoptions options = {.notation = FR_LNOTATION_CPFG};
    FrLsystem *system;
    g_assert_cmpint(fr_lsystem_compile(source, &options, &context, &system), ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, count);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

static void once(void) {
    check_error_count("Lsystem 1\naxiom: A\nA --> A\nB --> B\nendlsystem\n", 1);
    check_error_count("axiom: A\nA --> A\nB --> B\nendlsystem\n", 1);
    check_error_count("Lsystem: 1\naxiom: A\n/* A --> A\nendlsystem\n", 1);
    check_error_count("Lsystem: 1\n/*axiom: A\nA --> A\nendlsystem\n", 1);
}

static void formals(void) {
    GString *text = g_string_new("Lsystem: 1\naxiom: A\nA(x0");
    for (int i = 1; i < 256; i++) {
        g_string_append_printf(text, ",x%d", i);
    }
    g_string_append(text, ") --> A\nendlsystem\n");
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("test.l", text->str, text->len);
    FrLsystem *system;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_ERR_DOCUMENT);
    g_assert_nonnull(find(context.diags, "too-many-parameters"));
    g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 1);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    g_string_free(text, TRUE);
}

/// Limits of the turtle name the production that drew what is too much.
static void drawing(void) {
    const char text[] = "w : A\np1 : A -> F[+F]A@O(1)\n";
    const struct {
        const char *code;
        uint64_t nodes, organs;
        const char *says;
    } cases[] = {{"limit-nodes", 3, 100, "p1 (step 4, module 9) asks for 4"},
                 {"limit-organs", 100, 2, "p1 (step 4, module 27) asks for 3"}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        Derived d = begin(text, 1);
        FrPlant *plant;
        step(&d, 4);
        d.context.limits.nodes = cases[i].nodes;
        d.context.limits.organs = cases[i].organs;
        g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, NULL), ==,
                        FR_ERR_LIMIT);
        const FrDiag *diag = find(d.context.diags, cases[i].code);
        g_assert_nonnull(diag);
        g_assert_nonnull(strstr(diag->text, cases[i].says));
        uint32_t line, column;
        fr_source_position(diag->span.source, diag->span.begin, &line, &column);
        g_assert_cmpuint(line, ==, 2);
        end(&d);
    }
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
    g_test_add_func("/lsystem/errors/what is no L-system is told once", once);
    g_test_add_func("/lsystem/errors/too many formals are told as such", formals);
    g_test_add_func("/lsystem/errors/limits of drawing name production, step, module", drawing);
    return g_test_run();
}
