/// Plants that stand where a graft is, and what stands at the places of their symbols.
#include "graphs.h"

#include <cglm/struct.h>

/// A stem of two internodes, a side branch, a ball, and two places of `L`, one of `K`.
static FrStatus grow(void *data, const FrGraftWish *wish, const FrContext *context,
                     FrPlant **plant) {
    (void)data;
    float length = wish->count > 0 ? (float)wish->values[0] : 1;
    if (context->limits.nodes < 3) {
        return fr_limit_check(3, context->limits.nodes, "nodes", "the scion", (FrSpan){0},
                              context->diags);
    }
    FrPlant *made = *plant = fr_plant_new("scion");
    versors straight = GLMS_QUAT_IDENTITY;
    uint32_t stem = fr_plant_add_axis(made, FR_NONE, (vec3s){{0, 0, 0}}, 0.1F);
    fr_plant_add_node(made, stem, straight, length, 0.08F);
    uint32_t tip = fr_plant_add_node(made, stem, straight, length, 0.05F);
    uint32_t side = fr_plant_add_axis(made, 0, (vec3s){{0, 0, 0}}, 0.03F);
    fr_plant_add_node(made, side, glms_quat(GLM_PI_2f, 1, 0, 0), length / 2, 0.02F);
    fr_plant_add_component(made, "stem", (FrSpan){0});
    uint32_t leaf = fr_plant_add_component(made, "L", (FrSpan){0});
    uint32_t flower = fr_plant_add_component(made, "K", (FrSpan){0});
    FrShape ball = {.kind = FR_SHAPE_SPHERE, .size = {{1, 1, 1}}, .detail = 8};
    uint32_t first = fr_plant_append_organs(made, 4);
    const uint32_t nodes[] = {tip, 0, tip, 2};
    const uint32_t components[] = {0, leaf, flower, leaf};
    for (uint32_t i = 0; i < 4; i++) {
        made->organs.node[first + i] = nodes[i];
        made->organs.component[first + i] = components[i];
        made->organs.scale[first + i] = i == 2 ? 3 : 1;
    }
    made->organs.shape[first] = fr_plant_add_shape(made, &ball);
    made->organs.path[first] = wish->key;
    return FR_OK;
}

static const FrGraft graft = {NULL, grow};

#define TREE                                                                                       \
    "tree t length=4;radius=.3;number=5;branching-angle=60\ngraft g plant=scion;scale=.5\n"        \
    "leaf l length=.1\nsimple k primitive=box;size=.2\nt = g"

static FrPgraph *tree(void) {
    FrPgraph *graph = graph_read(TREE);
    uint32_t g = fr_pgraph_find(graph, "g");
    g_assert_cmpint(
        fr_pgraph_link_symbol(graph, g, fr_pgraph_find(graph, "l"), 'L', (FrSpan){0}, NULL), ==,
        FR_OK);
    g_assert_cmpint(
        fr_pgraph_link_symbol(graph, g, fr_pgraph_find(graph, "k"), 'K', (FrSpan){0}, NULL), ==,
        FR_OK);
    return graph;
}

static Built grafted(FrPgraph *graph, FrPool *pool, uint64_t nodes) {
    Built built = {.graph = graph, .diags = fr_diags_new()};
    FrContext context = fr_context_default();
    context.diags = built.diags;
    context.pool = pool;
    context.limits.nodes = nodes;
    built.status = fr_pgraph_build_grafted(graph, &graft, &context, &built.plant, &built.counts);
    if (built.status == FR_OK) {
        assert_sound(built.plant);
    }
    return built;
}

static void counts(void) {
    Built built = grafted(tree(), NULL, 1000);
    g_assert_cmpint(built.status, ==, FR_OK);
    g_assert_cmpuint(built.counts.by_component[1], ==, 5);
    g_assert_cmpuint(built.counts.by_component[2], ==, 10);
    g_assert_cmpuint(built.counts.by_component[3], ==, 5);
    g_assert_cmpuint(built.plant->axes.count, ==, 1 + 5 * 2);
    g_assert_cmpuint(built.plant->organs.count, ==, 5 + 10 + 5);
    built_free(built);
}

static void places(void) {
    Built built = grafted(tree(), NULL, 1000);
    const FrPlant *plant = built.plant;
    // The flower of the first graft: at the tip of its stem, three times and half as large.
    uint32_t axis = 1;
    g_assert_cmpstr(g_array_index(plant->components, FrComponent, plant->axes.component[axis]).id,
                    ==, "g");
    vec3s origin = fr_plant_axis_origin(plant, axis);
    vec3s tip = plant->nodes.position[plant->axes.last[axis]];
    g_assert_cmpfloat_with_epsilon(glms_vec3_distance(origin, tip), 1, 1e-5);
    g_assert_cmpfloat_with_epsilon(plant->nodes.radius[plant->axes.last[axis]], 0.025, 1e-6);
    g_assert_cmpuint(plant->axes.order[axis], ==, 1);
    g_assert_cmpuint(plant->axes.order[axis + 1], ==, 2);
    bool is_found = false;
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(plant, i, &position, &rotation);
        bool is_flower =
            strcmp(g_array_index(plant->components, FrComponent, plant->organs.component[i]).id,
                   "k") == 0;
        if (is_flower && glms_vec3_distance(position, tip) < 1e-5F) {
            g_assert_cmpfloat_with_epsilon(plant->organs.scale[i], 1.5, 1e-5);
            is_found = true;
        }
    }
    g_assert_true(is_found);
    built_free(built);
}

static void numbers(void) {
    FrPgraph *graph = tree();
    FrNumber number = {0};
    g_assert_cmpint(fr_number_parse(&number, "= 1 + i", (FrSpan){0}, 1, -10, 10, NULL, NULL), ==,
                    FR_OK);
    g_assert_true(fr_pgraph_define(graph, 1, "length", &number));
    g_assert_false(fr_pgraph_define(graph, 1, "length", &number));
    Built built = grafted(graph, NULL, 1000);
    uint32_t i = 0;
    for (uint32_t axis = 1; axis < built.plant->axes.count; axis += 2, i++) {
        g_assert_cmpfloat_with_epsilon(built.plant->nodes.length[built.plant->axes.first[axis]],
                                       0.5 * (1 + i), 1e-5);
    }
    fr_number_clear(&number);
    built_free(built);
}

static void threads(void) {
    FrDigest first = 0;
    for (int count = 1; count <= 8; count++) {
        FrPool *pool = fr_pool_new(count);
        Built built = grafted(tree(), pool, 1000);
        FrDigest digest = fr_plant_digest(built.plant);
        g_assert_true(count == 1 || digest == first);
        first = digest;
        built_free(built);
        fr_pool_free(pool);
    }
}

static void keys(void) {
    Built built = grafted(tree(), NULL, 1000);
    GHashTable *paths = g_hash_table_new(g_int64_hash, g_int64_equal);
    for (uint32_t i = 0; i < built.plant->organs.count; i++) {
        g_hash_table_add(paths, &built.plant->organs.path[i]);
    }
    g_assert_cmpuint(g_hash_table_size(paths), ==, built.plant->organs.count);
    g_hash_table_unref(paths);
    built_free(built);
}

static void limits(void) {
    for (uint64_t nodes = 1; nodes < 30; nodes++) {
        Built built = grafted(tree(), NULL, nodes);
        bool fits = built.status == FR_OK;
        g_assert_true(fits || built.status == FR_ERR_LIMIT);
        g_assert_true(!fits || built.plant->nodes.count <= nodes);
        if (!fits) {
            g_assert_cmpstr(fr_diags_get(built.diags, 0)->code, ==, "limit-nodes");
        }
        built_free(built);
    }
}

static void recursion(void) {
    FrPgraph *graph = graph_read("graft g plant=scion;depth=3;recursion-scale=.5");
    g_assert_cmpint(fr_pgraph_link_symbol(graph, 0, 0, 'L', (FrSpan){0}, NULL), ==, FR_OK);
    Built built = grafted(graph, NULL, 1000);
    g_assert_cmpuint(built.counts.by_component[0], ==, 1 + 2 + 4);
    built_free(built);
}

// How long the grafts take is told with them: they are what takes time here.
static void times(void) {
    Built built = {.graph = tree(), .diags = fr_diags_new()};
    FrContext context = fr_context_default();
    double wanted;
    context.diags = built.diags;
    built.counts.seconds = &wanted;
    built.status =
        fr_pgraph_build_grafted(built.graph, &graft, &context, &built.plant, &built.counts);
    g_assert_cmpint(built.status, ==, FR_OK);
    double each = built.counts.seconds[fr_pgraph_find(built.graph, "g")];
    g_assert_cmpfloat(each, >, 0); // and no NAN
    built_free(built);
}

static void wrong(void) {
    FrPgraph *graph = tree();
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(fr_pgraph_link_symbol(graph, 0, 2, 'L', (FrSpan){0}, diags), ==,
                    FR_ERR_DOCUMENT);
    g_assert_cmpint(fr_pgraph_link_symbol(graph, 1, 2, 'F', (FrSpan){0}, diags), ==,
                    FR_ERR_DOCUMENT);
    g_assert_cmpint(fr_pgraph_link_symbol(graph, 1, 2, '[', (FrSpan){0}, diags), ==,
                    FR_ERR_DOCUMENT);
    g_assert_cmpint(fr_pgraph_link_symbol(graph, 1, 2, 'L', (FrSpan){0}, diags), ==,
                    FR_ERR_DOCUMENT);
    const char *const codes[] = {"wrong-symbol", "wrong-symbol", "wrong-symbol", "duplicate-link"};
    for (size_t i = 0; i < G_N_ELEMENTS(codes); i++) {
        g_assert_cmpstr(fr_diags_get(diags, i)->code, ==, codes[i]);
    }
    fr_diags_free(diags);
    Built built = build_graph(graph, NULL);
    g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpstr(fr_diags_get(built.diags, 0)->code, ==, "no-graft");
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/graft/each place of a symbol has what is linked to it", counts);
    g_test_add_func("/pgraph/graft/it stands and is scaled as its component is", places);
    g_test_add_func("/pgraph/graft/each instance has its own numbers", numbers);
    g_test_add_func("/pgraph/graft/the bits do not depend on the number of threads", threads);
    g_test_add_func("/pgraph/graft/all organs have keys of their own", keys);
    g_test_add_func("/pgraph/graft/grafts count against the limits", limits);
    g_test_add_func("/pgraph/graft/its symbols may place grafts again", recursion);
    g_test_add_func("/pgraph/graft/grafts have a time", times);
    g_test_add_func("/pgraph/graft/wrong links and unknown plants are errors", wrong);
    return g_test_run();
}
