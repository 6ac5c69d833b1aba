// Stems that fork, held against geometry and counting.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

static vec3s first_heading(const FrPlant *plant, uint32_t axis) {
    return fr_frame_heading(plant->nodes.frame[plant->axes.first[axis]]);
}

static vec3s last_heading(const FrPlant *plant, uint32_t axis) {
    return fr_frame_heading(plant->nodes.frame[plant->axes.last[axis]]);
}

static double angle_between(vec3s a, vec3s b) {
    return acos(fmax(-1, fmin(1, (double)glms_vec3_dot(a, b)))) * DEGREES;
}

// From a node to the ground along the stem, m.
static double length_below(const FrPlant *plant, uint32_t node) {
    double length = 0;
    for (; node != FR_NONE; node = plant->nodes.parent[node]) {
        length += (double)plant->nodes.length[node];
    }
    return length;
}

static void arms_end_together(void) {
    Built built = build("horn H length=2;forks=3;fork-arms=3;fork-angle=50 ~ 20;gnarl=20");
    const FrPlant *plant = built.plant;
    g_assert_cmpuint(plant->axes.count, ==, 27);
    for (uint32_t axis = 0; axis < 27; axis++) {
        g_assert_cmpfloat_with_epsilon(length_below(plant, plant->axes.last[axis]), 2, 1e-5);
        g_assert_cmpint((plant->axes.flags[axis] & FR_FORK) != 0, ==, axis > 0);
        g_assert_cmpuint(plant->axes.order[axis], ==, 0);
    }
    built_free(built);
}

static void angle_and_radius(void) {
    Built built = build("horn H length=2;radius=.1;taper=0;forks=1;fork-start=.5;fork-end=.5;"
                        "fork-angle=60;fork-azimuth=0;fork-radius=.7");
    const FrPlant *plant = built.plant;
    g_assert_cmpuint(plant->axes.count, ==, 2);
    vec3s a = last_heading(plant, 0), b = first_heading(plant, 1);
    g_assert_cmpfloat_with_epsilon(angle_between(a, b), 60, 1e-3);
    g_assert_cmpfloat_with_epsilon((double)a.x, 0.5, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)b.x, -0.5, 1e-6);
    uint32_t fork = plant->axes.bearer[1];
    double at = length_below(plant, fork) / 2;
    g_assert_cmpfloat_with_epsilon(at, 0.5, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)plant->nodes.radius[fork], 0.1, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)plant->axes.base_radius[1], 0.07, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)plant->nodes.radius[plant->axes.last[0]], 0.07, 1e-6);
    built_free(built);
}

static void balance(void) {
    Built built = build("horn H length=2;forks=1;fork-angle=60;fork-balance=0");
    vec3s up = {{0, 0, 1}};
    g_assert_cmpfloat_with_epsilon(angle_between(last_heading(built.plant, 0), up), 0, 0.05);
    g_assert_cmpfloat_with_epsilon(angle_between(first_heading(built.plant, 1), up), 60, 1e-3);
    built_free(built);
}

static void straightness(void) {
    // Half an internode before the tip all is taken back but for that half.
    Built built = build("horn H length=2;segments=40;forks=1;fork-angle=60;fork-straightness=1");
    const FrPlant *plant = built.plant;
    g_assert_cmpfloat_with_epsilon(angle_between(first_heading(plant, 1), (vec3s){{0, 0, 1}}), 30,
                                   1.5);
    g_assert_cmpfloat(angle_between(last_heading(plant, 0), last_heading(plant, 1)), <, 3);
    built_free(built);
}

static void bear_branches(void) {
    // Places below the fork once, above it on every arm; a flower at each tip.
    Built built = build("tree T length=2;number=10;start=0;forks=1;fork-start=.5;fork-end=.5\n"
                        "leaf L\nsimple S\nT = L\nT - S");
    g_assert_cmpuint(built_count(&built, "L"), ==, 5 + 2 * 5);
    g_assert_cmpuint(built_count(&built, "S"), ==, 2);
    const FrPlant *plant = built.plant;
    for (uint32_t organ = 0; organ < plant->organs.count; organ++) {
        for (uint32_t other = 0; other < organ; other++) {
            g_assert_cmpuint(plant->organs.path[organ], !=, plant->organs.path[other]);
        }
    }
    built_free(built);
    built = build("tree T length=2;number=10;start=0;forks=1;fork-start=.5;fork-end=.5\n"
                  "leaf L only=4,7\nT = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 1 + 2);
    built_free(built);
}

static void keep_the_stem(void) {
    // Up to its first fork, and in what it draws along its own axis, the stem is what it was.
    Built plain = build("tree T length=2 ~ .5;number=10;start=0;gnarl=20\nleaf L scale=1 ~ .5\n"
                        "T = L");
    Built forked = build("tree T length=2 ~ .5;number=10;start=0;gnarl=20;forks=2\n"
                         "leaf L scale=1 ~ .5\nT = L");
    const FrOrgans *a = &plain.plant->organs;
    const FrOrgans *b = &forked.plant->organs;
    for (uint32_t k = 0; k < a->count; k++) {
        uint32_t same = 0;
        while (same < b->count && b->path[same] != a->path[k]) {
            same++;
        }
        g_assert_cmpuint(same, <, b->count);
        g_assert_cmpfloat(a->scale[k], ==, b->scale[same]);
    }
    built_free(plain);
    built_free(forked);
    plain = build("tree T length=2;gnarl=20;number=3\nleaf L\nT = L");
    forked = build("tree T length=2;gnarl=20;number=3;fork-arms=4;fork-angle=20;fork-radius=.5\n"
                   "leaf L\nT = L");
    g_assert_cmpuint(fr_plant_digest(plain.plant), ==, fr_plant_digest(forked.plant));
    built_free(plain);
    built_free(forked);
}

static void by_chance(void) {
    // Half of them fork once more.
    Built built = build("scatter S number=400\nhorn H length=1;forks=.5\nS - H");
    g_assert_cmpuint(built.plant->axes.count, >, 400 + 160);
    g_assert_cmpuint(built.plant->axes.count, <, 400 + 240);
    built_free(built);
}

static void strings_fork(void) {
    Built built = build("horn H length=1;forks=1;primitive=sphere;segments=10;fork-start=.5;"
                        "fork-end=.5");
    g_assert_cmpuint(built.plant->organs.count, ==, 15);
    built_free(built);
}

static void any_threads(void) {
    const char *text = "tree T length=3;number=30;forks=2.5;gnarl=30;phototropism=1\n"
                       "tree B length=.6 ~ .3;forks=1.5;number=8\nleaf L\nT = B\nB = L\nB - L";
    uint64_t expected = 0;
    for (int threads = 1; threads <= 8; threads = threads * 2 - (threads == 2)) {
        FrPool *pool = fr_pool_new(threads);
        Built built = build_graph(graph_read(text), pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        uint64_t digest = fr_plant_digest(built.plant);
        expected = threads == 1 ? digest : expected;
        g_assert_cmpuint(digest, ==, expected);
        built_free(built);
        fr_pool_free(pool);
    }
}

static void too_many(void) {
    Built built = build_graph(graph_read("tree T number=1000000;forks=6;fork-arms=4;start=0\n"
                                         "leaf L\nT = L"),
                              NULL);
    g_assert_cmpint(built.status, ==, FR_ERR_LIMIT);
    g_assert_null(built.plant);
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/fork/" name, function)
    TEST("all arms end where the stem would have ended", arms_end_together);
    TEST("arms stand fork-angle apart and have their radius", angle_and_radius);
    TEST("without balance one arm goes straight on", balance);
    TEST("straightness takes the turn back up to the tip", straightness);
    TEST("every arm bears the branches of its stretch and a tip", bear_branches);
    TEST("what grows on the stem itself is drawn as without forks", keep_the_stem);
    TEST("half a fork is one by chance", by_chance);
    TEST("strings of objects fork too", strings_fork);
    TEST("any number of threads gives the same bits", any_threads);
    TEST("too many branches are refused before they are made", too_many);
    return g_test_run();
}
