// Stems and leaves: forms held against geometry.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

static double angle_between(vec3s a, vec3s b) {
    return acos(fmin(1, (double)glms_vec3_dot(a, b))) * DEGREES;
}

static void simple_chain(void) {
    // Four cross-sections by Simple make the tube that a Horn of four steps makes.
    Built chain = build("simple A primitive=tube;size=.2;depth=4;recursion-scale=.8;"
                        "translate-z=.5;rotate-x=15\nA - A");
    Built horn = build("horn H course=steps;steps=4;step-translate=0,0,.5;step-rotate-x=15;"
                       "step-scale=.8;radius=.1;translate-z=.5;rotate-x=15");
    const FrPlant *a = chain.plant;
    const FrPlant *b = horn.plant;
    g_assert_cmpuint(a->axes.count, ==, 1);
    g_assert_cmpuint(a->nodes.count, ==, 3);
    g_assert_cmpuint(a->axes.flags[0] & FR_POINT_SETS, !=, 0);
    g_assert_cmpuint(b->axes.flags[0] & FR_POINT_SETS, !=, 0);
    g_assert_cmpuint(b->nodes.count, ==, 3);
    g_assert_cmpfloat_with_epsilon(a->axes.base_radius[0], b->axes.base_radius[0], 1e-6);
    // The chain's translation is scaled with each generation, the first not.
    float scale = 0.8f;
    for (uint32_t k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(a->nodes.length[k], 0.5f * scale, 1e-6);
        g_assert_cmpfloat_with_epsilon(a->nodes.radius[k], b->nodes.radius[k], 1e-6);
        for (int d = 0; d < 4; d++) {
            g_assert_cmpfloat_with_epsilon(a->nodes.frame[k].raw[d], b->nodes.frame[k].raw[d],
                                           1e-5);
        }
        scale *= 0.8f;
    }
    built_free(chain);
    built_free(horn);
}

static void simple_chain_forks(void) {
    // Only one of two cross-sections goes on in the tube, the other begins a new one.
    Built built = build("simple A primitive=tube\nsimple B primitive=tube;translate-z=1\n"
                        "simple C primitive=tube;translate-x=1\nsimple D primitive=area\n"
                        "A - B\nA - C\nB - D");
    g_assert_cmpuint(built.plant->axes.count, ==, 3);
    g_assert_cmpuint(built.plant->nodes.count, ==, 1);
    built_free(built);
}

static void stacked_solids(void) {
    Built built = build("simple A size=1,1,2\nsimple B primitive=sphere;rotate-y=90;size=1\n"
                        "simple C size=.5\nA - B\nB - C");
    const FrOrgans *organs = &built.plant->organs;
    g_assert_cmpfloat(organs->offset[1].z, ==, 2);
    g_assert_cmpfloat_with_epsilon(organs->offset[2].x, 1, 1e-6);
    g_assert_cmpfloat_with_epsilon(organs->offset[2].z, 2, 1e-6);
    g_assert_cmpuint(built.plant->shapes->len, ==, 3);
    built_free(built);
}

static void transformation_order(void) {
    // Translate, then about x, y, z in turn; children are within.
    Built built = build("simple A primitive=none;translate-x=1;rotate-x=90;scale=2\n"
                        "simple B translate-z=1\nA - B");
    vec3s at = built.plant->organs.offset[0];
    g_assert_cmpfloat_with_epsilon(at.x, 1, 1e-6);
    g_assert_cmpfloat_with_epsilon(at.y, -2, 1e-6);
    g_assert_cmpfloat_with_epsilon(at.z, 0, 1e-6);
    g_assert_cmpfloat(built.plant->organs.scale[0], ==, 2);
    built_free(built);
    built = build("simple A rotate-x=90;rotate-z=90");
    // z goes to -y by x, then to x by z.
    vec3s heading = fr_frame_heading(built.plant->organs.rotation[0]);
    g_assert_cmpfloat_with_epsilon(heading.x, 1, 1e-6);
    built_free(built);
}

static void spline(void) {
    Built built = build("horn A course=path;path=0,0,0 0,0,1 1,0,2 1,1,3;segments=30");
    const FrPlant *plant = built.plant;
    vec3s points[] = {{{0, 0, 0}}, {{0, 0, 1}}, {{1, 0, 2}}, {{1, 1, 3}}};
    FrPath *path = fr_path_new(points, 4);
    for (uint32_t k = 0; k < 30; k++) {
        vec3s point, tangent;
        fr_path_at(path, fr_path_length(path) * (k + 1) / 30, &point, &tangent);
        g_assert_cmpfloat(glms_vec3_distance(point, plant->nodes.position[k]), <, 1e-5f);
        if (k > 0) { // no jump of the frame
            float turn = fabsf(plant->nodes.rotation[k].w);
            g_assert_cmpfloat(turn, >, cosf(0.2f));
            g_assert_cmpfloat(fabsf(plant->nodes.rotation[k].z), <, 1e-4f);
        }
    }
    fr_path_unref(path);
    built_free(built);
}

static void logarithmic_spiral(void) {
    // Each step turns by a and scales by q: distances from the spiral's pole fall by q.
    Built built = build("horn A course=steps;steps=40;step-translate=0,0,1;step-rotate-x=20;"
                        "step-scale=.95");
    const FrNodes *nodes = &built.plant->nodes;
    // Steps as complex numbers in the plane y, z: the sum of (q e^ia)^k.
    double sum_z = 0, sum_y = 0, length = 1, angle = 0;
    for (uint32_t k = 0; k < nodes->count; k++) {
        sum_z += length * cos(angle);
        sum_y -= length * sin(angle);
        g_assert_cmpfloat_with_epsilon(nodes->position[k].z, sum_z, 1e-4);
        g_assert_cmpfloat_with_epsilon(nodes->position[k].y, sum_y, 1e-4);
        length *= 0.95;
        angle += 20 / DEGREES;
    }
    g_assert_cmpuint(nodes->count, ==, 39);
    built_free(built);
}

static void string_of_objects(void) {
    Built built = build("horn A primitive=sphere;length=1;radius=.1;taper=0;segments=5");
    g_assert_cmpuint(built.plant->organs.count, ==, 5);
    g_assert_cmpuint(built.plant->shapes->len, ==, 1);
    g_assert_cmpuint(built.plant->axes.flags[0] & FR_HIDDEN, !=, 0);
    for (uint32_t k = 0; k < 5; k++) {
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(built.plant, k, &position, &rotation);
        g_assert_cmpfloat_with_epsilon(position.z, 0.2 * k, 1e-6);
        g_assert_cmpfloat_with_epsilon(built.plant->organs.scale[k], 0.1, 1e-7);
    }
    built_free(built);
}

static void arc_length(void) {
    Built built = build("horn A length=3;curvature=200;gnarl=40;gravitropism=.5");
    double length = 0;
    for (uint32_t k = 0; k < built.plant->nodes.count; k++) {
        length += (double)built.plant->nodes.length[k];
    }
    g_assert_cmpfloat_with_epsilon(length, 3, 1e-5);
    built_free(built);
}

static void tip_turn(void) {
    const char *segments[] = {"1", "3", "10", "0"};
    for (size_t k = 0; k < G_N_ELEMENTS(segments); k++) {
        char *text = g_strdup_printf("horn A curvature=80;segments=%s\nleaf L\nA - L", segments[k]);
        Built built = build(text);
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(built.plant, 0, &position, &rotation);
        vec3s up = {{0, 0, 1}};
        g_assert_cmpfloat_with_epsilon(angle_between(fr_frame_heading(rotation), up), 80, 0.05);
        g_assert_cmpfloat(fr_frame_heading(rotation).y, >, 0.9f);
        built_free(built);
        g_free(text);
    }
    // A curve spreads it: nothing in the lower half.
    Built built = build("horn A curvature=80;curvature-curve=0,0 .5,0 .51,2 1,2;segments=20");
    g_assert_cmpfloat_with_epsilon(built.plant->nodes.position[9].y, 0, 1e-6);
    g_assert_cmpfloat(built.plant->nodes.position[19].y, >, 0.2f);
    built_free(built);
}

static void radius_profile(void) {
    Built built = build("horn A radius=.2;taper=.5;segments=4\nhorn B radius-mode=of-parent;"
                        "radius=.5;length-mode=of-parent;length=.25;scale=.5\nA - B");
    const FrPlant *plant = built.plant;
    for (uint32_t k = 0; k < 4; k++) {
        g_assert_cmpfloat_with_epsilon(plant->nodes.radius[k], 0.2 * (1 - 0.125 * (k + 1)), 1e-6);
    }
    g_assert_cmpfloat_with_epsilon(plant->axes.base_radius[1], 0.1 * 0.5 * 0.5, 1e-6);
    g_assert_cmpfloat_with_epsilon(plant->nodes.length[4], 1 * 0.25 * 0.5, 1e-6);
    built_free(built);
    built = build("horn A radius=.2;profile=0,1 1,.1;segments=4;min-radius=.1");
    g_assert_cmpfloat_with_epsilon(built.plant->nodes.radius[1], 0.2 * 0.55, 1e-6);
    g_assert_cmpfloat_with_epsilon(built.plant->nodes.radius[3], 0.1, 1e-6);
    built_free(built);
}

static void gnarl(void) {
    Built straight = build("horn A gnarl=0;segments=10");
    Built one = build("horn A gnarl=40;segments=10");
    Built two = build("horn A gnarl=40;segments=10");
    Built fine = build("horn A gnarl=40;segments=200");
    vec3s tip = straight.plant->nodes.position[9];
    g_assert_cmpfloat(tip.x, ==, 0);
    g_assert_cmpfloat_with_epsilon(tip.z, 1, 1e-6);
    tip = one.plant->nodes.position[9];
    g_assert_cmpfloat(glms_vec3_distance(tip, two.plant->nodes.position[9]), ==, 0);
    g_assert_cmpfloat(hypotf(tip.x, tip.y), >, 0.01f);
    g_assert_cmpfloat(glms_vec3_distance(tip, fine.plant->nodes.position[199]), <, 0.04f);
    built_free(straight);
    built_free(one);
    built_free(two);
    built_free(fine);
}

static void tree_without_branches(void) {
    Built tree = build("tree A length=2;curvature=30;gnarl=10");
    Built horn = build("horn A length=2;curvature=30;gnarl=10");
    g_assert_cmpuint(fr_plant_digest(tree.plant), ==, fr_plant_digest(horn.plant));
    built_free(tree);
    built_free(horn);
}

static void branching_angle(void) {
    Built built = build("tree A number=30;curvature=50;start=0;branching-angle=20..70 : x\n"
                        "horn B length=1;segments=1\nA = B");
    const FrPlant *plant = built.plant;
    for (uint32_t b = 1; b <= 30; b++) {
        vec3s stem = fr_frame_heading(plant->nodes.frame[plant->axes.bearer[b]]);
        vec3s branch = fr_frame_heading(plant->nodes.frame[plant->axes.first[b]]);
        double x = (b - 0.5) / 30;
        g_assert_cmpfloat_with_epsilon(angle_between(stem, branch), 20 + 50 * x, 0.02);
        g_assert_cmpuint(plant->axes.order[b], ==, 1);
    }
    built_free(built);
}

static void places_along_stem(void) {
    Built built = build("tree A number=3;length=10;start=.2;end=.8;spacing=ends;taper=0;radius=.5;"
                        "segments=7\nhorn B\nleaf L\nA = B\nA = L");
    const double z[] = {2, 5, 8};
    for (uint32_t b = 0; b < 3; b++) {
        vec3s origin = fr_plant_axis_origin(built.plant, 1 + b);
        g_assert_cmpfloat_with_epsilon(origin.z, z[b], 1e-5);
        g_assert_cmpfloat_with_epsilon(hypot((double)origin.x, (double)origin.y), 0, 1e-6);
        // Leaves stand on the bark.
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(built.plant, b, &position, &rotation);
        g_assert_cmpfloat_with_epsilon(hypot((double)position.x, (double)position.y), 0.5, 1e-6);
        g_assert_cmpfloat_with_epsilon(position.z, z[b], 1e-5);
    }
    built_free(built);
    built = build("tree A mode=density;density=7;length=2;start=0\nleaf L\nA = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 14);
    built_free(built);
    // With a given internode a longer stem keeps its places.
    built = build("tree A mode=internode;internode=.25;length=2;start=.5;whorl=2\nhorn L\nA = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 10);
    g_assert_cmpfloat_with_epsilon(fr_plant_axis_origin(built.plant, 5).z, 1.5, 1e-5);
    built_free(built);
}

static void deviation(void) {
    // The stem turns by the angle at every branch, and nowhere else.
    Built built = build("tree A number=4;phyllotaxis=distichous;deviation=30;segments=10\n"
                        "horn L\nA = L");
    const FrPlant *plant = built.plant;
    uint32_t bends = 0, before = FR_NONE;
    for (uint32_t k = plant->axes.first[0]; k != FR_NONE; before = k, k = plant->nodes.next[k]) {
        double turn = before == FR_NONE
                          ? 0
                          : angle_between(fr_frame_heading(plant->nodes.frame[k]),
                                          fr_frame_heading(plant->nodes.frame[before]));
        if (turn > 0.1) {
            g_assert_cmpfloat_with_epsilon(turn, 30, 0.05);
            bends++;
            // A branch stands where it bends.
            bool is_borne = false;
            for (uint32_t a = 1; a < plant->axes.count; a++) {
                is_borne |= plant->axes.bearer[a] == before;
            }
            g_assert_true(is_borne);
        }
    }
    g_assert_cmpuint(bends, ==, 4);
    built_free(built);
}

static void leaf_shapes_shared(void) {
    Built built = build("phiball P number=2000\nleaf L length=.1 ~ .02;fold=20 ~ 9;variants=8\n"
                        "P - L");
    g_assert_cmpuint(built.plant->organs.count, ==, 2000);
    g_assert_cmpuint(built.plant->shapes->len, ==, 8);
    built_free(built);
    built = build("phiball P number=2000\nleaf L\nP - L");
    g_assert_cmpuint(built.plant->shapes->len, ==, 1);
    built_free(built);
}

static void agave(void) {
    // Curvature by iteration: nearly vertical leaves are less bent.
    Built built = build("phiball P number=60;closing=80\n"
                        "leaf L curvature-along=-5..-90 ~ 4;variants=64\nP - L");
    const FrPlant *plant = built.plant;
    double above = 0, below = 0;
    for (uint32_t k = 0; k < 60; k++) {
        const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[k]);
        double expected = -(5 + 85.0 * k / 59) / DEGREES;
        g_assert_cmpfloat_with_epsilon(shape->blade.curvature_along, expected, 4.01 / DEGREES);
        above += (double)shape->blade.curvature_along > expected;
        below += (double)shape->blade.curvature_along < expected;
    }
    g_assert_cmpfloat(above, >, 10);
    g_assert_cmpfloat(below, >, 10);
    built_free(built);
}

static void outlines(void) {
    FrComponentKind kind = FR_COMPONENT_LEAF;
    const FrParam *row = fr_params_find(fr_pgraph_table(kind), "outline");
    char **names = g_strsplit(row->choices, " ", -1);
    g_assert_cmpstr(names[0], ==, "elliptic");
    for (char **name = names + 1; *name != NULL; name++) {
        char *text = g_strdup_printf("leaf L outline=%s", *name);
        Built built = build(text);
        const FrShape *shape = &g_array_index(built.plant->shapes, FrShape, 0);
        const FrProfile *outline =
            &g_array_index(built.plant->profiles, FrProfile, shape->blade.outline);
        double widest = 0;
        for (uint32_t p = 0; p < outline->count; p++) {
            widest = fmax(widest, outline->points[p][1]);
            g_assert_true(p == 0 || outline->points[p][0] > outline->points[p - 1][0]);
        }
        g_assert_cmpfloat_with_epsilon(widest, 0.5, 0.02);
        g_assert_cmpfloat(outline->points[outline->count - 1][0], ==, 1);
        built_free(built);
        g_free(text);
    }
    g_strfreev(names);
}

// A stem that bears welded branches has internodes for their holes; others do not change.
static void welded(void) {
    const char *text =
        "tree T length=2;radius=.1;number=3;%s\nhorn H length=.3;radius=.02;%s\nT = H";
    const struct {
        const char *tree, *horn;
        uint32_t internodes;
    } cases[] = {
        {"", "", 1},
        {"", "junction=welded", 20},
        {"segments=3", "junction=welded", 3},
        {"mode=nodes", "junction=welded", 1},
        {"junction=welded", "", 1},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        char *own = g_strdup_printf(text, cases[k].tree, cases[k].horn);
        Built built = build_graph(graph_read(own), NULL);
        uint32_t internodes = 0;
        for (uint32_t n = 0; n < built.plant->nodes.count; n++) {
            internodes += built.plant->nodes.axis[n] == 0;
        }
        g_assert_cmpuint(internodes, ==, cases[k].internodes);
        built_free(built);
        g_free(own);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("S8 four cross-sections by Simple are a Horn of four", simple_chain);
    TEST("S8 a second cross-section begins a tube of its own", simple_chain_forks);
    TEST("B1 solids stand on one another", stacked_solids);
    TEST("B3 transformations apply in order and to children", transformation_order);
    TEST("C3 a stem runs along its spline", spline);
    TEST("C4 relative steps give a logarithmic spiral", logarithmic_spiral);
    TEST("C5 other primitives make a string of objects", string_of_objects);
    TEST("C6 the arc is as long as asked", arc_length);
    TEST("C9 C20 curvature turns the tip by its value", tip_turn);
    TEST("C13 a tree without branches is a horn", tree_without_branches);
    TEST("C14 branches stand between start and end", places_along_stem);
    TEST("C15 branches leave at the branching angle", branching_angle);
    TEST("C17 a stem deviates at its branches only", deviation);
    TEST("C18 gnarl wanders and is the same each time", gnarl);
    TEST("C19 radius follows taper or profile", radius_profile);
    TEST("C8 every outline is as wide as the leaf", outlines);
    TEST("leaves of random form share a few shapes", leaf_shapes_shared);
    TEST("F7 leaves bend by their iteration", agave);
    g_test_add_func("/pgraph/stem/what bears welded branches has internodes for them", welded);
    return g_test_run();
}
