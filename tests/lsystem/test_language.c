// What cpfg does where its manual is silent or says otherwise; each was observed by running it.
#include "lsystems.h"

static void check_value(const char *expression, const char *expected) {
    char *axiom = g_strdup_printf("A(%s)", expression);
    char *wanted = g_strdup_printf("A(%s)", expected);
    check_cpfg("", axiom, "X --> X", 0, wanted);
    g_free(axiom);
    g_free(wanted);
}

static void test_precedence(void) {
    check_value("-2^2", "4");
    check_value("2^3^2", "64");
    check_value("2^-1", "0.5");
    check_value("3>2>1", "0");
    check_value("1/3*3", "1");
    check_value("-7%3", "-1");
    check_value("1 ? 2 : 0 ? 3 : 4", "2");
    check_value("1 || 0 && 0", "1");
    check_value("2 <> 3", "1");
    check_value("!0 + 1", "2");
    check_value("1.0e2 + .5 + 3.", "103.5");
}

static void test_functions(void) {
    check_value("sin(30)", "0.5");
    check_value("atan(1)", "45");
    check_value("trunc(2.5)", "3");
    check_value("trunc(2.4)", "2");
    check_value("sign(-3) + floor(2.7) + ceil(2.2)", "4");
    check_value("atan2(1,-1)", "135");
}

static void test_byte_order_mark(void) {
    Derived d = begin("\xef\xbb\xbfLsystem: 1\nderivation length: 1\naxiom: A\n"
                      "A --> AB\nendlsystem\n",
                      1);
    step(&d, 1);
    check_now(&d, "AB");
    end(&d);
}

static void test_division_by_zero(void) {
    Derived d = begin("Lsystem: 1\nderivation length: 1\naxiom: A(0)\n"
                      "A(x) --> B(5/x)\nendlsystem\n",
                      1);
    step(&d, 1);
    check_now(&d, "B(5)");
    g_assert_cmpuint(fr_diags_count(d.context.diags), ==, 1);
    const FrDiag *diag = fr_diags_get(d.context.diags, 0);
    uint32_t line, column;
    fr_source_position(diag->span.source, diag->span.begin, &line, &column);
    g_assert_cmpstr(diag->code, ==, "division-by-zero");
    g_assert_cmpuint(line, ==, 4);
    end(&d);
}

static void test_single_precision(void) {
    // 16777217 needs 25 bits.
    check_cpfg("", "A(16777217)", "A(x) : x == 16777216 --> B", 1, "B");
}

static void test_one_character(void) {
    check_cpfg("", "~p(2)@M(1,2,3)", "p(x) --> q(x+1)", 1, "~q(3)@M(1,2,3)");
}

static void test_comment_trap(void) {
    check_cpfg("", "F//F", "X --> X", 0, "F");
    check_cpfg("", "F/ /F", "X --> X", 0, "F//F");
    check_cpfg("", "F/* a\nb */G", "X --> X", 0, "FG");
}

static void test_continuation(void) {
    check_cpfg("", "AB\n\tC", "A -->\n\tX\n\tY", 1, "XYBC");
}

static void test_macros(void) {
    check_cpfg("#define Apex A\n#define Seg(l) F(l)+(2*(l))\n#if 2 > 1 && defined(Apex)\n"
               "#define N 3\n#else\n#error wrong\n#endif\n",
               "Apex", "Apex --> Seg(N) [Apex]", 1, "F(3)+(6)[A]");
}

// Two backslashes before a line end leave one, as in models of the field's library.
static void test_backslash(void) {
    check_cpfg("#define twice(x) \\\\\n\t(2*x)\n", "A(3)", "A(x) --> \\B(twice(x) + 1)", 1,
               "\\B(7)");
}

static void test_hash(void) {
    check_cpfg("", "#(3)", "* < #(d) --> #(d*2)", 1, "#(6)");
}

static void test_formals(void) {
    // The left context is bound last.
    check_cpfg("", "A(1)B(2)", "A(x) < B(x) --> C(x)", 1, "A(1)C(1)");
    check_cpfg("Start: { x = 7; }\n", "A(1)", "A(x) --> B(x)", 1, "B(1)");
    check_cpfg("Start: { x = 7; }\n", "A(x)", "A(y) --> B(x+y)", 1, "B(14)");
    check_cpfg("", "AA(1)A(1,2)", "A(x) --> B", 1, "ABA(1,2)");
}

static void test_static_locals(void) {
    check_cpfg("", "AAA", "A : {n = n + 1;} 1 --> B(n)", 1, "B(1)B(2)B(3)");
    check_cpfg("", "ABA", "A : {n = n + 1;} 1 --> B(n)", 2, "B(1)BB(2)");
}

static void test_blocks(void) {
    // The block before the condition runs even where the condition fails.
    check_cpfg("Start: { n = 0; }\n", "AAB", "A : {n = n + 1;} 0 --> A\nB --> C(n)", 1, "AAC(2)");
    check_cpfg("Start: { n = 0; }\nStartEach: { n = n + 10; }\nEndEach: { n = n + 1; }\n", "AA",
               "A --> B(n)\nB(x) --> C(x,n,Q,Z)", 2, "C(10,21,2,2)C(10,21,2,2)");
    check_cpfg("Start: { n = 0; i = 0; while (i < 5) { if (i != 2) { n = n + i; } i = i + 1; }\n"
               "  do { n = n * 2; } while (n < 30); }\n",
               "A(n)", "X --> X", 0, "A(32)");
}

static void test_arrays(void) {
    check_cpfg("define: { array a[2][3] = {1,2,3,4,5,6}, b[2]; }\nStart: { b[1] = a[1][0]; }\n",
               "A(a[0][2],b[1],a[9][9])", "X --> X", 0, "A(3,4,6)");
}

static void test_right_context(void) {
    check_cpfg("", "A[B]D A[BC]D", "A > [B]D --> X", 1, "X[B]DA[BC]D");
    check_cpfg("", "A[B]D A[BC]D", "A > [B=]D --> X", 1, "X[B]DX[BC]D");
    check_cpfg("", "A[BC]D", "A > [=]D --> X", 1, "X[BC]D");
    check_cpfg("", "A[B]D", "A > D --> X", 1, "X[B]D");
    check_cpfg("consider: ABD\n", "A[B]D", "A > D --> X", 1, "A[B]D");
    check_cpfg("consider: ABD\n", "A[B]D", "A > B --> X", 1, "X[B]D");
    check_cpfg("consider: ABD[]\n", "A[B]D", "A > D --> X", 1, "X[B]D");
    check_cpfg("ignore: +F\n", "A+F(2)B", "A > B --> X", 1, "X+F(2)B");
}

static void test_left_context(void) {
    check_cpfg("", "A[C]B", "A < B --> X", 1, "A[C]X");
    check_cpfg("", "A[[B]]", "A < B --> X", 1, "A[[X]]");
    check_cpfg("consider: AB\n", "A[A]C[B]", "A < B --> X", 1, "A[A]C[X]");
}

static void test_ring(void) {
    check_cpfg("ring Lsystem\n", "BAAA", "B < A --> B\nB --> A", 4, "BAAA");
    check_cpfg("", "AB", "B > A --> X", 1, "AB");
    check_cpfg("ring Lsystem\n", "AB", "B > A --> X", 1, "AX");
}

static void test_strict(void) {
    check_cpfg("", "ABABA", "AB --> C", 1, "CCA");
}

static void test_decomposition(void) {
    check_cpfg("", "A", "A --> BB\ndecomposition\nB --> C", 0, "A");
    check_cpfg("", "A", "A --> BB\ndecomposition\nB --> C", 1, "CC");
    check_cpfg("", "B", "A --> A\ndecomposition\nB --> C", 0, "B");
    check_cpfg("", "B", "A --> A\ndecomposition\nB --> C", 1, "C");
    check_cpfg("", "A(5)", "X --> X\ndecomposition\nmaximum depth: 10\nA(n) : n > 0 --> FA(n-1)", 1,
               "FFFFFA(0)");
    // Contexts are those of the module that was replaced, in the old string.
    check_cpfg("", "LA", "A --> BB\nL --> M\ndecomposition\nL < B --> C", 1, "MCC");
}

static void test_cut(void) {
    check_cpfg("", "A[BA]C", "B --> %", 1, "A[%A]C");
    check_cpfg("", "A[BA]C", "B --> %", 2, "A[]C");
    check_cpfg("", "AB[C]D", "B --> %", 2, "A");
}

static void test_calls(void) {
    const char *text = "Lsystem: 1\nderivation length: 2\nStart: { v = 5; }\naxiom: ?(2,1)A$A\n"
                       "A --> B\nendlsystem\n"
                       "Lsystem: 2\ndefine: { external v; }\naxiom: A\nA --> C(v)\nC(x) --> D(x)\n"
                       "endlsystem\n";
    Derived d = begin(text, 1);
    step(&d, 1);
    check_now(&d, "?(2,1)C(5)$B");
    step(&d, 1);
    check_now(&d, "?(2,1)D(5)$B");
    end(&d);
}

// The LCG of drand48 from the published start: x = 5 | 155·2³².
static void test_streams(void) {
    uint64_t x = 5 | UINT64_C(155) << 32;
    GString *expected = g_string_new(NULL);
    for (int i = 0; i < 40; i++) {
        x = (UINT64_C(0x5DEECE66D) * x + 0xB) & ((UINT64_C(1) << 48) - 1);
        g_string_append_c(expected, (double)x / (double)(UINT64_C(1) << 48) * 4 <= 1 ? 'B' : 'C');
    }
    check_cpfg("seed: 5\n", "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA", "A --> B : 1\nA --> C : 3",
               1, expected->str);
    g_string_free(expected, TRUE);
    // One draw for each position, also where nothing matches.
    check_cpfg("seed: 5\n", "A", "A --> B : 0\nA --> C : 1", 1, "C");
    // srand(7): the first number of stream B.
    srand48(7);
    char *value = g_strdup_printf("A(%g)", (double)(float)drand48());
    check_cpfg("Start: { srand(7); }\n", "A(ran(1))", "X --> X", 0, value);
    g_free(value);
}

static void test_unseeded(void) {
    check_cpfg("", "AAAAAAAA", "A --> B : 1\nA --> C : 99", 1, "BBBBBBBB");
}

static void check_error(const char *text, const char *code, uint32_t line) {
    FrSource *source = fr_source_new("bad.l", text, strlen(text));
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrLsystem *system;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_ERR_DOCUMENT);
    g_assert_null(system);
    g_assert_cmpuint(fr_diags_count(context.diags), >, 0);
    const FrDiag *diag = fr_diags_get(context.diags, 0);
    uint32_t at, column;
    fr_source_position(diag->span.source, diag->span.begin, &at, &column);
    g_test_message("%s: %s", diag->code, diag->text);
    g_assert_cmpstr(diag->code, ==, code);
    g_assert_cmpuint(at, ==, line);
    fr_diags_free(context.diags);
    fr_source_unref(source);
}

static void test_errors(void) {
    check_error("Lsystem: 1\naxiom: A\nA --> B(\nendlsystem\n", "syntax", 3);
    check_error("Lsystem: 1\naxiom: A\nA --> B(1e2)\nendlsystem\n", "syntax", 3);
    check_error("Lsystem: 1\naxiom: A\n#(3) --> B\nendlsystem\n", "directive", 3);
    check_error("Lsystem: 1\naxiom: A\nA --> B(sni(2))\nendlsystem\n", "unknown-function", 3);
    check_error("Lsystem: 1\naxiom: A\nA --> B(sin(2,3))\nendlsystem\n", "argument-count", 3);
    check_error("Lsystem: 1\naxoim: A\nA --> B\nendlsystem\n", "syntax", 2);
    check_error("Lsystem:\naxiom: A\nA --> B\nendlsystem\n", "syntax", 1);
    check_error("Lsystem: 1\naxiom: A\nA --> B\n", "syntax", 3);
    check_error("Lsystem: 1\naxiom: A\nA B\n C --> B\nendlsystem\n", "syntax", 3);
    check_error("#ifdef X\nLsystem: 1\n", "directive", 1);
    check_error("w : A\np1 : A -> B\nnonsense\n", "syntax", 3);
    check_error("p1 : A -> B\n", "syntax", 1);
}

static void test_limits(void) {
    Derived d = begin("w : A\np1 : A -> AA\n", 1);
    d.context.limits.modules = 1000;
    g_assert_cmpint(fr_lderivation_run(d.derivation, 50, &d.context), ==, FR_ERR_LIMIT);
    g_assert_cmpuint(fr_lstring_count(fr_lderivation_string(d.derivation)), ==, 512);
    g_assert_cmpuint(fr_lderivation_step(d.derivation), ==, 9);
    g_assert_cmpstr(fr_diags_get(d.context.diags, 0)->code, ==, "limit-modules");
    end(&d);
    d = begin("Lsystem: 1\naxiom: A\nA : {x = 1;} 1 --> AA\nendlsystem\n", 1);
    d.context.limits.modules = 1000;
    g_assert_cmpint(fr_lderivation_run(d.derivation, 50, &d.context), ==, FR_ERR_LIMIT);
    g_assert_cmpuint(fr_lstring_count(fr_lderivation_string(d.derivation)), ==, 512);
    end(&d);
    d = begin("Lsystem: 1\naxiom: A\nA : {while (1) {}} 1 --> AA\nendlsystem\n", 1);
    g_assert_cmpint(fr_lderivation_run(d.derivation, 1, &d.context), ==, FR_ERR_LIMIT);
    g_assert_cmpstr(fr_diags_get(d.context.diags, 0)->code, ==, "limit-iterations");
    end(&d);
    d = begin("Lsystem: 1\naxiom: A\nB --> B\ndecomposition\nmaximum depth: 4000\nA --> AA\n"
              "endlsystem\n",
              1);
    d.context.limits.modules = 100000;
    g_assert_cmpint(fr_lderivation_run(d.derivation, 1, &d.context), ==, FR_ERR_LIMIT);
    end(&d);
}

static void test_stochastic_threads(void) {
    FrDigest first = 0;
    for (int threads = 1; threads <= 3; threads++) {
        Derived d = begin("Lsystem: 1\nseed: 3\naxiom: A\nA --> A[+A]F(2)A : 2\n"
                          "A --> F(3)A : 1\nA < F(x) --> F(x*1.1) : 1\nendlsystem\n",
                          threads);
        step(&d, 11);
        FrDigest digest = fr_lstring_digest(fr_lderivation_string(d.derivation));
        first = threads == 1 ? digest : first;
        g_assert_cmpuint(fr_lstring_count(fr_lderivation_string(d.derivation)), >, 20000);
        g_assert_cmpuint(digest, ==, first);
        end(&d);
    }
}

// What cpfg's evaluator gives: behind a number or a name both sides of && and || are computed, so
// that both draw; what a computed left side decides is its own value where its last byte is not 0.
static void test_truth(void) {
    check_cpfg("", "A(5)", "A(x) --> B(x || 0, (x+1) || 0, (x/20) || 0, (x+251) || 0)", 1,
               "B(1,6,1,1)");
    check_cpfg("", "A(5)", "A(x) --> B(x && 3, 0 && x, (x-5) && 3, !(x && x))", 1, "B(1,0,0,0)");
    // 0.0416303 and 0.454492 are the second and third number of srand(1).
    const char *draws = "A(x) : {srand(1); n = %s; y = ran(1);} 1 --> B(y)";
    const struct {
        const char *left, *expected;
    } cases[] = {{"x && ran(1)", "B(0.454492)"},
                 {"(x+0) && ran(1)", "B(0.0416303)"},
                 {"1 || ran(1)", "B(0.454492)"},
                 {"(x+1) || ran(1)", "B(0.0416303)"}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        char *production = g_strdup_printf(draws, cases[i].left);
        check_cpfg("", "A(0)", production, 1, cases[i].expected);
        g_free(production);
    }
}

static void append(void *user, const char *text) {
    g_string_append(user, text);
}

// Sizes of conversions are read over, as all numbers are doubles.
static void test_print(void) {
    FrContext context = fr_context_default();
    const char text[] =
        "Lsystem: 1\nStart: {printf(\"%.lf %5.2lf|%g%%\", 3, 1.5, 7);}\naxiom: A\nA --> A\n"
        "endlsystem\n";
    FrSource *source = fr_source_new("test.l", text, sizeof text - 1);
    GString *out = g_string_new(NULL);
    FrLsettings settings = fr_lsettings_default();
    settings.print = append;
    settings.print_user = out;
    FrLsystem *system;
    FrLderivation *derivation;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_new(system, &settings, &context, &derivation), ==, FR_OK);
    g_assert_cmpstr(out->str, ==, "3  1.50|7%");
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_source_unref(source);
    g_string_free(out, TRUE);
}

static void test_paper(void) {
    CHECK_STEPS("w : AI(0.5)W(0)\nf(i) = 2*i\np1 : A -> FA : 1\np2 : I(i) < W(0) -> W(fi)\n",
                "AI(0.5)W(0)", "FAI(0.5)W(1)", "FFAI(0.5)W(1)");
    CHECK_STEPS("brackets: round\nw : F\np1 : F -> F(+F(+F)(-F))F(-F)F\n", "F",
                "F[+F[+F][-F]]F[-F]F");
    CHECK_STEPS("w : A\np1 : A -> FR(?,8)A\n", "A", "FR(?,8)A");
}

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        void (*run)(void);
    } tests[] = {
        {"operators bind as in cpfg", test_precedence},
        {"the mark of UTF-8 before a text is skipped", test_byte_order_mark},
        {"functions take degrees and trunc rounds", test_functions},
        {"division by zero divides by one and tells its place", test_division_by_zero},
        {"parameters are kept in single precision", test_single_precision},
        {"a module is one character", test_one_character},
        {"two slashes begin a comment even in a string", test_comment_trap},
        {"a tab continues a line", test_continuation},
        {"macros stand for symbols and modules", test_macros},
        {"a backslash in an expression is read over", test_backslash},
        {"a number sign may follow an empty context", test_hash},
        {"the left context is bound last and formals hide globals", test_formals},
        {"variables of a production keep their values", test_static_locals},
        {"blocks run as in cpfg", test_blocks},
        {"truth has the values of cpfg", test_truth},
        {"printf prints numbers", test_print},
        {"arrays are filled and their indices clamped", test_arrays},
        {"right contexts skip branches as published", test_right_context},
        {"left contexts lead to the root", test_left_context},
        {"in a ring the end meets the beginning", test_ring},
        {"a predecessor of two modules takes both", test_strict},
        {"decomposition follows at once, but not on the axiom", test_decomposition},
        {"a cut acts one step later", test_cut},
        {"an L-system calls another", test_calls},
        {"both random streams are those of cpfg", test_streams},
        {"without a seed the first production is taken", test_unseeded},
        {"errors tell their lines", test_errors},
        {"limits stop growth and leave the last whole step", test_limits},
        {"chance is the same on any threads", test_stochastic_threads},
        {"the notation of papers is read", test_paper},
    };
    g_test_init(&argc, &argv, NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(tests); i++) {
        char *path = g_strconcat("/lsystem/language/", tests[i].name, NULL);
        g_test_add_func(path, tests[i].run);
        g_free(path);
    }
    return g_test_run();
}
