// What a rebuild takes over and what it makes, in small graphs. That every parameter is known to
// matter is tested on the shipped documents: tests/scene/test_rebuild.c.
#include "graphs.h"

static const char *const tree = "tree trunk number=6;gnarl=10\n"
                                "tree twig number=5;length=.4;curvature=20 ~ 9\n"
                                "leaf leaf length=.1 ~ .02;scale=1 ~ .2\n"
                                "simple berry primitive=sphere;only=odd\n"
                                "trunk = twig\ntwig = leaf\ntwig = berry";

/// A plant with everything that refers to something else.
static const char *const motley =
    "ffd bent moves=skeleton;to_x=x+.1*z*z\n"
    "tree trunk number=4 ~ 2;forks=1.4\n"
    "world sun light_x=1\n"
    "horn twig length=.4;phototropism=2;segments=7\n"
    "simple ring primitive=tube;size=.1, .1, 0;translate_z=.1;depth=4;recursion_scale=.8\n"
    "leaf leaf length== .1+.05*x;width=.03\n"
    "horn beads primitive=sphere;radius=.01\n"
    "phiball ball number=9\n"
    "variation either\nleaf red length=.03\nrevo cup size=.1, .1, .1\n";

static FrPgraphBuild *rebuild(const FrPgraph *graph, const FrPgraphBuild *last) {
    FrContext context = fr_context_default();
    FrPgraphBuild *build;
    FrPlant *fresh;
    FrPgraphCounts counts = {0};
    g_assert_cmpint(fr_pgraph_rebuild(graph, last, &context, &build), ==, FR_OK);
    g_assert_cmpint(fr_pgraph_build(graph, &context, &fresh, &counts), ==, FR_OK);
    for (uint32_t c = 0; c < fr_pgraph_count(graph); c++) {
        g_assert_cmpuint(fr_pgraph_build_counts(build)->by_component[c], ==,
                         counts.by_component[c]);
    }
    fr_pgraph_counts_clear(&counts);
    assert_sound(fr_pgraph_build_plant(build));
    g_assert_cmphex(fr_plant_digest(fr_pgraph_build_plant(build)), ==, fr_plant_digest(fresh));
    fr_plant_free(fresh);
    return build;
}

typedef struct Pair {
    FrPgraph *graph;
    FrPgraphBuild *last, *build;
} Pair;

/// Builds a graph, sets a parameter and builds again.
static Pair rebuilt(const char *text, const char *id, const char *name, const char *value) {
    Pair pair = {.graph = graph_read(text)};
    pair.last = rebuild(pair.graph, NULL);
    graph_set(pair.graph, id, name, value);
    pair.build = rebuild(pair.graph, pair.last);
    return pair;
}

static void pair_free(Pair pair) {
    fr_pgraph_build_free(pair.last);
    fr_pgraph_build_free(pair.build);
    fr_pgraph_free(pair.graph);
}

static uint64_t made(const FrPgraphBuild *build) {
    return fr_pgraph_build_counts(build)->instances - fr_pgraph_build_taken_over(build);
}

static uint64_t count_of(const Pair *pair, const char *id) {
    return fr_pgraph_build_counts(pair->build)->by_component[fr_pgraph_find(pair->graph, id)];
}

static void test_first_build(void) {
    FrPgraph *graph = graph_read(tree);
    FrPgraphBuild *build = rebuild(graph, NULL);
    g_assert_cmpuint(fr_pgraph_build_taken_over(build), ==, 0);
    fr_pgraph_build_free(build);
    fr_pgraph_free(graph);
}

static void test_shape(void) {
    Pair pair = rebuilt(tree, "leaf", "width", ".07");
    g_assert_cmpuint(made(pair.build), ==, 0);
    g_assert_true(fr_pgraph_build_shares(pair.build, pair.last));
    pair_free(pair);
}

static void test_last_lives_on(void) {
    Pair pair = rebuilt(tree, "leaf", "width", ".07");
    FrDigest before = fr_plant_digest(fr_pgraph_build_plant(pair.last));
    fr_pgraph_build_free(pair.build);
    g_assert_cmphex(fr_plant_digest(fr_pgraph_build_plant(pair.last)), ==, before);
    graph_set(pair.graph, "leaf", "width", ".05");
    pair.build = rebuild(pair.graph, pair.last);
    g_assert_cmphex(fr_plant_digest(fr_pgraph_build_plant(pair.build)), ==, before);
    fr_pgraph_build_free(pair.last);
    pair.last = NULL;
    assert_sound(fr_pgraph_build_plant(pair.build));
    pair_free(pair);
}

static void test_leaf(void) {
    Pair pair = rebuilt(tree, "leaf", "scale", "1.2 ~ .2");
    g_assert_cmpuint(made(pair.build), ==, count_of(&pair, "leaf"));
    pair_free(pair);
}

static void test_twig(void) {
    Pair pair = rebuilt(tree, "twig", "length", ".5");
    g_assert_cmpuint(fr_pgraph_build_taken_over(pair.build), ==, count_of(&pair, "trunk"));
    pair_free(pair);
}

static void test_trunk(void) {
    Pair pair = rebuilt(tree, "trunk", "gnarl", "11");
    g_assert_cmpuint(fr_pgraph_build_taken_over(pair.build), ==, 0);
    pair_free(pair);
}

static void test_whom_others_show(void) {
    // `only` of the berry tells the twig where to make one.
    Pair pair = rebuilt(tree, "berry", "only", "even");
    g_assert_cmpuint(fr_pgraph_build_taken_over(pair.build), ==, count_of(&pair, "trunk"));
    pair_free(pair);
}

static void test_seed(void) {
    FrPgraph *graph = graph_read(tree), *other = fr_pgraph_new("test", 2);
    char **lines = g_strsplit(tree, "\n", -1);
    for (char **line = lines; *line != NULL; line++) {
        graph_read_line(other, *line);
    }
    g_strfreev(lines);
    FrPgraphBuild *last = rebuild(graph, NULL), *build = rebuild(other, last);
    g_assert_cmpuint(fr_pgraph_build_taken_over(build), ==, 0);
    fr_pgraph_build_free(last);
    fr_pgraph_build_free(build);
    fr_pgraph_free(graph);
    fr_pgraph_free(other);
}

/// Rebuilds `text` from `before` and answers how many instances were taken over.
static uint64_t taken_from(const char *before, const char *text) {
    FrPgraph *first = graph_read(before), *second = graph_read(text);
    FrPgraphBuild *last = rebuild(first, NULL), *build = rebuild(second, last);
    uint64_t count = fr_pgraph_build_taken_over(build);
    fr_pgraph_build_free(last);
    fr_pgraph_build_free(build);
    fr_pgraph_free(first);
    fr_pgraph_free(second);
    return count;
}

static void test_structure(void) {
    const char *bare = "tree trunk number=6\ntree twig number=5\nleaf leaf\n"
                       "trunk = twig\ntwig = leaf";
    const char *shod = "leaf thorn\ntree trunk number=6\ntree twig number=5\nleaf leaf\n"
                       "trunk = twig\ntwig = leaf\nleaf - thorn";
    // Leaves with thorns are made anew, what bears them is not.
    g_assert_cmpuint(taken_from(bare, shod), ==, 1 + 6);
    g_assert_cmpuint(taken_from(shod, bare), ==, 1 + 6);
    const char *twice = "tree trunk number=6\ntree twig number=5\nleaf leaf\n"
                        "leaf more\ntrunk = twig\ntwig = leaf\ntrunk = more";
    g_assert_cmpuint(taken_from(bare, twice), ==, 0);
    const char *forest = "horn other\ntree trunk number=6\ntree twig number=5\nleaf leaf\n"
                         "trunk = twig\ntwig = leaf";
    g_assert_cmpuint(taken_from(bare, forest), ==, 1 + 6 + 30);
    g_assert_cmpuint(taken_from(forest, bare), ==, 1 + 6 + 30);
    g_assert_cmpuint(taken_from(bare, "leaf leaf"), ==, 0);
}

static void test_mixture(void) {
    static const char *const links = "bent - trunk\ntrunk = sun\nsun - twig\ntwig - leaf\n"
                                     "twig = ball\nball - either\neither - red\neither - cup\n"
                                     "trunk - ring\nring - ring\ntrunk = beads\nbeads - leaf";
    static const char *const edits[][3] = {
        {"leaf", "width", ".02"},          {"cup", "scale", "2"},        {"red", "rotate_x", "30"},
        {"sun", "light_x", "2"},           {"ring", "rotate_y", "20"},   {"bent", "amount", "2"},
        {"beads", "radius", ".02"},        {"either", "weights", "3 1"}, {"ball", "number", "7"},
        {"twig", "length", ".3"},          {"trunk", "gnarl", "4"},      {"leaf", "scale", "= 1+x"},
        {"ring", "recursion_scale", ".7"}, {"ring", "depth", "6"},       {"leaf", "length", ".2"},
    };
    GString *text = g_string_new(motley);
    g_string_append(text, links);
    FrPgraph *graph = graph_read(text->str);
    FrPgraphBuild *last = rebuild(graph, NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(edits); k++) {
        graph_set(graph, edits[k][0], edits[k][1], edits[k][2]);
        FrPgraphBuild *build = rebuild(graph, last);
        fr_pgraph_build_free(last);
        last = build;
    }
    fr_pgraph_build_free(last);
    fr_pgraph_free(graph);
    g_string_free(text, TRUE);
}

// What broke keeps its own finish, whatever other finishes come before it.
static void test_finishes(void) {
    Pair pair = rebuilt("horn first length=.1\ntree trunk number=40\n"
                        "horn twig break_chance=.5;break_tip=broken;tip=round\n"
                        "first - trunk\ntrunk = twig",
                        "first", "tip", "round");
    g_assert_cmpuint(fr_pgraph_build_plant(pair.build)->finishes->len, ==, 4);
    pair_free(pair);
    pair = rebuilt("tree trunk number=40\nhorn twig break_chance=.5;break_tip=broken\n"
                   "horn other relief=.1\ntrunk = twig\ntrunk = other",
                   "other", "relief", "0");
    pair_free(pair);
}

static void test_failure(void) {
    FrPgraph *graph = graph_read(tree);
    FrPgraphBuild *last = rebuild(graph, NULL), *none;
    FrDigest before = fr_plant_digest(fr_pgraph_build_plant(last));
    FrContext context = fr_context_default();
    graph_set(graph, "twig", "number", "900000");
    context.limits.instances = 1000;
    g_assert_cmpint(fr_pgraph_rebuild(graph, last, &context, &none), ==, FR_ERR_LIMIT);
    g_assert_null(none);
    g_assert_cmphex(fr_plant_digest(fr_pgraph_build_plant(last)), ==, before);
    graph_set(graph, "twig", "number", "5");
    FrPgraphBuild *build = rebuild(graph, last);
    g_assert_cmpuint(made(build), ==, 0);
    // A lower limit is met by what would be taken over too.
    context.limits.instances = 20;
    g_assert_cmpint(fr_pgraph_rebuild(graph, build, &context, &none), ==, FR_ERR_LIMIT);
    fr_pgraph_build_free(build);
    fr_pgraph_build_free(last);
    fr_pgraph_free(graph);
}

static void test_warnings(void) {
    FrPgraph *graph = graph_read("horn stem length== 1/(x*0)\nleaf leaf\nstem - leaf");
    FrPgraphBuild *last = NULL;
    for (int k = 0; k < 2; k++) {
        FrContext context = fr_context_default();
        FrPgraphBuild *build;
        context.diags = fr_diags_new();
        g_assert_cmpint(fr_pgraph_rebuild(graph, last, &context, &build), ==, FR_OK);
        g_assert_cmpuint(fr_diags_count(context.diags), ==, 1);
        fr_diags_free(context.diags);
        fr_pgraph_build_free(last);
        last = build;
    }
    fr_pgraph_build_free(last);
    fr_pgraph_free(graph);
}

static void test_threads(void) {
    static const int threads[] = {1, 2, 3, 8};
    FrPgraph *graph = graph_read("tree trunk number=40\ntree twig number=40\nleaf leaf\nleaf more\n"
                                 "trunk = twig\ntwig = leaf\ntwig = more");
    FrPgraphBuild *last = rebuild(graph, NULL);
    graph_set(graph, "more", "scale", "2 ~ 1");
    FrDigest digest = 0;
    for (size_t k = 0; k < G_N_ELEMENTS(threads); k++) {
        FrContext context = fr_context_default();
        FrPgraphBuild *build;
        context.pool = fr_pool_new(threads[k]);
        g_assert_cmpint(fr_pgraph_rebuild(graph, last, &context, &build), ==, FR_OK);
        FrDigest now = fr_plant_digest(fr_pgraph_build_plant(build));
        g_assert_cmphex(now, ==, k > 0 ? digest : now);
        g_assert_cmpuint(made(build), ==, 1600);
        digest = now;
        fr_pgraph_build_free(build);
        fr_pool_free(context.pool);
    }
    fr_pgraph_build_free(last);
    fr_pgraph_free(graph);
}

static void test_lone(void) {
    enum { MORE = 64 }; // what lies behind a short array of counts is not always zero
    FrPgraph *graph = graph_read("camera root\nhorn stem\nroot - stem");
    FrPgraphBuild *last = rebuild(graph, NULL);
    for (int k = 0; k < MORE; k++) {
        char *line = g_strdup_printf("leaf lone%d", k);
        graph_read_line(graph, line);
        g_free(line);
        FrPgraphBuild *build = rebuild(graph, last);
        g_assert_true(fr_pgraph_build_shares(build, last));
        fr_pgraph_build_free(last);
        last = build;
    }
    FrPgraph *few = graph_read("camera root\nhorn stem\nroot - stem");
    FrPgraphBuild *build = rebuild(few, last);
    g_assert_true(fr_pgraph_build_shares(build, last));
    fr_pgraph_build_free(build);
    fr_pgraph_build_free(last);
    fr_pgraph_free(few);
    fr_pgraph_free(graph);
}

#define NAME(text) "/pgraph/rebuild/" text

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(NAME("a first build makes every instance"), test_first_build);
    g_test_add_func(NAME("another shape of leaves makes no instance"), test_shape);
    g_test_add_func(NAME("builds that share rows live and die alone"), test_last_lives_on);
    g_test_add_func(NAME("larger leaves make the leaves only"), test_leaf);
    g_test_add_func(NAME("a twig's change makes twigs and what hangs on them"), test_twig);
    g_test_add_func(NAME("a trunk's change makes all"), test_trunk);
    g_test_add_func(NAME("what a parent reads of its child reaches the parent"),
                    test_whom_others_show);
    g_test_add_func(NAME("another seed makes all"), test_seed);
    g_test_add_func(NAME("components and links come and go"), test_structure);
    g_test_add_func(NAME("components that nothing leads to come and go and count none"), test_lone);
    g_test_add_func(NAME("scopes, fields, chains, strings and choices follow edits"), test_mixture);
    g_test_add_func(NAME("what broke keeps its finish"), test_finishes);
    g_test_add_func(NAME("a build that fails leaves the last one as it was"), test_failure);
    g_test_add_func(NAME("warnings are given again"), test_warnings);
    g_test_add_func(NAME("the bits are the same for any number of threads"), test_threads);
    return g_test_run();
}
