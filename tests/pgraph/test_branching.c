// Where a Tree's branches stand, in the modes and with the numbers that others tell in other files.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

// Heights of the leaves on an upright stem.
static double height_of(const Built *built, uint32_t organ) {
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(built->plant, organ, &position, &rotation);
    return (double)position.z;
}

static double azimuth_of(const Built *built, uint32_t organ) {
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(built->plant, organ, &position, &rotation);
    return atan2((double)position.y, (double)position.x);
}

static void at_nodes(void) {
    // Five internodes of a metre: nodes at 1 to 5 m, of which start and end leave those at 2 to 4.
    Built built = build("tree T mode=nodes;length=5;segments=5;start=.3;end=.9;whorl=2\n"
                        "leaf L\nT = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 6);
    for (uint32_t k = 0; k < 6; k++) {
        g_assert_cmpfloat_with_epsilon(height_of(&built, k), 2 + k / 2, 1e-5);
    }
    built_free(built);
}

static void in_proportion(void) {
    // A crown that is a cone: the branches at 1/4 and 3/4 are as long as its half and less.
    Built built = build("tree T number=2;length=4;start=0;crown=conical\n"
                        "tree B mode=proportional;number=20;length=1\nleaf L\nT = B\nB = L");
    Built plain = build("tree T number=2;length=4;start=0;crown=conical\n"
                        "tree B number=20;length=1\nleaf L\nT = B\nB = L");
    const FrPlant *plant = built.plant;
    uint64_t expected = 0;
    for (uint32_t axis = 1; axis <= 2; axis++) {
        double length = 0;
        for (uint32_t n = plant->axes.first[axis]; n != FR_NONE; n = plant->nodes.next[n]) {
            length += (double)plant->nodes.length[n];
        }
        expected += (uint64_t)floor(20 * length + 0.5);
    }
    g_assert_cmpuint(built_count(&built, "L"), ==, expected);
    g_assert_cmpuint(expected, <, 40);
    g_assert_cmpuint(built_count(&plain, "L"), ==, 40);
    built_free(built);
    built_free(plain);
}

static void bifurcation(void) {
    // Two at the end of each of three generations: 1 + 2 + 4 stems, each beginning at a tip.
    Built built = build("tree T mode=bifurcation;number=2;depth=3;branching-angle=30;length=1\n"
                        "T = T");
    const FrPlant *plant = built.plant;
    g_assert_cmpuint(plant->axes.count, ==, 7);
    for (uint32_t axis = 1; axis < 7; axis++) {
        uint32_t bearer = plant->axes.bearer[axis];
        g_assert_cmpuint(bearer, ==, plant->axes.last[plant->nodes.axis[bearer]]);
        g_assert_cmpfloat(glms_vec3_norm(plant->axes.offset[axis]), <, 1e-6f);
    }
    // The arms are as far to both sides, opposite each other.
    vec3s a = fr_frame_heading(plant->nodes.frame[plant->axes.first[1]]);
    vec3s b = fr_frame_heading(plant->nodes.frame[plant->axes.first[2]]);
    g_assert_cmpfloat_with_epsilon((double)glms_vec3_dot(a, b), cos(60 * G_PI / 180), 1e-5);
    built_free(built);
}

static void shrinking_gaps(void) {
    Built built = build("tree T number=5;spacing=ends;start=0;end=1;length=1;gap-ratio=.5\n"
                        "leaf L\nT = L");
    double gaps[4];
    for (uint32_t k = 0; k < 4; k++) {
        gaps[k] = height_of(&built, k + 1) - height_of(&built, k);
    }
    g_assert_cmpfloat_with_epsilon(height_of(&built, 4), 1, 1e-6);
    for (uint32_t k = 1; k < 4; k++) {
        g_assert_cmpfloat_with_epsilon(gaps[k] / gaps[k - 1], 0.5, 1e-4);
    }
    built_free(built);
    // Hundreds of gaps that grow tenfold are nothing but the last.
    built =
        build("tree T number=900;spacing=ends;start=0;end=1;length=1;gap-ratio=10\nleaf L\nT = L");
    g_assert_cmpfloat_with_epsilon(height_of(&built, 0), 0, 1e-6);
    g_assert_cmpfloat_with_epsilon(height_of(&built, 898), 0.1, 1e-5);
    g_assert_cmpfloat_with_epsilon(height_of(&built, 899), 1, 1e-6);
    built_free(built);
    // By internode: 0.1 + 0.2 + 0.4 fit into a metre, the next 0.8 do not.
    built = build("tree T mode=internode;internode=.1;start=0;length=1;gap-ratio=2\nleaf L\nT = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 4);
    g_assert_cmpfloat_with_epsilon(height_of(&built, 3), 0.7, 1e-6);
    built_free(built);
    // Gaps that shrink would never reach the end of a stem of 2 m.
    built = build("tree T mode=internode;internode=1;start=0;length=9;gap-ratio=.5\nleaf L\nT = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 7);
    built_free(built);
}

// The nearest two feet over the surface of a stem of 10 cm radius.
static double least_room(const Built *built) {
    double least = INFINITY;
    for (uint32_t a = 0; a < built->plant->organs.count; a++) {
        for (uint32_t b = 0; b < a; b++) {
            double turn = remainder(azimuth_of(built, a) - azimuth_of(built, b), 2 * G_PI);
            least = fmin(least, hypot(height_of(built, a) - height_of(built, b), 0.1 * turn));
        }
    }
    return least;
}

static void apart(void) {
    const char *text = "tree T number=12;length=.6;radius=.1;taper=0;start=0;azimuth-jitter=180%s\n"
                       "leaf L\nT = L";
    char *crowded = g_strdup_printf(text, ""), *kept = g_strdup_printf(text, ";apart=.1");
    Built before = build(crowded), after = build(kept);
    g_assert_cmpfloat(least_room(&before), <, 0.09);
    g_assert_cmpfloat(least_room(&after), >=, 0.1 - 1e-6);
    for (uint32_t k = 0; k < 12; k++) { // along the stem nothing moves
        g_assert_cmpfloat_with_epsilon(height_of(&before, k), height_of(&after, k), 1e-6);
    }
    built_free(before);
    built_free(after);
    g_free(crowded);
    g_free(kept);
}

static void apart_whatever_flags(void) {
    // What stands at place 7 does not depend on whether the others are made.
    Built all = build("tree T number=12;radius=.1;azimuth-jitter=180;apart=.3\nleaf L\nT = L");
    Built one =
        build("tree T number=12;radius=.1;azimuth-jitter=180;apart=.3\nleaf L only=7\nT = L");
    g_assert_cmpfloat(azimuth_of(&all, 7), ==, azimuth_of(&one, 0));
    built_free(all);
    built_free(one);
}

static void sink(void) {
    Built built = build("tree T number=1;radius=.1;taper=0;start=0;sink=.25\nleaf L\nT = L");
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(built.plant, 0, &position, &rotation);
    g_assert_cmpfloat_with_epsilon(hypot((double)position.x, (double)position.y), 0.075, 1e-6);
    built_free(built);
}

static void orient(void) {
    // Children of a ring look outwards, along it, or all the same way.
    const char *texts[] = {"", ";orient=tangential", ";orient=world"};
    for (int k = 0; k < 3; k++) {
        char *text = g_strdup_printf("hydra H number=4%s\nsimple S\nH - S", texts[k]);
        Built built = build(text);
        for (uint32_t i = 0; i < 4; i++) {
            vec3s heading = fr_frame_heading(built.plant->organs.rotation[i]);
            vec3s out = {{(float)cos(i * G_PI / 2), (float)sin(i * G_PI / 2), 0}};
            vec3s along = {{-out.y, out.x, 0}};
            vec3s same = {{1, 0, 0}};
            vec3s wanted = k == 0 ? out : k == 1 ? along : same;
            g_assert_cmpfloat(glms_vec3_dot(heading, wanted), >, 1 - 1e-5f);
        }
        built_free(built);
        g_free(text);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/branching/" name, function)
    TEST("nodes between start and end bear a whorl each", at_nodes);
    TEST("in proportion shorter stems of a crown bear fewer", in_proportion);
    TEST("a bifurcation puts its branches on the very end", bifurcation);
    TEST("each gap is gap-ratio times the one before", shrinking_gaps);
    TEST("feet of branches keep apart", apart);
    TEST("branches keep apart from those that flags leave out", apart_whatever_flags);
    TEST("what is sunk begins within the stem", sink);
    TEST("children of a ring look out, along it or all one way", orient);
    return g_test_run();
}
