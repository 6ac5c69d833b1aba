#include "trees.h"

#include <string.h>

#define NONE FR_NONE

/// Node i has length i + 1, so that survivors are recognized.
static FrPlant *numbered(const uint32_t *parent, uint32_t count) {
    FrPlant *plant = tree_from_parents(parent, count);
    for (uint32_t i = 0; i < count; i++) {
        plant->nodes.length[i] = (float)(i + 1);
    }
    fr_plant_append_organs(plant, count);
    fr_plant_append_buds(plant, count);
    FrShape box = {.kind = FR_SHAPE_BOX, .size = {{1, 1, 1}}, .detail = 4};
    for (uint32_t i = 0; i < count; i++) {
        plant->organs.node[i] = i;
        plant->organs.shape[i] = fr_plant_add_shape(plant, &box);
        plant->organs.scale[i] = (float)(i + 1);
        plant->buds.node[i] = i;
        plant->buds.id[i] = i + 1;
    }
    fr_plant_update_frames(plant, 0);
    return plant;
}

static void assert_left(const FrPlant *plant, const uint32_t *left, uint32_t count) {
    assert_valid(plant);
    g_assert_cmpuint(plant->nodes.count, ==, count);
    g_assert_cmpuint(plant->organs.count, ==, count);
    g_assert_cmpuint(plant->buds.count, ==, count);
    for (uint32_t i = 0; i < count; i++) {
        g_assert_cmpfloat(plant->nodes.length[i], ==, (float)(left[i] + 1));
        g_assert_cmpfloat(plant->organs.scale[i], ==, (float)(left[i] + 1));
        g_assert_cmpuint(plant->organs.node[i], ==, i);
        g_assert_cmpuint(plant->buds.id[i], ==, left[i] + 1);
        g_assert_cmpuint(plant->buds.node[i], ==, i);
    }
}

//  0 ─ 1 ─ 2 ─ 3        axis 0
//      │   └ 6 ─ 7      axis 2
//      └ 4 ─ 5          axis 1
//            └ 8 …      5's second child would be an axis; 8 goes on along axis 1
static const uint32_t parents[] = {NONE, 0, 1, 2, 1, 4, 2, 6, 5};

static void nothing_shed(void) {
    static const uint32_t left[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    FrPlant *plant = numbered(parents, 9);
    FrDigest before = fr_plant_digest(plant);
    fr_plant_compact(plant);
    assert_left(plant, left, 9);
    g_assert_cmpuint(fr_plant_digest(plant), ==, before);
    fr_plant_free(plant);
}

static void a_node_takes_what_it_bears(void) {
    static const uint32_t left[] = {0, 1, 4, 5, 8};
    FrPlant *plant = numbered(parents, 9);
    plant->nodes.flags[2] = FR_SHED;
    vec3s tip = plant->nodes.position[8];
    fr_plant_compact(plant);
    assert_left(plant, left, 5);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    g_assert_cmpuint(plant->axes.last[0], ==, 1);
    g_assert_cmpuint(plant->nodes.next[1], ==, FR_NONE);
    g_assert_cmpuint(plant->axes.first[1], ==, 2);
    g_assert_cmpuint(plant->axes.last[1], ==, 4);
    // The cache moves along, and is what the pass would make.
    g_assert_true(memcmp(&tip, &plant->nodes.position[4], sizeof tip) == 0);
    fr_plant_free(plant);
}

static void an_axis_takes_what_it_bears(void) {
    static const uint32_t left[] = {0, 1, 2, 3, 6, 7};
    FrPlant *plant = numbered(parents, 9);
    plant->axes.flags[1] = FR_SHED;
    fr_plant_compact(plant);
    assert_left(plant, left, 6);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    fr_plant_free(plant);
}

static void organs_alone(void) {
    FrPlant *plant = numbered(parents, 9);
    plant->organs.flags[3] = FR_SHED;
    plant->organs.node[5] = FR_NONE; // stands on the ground
    plant->nodes.flags[5] = FR_SHED;
    fr_plant_compact(plant);
    assert_valid(plant);
    g_assert_cmpuint(plant->nodes.count, ==, 7);
    g_assert_cmpuint(plant->organs.count, ==, 7); // without 3 and 8, but with 5
    g_assert_cmpfloat(plant->organs.scale[3], ==, 5);
    g_assert_cmpfloat(plant->organs.scale[4], ==, 6);
    fr_plant_free(plant);
}

static void everything(void) {
    FrPlant *plant = numbered(parents, 9);
    plant->nodes.flags[0] = FR_SHED;
    fr_plant_compact(plant);
    assert_valid(plant);
    g_assert_cmpuint(plant->nodes.count + plant->axes.count + plant->organs.count, ==, 0);
    fr_plant_compact(plant);
    fr_plant_free(plant);
}

static void an_empty_axis_stays(void) {
    FrPlant *plant = numbered(parents, 9);
    fr_plant_add_axis(plant, 3, (vec3s){{0, 0, 0}}, 0.1f);
    plant->nodes.flags[5] = FR_SHED;
    fr_plant_compact(plant);
    assert_valid(plant);
    g_assert_cmpuint(plant->axes.count, ==, 4);
    g_assert_cmpuint(plant->axes.first[3], ==, FR_NONE);
    g_assert_cmpuint(plant->axes.bearer[3], ==, 3);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/plant/compact/nothing shed, nothing changed", nothing_shed);
    g_test_add_func("/plant/compact/a shed internode takes the rest of its axis and its branches",
                    a_node_takes_what_it_bears);
    g_test_add_func("/plant/compact/a shed axis goes whole and the order of the rest is kept",
                    an_axis_takes_what_it_bears);
    g_test_add_func("/plant/compact/organs go alone or with their node", organs_alone);
    g_test_add_func("/plant/compact/shedding the base leaves nothing", everything);
    g_test_add_func("/plant/compact/an axis yet without internodes stays", an_empty_axis_stays);
    return g_test_run();
}
