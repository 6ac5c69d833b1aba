// What instances take to make: a sample, so that times are only held against each other.
#include "graphs.h"

#include <math.h>

// 400 stems of many joints, on each two leaves, which are flat and alike.
static const char *const stems = "phiball ball number=400\n"
                                 "horn stem segments=60;gnarl=20;gnarl_frequency=9\n"
                                 "leaf leaf length=.1\n"
                                 "simple off primitive=sphere;enabled=no\n"
                                 "ball = stem\nstem = leaf\nleaf = off";

static Built timed(FrPgraph *graph, FrPool *pool) {
    Built built = {.graph = graph};
    FrContext context = fr_context_default();
    double wanted;
    context.pool = pool;
    built.diags = NULL;
    built.counts.seconds = &wanted;
    built.status = fr_pgraph_build(graph, &context, &built.plant, &built.counts);
    g_assert_cmpint(built.status, ==, FR_OK);
    return built;
}

static double of(const Built *built, const char *id) {
    return built->counts.seconds[fr_pgraph_find(built->graph, id)];
}

static void test_times(void) {
    FrPgraph *graph = graph_read(stems);
    Built built = timed(graph, NULL);
    g_assert_cmpfloat(of(&built, "stem"), >, 0);
    g_assert_cmpfloat(of(&built, "stem"), <, 0.01);
    g_assert_cmpfloat(of(&built, "stem"), >, 3 * of(&built, "leaf")); // 60 joints to none
    g_assert_true(isnan(of(&built, "off")));
    built_free(built);
}

static void test_only_on_request(void) {
    Built built = build(stems);
    g_assert_null(built.counts.seconds);
    built_free(built);
}

static void test_same_plant(void) {
    FrPool *pool = fr_pool_new(3);
    Built plain = build(stems), built = timed(graph_read(stems), pool);
    g_assert_cmphex(fr_plant_digest(built.plant), ==, fr_plant_digest(plain.plant));
    built_free(plain);
    built_free(built);
    fr_pool_free(pool);
}

static void test_kept(void) {
    FrPgraph *graph = graph_read(stems);
    FrContext context = fr_context_default();
    FrPgraphBuild *first, *next;
    g_assert_cmpint(fr_pgraph_rebuild(graph, NULL, &context, &first), ==, FR_OK);
    graph_set(graph, "leaf", "length", ".2");
    g_assert_cmpint(fr_pgraph_rebuild(graph, first, &context, &next), ==, FR_OK);
    uint32_t stem = fr_pgraph_find(graph, "stem");
    double was = fr_pgraph_build_counts(first)->seconds[stem];
    g_assert_cmpfloat(was, >, 0);
    g_assert_cmpfloat(fr_pgraph_build_counts(next)->seconds[stem], ==, was); // none was made
    fr_pgraph_build_free(first);
    fr_pgraph_build_free(next);
    fr_pgraph_free(graph);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/timing/stems of many joints take longer than leaves", test_times);
    g_test_add_func("/pgraph/timing/nothing is timed that nobody asked for", test_only_on_request);
    g_test_add_func("/pgraph/timing/a plant that is timed is the same", test_same_plant);
    g_test_add_func("/pgraph/timing/what is taken over keeps its time", test_kept);
    return g_test_run();
}
