// Derivations printed in The Algorithmic Beauty of Plants (Prusinkiewicz, Lindenmayer 1990).
#include "lsystems.h"

#include <math.h>

static void test_algae(void) {
    CHECK_STEPS("w : A\np1 : A -> AB\np2 : B -> A\n", "A", "AB", "ABA", "ABAAB", "ABAABABA");
}

// Section 1.2, eq. 1.1, with a = a_r, A = a_l, b = b_r, B = b_l.
static void test_anabaena(void) {
    CHECK_STEPS("w : a\np1 : a -> Ab\np2 : A -> Ba\np3 : b -> a\np4 : B -> A\n", "a", "Ab", "Baa",
                "AAbAb", "BaBaaBaa");
}

// Section 1.8: a signal walks along a filament.
static void test_signal(void) {
    CHECK_STEPS("w : baaaaaaaa\np1 : b < a -> b\np2 : b -> a\n", "baaaaaaaa", "abaaaaaaa",
                "aabaaaaaa", "aaabaaaaa");
}

// Fig 1.31: a signal from the base reaches all branches, one from the tip only the main axis.
static void test_signals_in_branches(void) {
    CHECK_STEPS("ignore: +-\nw : b[+a]a[-a]a[+a]a\np1 : b < a -> b\n", "b[+a]a[-a]a[+a]a",
                "b[+b]b[-a]a[+a]a", "b[+b]b[-b]b[+a]a", "b[+b]b[-b]b[+b]b");
    CHECK_STEPS("ignore: +-\nw : a[+a]a[-a]a[+a]b\np1 : a > b -> b\n", "a[+a]a[-a]a[+a]b",
                "a[+a]a[-a]b[+a]b", "a[+a]b[-a]b[+a]b", "b[+a]b[-a]b[+a]b");
}

// Section 1.10.1, Fig 1.37.
static void test_parametric(void) {
    CHECK_STEPS("w : B(2)A(4,4)\n"
                "p1 : A(x,y) : y<=3 -> A(x*2,x+y)\n"
                "p2 : A(x,y) : y>3 -> B(x)A(x/y,0)\n"
                "p3 : B(x) : x<1 -> C\n"
                "p4 : B(x) : x>=1 -> B(x-1)\n",
                "B(2)A(4,4)", "B(1)B(4)A(1,0)", "B(0)B(3)A(2,1)", "CB(2)A(4,3)", "CB(1)A(8,7)",
                "CB(0)B(8)A(1.14286,0)");
}

// Section 1.8, the 2L-system over the context of ABC[DE][SG[HI[JK]L]MNO]: S < … > G[H]M.
static void test_bracket_context(void) {
    CHECK_STEPS("w : ABC[DE][SG[HI[JK]L]MNO]\np1 : BC < S > G[H=]M -> X\n",
                "ABC[DE][SG[HI[JK]L]MNO]", "ABC[DE][XG[HI[JK]L]MNO]");
}

static const char KOCH[] = "w : F-F-F-F\np1 : F -> F-F+F+FF-F-F+F\n";

static void test_koch(void) {
    Derived d = begin(KOCH, 1);
    step(&d, 1);
    check_now(&d, "F-F+F+FF-F-F+F-F-F+F+FF-F-F+F-F-F+F+FF-F-F+F-F-F+F+FF-F-F+F");
    step(&d, 2);
    uint64_t segments = 0, at = 0;
    FrLmodule module;
    while (fr_lstring_next(fr_lderivation_string(d.derivation), &at, &module)) {
        segments += module.symbol == 'F';
    }
    g_assert_cmpuint(segments, ==, 4 * 8 * 8 * 8);
    end(&d);
}

// Fig 1.24 e: F is doubled, X makes 4 X of itself.
static void test_bracketed(void) {
    CHECK_STEPS("w : X\np1 : X -> F[+X][-X]FX\np2 : F -> FF\n", "X", "F[+X][-X]FX",
                "FF[+F[+X][-X]FX][-F[+X][-X]FX]FFF[+X][-X]FX");
}

static const char MONO[] = "#define r1 0.9\n#define r2 0.6\n#define wr 0.707\n"
                           "Lsystem: 1\nderivation length: 20\naxiom: A(1,10)\n"
                           "A(l,w) --> !(w)F(l)[&(45)B(l*r2,w*wr)]/(137.5)A(l*r1,w*wr)\n"
                           "B(l,w) --> !(w)F(l)[-(45)$C(l*r2,w*wr)]C(l*r1,w*wr)\n"
                           "C(l,w) --> !(w)F(l)[+(45)$B(l*r2,w*wr)]B(l*r1,w*wr)\n"
                           "endlsystem\n";

// Fig 2.6: 7·2ⁿ − 6 modules after n steps, and the same bits for any number of threads.
static void test_monopodial(void) {
    FrDigest first = 0;
    for (int threads = 1; threads <= 8; threads = threads == 3 ? 8 : threads + 1) {
        Derived d = begin(MONO, threads);
        step(&d, 2);
        check_now(&d, "!(10)F(1)[&(45)!(7.07)F(0.6)[-(45)$C(0.36,4.99849)]C(0.54,4.99849)]"
                      "/(137.5)!(7.07)F(0.9)[&(45)B(0.54,4.99849)]/(137.5)A(0.81,4.99849)");
        step(&d, 13);
        const FrLstring *string = fr_lderivation_string(d.derivation);
        g_assert_cmpuint(fr_lstring_count(string), ==, 7 * (1 << 15) - 6);
        g_assert_cmpuint(fr_lstring_bytes(string), <=, 8 * fr_lstring_count(string));
        FrDigest digest = fr_lstring_digest(string);
        first = threads == 1 ? digest : first;
        g_assert_cmpuint(digest, ==, first);
        end(&d);
    }
}

// Fig 5.6 f and 5.8: the axis of a leaf after n steps is LA·(RAⁿ − 1)/(RA − 1) long; a rose leaf
// has two teeth more every step.
static void test_leaves(void) {
    Derived d = begin("#define PD 1\nLsystem: 1\naxiom: {.A(0)}\n"
                      "A(t) --> G(5,1.1)[-(60)B(t).][A(t+1)][+(60)B(t).]\n"
                      "B(t) : t > 0 --> G(1,1.2)B(t-PD)\nG(s,r) --> G(s*r,r)\nendlsystem\n",
                      1);
    FrPlant *plant;
    FrLdrawn drawn;
    step(&d, 1);
    check_now(&d, "{.G(5,1.1)[-(60)B(0).][A(1)][+(60)B(0).]}");
    step(&d, 19);
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, &drawn), ==, FR_OK);
    g_assert_cmpfloat_with_epsilon(drawn.max[1], 5 * (pow(1.1, 20) - 1) / 0.1, 1e-3);
    g_assert_cmpuint(drawn.polygons, ==, 1);
    fr_plant_free(plant);
    end(&d);
    d = begin("Lsystem: 1\naxiom: [{A(0,0).}][{A(0,1).}]\n"
              "A(t,d) : d == 0 --> .G(5,1.15).[+(60)B(t)G(3,1.19,t).}][+(60)B(t){.]A(t+1,d)\n"
              "A(t,d) : d == 1 --> .G(5,1.15).[-(60)B(t)G(3,1.19,t).}][-(60)B(t){.]A(t+1,d)\n"
              "B(t) : t > 0 --> G(1.3,1.25)B(t-1)\nG(s,r) --> G(s*r,r)\n"
              "G(s,r,t) : t > 1 --> G(s*r,r,t-1)\nendlsystem\n",
              1);
    step(&d, 25);
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, &drawn), ==, FR_OK);
    g_assert_cmpuint(drawn.polygons, ==, 2 * 25);
    fr_plant_free(plant);
    end(&d);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/published/algae grow as printed", test_algae);
    g_test_add_func("/lsystem/published/Anabaena divides as printed", test_anabaena);
    g_test_add_func("/lsystem/published/a signal walks along a filament", test_signal);
    g_test_add_func("/lsystem/published/signals go up and down through branches",
                    test_signals_in_branches);
    g_test_add_func("/lsystem/published/parameters change as printed", test_parametric);
    g_test_add_func("/lsystem/published/contexts see through branches", test_bracket_context);
    g_test_add_func("/lsystem/published/the Koch island has its segments", test_koch);
    g_test_add_func("/lsystem/published/a bracketed plant grows as printed", test_bracketed);
    g_test_add_func("/lsystem/published/the monopodial tree has its modules on any threads",
                    test_monopodial);
    g_test_add_func("/lsystem/published/leaves have their axes and teeth", test_leaves);
    return g_test_run();
}
