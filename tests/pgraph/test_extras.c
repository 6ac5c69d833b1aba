// What stems and crowns have beyond the paper: crown shapes, sectors, whorls, feet, ribs, breaks.
#include "graphs.h"

#include <math.h>

#define DEGREE (G_PI / 180)

static void crown_shapes(void) {
    // Weber and Penn 1995: conical is 0.2 + 0.8 r, r = 0 at the top and 1 at the base of the crown.
    Built built = build("tree A length=4;number=5;spacing=ends;start=.2;end=1;crown=conical\n"
                        "horn B length=2;radius=.1\nleaf L\nA = B\nB - L");
    const FrNodes *nodes = &built.plant->nodes;
    uint32_t first = built_axis(&built, "B");
    for (uint32_t k = 0; k < 5; k++) {
        uint32_t node = built.plant->axes.first[first + k];
        g_assert_cmpfloat_with_epsilon(nodes->length[node], 2 * (1 - 0.2 * k), 1e-5);
        // Only the length: neither radius nor what the branch bears.
        g_assert_cmpfloat_with_epsilon(built.plant->axes.base_radius[first + k], 0.1, 1e-6);
        g_assert_cmpfloat(built.plant->organs.scale[k], ==, 1);
    }
    built_free(built);
    built = build("tree A length=4;number=5\nhorn B length=2\nA = B");
    g_assert_cmpfloat(built.plant->nodes.length[built.plant->axes.first[3]], ==, 2);
    built_free(built);
}

static void sectors(void) {
    Built built = build("tree A number=50;sweep=90;branching-angle=90\nhorn B\nA = B");
    for (uint32_t k = 1; k < built.plant->axes.count; k++) {
        vec3s heading = fr_frame_heading(built.plant->nodes.rotation[built.plant->axes.first[k]]);
        g_assert_cmpfloat(heading.y, >, cos(45.01 * DEGREE));
    }
    built_free(built);
    // Two rows, to the left and right, and an azimuth turns the sector.
    built = build("tree A number=4;sweep=90;azimuth=180;branching-angle=90;phyllotaxis=distichous\n"
                  "horn B\nA = B");
    for (uint32_t k = 1; k < 5; k++) {
        vec3s heading = fr_frame_heading(built.plant->nodes.rotation[built.plant->axes.first[k]]);
        g_assert_cmpfloat(heading.y, <, -0.7);
    }
    built_free(built);
}

static void whorls_of_a_range(void) {
    Built built = build("phiball P number=3\ntree A number=12;whorl=2..4;regularity=1\nhorn B\n"
                        "P - A\nA = B");
    // The places of a whorl are one: 6 on the first tree, 4 on the second, 3 on the third.
    const FrAxes *axes = &built.plant->axes;
    for (uint32_t tree = 0; tree < 3; tree++) {
        uint32_t whorl = 2 + tree, first = 3 + 12 * tree;
        for (uint32_t b = 0; b < 12; b++) {
            uint32_t other = first + b - b % whorl;
            g_assert_cmpuint(axes->bearer[first + b], ==, axes->bearer[other]);
            g_assert_cmpfloat(axes->offset[first + b].z, ==, axes->offset[other].z);
        }
    }
    built_free(built);
}

static void wide_feet(void) {
    Built built = build("horn A length=10;radius=.5;taper=0;flare=2;flare-height=.2");
    const FrNodes *nodes = &built.plant->nodes;
    g_assert_cmpfloat_with_epsilon(built.plant->axes.base_radius[0], 1.5, 1e-5);
    g_assert_cmpuint(nodes->count, >=, 20);
    for (uint32_t k = 0; k < nodes->count; k++) {
        double at = (k + 1.0) / nodes->count;
        double expected = at < 0.2 ? 0.5 + pow(1 - at / 0.2, 3) : 0.5;
        g_assert_cmpfloat_with_epsilon(nodes->radius[k], expected, 1e-5);
    }
    built_free(built);
}

static void ribs(void) {
    Built built = build("horn A lobes=5;lobe-depth=.4");
    const FrProfile *profile =
        &g_array_index(built.plant->profiles, FrProfile, built.plant->axes.profile[0]);
    double least = 2, most = 0;
    for (uint32_t k = 0; k < profile->count; k++) {
        double radius = hypot(profile->points[k][0], profile->points[k][1]);
        least = fmin(least, radius);
        most = fmax(most, radius);
    }
    g_assert_cmpfloat_with_epsilon(most, 1, 1e-12);
    g_assert_cmpfloat_with_epsilon(least, 0.6, 1e-12);
    built_free(built);
}

static void broken_stems(void) {
    const char *text =
        "phiball P number=200\ntree A length=2;radius=.1;taper=.5;number=10;start=.5;"
        "end=1;break-chance=.25;break-at=.75;curvature=30\nleaf L\nP - A\nA = L";
    Built built = build(text);
    const FrAxes *axes = &built.plant->axes;
    uint32_t broken = 0;
    for (uint32_t k = 0; k < axes->count; k++) {
        double length = 0;
        for (uint32_t node = axes->first[k]; node != FR_NONE;
             node = built.plant->nodes.next[node]) {
            length += (double)built.plant->nodes.length[node];
        }
        bool is_broken = (axes->flags[k] & FR_CUT) != 0;
        broken += is_broken;
        g_assert_cmpfloat_with_epsilon(length, is_broken ? 1.5 : 2, 1e-5);
        // Where it broke it is as thick as it was there.
        g_assert_cmpfloat_with_epsilon(built.plant->nodes.radius[axes->last[k]],
                                       is_broken ? 0.1 * (1 - 0.5 * 0.75) : 0.05, 1e-6);
    }
    g_assert_cmpuint(broken, >, 30);
    g_assert_cmpuint(broken, <, 70);
    // Half of where leaves stood is gone.
    g_assert_cmpuint(built.plant->organs.count, ==, 200 * 10 - broken * 5);
    built_free(built);
    built = build("tree A break-chance=1;break-at=.01;start=.5\nleaf L\nA = L");
    g_assert_cmpuint(built.plant->organs.count, ==, 0);
    built_free(built);
}

// Stems without a finish of their own have none; of others those that broke have another.
static void finishes(void) {
    Built built = build("horn A tip=flat\nhorn B lobes=5");
    g_assert_cmpuint(built.plant->finishes->len, ==, 0);
    built_free(built);
    built = build("phiball P number=200\nhorn A length=2;radius=.1;break-chance=.5;tip=round;"
                  "break-tip=broken;wall=.2;relief=.1;buttresses=3\nP - A");
    const FrAxes *axes = &built.plant->axes;
    uint32_t broken = 0;
    g_assert_cmpuint(built.plant->finishes->len, ==, 2);
    for (uint32_t k = 0; k < axes->count; k++) {
        double length = 0;
        for (uint32_t node = axes->first[k]; node != FR_NONE;
             node = built.plant->nodes.next[node]) {
            length += (double)built.plant->nodes.length[node];
        }
        bool is_broken = length < 1.9;
        broken += is_broken;
        const FrFinish *finish = &g_array_index(built.plant->finishes, FrFinish, axes->finish[k]);
        g_assert_cmpuint(finish->cap, ==, is_broken ? FR_CAP_BROKEN : FR_CAP_ROUND);
        g_assert_cmpuint(finish->buttresses, ==, 3);
        g_assert_true(axes->flags[k] & FR_CUT);
    }
    g_assert_cmpuint(broken, >, 70);
    g_assert_cmpuint(broken, <, 130);
    built_free(built);
}

static void faint_bends(void) {
    // No joint turns by so much that it shows; what is straight stays one piece.
    Built built = build("horn A curvature=20");
    g_assert_cmpuint(built.plant->nodes.count, ==, 5);
    built_free(built);
    built = build("horn A curvature=3");
    g_assert_cmpuint(built.plant->nodes.count, ==, 3);
    built_free(built);
    built = build("horn A");
    g_assert_cmpuint(built.plant->nodes.count, ==, 1);
    built_free(built);
}

static const FrProfile *outline_of(const Built *built) {
    const FrShape *shape = &g_array_index(built->plant->shapes, FrShape, 0);
    g_assert_cmpuint(shape->blade.outline, !=, FR_NONE);
    return &g_array_index(built->plant->profiles, FrProfile, shape->blade.outline);
}

static void superformula(void) {
    // Gielis: m = 4, all n = 2 and a = b is a circle.
    Built built = build("leaf L outline=superformula");
    const FrProfile *circle = outline_of(&built);
    for (uint32_t k = 0; k < circle->count; k++) {
        double x = 2 * circle->points[k][0] - 1, y = 2 * circle->points[k][1];
        g_assert_cmpfloat_with_epsilon(x * x + y * y, 1, 1e-9);
    }
    built_free(built);
    // All n = 1 is a square on its corner.
    built = build("leaf L outline=superformula;super-n1=1;super-n2=1;super-n3=1");
    const FrProfile *square = outline_of(&built);
    for (uint32_t k = 0; k < square->count; k++) {
        double x = 2 * square->points[k][0] - 1, y = 2 * square->points[k][1];
        g_assert_cmpfloat_with_epsilon(fabs(x) + fabs(y), 1, 1e-9);
    }
    built_free(built);
}

static void two_halves(void) {
    Built built = build("leaf L outline-points=0,0 .5,.4 1,0;left-points=0,0 .4,.2 1,0");
    const FrProfile *outline = outline_of(&built);
    g_assert_true(outline->is_closed);
    g_assert_cmpuint(outline->count, ==, 6);
    g_assert_cmpfloat(outline->points[1][1], ==, 0.4);
    g_assert_cmpfloat(outline->points[4][0], ==, 0.4);
    g_assert_cmpfloat(outline->points[4][1], ==, -0.2);
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("a crown shape makes branches shorter and nothing else", crown_shapes);
    TEST("branches keep to their sector", sectors);
    TEST("a whorl has as many branches as its range says", whorls_of_a_range);
    TEST("a flare widens the foot", wide_feet);
    TEST("lobes are ribs of the cross-section", ribs);
    TEST("stems break by chance and bear nothing above", broken_stems);
    TEST("the superformula makes the outlines of its paper", superformula);
    TEST("a leaf may have two different halves", two_halves);
    TEST("finishes are there where they are asked for, others on what broke", finishes);
    TEST("bends are so fine that no joint shows", faint_bends);
    return g_test_run();
}
