// What a p-graph promises whatever is in it: the same bits for any number of threads, small
// changes that stay small, limits before memory, errors with places.
#include "graphs.h"

#include <math.h>
#include <time.h>

static const char tree_text[] =
    "camera C\n"
    "tree trunk length=6;radius=.2;gnarl=15;number=24;child-scale=1..0.3;curvature=8;"
    "branching-angle=70..40 ~ 8;azimuth-jitter=15;regularity=.5;gravitropism=.1\n"
    "tree bough length=2 ~ .4;radius=.4;radius-mode=of-parent;gnarl=25;number=14 ~ 3;"
    "phototropism=.4;deviation=6\n"
    "tree twig length=.5;radius=.4;radius-mode=of-parent;mode=density;density=30;curvature=20 ~ 9\n"
    "leaf leaf length=.08 ~ .02;fold=12 ~ 6;phototropism=.4 ~ .2;only=!3\n"
    "leaf odd length== .05 + .05*x;only=3\n"
    "simple bead primitive=tube;size=.01;translate-z=.02;depth=3;rotate-x=9 ~ 9\n"
    "C - trunk\ntrunk = bough\nbough = twig\ntwig = leaf\ntwig = odd\ntwig - bead\nbead - bead";

static void same_for_any_threads(void) {
    FrDigest digest = 0;
    static const int threads[] = {1, 2, 3, 8};
    for (size_t k = 0; k < G_N_ELEMENTS(threads); k++) {
        FrPool *pool = fr_pool_new(threads[k]);
        Built built = build_graph(graph_read(tree_text), pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        assert_sound(built.plant);
        g_assert_cmpuint(built.plant->organs.count, >, 3000);
        FrDigest now = fr_plant_digest(built.plant);
        g_assert_true(k == 0 || now == digest);
        digest = now;
        built_free(built);
        fr_pool_free(pool);
    }
}

static void cache_is_the_frames_pass(void) {
    Built built = build(tree_text);
    const FrNodes *nodes = &built.plant->nodes;
    size_t size = nodes->count;
    vec3s *position = g_memdup2(nodes->position, size * sizeof *position);
    versors *frame = g_memdup2(nodes->frame, size * sizeof *frame);
    fr_plant_update_frames(built.plant, 0);
    g_assert_true(memcmp(position, nodes->position, size * sizeof *position) == 0);
    g_assert_true(memcmp(frame, nodes->frame, size * sizeof *frame) == 0);
    g_free(position);
    g_free(frame);
    built_free(built);
}

static gint compare_keys(gconstpointer a, gconstpointer b) {
    FrKey p = *(const FrKey *)a, q = *(const FrKey *)b;
    return p < q ? -1 : p > q;
}

static void one_more_child(void) {
    // Nothing that was drawn for the other children is drawn anew.
    FrPgraph *graph = graph_read("tree A mode=internode;internode=.1;length=1;start=0\n"
                                 "tree B length=.5 ~ .2;number=5;branching-angle=50 ~ 20\n"
                                 "leaf L scale=1 ~ .5\nA = B\nB = L");
    Built few = build_graph(graph, NULL);
    graph = graph_read("tree A mode=internode;internode=.1;length=1.1;start=0\n"
                       "tree B length=.5 ~ .2;number=5;branching-angle=50 ~ 20\n"
                       "leaf L scale=1 ~ .5\nA = B\nB = L");
    Built more = build_graph(graph, NULL);
    g_assert_cmpuint(built_count(&few, "B"), ==, 11);
    g_assert_cmpuint(built_count(&more, "B"), ==, 12);
    for (uint32_t k = 1; k < few.plant->axes.count; k++) {
        const FrAxes *a = &few.plant->axes;
        const FrAxes *b = &more.plant->axes;
        g_assert_cmpuint(a->path[k], ==, b->path[k]);
        g_assert_cmpfloat(few.plant->nodes.length[a->first[k]], ==,
                          more.plant->nodes.length[b->first[k]]);
    }
    for (uint32_t k = 0; k < few.plant->organs.count; k++) {
        g_assert_cmpuint(few.plant->organs.path[k], ==, more.plant->organs.path[k]);
        g_assert_cmpfloat(few.plant->organs.scale[k], ==, more.plant->organs.scale[k]);
    }
    built_free(few);
    built_free(more);
}

static void paths_differ(void) {
    Built built = build(tree_text);
    GArray *keys = g_array_new(FALSE, FALSE, sizeof(FrKey));
    g_array_append_vals(keys, built.plant->axes.path, built.plant->axes.count);
    g_array_append_vals(keys, built.plant->organs.path, built.plant->organs.count);
    g_array_sort(keys, compare_keys);
    for (guint k = 1; k < keys->len; k++) {
        g_assert_cmpuint(g_array_index(keys, FrKey, k - 1), !=, g_array_index(keys, FrKey, k));
    }
    g_array_unref(keys);
    built_free(built);
}

static void other_seed(void) {
    Built built = build(tree_text);
    FrPgraph *graph = graph_read(tree_text);
    graph_set(graph, "bough", "seed", "2");
    Built again = build_graph(graph, NULL);
    g_assert_cmpuint(fr_plant_digest(built.plant), !=, fr_plant_digest(again.plant));
    // What does not follow on the bough is as it was.
    uint32_t trunk = built.plant->axes.last[0] + 1;
    g_assert_true(memcmp(built.plant->nodes.rotation, again.plant->nodes.rotation,
                         trunk * sizeof(versors)) == 0);
    built_free(built);
    built_free(again);
}

static void assert_refused(const char *text, const char *code, FrStatus status) {
    clock_t begin = clock(); // processor time: the machine may be busy
    Built built = build_graph(graph_read(text), NULL);
    g_assert_cmpint(built.status, ==, status);
    g_assert_null(built.plant);
    if (!built_has(&built, code)) {
        GString *errors = g_string_new("");
        fr_diags_print(built.diags, errors);
        g_error("not %s but %s", code, errors->str);
    }
    // Sanitizers take time of their own.
    g_assert_true(g_getenv("FROND_SANITIZED") != NULL || clock() - begin < CLOCKS_PER_SEC);
    built_free(built);
}

static void too_many(void) {
    GString *text = g_string_new("tree t0 number=10\n");
    for (int k = 1; k <= 20; k++) {
        g_string_append_printf(text, "tree t%d number=10\nt%d = t%d\n", k, k - 1, k);
    }
    assert_refused(text->str, "limit-instances", FR_ERR_LIMIT); // 10^20
    g_string_free(text, TRUE);
    assert_refused("tree A number=900..1000 ~ 50;depth=6\nA = A", "limit-instances", FR_ERR_LIMIT);
    assert_refused("tree A number=1000000;depth=4000\nA = A", "limit-instances", FR_ERR_LIMIT);
    assert_refused("phiball A number== 1000000\nphiball B number== 1000000 + i\nleaf L\n"
                   "A - B\nB - L",
                   "limit-instances", FR_ERR_LIMIT);
    assert_refused("tree A mode=internode;internode=.00001;length=1000\nleaf L\nA = L",
                   "limit-instances", FR_ERR_LIMIT);
    // Children that flags leave out cost time, so they count.
    assert_refused("phiball A number=10000\nphiball B number== 999999 + t\nleaf L only=first\n"
                   "A - B\nB - L",
                   "limit-instances", FR_ERR_LIMIT);
    assert_refused("phiball A number=100000\nhorn H segments=1000\nA - H", "limit-nodes",
                   FR_ERR_LIMIT);
    assert_refused("horn H depth=100000\nH - H", "limit-depth", FR_ERR_LIMIT);
    assert_refused("phiball A number=1000000\nhorn H course=steps;steps=100000\nA - H",
                   "limit-nodes", FR_ERR_LIMIT);
    assert_refused("phiball A number=100000\nleaf L length== .01 + .000001*i\nA - L",
                   "limit-shapes", FR_ERR_LIMIT);
}

static void many_generations(void) {
    // Two members that lead to each other and to themselves: stages grow with the square of the
    // depth, instances beyond any number.
    assert_refused("horn A depth=3000\nhorn B depth=3000\nA - A\nA - B\nB - A\nB - B",
                   "limit-instances", FR_ERR_LIMIT);
    Built built = build("horn A depth=4096;length=.1\nA - A");
    g_assert_cmpuint(built.counts.instances, ==, 4096);
    built_free(built);
}

static void endless(void) {
    FrSource *source = fr_source_new("loop", "0123456789", 10);
    FrPgraph *graph = graph_read("horn A\nhorn B\nhorn C depth=2\nA - B");
    FrSpan span = {source, 3, 5};
    g_assert_cmpint(fr_pgraph_link(graph, 1, 0, FR_LINK_CHILD, span, NULL), ==, FR_OK);
    g_assert_cmpint(fr_pgraph_link(graph, 1, 2, FR_LINK_CHILD, span, NULL), ==, FR_OK);
    g_assert_cmpint(fr_pgraph_link(graph, 2, 0, FR_LINK_CHILD, span, NULL), ==, FR_OK);
    Built built = build_graph(graph, NULL);
    g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
    g_assert_true(built_has(&built, "endless-recursion"));
    built_free(built);
    graph = graph_read("horn A");
    fr_pgraph_link(graph, 0, 0, FR_LINK_LEAF, span, NULL);
    built = build_graph(graph, NULL);
    g_assert_true(built_has(&built, "endless-recursion"));
    const FrDiag *diag = fr_diags_get(built.diags, 0);
    g_assert_true(diag->span.source == source && diag->span.begin == 3 && diag->span.end == 5);
    built_free(built);
    fr_source_unref(source);
}

static void wrong_graphs(void) {
    static const struct {
        const char *text, *code;
    } cases[] = {
        {"camera A\ncamera B", "second-camera"},
        {"horn A material=oak", "unknown-material"},
        {"horn A only=2..1", "wrong-flags"},
        {"horn A only=%0=0", "wrong-flags"},
        {"horn A only=sometimes", "wrong-flags"},
        {"horn A course=path;path=1,2,3", "wrong-path"},
        {"horn A course=path;path=1,2,3 nan,0,0", "wrong-path"},
        {"horn A course=path;path=1,2,3 4,5", "wrong-path"},
        {"", "no-component"},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        assert_refused(cases[k].text, cases[k].code, FR_ERR_DOCUMENT);
    }
}

static void assert_warned(const char *text, const char *code) {
    FrDiags *diags = fr_diags_new();
    FrPgraph *graph = graph_read(text);
    g_assert_cmpint(fr_pgraph_check(graph, diags), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(diags), ==, code != NULL ? 1 : 0);
    if (code != NULL) {
        g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, code);
        g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, "'A'"));
    }
    fr_pgraph_free(graph);
    fr_diags_free(diags);
}

static void comes_to_nothing(void) {
    assert_warned("revo A outline=-1,0 1,1 0,2", "negative-radius");
    assert_warned("phyllotaxis A outline=1,0 -0.5,1", "negative-radius");
    assert_warned("revo A outline=1,0 0,-1", NULL);
    assert_warned("horn A course=path;path=1,2,3 1,2,3 1,2,3", "path-without-length");
    assert_warned("ffd A preset=curve;path=0,0,0 0,0,0", "path-without-length");
    assert_warned("force A kind=curve;path=0,0,1 0,0,1", "path-without-length");
    assert_warned("horn A path=1,2,3 1,2,3", NULL); // not followed
    assert_warned("horn A course=path;path=1,2,3 1,2,4 1,2,3", NULL);
    assert_warned("horn A aim=.5;aim-at=0,0,0", "aim-without-direction");
    assert_warned("tree A aim=0..1;aim-at=0,0,0", "aim-without-direction");
    assert_warned("horn A aim-at=0,0,0", NULL);
}

static void outgrown(void) {
    // 100 to the fourth is 10^8, to the fifth 10^10.
    const char *text = "horn A depth=%d;recursion-scale=100;length=1e-6;radius=1e-7\nA - A";
    for (int depth = 5; depth <= 6; depth++) {
        char *own = g_strdup_printf(text, depth);
        Built built = build_graph(graph_read(own), NULL);
        g_assert_cmpint(built.status, ==, FR_OK);
        g_assert_cmpint(built_has(&built, "outgrown"), ==, depth == 6);
        built_free(built);
        g_free(own);
    }
}

static void warnings(void) {
    FrDiags *diags = fr_diags_new();
    FrPgraph *graph = graph_read("camera C\nhorn A depth=3\nhorn B\nC - A");
    g_assert_cmpint(fr_pgraph_check(graph, diags), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(diags), ==, 2);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "unreachable-component");
    g_assert_cmpstr(fr_diags_get(diags, 1)->code, ==, "depth-without-recursion");
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 0);
    g_assert_cmpuint(fr_pgraph_add(graph, FR_COMPONENT_HORN, "A", (FrSpan){0}, diags), ==, FR_NONE);
    g_assert_cmpint(fr_pgraph_link(graph, 0, 1, FR_LINK_CHILD, (FrSpan){0}, diags), ==,
                    FR_ERR_DOCUMENT);
    g_assert_cmpint(fr_pgraph_link(graph, 1, 0, FR_LINK_CHILD, (FrSpan){0}, diags), ==,
                    FR_ERR_DOCUMENT);
    fr_pgraph_free(graph);
    fr_diags_free(diags);
}

static void faults_reported_once(void) {
    static const int threads[] = {1, 4};
    for (size_t k = 0; k < G_N_ELEMENTS(threads); k++) {
        FrPool *pool = fr_pool_new(threads[k]);
        Built built = build_graph(graph_read("tree A number=3000;branching-angle== 9/(i-5)\n"
                                             "leaf L scale== 1/(i-7);phototropism== log(0-i)\n"
                                             "A = L"),
                                  pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        g_assert_cmpuint(fr_diags_count(built.diags), ==, 3);
        g_assert_nonnull(strstr(fr_diags_get(built.diags, 0)->text, "branching-angle of 'A'"));
        g_assert_nonnull(strstr(fr_diags_get(built.diags, 1)->text, "phototropism of 'L'"));
        g_assert_nonnull(strstr(fr_diags_get(built.diags, 2)->text, "scale of 'L'"));
        built_free(built);
        fr_pool_free(pool);
    }
}

static void extremes(void) {
    // Nothing within the hard ranges gives a plant that is not sound.
    static const char *const texts[] = {
        "horn A depth=64;recursion-scale=1000;scale=1000000;length=1000;translate-x=10000\nA - A",
        "horn A depth=64;recursion-scale=.000001;scale=.000001;length=0\nA - A",
        "tree A number=50;start=1;end=1;deviation=90;length=1000\nleaf L scale=.000001\nA = L",
        "tree A number=7;start=.9;end=.1;deviation=40;spacing=ends;regularity=0;segments=3\n"
        "horn B\nA = B",
        "tree A length=0;number=5\nhorn B\nA = B",
        "horn A course=steps;steps=1\nhorn B\nA - B",
        "horn A course=steps;steps=500;step-scale=1000;primitive=box\nhorn B\nA - B",
        "horn A course=steps;steps=9;step-translate=0,0,0;step-rotate-y=40\nhorn B\nA - B",
        "horn A course=path;path=0,0,0 0,0,0\nhorn B\nA - B",
        "horn A course=path;path=0,0,1 0,0,5 0,0,1;twist=90;primitive=cone\nhorn B\nA - B",
        "phiball A number=0\nhorn B\nA - B",
        "phiball A number=9;opening=90;closing=90;radius-mode=touching\nhorn B\nA - B",
        "phiball A number=9;opening=180;closing=0;influence=1;child-scale=.000001..1000\nleaf B\n"
        "A - B",
        "horn A gravitropism=-20;phototropism=-20;plagiotropism=20;gnarl=180;"
        "gnarl-frequency=100;curvature=3600;twist=36000\nhorn B\nA - B",
        "horn A gravitropism=20\nhorn B gravitropism=-20\nA - B",
        "simple A primitive=tube;size=0\nsimple B primitive=tube;size=0\nA - B",
        "leaf A phototropism=1;gravitropism=1;rotate-x=180\nleaf B gravitropism=-1\nA - B",
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        built_free(build(texts[k]));
    }
}

static void cancelled(void) {
    FrPgraph *graph = graph_read(tree_text);
    FrContext context = fr_context_default();
    context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(context.progress);
    FrPlant *plant;
    g_assert_cmpint(fr_pgraph_build(graph, &context, &plant, NULL), ==, FR_CANCELLED);
    g_assert_null(plant);
    fr_progress_free(context.progress);
    fr_pgraph_free(graph);
}

static void tables_are_sound(void) {
    for (int kind = 0; kind < FR_COMPONENT_COUNT; kind++) {
        const FrParamTable *table = fr_pgraph_table((FrComponentKind)kind);
        g_assert_cmpuint(table->count, >, 10);
        for (size_t row = 0; row < table->count; row++) {
            const FrParam *param = &table->rows[row];
            g_assert_cmpuint(param->offset, <, table->struct_size);
            g_assert_cmpuint(strlen(param->meaning), >, 3);
            g_assert_true(fr_params_find(table, param->name) == param);
        }
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("the same bits for any number of threads", same_for_any_threads);
    TEST("the cache is what the frames pass makes", cache_is_the_frames_pass);
    TEST("one more child leaves all other draws as they were", one_more_child);
    TEST("a component's seed changes only what follows on it", other_seed);
    TEST("no two parts have the same path", paths_differ);
    TEST("too large plants are refused at once", too_many);
    TEST("deep recursions end or are refused", many_generations);
    TEST("endless recursions are shown by a link", endless);
    TEST("wrong graphs give errors", wrong_graphs);
    TEST("useless parts give warnings", warnings);
    TEST("faults of expressions are reported once, in order", faults_reported_once);
    TEST("extreme values make sound plants", extremes);
    TEST("a cancelled build leaves nothing", cancelled);
    TEST("tables have sound rows", tables_are_sound);
    g_test_add_func("/pgraph/promises/outlines, paths and aims that come to nothing are told",
                    comes_to_nothing);
    g_test_add_func("/pgraph/promises/scales that outgrow numbers are told", outgrown);
    return g_test_run();
}
