// Local time, growth, seasons.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

static Built build_at(const char *text, double age, double season) {
    FrPgraph *graph = graph_read(text);
    FrPgraphState state = {.age = age, .season = season, .health = 1};
    fr_pgraph_set_state(graph, &state);
    Built built = build_graph(graph, NULL);
    g_assert_cmpint(built.status, ==, FR_OK);
    assert_sound(built.plant);
    return built;
}

static double height_of(const Built *built) {
    return built->plant->nodes.count > 0
               ? (double)built->plant->nodes.position[built->plant->nodes.count - 1].z
               : 0;
}

static void embedded(void) {
    // A1: a leaf born at 2 on a twig born at 3 shows at age 7.5 its frame of 2.5.
    Built built = build_at("horn T birth=3\nleaf L birth=2;scale=keys 0,1 5,6\nT - L", 7.5, 0);
    g_assert_cmpfloat_with_epsilon((double)built.plant->organs.scale[0], 3.5, 1e-5);
    built_free(built);
}

static void scaled(void) {
    // A2: clocks within clocks. (8 − 2)·0.5 = 3 for the twig, (3 − 1)·2 = 4 for the leaf.
    Built built = build_at("horn T birth=2;time-scale=.5\n"
                           "leaf L birth=1;time-scale=2;scale== 1 + age\nT - L",
                           8, 0);
    g_assert_cmpfloat_with_epsilon((double)built.plant->organs.scale[0], 5, 1e-5);
    built_free(built);
}

static void born_and_dead(void) {
    static const char text[] = "horn T birth=1;lifetime=5\nleaf L birth=1;lifetime=2\nT - L";
    static const struct {
        double age;
        uint64_t stems, leaves;
    } moments[] = {{0.5, 0, 0}, {1, 1, 0}, {2, 1, 1},  {4, 1, 1},
                   {4.5, 1, 0}, {6, 1, 0}, {6.5, 0, 0}};
    for (size_t k = 0; k < G_N_ELEMENTS(moments); k++) {
        Built built = build_at(text, moments[k].age, 0);
        g_assert_cmpuint(built_count(&built, "T"), ==, moments[k].stems);
        g_assert_cmpuint(built_count(&built, "L"), ==, moments[k].leaves);
        g_assert_cmpuint(built.counts.instances, ==, moments[k].stems + moments[k].leaves);
        g_assert_cmpuint(built.plant->organs.count, ==, moments[k].leaves);
        built_free(built);
    }
}

static void tree_of_the_living(void) {
    // What is not there is not in the i-tree either, and all others keep their parents.
    Built built = build_at("tree T number=4;start=0\nhorn B chance== i % 2;length=.1\nleaf L\n"
                           "T = B\nB - L",
                           1, 0);
    GString *text = g_string_new("");
    built_tree_below(&built, 0, text);
    g_assert_cmpstr(text->str, ==, "T(B(L) B(L))");
    g_string_free(text, TRUE);
    built_free(built);
}

static void grows_at_the_tip(void) {
    // Half the time, half the length; what has grown stays as it is.
    static const char text[] = "horn H length=2;growth=10;curvature=60;gnarl=30;taper=0;segments=8";
    Built half = build_at(text, 5, 0), whole = build_at(text, 10, 0), later = build_at(text, 90, 0);
    const FrNodes *a = &half.plant->nodes, *b = &whole.plant->nodes;
    double length = 0;
    for (uint32_t k = 0; k < a->count; k++) {
        length += (double)a->length[k];
    }
    g_assert_cmpfloat_with_epsilon(length, 1, 1e-6);
    // The same curve, divided more finely.
    for (int r = 0; r < 3; r++) {
        g_assert_cmpfloat_with_epsilon(a->position[7].raw[r], b->position[3].raw[r], 0.02);
    }
    g_assert_cmpuint(fr_plant_digest(whole.plant), ==, fr_plant_digest(later.plant));
    built_free(half);
    built_free(whole);
    built_free(later);
}

static void neutral(void) {
    // A plant that has grown is the plant that never grew.
    static const char text[] = "tree T number=9%s\nhorn B length=.4;gnarl=20%s\nleaf L %s\n"
                               "T = B\nB - L";
    char *growing = g_strdup_printf(text, ";growth=3", ";growth=2", "growth=.5");
    char *plain = g_strdup_printf(text, "", "", "");
    Built a = build_at(growing, 50, 0), b = build_at(plain, 0, 0);
    g_assert_cmpuint(fr_plant_digest(a.plant), ==, fr_plant_digest(b.plant));
    built_free(a);
    built_free(b);
    g_free(growing);
    g_free(plain);
}

static void born_when_passed(void) {
    // The tip passes the branch at x = 0.5 in the year 5; at 8 the branch is three years old.
    static const char text[] = "tree T length=2;growth=10;number=1;start=.5;end=.5;spacing=ends\n"
                               "leaf L scale== 1 + age\nT = L";
    Built before = build_at(text, 4.9, 0), after = build_at(text, 8, 0);
    g_assert_cmpuint(before.plant->organs.count, ==, 0);
    g_assert_cmpfloat_with_epsilon((double)after.plant->organs.scale[0], 4, 1e-4);
    // It stays where it was born: one metre up.
    vec3s place;
    versors turn;
    fr_plant_organ_pose(after.plant, 0, &place, &turn);
    g_assert_cmpfloat_with_epsilon((double)place.z, 1, 1e-5);
    built_free(before);
    built_free(after);
}

static void growth_curve(void) {
    // With a curve of x² the stem is a quarter long after half its time, and passes x = 0.25 then.
    static const char text[] =
        "tree T length=1;growth=2;growth-curve=0,0 .25,.0625 .5,.25 .75,.5625 "
        "1,1;number=1;start=.25;end=.25;spacing=ends\n"
        "leaf L scale== 1 + age\nT = L";
    Built built = build_at(text, 1.5, 0);
    g_assert_cmpfloat_with_epsilon(height_of(&built), 0.5625, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)built.plant->organs.scale[0], 1.5, 1e-3);
    built_free(built);
}

static void all_kinds_grow(void) {
    Built built = build_at("simple S growth=4;size=1\nleaf L growth=2\nS - L", 1, 0);
    g_assert_cmpfloat_with_epsilon(built.plant->organs.scale[0], 0.25f, 1e-6);
    g_assert_cmpfloat_with_epsilon(built.plant->organs.scale[1], 0.125f, 1e-6);
    built_free(built);
    static const char path[] = "horn H course=path;path=0,0,0 0,0,1 0,1,1;growth=10;segments=16";
    Built half = build_at(path, 5, 0);
    g_assert_cmpfloat_with_epsilon(height_of(&half), 1, 0.05);
    built_free(half);
    static const char fork[] = "horn H length=4;growth=10;forks=1;fork-start=.5;fork-end=.5";
    Built young = build_at(fork, 3, 0), old = build_at(fork, 9, 0);
    g_assert_cmpuint(young.plant->axes.count, ==, 1);
    g_assert_cmpuint(old.plant->axes.count, ==, 2);
    built_free(young);
    built_free(old);
}

static void leaves_fall(void) {
    // A falling chance takes leaves one by one; none that fell comes back, none moves.
    uint64_t before = 1000;
    for (int k = 0; k <= 4; k++) {
        Built built =
            build_at("tree T number=200\nleaf L chance=1 | season 0,1 1,0\nT = L", 0, k / 4.0);
        uint64_t leaves = built_count(&built, "L");
        g_assert_cmpuint(leaves, <, before);
        g_assert_cmpfloat(fabs((double)leaves - 200 * (1 - k / 4.0)), <, 25);
        before = leaves;
        built_free(built);
    }
    g_assert_cmpuint(before, ==, 0);
}

static void variables(void) {
    FrPgraph *graph = graph_read("horn T rotate-x=90;length=2\n"
                                 "leaf A scale== 10 + px\nleaf B scale== 10 + py\n"
                                 "leaf C scale== 10 + pz\nleaf D scale== time + season + health\n"
                                 "leaf E scale== 1 + (rnd == rnd(0)) + r\n"
                                 "T - A\nT - B\nT - C\nT - D\nT - E");
    FrPgraphState state = {.age = 1, .time = 4, .season = 0.5, .health = 0.25};
    fr_pgraph_set_state(graph, &state);
    Built built = build_graph(graph, NULL);
    const float *scale = built.plant->organs.scale;
    vec3s tip = built.plant->nodes.position[built.plant->nodes.count - 1];
    g_assert_cmpfloat_with_epsilon(scale[0], 10 + tip.x, 1e-5);
    g_assert_cmpfloat_with_epsilon(scale[1], 10 + tip.y, 1e-5);
    g_assert_cmpfloat(fabs((double)tip.y), >, 1.9);
    g_assert_cmpfloat_with_epsilon(scale[2], 10 + tip.z, 1e-5);
    g_assert_cmpfloat_with_epsilon(scale[3], 4.75f, 1e-6);
    g_assert_cmpfloat_with_epsilon(scale[4], 2, 1e-6);
    built_free(built);
}

static FrMaterial *ramped(void) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.ramp = g_strdup("0 #000000, 1 #ff8000");
    FrMaterial *material = fr_material_new("green", &params, NULL, (FrSpan){0});
    fr_params_clear(fr_material_table(), &params);
    return material;
}

static vec3s colour_of(const Built *built, uint32_t organ) {
    uint32_t index = built->plant->organs.material[organ];
    return fr_material_params(g_ptr_array_index(built->plant->materials, index))->colour;
}

static void colours(void) {
    // A3: age, season and iteration number reach the colour; steps that nothing has are dropped.
    FrMaterial *material = ramped();
    FrPgraph *graph =
        graph_read("tree T number=3;spacing=ends\n"
                   "leaf L material=green;ramp-at== i/2\nT = L\nleaf M material=green\n"
                   "T - M");
    fr_pgraph_add_material(graph, material);
    FrPgraphState state = {.season = 0.5, .health = 1};
    fr_pgraph_set_state(graph, &state);
    Built built = build_graph(graph, NULL);
    g_assert_cmpint(built.status, ==, FR_OK);
    assert_sound(built.plant);
    g_assert_cmpuint(built.plant->organs.count, ==, 4);
    for (uint32_t k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(colour_of(&built, k).x, 0.5f * (float)k, 1e-6);
    }
    g_assert_cmpfloat_with_epsilon(colour_of(&built, 3).x, 0.5f, 1e-6);
    g_assert_cmpuint(built.plant->materials->len, ==, 4); // itself and three steps
    built_free(built);
    fr_material_unref(material);
}

static void threads(void) {
    static const char text[] = "tree T number=300;growth=9;length=5\n"
                               "tree B number=9;growth=3;length=.5;chance=.8\nleaf L growth=.3;"
                               "lifetime=2;scale=1 ~ .2\nT = B\nB = L";
    FrDigest first = 0;
    static const int counts[] = {1, 2, 3, 8};
    for (size_t k = 0; k < G_N_ELEMENTS(counts); k++) {
        FrPgraph *graph = graph_read(text);
        FrPgraphState state = {.age = 6.3, .health = 1};
        fr_pgraph_set_state(graph, &state);
        FrPool *pool = fr_pool_new(counts[k]);
        Built built = build_graph(graph, pool);
        FrDigest digest = fr_plant_digest(built.plant);
        first = k == 0 ? digest : first;
        g_assert_cmpuint(digest, ==, first);
        g_assert_cmpuint(built.plant->organs.count, >, 500);
        built_free(built);
        fr_pool_free(pool);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/life/A1 a leaf's key frames are embedded in its twig's", embedded);
    g_test_add_func("/pgraph/life/A2 clocks run within clocks", scaled);
    g_test_add_func("/pgraph/life/a part is there from its birth to its death", born_and_dead);
    g_test_add_func("/pgraph/life/what is not there is not in the i-tree", tree_of_the_living);
    g_test_add_func("/pgraph/life/a stem grows at its tip and keeps its form", grows_at_the_tip);
    g_test_add_func("/pgraph/life/what has grown is as if it never grew", neutral);
    g_test_add_func("/pgraph/life/a branch is born when the tip comes by", born_when_passed);
    g_test_add_func("/pgraph/life/a growth curve says when", growth_curve);
    g_test_add_func("/pgraph/life/solids, leaves, paths and forks grow", all_kinds_grow);
    g_test_add_func("/pgraph/life/leaves fall one by one", leaves_fall);
    g_test_add_func("/pgraph/life/expressions see place, time, season, health and chance",
                    variables);
    g_test_add_func("/pgraph/life/A3 season and iteration number reach the colour", colours);
    g_test_add_func("/pgraph/life/growth is the same for any number of threads", threads);
    return g_test_run();
}
