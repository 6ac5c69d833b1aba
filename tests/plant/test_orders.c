#include "trees.h"

#include <math.h>

#define NONE FR_NONE

static void assert_order(const uint32_t *got, const uint32_t *wanted, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        if (got[i] != wanted[i]) {
            g_test_message("node %u has order %u, not %u", i, got[i], wanted[i]);
            g_test_fail();
        }
    }
}

static void strahler_of_perfect_trees(void) {
    for (uint32_t levels = 1; levels <= 12; levels++) {
        FrPlant *plant = tree_perfect(levels);
        uint32_t *order = g_new(uint32_t, plant->nodes.count);
        fr_plant_strahler(plant, order);
        g_assert_cmpuint(order[0], ==, levels);
        g_assert_cmpuint(order[plant->nodes.count - 1], ==, 1);
        g_free(order);
        fr_plant_free(plant);
    }
}

// A river drawn by hand, from its mouth (0) up; orders beside the reaches:
//
//       4(1) 5(1)  8(1) 9(1)
//         \  /       \  /
//   3(1)  2(2)       7(2)     11(1)
//      \   |          |        |
//       \  |         6(2)     10(1)
//        \ |          |       /
//          1(2)-------+      /
//                 \   |     /
//                   0 (3)--+
//
// Equal 2s meet at the mouth and make 3; the 1s that join at 1 and 0 change nothing.
static void strahler_of_a_river(void) {
    static const uint32_t parent[] = {NONE, 0, 1, 1, 2, 2, 0, 6, 7, 7, 0, 10};
    static const uint32_t wanted[] = {3, 2, 2, 1, 1, 1, 2, 2, 1, 1, 1, 1};
    FrPlant *plant = tree_from_parents(parent, G_N_ELEMENTS(parent));
    uint32_t order[G_N_ELEMENTS(parent)];
    fr_plant_strahler(plant, order);
    assert_order(order, wanted, G_N_ELEMENTS(parent));
    fr_plant_free(plant);
}

static void strahler_of_a_herringbone(void) {
    // A stem with any number of single twigs has order 2: only the topmost fork counts.
    enum { PAIRS = 500 };
    uint32_t parent[2 * PAIRS + 2] = {NONE};
    for (uint32_t i = 0; i < PAIRS; i++) {
        parent[2 * i + 1] = 2 * i;
        parent[2 * i + 2] = 2 * i;
    }
    FrPlant *plant = tree_from_parents(parent, 2 * PAIRS + 1);
    uint32_t order[2 * PAIRS + 1];
    fr_plant_strahler(plant, order);
    g_assert_cmpuint(order[0], ==, 2);
    fr_plant_free(plant);
}

static void strahler_of_three_equal_children(void) {
    static const uint32_t parent[] = {NONE, 0, 0, 0};
    static const uint32_t wanted[] = {2, 1, 1, 1};
    FrPlant *plant = tree_from_parents(parent, 4);
    uint32_t order[4];
    fr_plant_strahler(plant, order);
    assert_order(order, wanted, 4);
    fr_plant_free(plant);
}

static void weibel_of_the_river(void) {
    static const uint32_t parent[] = {NONE, 0, 1, 1, 2, 2, 0, 6, 7, 7, 0, 10};
    static const uint32_t wanted[] = {0, 1, 2, 2, 3, 3, 1, 1, 2, 2, 1, 1};
    FrPlant *plant = tree_from_parents(parent, G_N_ELEMENTS(parent));
    uint32_t order[G_N_ELEMENTS(parent)];
    fr_plant_weibel(plant, order);
    assert_order(order, wanted, G_N_ELEMENTS(parent));
    fr_plant_free(plant);
}

static void weibel_of_a_perfect_tree(void) {
    FrPlant *plant = tree_perfect(8);
    uint32_t *order = g_new(uint32_t, plant->nodes.count);
    fr_plant_weibel(plant, order);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        g_assert_cmpuint(order[i], ==, (uint32_t)floor(log2(i + 1)));
    }
    g_free(order);
    fr_plant_free(plant);
}

static void botanical(void) {
    static const uint32_t parent[] = {NONE, 0, 0, 2, 2, 1};
    static const uint32_t wanted[] = {0, 0, 1, 1, 2, 0};
    FrPlant *plant = tree_from_parents(parent, 6);
    uint32_t order[6];
    fr_plant_botanical(plant, order);
    assert_order(order, wanted, 6);
    fr_plant_free(plant);
}

static void pipes_conserve_area(void) {
    static const double exponents[] = {1.0, 2.0, 2.49, 3.0, 4.0};
    static const uint32_t parent[] = {NONE, 0, 1, 1, 2, 2, 0, 6, 7, 7, 0, 10, 11, 11, 11};
    FrPlant *plant = tree_from_parents(parent, G_N_ELEMENTS(parent));
    const FrNodes *nodes = &plant->nodes;
    for (size_t e = 0; e < G_N_ELEMENTS(exponents); e++) {
        fr_plant_pipe_radii(plant, exponents[e], 0.002);
        double borne[G_N_ELEMENTS(parent)] = {0};
        for (uint32_t i = nodes->count; i-- > 0;) {
            double bundle = pow((double)nodes->radius[i], exponents[e]);
            double wanted = borne[i] > 0.0 ? borne[i] : pow(0.002, exponents[e]);
            g_assert_cmpfloat(fabs(bundle / wanted - 1.0), <, 1e-5);
            if (i > 0) {
                borne[parent[i]] += bundle;
            }
        }
    }
    fr_plant_free(plant);
}

static void pipes_of_a_perfect_tree(void) {
    // 1024 tips: by da Vinci's rule the stem is √1024 = 32 times as thick as a tip.
    FrPlant *plant = tree_perfect(11);
    fr_plant_pipe_radii(plant, 2.0, 0.001);
    g_assert_cmpfloat_with_epsilon(plant->nodes.radius[0], 0.032f, 1e-8f);
    g_assert_cmpfloat_with_epsilon(plant->axes.base_radius[0], 0.032f, 1e-8f);
    g_assert_cmpfloat_with_epsilon(plant->nodes.radius[2046], 0.001f, 1e-9f);
    // By Murray's law ∛1024.
    fr_plant_pipe_radii(plant, 3.0, 0.001);
    g_assert_cmpfloat_with_epsilon((double)plant->nodes.radius[0], 0.001 * cbrt(1024.0), 1e-8);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/plant/orders/a perfect binary tree of n levels has Strahler number n",
                    strahler_of_perfect_trees);
    g_test_add_func("/plant/orders/Strahler numbers of a river drawn by hand", strahler_of_a_river);
    g_test_add_func("/plant/orders/single twigs never raise the Strahler number",
                    strahler_of_a_herringbone);
    g_test_add_func("/plant/orders/three equal children raise the Strahler number by one",
                    strahler_of_three_equal_children);
    g_test_add_func("/plant/orders/Weibel generations of a river drawn by hand",
                    weibel_of_the_river);
    g_test_add_func("/plant/orders/Weibel generations of a perfect tree are its levels",
                    weibel_of_a_perfect_tree);
    g_test_add_func("/plant/orders/botanical order is that of the axis", botanical);
    g_test_add_func("/plant/pipes/every fork conserves the cross-section", pipes_conserve_area);
    g_test_add_func("/plant/pipes/a stem of 1024 tips is 32 tips thick", pipes_of_a_perfect_tree);
    return g_test_run();
}
