// Rules of cpfg that few models need and that decide counts where they do. Random numbers were
// computed apart, by a program that knows nothing but the recurrence of drand48.
#include "lsystems.h"

/// The recurrence x → 0x5DEECE66D·x + 11 mod 2⁴⁸.
static double next(uint64_t *x) {
    *x = (UINT64_C(0x5DEECE66D) * *x + 0xB) & ((UINT64_C(1) << 48) - 1);
    return (double)*x / (double)(UINT64_C(1) << 48);
}

static void test_level_end(void) {
    // '=' goes to the end of the level whether brackets are considered or not.
    check_cpfg("consider: ABD\n", "A[BC]D", "A > B=D --> X", 1, "X[BC]D");
    check_cpfg("", "A[B[C]E]D", "A > [B=]D --> X", 1, "X[B[C]E]D");
    check_cpfg("", "AB[C]E", "A > B= --> X", 1, "XB[C]E");
    check_cpfg("", "AB[C]E", "A > B=E --> X", 1, "AB[C]E");
}

static void test_small_ring(void) {
    check_cpfg("ring Lsystem\n", "A", "A > AAA --> B", 1, "B");
    check_cpfg("ring Lsystem\n", "A", "AA < A --> B", 1, "B");
    check_cpfg("ring Lsystem\nignore: A\n", "AA", "A > B --> B", 1, "AA");
}

static void test_weights(void) {
    check_cpfg("seed: 3\n", "AAA", "A --> B : 0", 1, "BBB");
    // Parameters changed by the block stay changed in the successor.
    check_cpfg("seed: 3\n", "A(1)", "A(x) : {x = x+1;} 1 --> B(x) : 2", 1, "B(2)");
    check_cpfg("seed: 3\nStart: { n = 0; }\n", "A",
               "A : {n=n+1;} 1 --> B(n)\nA : {n=n+1;} 1 --> B(n)", 1, "B(2)");
}

static void test_seed_zero(void) {
    uint64_t x = 0;
    GString *expected = g_string_new(NULL);
    for (int i = 0; i < 20; i++) {
        g_string_append_c(expected, next(&x) * 2 <= 1 ? 'B' : 'C');
    }
    check_cpfg("seed: 0\n", "AAAAAAAAAAAAAAAAAAAA", "A --> B\nA --> C", 1, expected->str);
    g_string_free(expected, TRUE);
}

// One stream chooses for all L-systems of a file, and the end of a call is a position too.
static void test_one_stream(void) {
    uint64_t x = 5 | UINT64_C(155) << 32;
    double u[4];
    for (int i = 0; i < 4; i++) {
        u[i] = next(&x);
    }
    char *expected =
        g_strdup_printf("?(2)%c$%c", u[1] * 4 <= 1 ? 'D' : 'E', u[3] * 4 <= 1 ? 'B' : 'C');
    Derived d = begin("Lsystem: 1\nseed: 5\nderivation length: 1\naxiom: ?(2)A$A\nA --> B : 1\n"
                      "A --> C : 3\nendlsystem\nLsystem: 2\nseed: 77\naxiom: A\nA --> D : 1\n"
                      "A --> E : 3\nendlsystem\n",
                      1);
    step(&d, 1);
    check_now(&d, expected);
    g_free(expected);
    end(&d);
}

/// What a bud of generation n becomes: two axes or, where `lost` is 1 or 2, an axis and an end.
static void append_fork(GString *string, int n, int lost) {
    for (int side = 1; side <= 2; side++) {
        if (lost == side) {
            g_string_append(string, "[-L]");
        } else {
            g_string_append_printf(string, "[+FA(%d)]", n + 1);
        }
    }
}

// Weights of parameters, through four steps: every place of the string draws, brackets too.
static void test_weights_of_parameters(void) {
    uint64_t x = 1 | UINT64_C(155) << 32;
    GString *now_ = g_string_new("F[A(1)][A(1)]");
    for (int step = 0; step < 4; step++) {
        GString *next_ = g_string_new(NULL);
        for (const char *c = now_->str; *c != '\0'; c++) {
            double u = next(&x);
            if (*c != 'A') {
                g_string_append_c(next_, *c);
                continue;
            }
            int n = c[2] - '0';
            float first = 10, second = first + (float)n, all = second + (float)n;
            double at = u * (double)all;
            append_fork(next_, n, at <= (double)first ? 0 : at <= (double)second ? 1 : 2);
            c += 3;
        }
        g_string_free(now_, TRUE);
        now_ = next_;
    }
    check_cpfg("seed: 1\n", "F[A(1)][A(1)]",
               "A(n) --> [+FA(n+1)][+FA(n+1)] : 10\nA(n) --> [-L][+FA(n+1)] : n\n"
               "A(n) --> [+FA(n+1)][-L] : n",
               4, now_->str);
    g_string_free(now_, TRUE);
}

static void test_distributions(void) {
    const char *start = "Start: { srand(7); }\n";
    check_cpfg(start, "A(nran(10,2),nran(10,2),nran(10,2),nran(10,2))", "X --> X", 0,
               "A(11.7797,7.71654,8.77846,9.22764)");
    check_cpfg(start, "A(bran(2,3),bran(2,3),bran(2,3),bran(.5,.7),bran(.5,.7),ran(1))", "X --> X",
               0, "A(0.255696,0.255088,0.396614,7.36925e-05,0.481508,0.290213)");
    check_cpfg(start, "A(biran(20,.3),biran(20,.3),biran(20,.3),biran(2.9,.5),ran(1))", "X --> X",
               0, "A(10,6,10,1,0.158658)");
    check_cpfg("", "A(nran(10,2))", "X --> X", 0, "A(10)");
}

static void test_cut_ends(void) {
    check_cpfg("", "AB$C", "B --> %", 2, "A$C");
    check_cpfg("", "A%B[C]D", "X --> X\ndecomposition\n% --> Z", 1, "AZB[C]D");
    check_cpfg("", "A[%B[C]D]E", "X --> X", 1, "A[]E");
}

static void test_decomposed_pairs(void) {
    check_cpfg("", "BCB", "A --> A\ndecomposition\nBC --> D", 1, "DB");
    check_cpfg("", "A(3)", "X --> X\ndecomposition\nmaximum depth: 0\nA(n) --> B", 1, "A(3)");
}

static void test_rewritten_call(void) {
    const char *text = "Lsystem: 1\nderivation length: 3\naxiom: ?(2,1)A$\n"
                       "?(i,s) --> ?(i,s*2)\nEndLsystem\n"
                       "Lsystem: 2\nStart: { n = 10; }\nStartEach: { n = n+1; }\naxiom: A\n"
                       "A --> A(n)\nA(x) --> A(n)\nEndLsystem\n";
    Derived d = begin(text, 1);
    step(&d, 1);
    check_now(&d, "?(2,2)A(11)$");
    step(&d, 1);
    check_now(&d, "?(2,4)A(12)$");
    end(&d);
}

static void test_fractions_of_indices(void) {
    check_cpfg("define: { array a[2][3] = {1,2,3,4,5,6}; }\n", "A(a[0.5][1],a[1.9][0],a[1][1.9])",
               "X --> X", 0, "A(3,6,5)");
}

static void check_homomorphism(Derived *d, const char *expected) {
    FrLstring *string;
    g_assert_cmpint(fr_lderivation_homomorphism(d->derivation, &d->context, &string), ==, FR_OK);
    GString *out = g_string_new(NULL);
    fr_lstring_print(string, out);
    g_assert_cmpstr(out->str, ==, expected);
    g_string_free(out, TRUE);
    fr_lstring_free(string);
}

// The successor of a homomorphism with a seed draws from its own stream, anew each time; its
// condition draws from the common one.
static void test_homomorphism_seed(void) {
    Derived d = begin("Lsystem: 1\nStart: { srand(7); }\naxiom: AA\nA --> C(ran(1))\n"
                      "homomorphism\nseed: 3\nA : ran(1) < 2 --> B(ran(1))\nendlsystem\n",
                      1);
    uint64_t own = 0x330E | UINT64_C(3) << 16, common = 0x330E | UINT64_C(7) << 16;
    double first = next(&own), second = next(&own);
    char *expected = g_strdup_printf("B(%g)B(%g)", (double)(float)first, (double)(float)second);
    check_homomorphism(&d, expected);
    check_homomorphism(&d, expected);
    g_free(expected);
    for (int i = 0; i < 4; i++) {
        next(&common);
    }
    first = next(&common);
    second = next(&common);
    expected = g_strdup_printf("C(%g)C(%g)", (double)(float)first, (double)(float)second);
    step(&d, 1);
    check_now(&d, expected);
    g_free(expected);
    end(&d);
}

// Contexts of a called L-system's homomorphism are those of the main one, its rules its own.
static void test_homomorphism_of_calls(void) {
    Derived d = begin("Lsystem: 1\nignore: +\naxiom: A?(2)A+B$A\nX --> X\nhomomorphism\nA --> F\n"
                      "endlsystem\nLsystem: 2\nignore: B\naxiom: A\nX --> X\nhomomorphism\n"
                      "A > B --> G\nendlsystem\n",
                      1);
    check_homomorphism(&d, "F?(2)G+B$F");
    end(&d);
}

static void test_old_query(void) {
    check_cpfg("", "?P(0,0)F(2)s(7,7)s(7,7,7)s(7)~s(7,7)X", "X --> X", 1,
               "?P(0,0)F(2)s(0,2)s(0,2,0)s(7)~s(7,7)X");
    check_cpfg("", "F(2)s(7,7)X", "X --> X", 1, "F(2)s(7,7)X");
}

static void test_stop(void) {
    const char *head = "Start: { n = 0; }\nEndEach: { n = n+1; if (n == 2) { stop(1); }\n"
                       "if (n == 4) { stop(0); } }\n";
    check_cpfg(head, "A", "A --> AB", 9, "ABBBB");
}

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        void (*run)(void);
    } tests[] = {
        {"an equals sign leads to the end of the level", test_level_end},
        {"a ring of one module is its own neighbour", test_small_ring},
        {"weights are relative and blocks are kept", test_weights},
        {"seed zero leaves the stream unseeded", test_seed_zero},
        {"one stream chooses for all L-systems", test_one_stream},
        {"weights of parameters choose at every place", test_weights_of_parameters},
        {"distributions draw as in cpfg", test_distributions},
        {"a cut ends at a dollar and after decomposition", test_cut_ends},
        {"decomposition takes pairs of the old string", test_decomposed_pairs},
        {"a call that is rewritten keeps its variables", test_rewritten_call},
        {"fractions of indices count", test_fractions_of_indices},
        {"a homomorphism with a seed has its own stream", test_homomorphism_seed},
        {"a called L-system has its own homomorphism", test_homomorphism_of_calls},
        {"s with two or three parameters is filled as ?P", test_old_query},
        {"stop(1) goes on", test_stop},
    };
    g_test_init(&argc, &argv, NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(tests); i++) {
        char *path = g_strconcat("/lsystem/compatible/", tests[i].name, NULL);
        g_test_add_func(path, tests[i].run);
        g_free(path);
    }
    return g_test_run();
}
