// Each limit of reading, deriving and drawing, reached on purpose.
#include "lsystems.h"

/// Reading this text fails with the code.
static void check_text(const char *text, const char *code) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("test.l", text, strlen(text));
    FrLsystem *system;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_ERR_DOCUMENT);
    g_assert_null(system);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, code);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

static void reading(void) {
    check_text("Lsystem: 1\ndefine: { array a[5000][5000]; }\naxiom: A\nA --> A\nendlsystem\n",
               "limit-variables");
    GString *functions = g_string_new("w : A\n"), *productions = g_string_new("w : A\n");
    for (int i = 0; i < 65; i++) {
        g_string_append_printf(functions, "f%d(i) = i\n", i);
    }
    check_text(functions->str, "limit-functions");
    for (int i = 0; i <= 65000; i++) {
        g_string_append_printf(productions, "p : A -> B\n");
    }
    check_text(productions->str, "limit-productions");
    g_string_free(functions, TRUE);
    g_string_free(productions, TRUE);
}

/// Drawing the string after so many steps is refused with these words.
static void check_drawing(const char *text, uint64_t steps, const char *says) {
    Derived d = begin(text, 1);
    FrPlant *plant;
    step(&d, steps);
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, NULL), ==, FR_ERR_LIMIT);
    g_assert_null(plant);
    size_t last = fr_diags_count(d.context.diags) - 1; // behind warnings of the text
    g_assert_nonnull(strstr(fr_diags_get(d.context.diags, last)->text, says));
    end(&d);
}

static void drawing(void) {
    check_drawing("w : [\np1 : [ -> [[\n", 17, "the limit 'brackets'");
    check_drawing("w : {.\np1 : . -> ..\n", 22, "the limit 'corners'");
}

/// What no production made has its place in the axiom.
static void axioms(void) {
    GString *text = g_string_new("w : ");
    for (int i = 0; i <= 100000; i++) {
        g_string_append_c(text, '[');
    }
    g_string_append(text, "A\np1 : A -> F\n");
    Derived d = begin(text->str, 1);
    FrPlant *plant;
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, NULL), ==, FR_ERR_LIMIT);
    const FrDiag *diag = fr_diags_get(d.context.diags, fr_diags_count(d.context.diags) - 1);
    g_assert_nonnull(strstr(diag->text, "the limit 'brackets'"));
    uint32_t line, column;
    fr_source_position(diag->span.source, diag->span.begin, &line, &column);
    g_assert_cmpuint(line, ==, 1);
    g_assert_cmpuint(column, ==, 5);
    end(&d);
    g_string_free(text, TRUE);
}

static void internodes(void) {
    Derived d = begin("w : F\np1 : F -> FF\n", 1);
    FrPlant *plant;
    step(&d, 8);
    d.context.limits.nodes = 100;
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, NULL), ==, FR_ERR_LIMIT);
    g_assert_null(plant);
    g_assert_cmpuint(fr_diags_count(d.context.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(d.context.diags, 0)->code, ==, "limit-nodes");
    g_assert_nonnull(strstr(fr_diags_get(d.context.diags, 0)->text, "module 101"));
    end(&d);
}

/// A step fails with the code; the string stays.
static void check_step(const char *text, uint64_t steps, const char *code,
                       void (*set)(FrLimits *limits)) {
    Derived d = begin(text, 1);
    step(&d, steps);
    if (set != NULL) {
        set(&d.context.limits);
    }
    FrDigest digest = fr_lstring_digest(fr_lderivation_string(d.derivation));
    g_assert_cmpint(fr_lderivation_run(d.derivation, 1, &d.context), ==, FR_ERR_LIMIT);
    g_assert_cmpstr(fr_diags_get(d.context.diags, 0)->code, ==, code);
    g_assert_cmpuint(fr_lstring_digest(fr_lderivation_string(d.derivation)), ==, digest);
    end(&d);
}

static void few_bytes(FrLimits *limits) {
    limits->bytes = 1000;
}

static void deriving(void) {
    check_step("w : A(1)\np1 : A(x) -> A(x)A(x)\n", 6, "limit-bytes", few_bytes);
    check_step("Lsystem: 1\naxiom: A(1)\nA(x) : {y = x;} 1 --> A(x)A(x)\nendlsystem\n", 6,
               "limit-bytes", few_bytes);
    check_step("Lsystem: 1\naxiom: A(17)\nA(n) : n > 0 --> A(n-1)A(n-1)\nA(n) --> ?(2)$\n"
               "endlsystem\nLsystem: 2\naxiom: F\nF --> F\nendlsystem\n",
               18, "limit", NULL);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/limits/a text has so many variables, functions, productions",
                    reading);
    g_test_add_func("/lsystem/limits/a drawing has so many brackets and corners", drawing);
    g_test_add_func("/lsystem/limits/brackets of the axiom are refused at its place", axioms);
    g_test_add_func("/lsystem/limits/too many internodes are told of once", internodes);
    g_test_add_func("/lsystem/limits/a step has so many bytes and calls", deriving);
    return g_test_run();
}
