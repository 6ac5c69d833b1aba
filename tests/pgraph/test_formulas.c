// Published formulas and their vectors, to the printed digits.
#include "graphs.h"

#include "pgraph/golden.h"
#include "pgraph/places.h"
#include "pgraph/tropism.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

static void interpolation(void) {
    // 4.10 A: v = v0 + i (v1 - v0) / (n - 1), and v0 for an only child.
    Built built = build("phiball P number=5\nhorn H length=10..20\nP - H");
    const double expected[] = {10, 12.5, 15, 17.5, 20};
    for (uint32_t i = 0; i < 5; i++) {
        g_assert_cmpfloat_with_epsilon(built.plant->nodes.length[i], expected[i], 1e-6);
    }
    built_free(built);
    built = build("phiball P number=1\nhorn H length=10..20\nP - H");
    g_assert_cmpfloat(built.plant->nodes.length[0], ==, 10);
    built_free(built);
}

static void functions(void) {
    // Each parameter has a function of its own; iteration and generation are variables.
    Built built = build("phiball P number=3\nhorn H length=1..2 : t^2;radius== 0.01*(1+i)\nP - H");
    for (uint32_t i = 0; i < 3; i++) {
        double t = i / 2.0;
        g_assert_cmpfloat_with_epsilon(built.plant->nodes.length[i], 1 + t * t, 1e-6);
        g_assert_cmpfloat_with_epsilon(built.plant->axes.base_radius[i], 0.01 * (1 + i), 1e-8);
    }
    built_free(built);
    built = build("phiball P number=2\nphiball Q number=3\nhorn H length== 1 + i + 10*i1\n"
                  "P - Q\nQ - H");
    for (uint32_t k = 0; k < 6; k++) {
        g_assert_cmpfloat_with_epsilon(built.plant->nodes.length[k], 1 + k % 3 + 10 * (k / 3),
                                       1e-5);
    }
    built_free(built);
}

static void randomness_per_component(void) {
    const char *text = "phiball P number=4\nhorn H length=1 ~ .5\nhorn K length=1 ~ .5\nP - H\n"
                       "P - K";
    Built one = build(text);
    FrPgraph *graph = graph_read(text);
    graph_set(graph, "K", "seed", "7");
    Built two = build_graph(graph, NULL);
    for (uint32_t k = 0; k < 8; k++) {
        bool is_h = one.plant->axes.component[k] == fr_pgraph_find(one.graph, "H");
        bool is_equal = one.plant->nodes.length[k] == two.plant->nodes.length[k];
        g_assert_true(is_equal == is_h);
    }
    built_free(one);
    built_free(two);
}

static void assert_polars(const double *expected, uint32_t n, double opening, double closing,
                          bool is_end) {
    for (uint32_t i = 0; i < n; i++) {
        double polar =
            fr_golden_polar(opening / DEGREES, closing / DEGREES, fr_golden_before(i, n, is_end));
        g_assert_cmpfloat_with_epsilon(polar * DEGREES, expected[i], 0.5e-4);
    }
}

static void golden_polars(void) {
    static const double five_end[] = {53.1301, 78.4630, 101.5370, 126.8699, 180};
    static const double five_mid[] = {36.8699, 66.4218, 90, 113.5782, 143.1301};
    static const double ten_end[] = {25.3523, 34.6565, 42.1441, 48.6739, 54.6037,
                                     60.1248, 65.3549, 70.3739, 75.2404, 80};
    static const double ten_mid[] = {19.2220, 30.3297, 38.5543, 45.5006, 51.6995,
                                     57.4069, 62.7706, 67.8868, 72.8231, 77.6310};
    assert_polars(five_end, 5, 0, 180, true);
    assert_polars(five_mid, 5, 0, 180, false);
    assert_polars(ten_end, 10, 10, 80, true);
    assert_polars(ten_mid, 10, 10, 80, false);
}

// Polar angle of organ k about the origin.
static double polar_of(const FrPlant *plant, uint32_t organ) {
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(plant, organ, &position, &rotation);
    return acos((double)position.z / (double)glms_vec3_norm(position)) * DEGREES;
}

static void golden_in_a_plant(void) {
    static const double mid[] = {19.2220, 30.3297, 38.5543, 45.5006, 51.6995,
                                 57.4069, 62.7706, 67.8868, 72.8231, 77.6310};
    Built built = build("phiball P number=10;opening=10;closing=80;radius=2\nleaf L\nP - L");
    for (uint32_t k = 0; k < 10; k++) {
        g_assert_cmpfloat_with_epsilon(polar_of(built.plant, k), mid[k], 1e-3);
        // The leaf stands along the normal.
        vec3s heading = fr_frame_heading(built.plant->organs.rotation[k]);
        g_assert_cmpfloat_with_epsilon(2 * heading.z, built.plant->organs.offset[k].z, 1e-5);
    }
    built_free(built);
}

static void golden_influence(void) {
    // Areas from 1 to 3: the children's scale is the root of a linear range.
    static const double sized[] = {15.3062, 23.1521, 30.0731, 36.6500, 43.0974,
                                   49.5279, 56.0169, 62.6253, 69.4116, 76.4387};
    static const double equal[] = {19.2220, 30.3297, 38.5543, 45.5006, 51.6995,
                                   57.4069, 62.7706, 67.8868, 72.8231, 77.6310};
    const char *text = "phiball P number=10;opening=10;closing=80;radius=2;"
                       "child-scale== sqrt(1 + 2*t);influence=%s\nleaf L\nP - L";
    for (int full = 0; full < 2; full++) {
        char *filled = g_strdup_printf(text, full ? "1" : "0");
        Built built = build(filled);
        for (uint32_t k = 0; k < 10; k++) {
            g_assert_cmpfloat_with_epsilon(polar_of(built.plant, k), full ? sized[k] : equal[k],
                                           1e-3);
        }
        built_free(built);
        g_free(filled);
    }
}

static void golden_radius(void) {
    g_assert_cmpfloat_with_epsilon(fr_golden_radius(300, 4e-4, 0.5), 0.195441, 0.5e-6);
    Built built = build("phiball P number=300;radius-mode=by-area;child-area=.0004;closing=60\n"
                        "leaf L\nP - L");
    g_assert_cmpfloat_with_epsilon(glms_vec3_norm(built.plant->organs.offset[7]), 0.195441, 1e-6);
    built_free(built);
}

static void golden_touching(void) {
    // Discs of the given radius never overlap.
    Built built = build("phiball P number=200;radius-mode=touching;child-radius=.01;opening=5;"
                        "closing=150\nleaf L\nP - L");
    const vec3s *at = built.plant->organs.offset;
    float nearest = 1;
    for (uint32_t a = 0; a < 200; a++) {
        for (uint32_t b = 0; b < a; b++) {
            nearest = fminf(nearest, glms_vec3_distance(at[a], at[b]));
        }
    }
    g_assert_cmpfloat(nearest, >=, 0.02f);
    g_assert_cmpfloat(nearest, <, 0.026f);
    built_free(built);
}

static void golden_parastichies(void) {
    Built built = build("phiball P number=500;closing=20;radius=1\nsimple S\nP - S");
    const vec3s *at = built.plant->organs.offset;
    for (uint32_t a = 350; a < 450; a++) {
        uint32_t nearest = a == 0;
        for (uint32_t b = 0; b < 500; b++) {
            if (b != a &&
                glms_vec3_distance2(at[a], at[b]) < glms_vec3_distance2(at[a], at[nearest])) {
                nearest = b;
            }
        }
        uint32_t apart = nearest > a ? nearest - a : a - nearest;
        g_assert_true(apart == 34 || apart == 55 || apart == 89);
    }
    built_free(built);
}

static void tropism_formula(void) {
    FrTropism light = {.up = 1.2};
    const uint32_t numbers[] = {4, 16, 64, 256};
    for (size_t k = 0; k < G_N_ELEMENTS(numbers); k++) {
        double angle = 100 / DEGREES;
        for (uint32_t step = 0; step < numbers[k]; step++) {
            angle = fr_tropism_angle(light, angle, 1.0 / numbers[k]);
        }
        g_assert_cmpfloat_with_epsilon(angle * DEGREES, 30.119421, 0.5e-6);
    }
    // All three fields together have a place of rest that steps approach as exactly.
    FrTropism all = {.up = 0.3, .down = 0.5, .flat = 0.7};
    double once = fr_tropism_angle(all, 0.4, 1), twice = 0.4;
    for (int step = 0; step < 10; step++) {
        twice = fr_tropism_angle(all, twice, 0.1);
    }
    g_assert_cmpfloat_with_epsilon(once, twice, 1e-12);
    g_assert_cmpfloat(fr_tropism_angle((FrTropism){.up = -9}, 1, 1), ==, G_PI);
}

static void tropism_in_a_stem(void) {
    // A horn after the stem shows the direction of its tip.
    const char *numbers[] = {"4", "16", "64", "256"};
    for (size_t k = 0; k < G_N_ELEMENTS(numbers); k++) {
        char *text = g_strdup_printf("horn A length=1;rotate-x=-100;phototropism=1.2;segments=%s\n"
                                     "horn B length=1;segments=1\nA - B",
                                     numbers[k]);
        Built built = build(text);
        const FrPlant *plant = built.plant;
        vec3s heading = fr_frame_heading(plant->nodes.frame[plant->axes.first[1]]);
        g_assert_cmpfloat_with_epsilon(acos((double)heading.z) * DEGREES, 30.119421, 1e-3);
        vec3s tip = plant->nodes.position[plant->axes.last[0]];
        // The midpoint rule is within half a per cent of the length with four internodes.
        double near_enough = k == 0 ? 0.005 : 0.0005;
        g_assert_cmpfloat_with_epsilon(tip.y, 0.79827, near_enough);
        g_assert_cmpfloat_with_epsilon(tip.z, 0.49761, near_enough);
        built_free(built);
        g_free(text);
    }
}

static void density_distribution(void) {
    // 4.10 E: positions follow the density: Kolmogorov distance under 0.05 at n = 200.
    Built built = build("tree A number=200;start=0;end=1;density-curve=0,0 1,1;length=1;taper=0\n"
                        "leaf L\nA = L");
    const FrPlant *plant = built.plant;
    double worst = 0;
    for (uint32_t k = 0; k < 200; k++) {
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(plant, k, &position, &rotation);
        double u = (double)position.z;
        worst = fmax(worst, fabs(u * u - (k + 0.5) / 200));
    }
    g_assert_cmpfloat(worst, <, 0.01);
    built_free(built);
}

static void divergence(void) {
    static const struct {
        const char *phyllotaxis;
        double step;
        uint32_t whorl;
    } cases[] = {{"spiral", 137.50776405, 1},
                 {"distichous", 180, 1},
                 {"decussate", 90, 2},
                 {"alternate", 144, 1},
                 {"custom;azimuth-step=33", 33, 1},
                 {"spiral;whorl=3", 137.50776405, 3}};
    for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
        char *text = g_strdup_printf("tree A number=12;branching-angle=60;phyllotaxis=%s\n"
                                     "horn B length=1;segments=1\nA = B",
                                     cases[c].phyllotaxis);
        Built built = build(text);
        const FrPlant *plant = built.plant;
        for (uint32_t b = 0; b < 12; b++) {
            uint32_t node = plant->axes.first[1 + b];
            vec3s heading = fr_frame_heading(plant->nodes.frame[node]);
            double azimuth = cases[c].step * (b / cases[c].whorl) +
                             360.0 / cases[c].whorl * (b % cases[c].whorl);
            double off = sin(G_PI / 3);
            g_assert_cmpfloat_with_epsilon(heading.x, off * cos(azimuth / DEGREES), 1e-5);
            g_assert_cmpfloat_with_epsilon(heading.y, off * sin(azimuth / DEGREES), 1e-5);
            g_assert_cmpfloat_with_epsilon(heading.z, 0.5, 1e-5);
            // The upper side looks to the stem's tip.
            g_assert_cmpfloat(fr_frame_up(plant->nodes.frame[node]).z, >, 0.8f);
        }
        built_free(built);
        g_free(text);
    }
}

static void leaf_phototropism(void) {
    const char *strengths[] = {"0", ".5", "1"};
    for (int k = 0; k < 3; k++) {
        char *text = g_strdup_printf("leaf L rotate-x=10;phototropism=%s", strengths[k]);
        Built built = build(text);
        vec3s normal = fr_frame_up(built.plant->organs.rotation[0]);
        // The upper face looked 80 degrees away from the light.
        g_assert_cmpfloat_with_epsilon(acos(fmin(1, (double)normal.z)) * DEGREES,
                                       (1 - 0.5 * k) * 80, 0.1);
        built_free(built);
        g_free(text);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("F1 children are interpolated between both ends", interpolation);
    TEST("F2 F4 F5 every parameter has its own function", functions);
    TEST("F6 components have seeds of their own", randomness_per_component);
    TEST("C26 golden section polar angles are the published ones", golden_polars);
    TEST("C26 a phiball stands its children there", golden_in_a_plant);
    TEST("C26 the sphere is as large as its children need", golden_radius);
    TEST("C26 touching children do not overlap", golden_touching);
    TEST("C26 parastichies are Fibonacci numbers", golden_parastichies);
    TEST("C27 larger children take more room", golden_influence);
    TEST("C21 tropism does not depend on steps", tropism_formula);
    TEST("C21 tropism does not depend on internodes", tropism_in_a_stem);
    TEST("C16 branches follow the density curve", density_distribution);
    TEST("E branches turn by the phyllotaxis", divergence);
    TEST("C11 a leaf turns its face to the light", leaf_phototropism);
    return g_test_run();
}
