// Links, multiplication, recursion, flags: the paper's structural claims by their ids.
#include "graphs.h"

#include <math.h>

static void figure2(void) {
    Built built = build("camera A\nhorn B length=1\nphiball C number=3\nhorn D depth=3;length=.2\n"
                        "A - B\nB - C\nC - D\nD - D");
    g_assert_cmpuint(built.counts.instances, ==, 12);
    g_assert_cmpuint(built_count(&built, "D"), ==, 9);
    assert_tree(&built, "A(B(C(D(D(D)) D(D(D)) D(D(D)))))");
    built_free(built);
}

static void shared_subgraph(void) {
    Built built = build("camera A\nhorn B\nhorn C\nleaf L\nA - B\nA - C\nB - L\nC - L");
    assert_tree(&built, "A(B(L) C(L))");
    built_free(built);
}

static void multiplied_tail(void) {
    Built built = build("horn A\nhorn B\nphiball C number=3\nsimple D\nA - B\nB - C\nC - D");
    assert_tree(&built, "A(B(C(D D D)))");
    built_free(built);
}

static void instance_counts(void) {
    // 4.10 J: a cascade multiplies, a recursion of one multiplier adds up powers.
    Built built = build("tree A number=4\ntree B number=5\nleaf L\nA = B\nB = L");
    g_assert_cmpuint(built.counts.instances, ==, 1 + 4 + 4 * 5);
    built_free(built);
    built = build("camera R\ntree A number=3;depth=4\nR - A\nA = A");
    g_assert_cmpuint(built_count(&built, "A"), ==, 1 + 3 + 9 + 27);
    built_free(built);
    built = build("horn A depth=7\nA - A");
    g_assert_cmpuint(built.counts.instances, ==, 7);
    built_free(built);
}

static void children_frames_differ_by_placement(void) {
    Built built = build("phiball C number=3;radius=1\nhorn D length=.5;depth=3\nC - D\nD - D");
    // The three chains are straight: all of a chain has the frame of its placement.
    const FrNodes *nodes = &built.plant->nodes;
    g_assert_cmpuint(nodes->count, ==, 9);
    for (uint32_t chain = 0; chain < 3; chain++) {
        for (uint32_t k = 0; k < 4; k++) {
            g_assert_cmpfloat_with_epsilon(nodes->frame[chain].raw[k],
                                           nodes->frame[chain + 3].raw[k], 1e-6);
            g_assert_cmpfloat_with_epsilon(nodes->frame[chain].raw[k],
                                           nodes->frame[chain + 6].raw[k], 1e-6);
        }
        vec3s heading = fr_frame_heading(nodes->frame[chain]);
        vec3s tip = nodes->position[chain + 6];
        // Radius 1 and three times 0.5 along the normal.
        for (uint32_t k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(tip.raw[k], 2.5f * heading.raw[k], 1e-5);
        }
    }
    built_free(built);
}

static void parents_first(void) {
    Built built = build("tree A number=4\ntree B number=3\nleaf L\nA = B\nB = L\nA - L");
    for (uint64_t k = 1; k < built.counts.instances; k++) {
        g_assert_cmpuint(built.counts.parent[k], <, k);
    }
    g_assert_cmpuint(built.counts.parent[0], ==, FR_NONE);
    built_free(built);
}

static void child_link_at_tip(void) {
    Built built = build("horn A length=2;curvature=60;segments=6\nhorn B length=1\nA - B");
    const FrPlant *plant = built.plant;
    uint32_t a = built_axis(&built, "A"), b = built_axis(&built, "B");
    g_assert_cmpuint(plant->axes.bearer[b], ==, plant->axes.last[a]);
    g_assert_cmpuint(plant->axes.flags[b] & FR_CONTINUES, !=, 0);
    g_assert_cmpuint(plant->axes.order[b], ==, 0);
    g_assert_cmpfloat(plant->axes.offset[b].z, ==, 0);
    // The child sets out in the direction of the very tip: 60 degrees from the vertical.
    vec3s heading = fr_frame_heading(plant->nodes.frame[plant->axes.first[b]]);
    g_assert_cmpfloat_with_epsilon(acosf(heading.z), G_PI / 3, 1e-5);
    g_assert_cmpfloat_with_epsilon(heading.y, sin(G_PI / 3), 1e-5);
    built_free(built);
    built = build("horn A\nhorn B rotate-x=20\nA - B");
    g_assert_cmpuint(built.plant->axes.flags[1] & FR_CONTINUES, ==, 0);
    built_free(built);
}

static void branch_link(void) {
    Built built = build("tree A number=10\nleaf L\nA = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 10);
    built_free(built);
    built = build("horn A\nleaf L\nA = L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 1);
    built_free(built);
    built = build("tree A number=10\nleaf L\nA - L");
    g_assert_cmpuint(built_count(&built, "L"), ==, 1);
    built_free(built);
}

static void leaf_link_after_recursion(void) {
    Built built = build("phiball C number=3\nhorn D depth=3\nsimple E\nC - D\nD - D\nD . E");
    g_assert_cmpuint(built_count(&built, "E"), ==, 3);
    assert_tree(&built, "C(D(D(D(E))) D(D(D(E))) D(D(D(E))))");
    built_free(built);
}

static void leaf_link_of_every_member(void) {
    // The chain ends in the second D; the leaf links of both members bloom there.
    Built built = build("horn D depth=2\nhorn E depth=1\nleaf L\nsimple S\n"
                        "D - E\nE - D\nD . L\nE . S");
    assert_tree(&built, "D(E(D(L S)))");
    built_free(built);
}

static void leaf_link_outside_recursion(void) {
    Built built = build("horn D\nleaf L\nD . L");
    assert_tree(&built, "D(L)");
    built_free(built);
}

static void mixed_links(void) {
    Built built = build("tree stalk number=4\nleaf leaf\nphiball head number=5\nsimple seed\n"
                        "stalk = leaf\nstalk - head\nhead - seed");
    assert_tree(&built, "stalk(leaf leaf leaf leaf head(seed seed seed seed seed))");
    // The head sits on the last internode, at its tip.
    uint32_t seed = built_organ(&built, "seed");
    g_assert_cmpuint(built.plant->organs.node[seed], ==, built.plant->axes.last[0]);
    built_free(built);
}

static void depth_counts_generations(void) {
    Built built = build("horn D depth=4;recursion-scale=.5;length=1\nD - D");
    const FrNodes *nodes = &built.plant->nodes;
    for (uint32_t k = 0; k < 4; k++) {
        g_assert_cmpfloat_with_epsilon(nodes->length[k], pow(0.5, k), 1e-6);
    }
    built_free(built);
    built = build("horn D depth=4;length== 1 + depth\nD - D");
    for (uint32_t k = 0; k < 4; k++) {
        g_assert_cmpfloat_with_epsilon(built.plant->nodes.length[k], 1 + k, 1e-6);
    }
    built_free(built);
}

static void disabled(void) {
    Built built = build("horn A\nhorn B enabled=no\nleaf L\nA - B\nB - L");
    assert_tree(&built, "A");
    built_free(built);
}

static void several_roots(void) {
    Built built = build("horn A\nhorn B");
    g_assert_cmpuint(built.counts.instances, ==, 2);
    g_assert_cmpuint(built.plant->axes.count, ==, 2);
    built_free(built);
}

static void flags_decide(void) {
    Built built = build("tree A number=20\nleaf L only=!2,13\nhorn T only=2,13\nA = L\nA = T");
    g_assert_cmpuint(built_count(&built, "L"), ==, 18);
    g_assert_cmpuint(built_count(&built, "T"), ==, 2);
    built_free(built);
    static const struct {
        const char *only;
        uint64_t count;
    } cases[] = {{"all", 20},     {"odd", 10}, {"even", 10},        {"first", 1},
                 {"last", 1},     {"0..4", 5}, {"%3=1", 7},         {"!odd", 10},
                 {"2, 13 19", 3}, {"25", 0},   {"!first,last", 18}, {"3..9,5..12", 10},
                 {"", 20}};
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        FrPgraph *graph = graph_read("tree A number=20\nleaf L\nA = L");
        graph_set(graph, "L", "only", cases[k].only);
        built = build_graph(graph, NULL);
        g_assert_cmpuint(built_count(&built, "L"), ==, cases[k].count);
        built_free(built);
    }
}

static void flags_keep_places(void) {
    Built whole = build("tree A number=20;regularity=.3\nleaf L\nA = L");
    Built parts = build("tree A number=20;regularity=.3\nleaf L only=!2,13\nleaf M only=2,13\n"
                        "A = L\nA = M");
    g_assert_cmpuint(parts.plant->organs.count, ==, 20);
    for (uint32_t o = 0; o < 20; o++) {
        vec3s place = whole.plant->organs.offset[o];
        bool is_there = false;
        for (uint32_t p = 0; p < 20; p++) {
            is_there |= memcmp(&parts.plant->organs.offset[p], &place, sizeof place) == 0;
        }
        g_assert_true(is_there);
    }
    built_free(whole);
    built_free(parts);
}

static void flags_reach_further_down(void) {
    // The iteration number is handed on below what the multiplier makes directly.
    Built built = build("phiball P number=4\nhorn H\nleaf L only=1,3\nP - H\nH - L");
    g_assert_cmpuint(built_count(&built, "H"), ==, 4);
    g_assert_cmpuint(built_count(&built, "L"), ==, 2);
    built_free(built);
}

static void material_inherited(void) {
    FrPgraph *graph = graph_read("horn A material=bark\nhorn B\nleaf L material=green\nsimple S\n"
                                 "A - B\nB - L\nL - S");
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    FrMaterial *bark = fr_material_new("bark", &params, ".", (FrSpan){0});
    FrMaterial *green = fr_material_new("green", &params, ".", (FrSpan){0});
    fr_pgraph_add_material(graph, bark);
    fr_pgraph_add_material(graph, green);
    Built built = build_graph(graph, NULL);
    const FrPlant *plant = built.plant;
    g_assert_true(g_ptr_array_index(plant->materials, plant->axes.material[0]) == bark);
    g_assert_true(g_ptr_array_index(plant->materials, plant->axes.material[1]) == bark);
    g_assert_true(g_ptr_array_index(plant->materials, plant->organs.material[0]) == green);
    g_assert_true(g_ptr_array_index(plant->materials, plant->organs.material[1]) == green);
    fr_material_unref(bark);
    fr_material_unref(green);
    fr_params_clear(fr_material_table(), &params);
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("S2 a shared subgraph is made under both parents", shared_subgraph);
    TEST("S4 parents come before their children", parents_first);
    TEST("S5 a multiplier multiplies all that follows", multiplied_tail);
    TEST("S3 S6 figure 2 gives three chains of three", figure2);
    TEST("S7 chains differ by the multiplier's placement only",
         children_frames_differ_by_placement);
    TEST("L1 a child link leads to the tip", child_link_at_tip);
    TEST("L2 a branch link is multiplied by a tree only", branch_link);
    TEST("L3 a leaf link blooms after the recursion", leaf_link_after_recursion);
    TEST("L3 leaf links of every member bloom at the end", leaf_link_of_every_member);
    TEST("L4 a leaf link outside a recursion is a child link", leaf_link_outside_recursion);
    TEST("L5 children by different links", mixed_links);
    TEST("B4 material is inherited until another is named", material_inherited);
    TEST("B5 generations are counted and scaled", depth_counts_generations);
    TEST("J counts of cascades and recursions", instance_counts);
    TEST("X1 flags decide which iterations are made", flags_decide);
    TEST("X2 flagged-out children keep their places", flags_keep_places);
    TEST("X2 flags see the iteration further down", flags_reach_further_down);
    TEST("a disabled component leaves out its subtree", disabled);
    TEST("several roots stand side by side", several_roots);
    return g_test_run();
}
