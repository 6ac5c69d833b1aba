// Stems that sag, turn to what they stand on, and are as long or thick as others leave them.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

static vec3s heading_at(const FrPlant *plant, uint32_t node) {
    return fr_frame_heading(plant->nodes.frame[node]);
}

static double angle_from_up(const FrPlant *plant, uint32_t node) {
    return acos(fmax(-1, fmin(1, (double)heading_at(plant, node).z))) * DEGREES;
}

static double length_of(const FrPlant *plant, uint32_t axis) {
    double length = 0;
    for (uint32_t node = plant->axes.first[axis]; node != FR_NONE; node = plant->nodes.next[node]) {
        length += (double)plant->nodes.length[node];
    }
    return length;
}

// A uniform horizontal beam that hardly sags turns by ρ g L³ 4/(6 E r²) at its tip.
static void beam(void) {
    const char *segments[] = {"8", "40", "0"};
    for (size_t k = 0; k < G_N_ELEMENTS(segments); k++) {
        char *text = g_strdup_printf("horn H rotate-x=-90;length=1;radius=.01;taper=0;stiffness=10;"
                                     "segments=%s\nleaf L\nH - L",
                                     segments[k]);
        Built built = build(text);
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(built.plant, 0, &position, &rotation);
        double turn = asin(-(double)fr_frame_heading(rotation).z);
        double expected = 8800.0 * 4 / (6 * 1e10 * 1e-4);
        g_assert_cmpfloat_with_epsilon(turn, expected, 0.03 * expected);
        built_free(built);
        g_free(text);
    }
}

static void sags_with_load(void) {
    // Longer, thinner, softer and laden stems sag more; upright ones not at all.
    const char *texts[] = {"length=1;radius=.01", "length=2;radius=.01", "length=2;radius=.006",
                           "length=2;radius=.006;load=4"};
    double last = 90;
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        char *text = g_strdup_printf("horn H rotate-x=-90;stiffness=6;%s", texts[k]);
        Built built = build(text);
        double angle = angle_from_up(built.plant, built.plant->nodes.count - 1);
        g_assert_cmpfloat(angle, >, last);
        last = angle;
        built_free(built);
        g_free(text);
    }
    Built built = build("horn H stiffness=.01;radius=.002;length=2");
    g_assert_cmpfloat(angle_from_up(built.plant, built.plant->nodes.count - 1), <, 0.01);
    built_free(built);
}

static void align(void) {
    // Like any tropism: e^−κ of the angle to the parent's direction is left.
    const char *segments[] = {"4", "64"};
    for (size_t k = 0; k < G_N_ELEMENTS(segments); k++) {
        char *text = g_strdup_printf("tree T number=1;rotate-x=-50;length=2\n"
                                     "horn H align=1.2;length=1;segments=%s\nleaf L\nT = H\nH - L",
                                     segments[k]);
        Built built = build(text);
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(built.plant, 0, &position, &rotation);
        double cosine =
            (double)glms_vec3_dot(fr_frame_heading(rotation), heading_at(built.plant, 0));
        g_assert_cmpfloat_with_epsilon(acos(cosine) * DEGREES, 45 * exp(-1.2), 0.05);
        built_free(built);
        g_free(text);
    }
}

static void aim(void) {
    // The same to a direction that is given, of any length, whatever it grows on; a negative one
    // turns away from it, and one without direction turns nothing.
    static const struct {
        const char *strength, *at;
        vec3s towards;
        double left;
    } cases[] = {
        {"1.2", "0, 30, 0", {{0, 1, 0}}, 90 * 0.30119421191220214},
        {"0.7", "-2, 0, 0", {{-1, 0, 0}}, 120 * 0.4965853037914095},
        {"-0.2", "0, 0, -1", {{0, 0, -1}}, 150 * 1.2214027581601699},
        {"5", "0, 0, 0", {{0, 0, 1}}, 30},
    };
    for (size_t k = 0; k < 2 * G_N_ELEMENTS(cases); k++) {
        char *text = g_strdup_printf("horn H rotate-y=30;length=1;segments=%d;aim=%s;aim-at=%s\n"
                                     "leaf L\nH - L",
                                     k % 2 == 0 ? 4 : 64, cases[k / 2].strength, cases[k / 2].at);
        Built built = build(text);
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(built.plant, 0, &position, &rotation);
        double cosine = (double)glms_vec3_dot(fr_frame_heading(rotation), cases[k / 2].towards);
        double left = fmin(cases[k / 2].left, 180);
        g_assert_cmpfloat_with_epsilon(acos(fmax(-1, fmin(cosine, 1))) * DEGREES, left, 0.06);
        built_free(built);
        g_free(text);
    }
}

static void back_curvature(void) {
    // An S: 60 degrees up to its middle, then back by as much.
    Built built = build("horn H curvature=120;curvature-back=-120;segments=40\nleaf L\nH - L");
    vec3s position;
    versors rotation;
    g_assert_cmpfloat_with_epsilon(angle_from_up(built.plant, 19), 60, 2);
    fr_plant_organ_pose(built.plant, 0, &position, &rotation);
    g_assert_cmpfloat((double)fr_frame_heading(rotation).z, >, cos(1 / DEGREES));
    built_free(built);
}

static void fine_gnarl(void) {
    // It trembles about the way it would go, which it leaves as it was.
    Built plain = build("horn H length=2;gnarl=20;segments=100");
    Built fine = build("horn H length=2;gnarl=20;segments=100;gnarl-fine=15");
    double off = 0, turns[2] = {0, 0};
    for (uint32_t k = 0; k < 100; k++) {
        off = fmax(off, (double)glms_vec3_distance(plain.plant->nodes.position[k],
                                                   fine.plant->nodes.position[k]));
        turns[0] += acos(fmin(1, fabs((double)plain.plant->nodes.rotation[k].w)));
        turns[1] += acos(fmin(1, fabs((double)fine.plant->nodes.rotation[k].w)));
    }
    g_assert_cmpfloat(off, <, 0.3);
    g_assert_cmpfloat(turns[1], >, 1.5 * turns[0]);
    built_free(plain);
    built_free(fine);
}

static void remaining_length(void) {
    Built built = build("tree T length=4;number=4;start=0;end=1\n"
                        "horn H length=.5;length-mode=of-remaining\nT = H");
    for (uint32_t k = 0; k < 4; k++) {
        double left = 4 * (1 - (k + 0.5) / 4);
        g_assert_cmpfloat_with_epsilon(length_of(built.plant, k + 1), 0.5 * left, 1e-5);
    }
    built_free(built);
}

static void to_an_envelope(void) {
    // Within a box of 2 by 2 m level branches to its sides are 1 m long, and 0.8 of that here.
    const char *text = "force F kind=box;size=2,2,8;inverted=yes;solid=stop;strength=0\n"
                       "tree T length=2;number=4;start=.1;branching-angle=90;radius=.01;"
                       "phyllotaxis=custom;azimuth-step=90\n"
                       "horn H length=.8;length-mode=to-obstacle\nF - T\nT = H";
    Built built = build(text);
    for (uint32_t axis = 1; axis <= 4; axis++) {
        g_assert_cmpfloat_with_epsilon(length_of(built.plant, axis), 0.8, 1e-3);
    }
    built_free(built);
    // Nothing ahead: so many metres.
    built = build("horn H length=.8;length-mode=to-obstacle");
    g_assert_cmpfloat_with_epsilon(length_of(built.plant, 0), 0.8, 1e-6);
    built_free(built);
}

static void pipes(void) {
    // Two twigs of 1 cm on a stem of exponent 2: √2 cm below both, 1 cm between them and at the
    // tip.
    Built built = build("tree T radius-mode=pipe;pipe-exponent=2;radius=.005;length=1;number=2;"
                        "spacing=ends;start=.3;end=.6;segments=10\n"
                        "horn H radius=.01;length=.3;taper=0\nT = H");
    const FrNodes *nodes = &built.plant->nodes;
    g_assert_cmpfloat_with_epsilon((double)nodes->radius[9], 0.005, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)nodes->radius[4], sqrt(0.005 * 0.005 + 1e-4), 1e-6);
    g_assert_cmpfloat_with_epsilon((double)nodes->radius[0], sqrt(0.005 * 0.005 + 2e-4), 1e-6);
    g_assert_cmpfloat_with_epsilon((double)built.plant->axes.base_radius[0],
                                   sqrt(0.005 * 0.005 + 2e-4), 1e-6);
    built_free(built);
}

static void pipes_carry_leaves(void) {
    // Leaves on a stem that became thicker stand on its new surface.
    Built built =
        build("tree T radius-mode=pipe;radius=.002;length=1;number=12;start=0;segments=12\n"
              "horn H radius=.02;length=.3\nleaf L\nT = H\nT = L");
    const FrPlant *plant = built.plant;
    for (uint32_t k = 0; k < plant->organs.count; k++) {
        vec3s offset = plant->organs.offset[k];
        double radius = (double)plant->nodes.radius[plant->organs.node[k]];
        g_assert_cmpfloat_with_epsilon(hypot((double)offset.x, (double)offset.y), radius, 1e-5);
    }
    built_free(built);
}

static void own_tropism(void) {
    // Half the way of 80 degrees up, whatever it stands on; negative all the way down.
    Built built = build("simple A rotate-x=80;tropism-z=.5");
    g_assert_cmpfloat_with_epsilon(
        acos((double)fr_frame_heading(built.plant->organs.rotation[0]).z) * DEGREES, 40, 1e-3);
    built_free(built);
    built = build("tree T number=5;length=1\nhorn H tropism-z=-1\nT = H");
    for (uint32_t axis = 1; axis <= 5; axis++) {
        vec3s heading = heading_at(built.plant, built.plant->axes.first[axis]);
        g_assert_cmpfloat((double)heading.z, <, -1 + 1e-6);
    }
    built_free(built);
    built = build("simple A rotate-z=70;tropism-axis=x;tropism-x=1");
    g_assert_cmpfloat((double)fr_frame_left(built.plant->organs.rotation[0]).x, >, 1 - 1e-6);
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/weight/" name, function)
    TEST("a beam sags as the theory of beams says", beam);
    TEST("longer, thinner and laden stems sag more", sags_with_load);
    TEST("an aligned stem keeps a part of its angle to the parent", align);
    TEST("a stem that aims keeps a part of its angle to a direction", aim);
    TEST("curvature and back curvature make an S", back_curvature);
    TEST("a fine gnarl trembles about the stem's way", fine_gnarl);
    TEST("a length of what remains shrinks to the tip", remaining_length);
    TEST("a length to an obstacle ends before it", to_an_envelope);
    TEST("pipes add up where stems divide", pipes);
    TEST("leaves stand on the surface of pipes", pipes_carry_leaves);
    TEST("a tropism of its own turns any component", own_tropism);
    return g_test_run();
}
