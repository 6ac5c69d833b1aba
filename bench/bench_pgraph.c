// From a p-graph to a plant: skeletons, leaves, and how constant and varying parameters compare.
#include "bench.h"

#include <string.h>

static void set(FrPgraph *graph, uint32_t component, const char *name, const char *value) {
    const FrParamTable *table = fr_pgraph_table(fr_pgraph_kind(graph, component));
    const FrParam *row = fr_params_find(table, name);
    FR_ASSERT(row != NULL);
    FrStatus status = fr_params_set(table, fr_pgraph_params(graph, component), row, value,
                                    (FrSpan){0}, NULL, NULL);
    FR_ASSERT(status == FR_OK);
}

static uint32_t add(FrPgraph *graph, FrComponentKind kind, const char *id) {
    uint32_t component = fr_pgraph_add(graph, kind, id, (FrSpan){0}, NULL);
    if (component > 0) {
        FrStatus status =
            fr_pgraph_link(graph, component - 1, component, FR_LINK_BRANCH, (FrSpan){0}, NULL);
        FR_ASSERT(status == FR_OK);
    }
    return component;
}

// A trunk with 100 boughs of 100 twigs of 10 twiglets, internodes as given.
static FrPgraph *skeleton(const char *gnarl) {
    static const char *const ids[] = {"trunk", "bough", "twig", "twiglet"};
    static const char *const numbers[] = {"100", "100", "10", "0"};
    FrPgraph *graph = fr_pgraph_new("skeleton", 1);
    for (int k = 0; k < 4; k++) {
        uint32_t tree = add(graph, FR_COMPONENT_TREE, ids[k]);
        set(graph, tree, "number", numbers[k]);
        set(graph, tree, "segments", "20");
        set(graph, tree, "curvature", "30");
        set(graph, tree, "gnarl", gnarl);
    }
    return graph;
}

// 250 000 leaves on 2500 twigs.
static FrPgraph *foliage(const char *scale, const char *length) {
    FrPgraph *graph = fr_pgraph_new("foliage", 1);
    set(graph, add(graph, FR_COMPONENT_TREE, "trunk"), "number", "50");
    set(graph, add(graph, FR_COMPONENT_TREE, "bough"), "number", "50");
    set(graph, add(graph, FR_COMPONENT_TREE, "twig"), "number", "100");
    uint32_t leaf = add(graph, FR_COMPONENT_LEAF, "leaf");
    set(graph, leaf, "scale", scale);
    set(graph, leaf, "length", length);
    return graph;
}

typedef struct Run {
    const FrPgraph *graph;
    FrContext context;
    uint64_t nodes, organs;
} Run;

static void build(void *data) {
    Run *run = data;
    FrPlant *plant;
    FrStatus status = fr_pgraph_build(run->graph, &run->context, &plant, NULL);
    FR_ASSERT(status == FR_OK);
    run->nodes = plant->nodes.count;
    run->organs = plant->organs.count;
    fr_plant_free(plant);
}

static void measure(const char *name, FrPgraph *graph, int threads, bool is_foliage,
                    const char *what) {
    Run run = {.graph = graph, .context = fr_context_default()};
    run.context.pool = threads > 1 ? fr_pool_new(threads) : NULL;
    double seconds = bench_shortest(3, build, &run);
    double made = (double)(is_foliage ? run.organs : run.nodes);
    bench_tell(name, made / seconds, 0, is_foliage ? "leaves/s" : "nodes/s",
               "%s: %.0f made in %.1f ms, %d thread%s", what, made, seconds * 1000, threads,
               threads > 1 ? "s" : "");
    fr_pool_free(run.context.pool);
    fr_pgraph_free(graph);
}

void bench_pgraph(void) {
    measure("pgraph.skeleton", skeleton("0"), 1, false, "bent stems of 20 internodes");
    measure("pgraph.skeleton-2", skeleton("0"), 2, false, "bent stems of 20 internodes");
    measure("pgraph.gnarled", skeleton("20"), 1, false, "bent, gnarled stems of 20 internodes");
    measure("pgraph.leaves", foliage("1", "0.1"), 1, true, "equal leaves");
    measure("pgraph.leaves-2", foliage("1", "0.1"), 2, true, "equal leaves");
    measure("pgraph.leaves-random", foliage("1 ~ .3", "0.1 ~ .02"), 1, true,
            "leaves of random size and form");
    measure("pgraph.leaves-function", foliage("1", "= .1*sin(pi*x)+.02"), 1, true,
            "leaves formed by a function of their place");
}
