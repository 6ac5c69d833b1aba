#include "trees.h"

#include <cglm/struct.h>

/// A stem of one internode of 2 m that bears a branch and organs along it.
static FrPlant *pole(void) {
    FrPlant *plant = fr_plant_new("pole");
    uint32_t stem = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0.5f, 0, 0}}, 0.4f);
    versors lean = fr_rotation_about((vec3s){{0, 1, 0}}, 0.3f);
    uint32_t node = fr_plant_add_node(plant, stem, lean, 2, 0.2f);
    uint32_t branch = fr_plant_add_axis(plant, node, (vec3s){{0.1f, 0, -0.9f}}, 0.05f);
    fr_plant_add_node(plant, branch, fr_rotation_about((vec3s){{1, 0, 0}}, 1), 1, 0.01f);
    FrShape box = {.kind = FR_SHAPE_BOX, .size = {{1, 1, 1}}, .detail = 4};
    fr_plant_append_organs(plant, 5);
    for (uint32_t i = 0; i < 5; i++) {
        plant->organs.node[i] = node;
        plant->organs.offset[i] = (vec3s){{0.2f, 0, -0.5f * (float)i + 0.01f}};
        plant->organs.shape[i] = fr_plant_add_shape(plant, &box);
    }
    fr_plant_update_frames(plant, 0);
    return plant;
}

static void places(void) {
    FrPlant *plant = pole();
    static const uint16_t joints[] = {4, 0};
    g_assert_cmpuint(fr_plant_refined_nodes(plant, joints), ==, 5);
    FrPlant *fine = fr_plant_refined(plant, joints);
    assert_valid(fine);
    g_assert_cmpuint(fine->nodes.count, ==, 5);
    for (uint32_t a = 0; a < 2; a++) {
        vec3s here = fr_plant_axis_origin(plant, a), there = fr_plant_axis_origin(fine, a);
        g_assert_cmpfloat(glms_vec3_distance(here, there), <, 1e-6f);
        here = plant->nodes.position[plant->axes.last[a]];
        there = fine->nodes.position[fine->axes.last[a]];
        g_assert_cmpfloat(glms_vec3_distance(here, there), <, 1e-6f);
    }
    for (uint32_t o = 0; o < plant->organs.count; o++) {
        vec3s here, there;
        versors turn, same;
        fr_plant_organ_pose(plant, o, &here, &turn);
        fr_plant_organ_pose(fine, o, &there, &same);
        g_assert_cmpfloat(glms_vec3_distance(here, there), <, 1e-6f);
        g_assert_cmpfloat(fabsf(glms_quat_dot(turn, same)), >, 1 - 1e-6f);
        // Beside the piece it stands on: 2 m in four pieces, the last of them node 3.
        static const uint32_t piece[] = {3, 3, 2, 1, 0};
        g_assert_cmpuint(fine->organs.node[o], ==, piece[o]);
    }
    // From 0.4 m at the foot to 0.2 m at the tip.
    static const float radius[] = {0.35f, 0.3f, 0.25f, 0.2f};
    for (uint32_t i = 0; i < 4; i++) {
        g_assert_cmpfloat_with_epsilon(fine->nodes.radius[i], radius[i], 1e-6f);
    }
    fr_plant_free(fine);
    fr_plant_free(plant);
}

static void enough(void) {
    FrPlant *plant = pole();
    static const uint16_t joints[] = {1, 0};
    FrPlant *same = fr_plant_refined(plant, joints);
    g_assert_cmpuint(fr_plant_digest(same), ==, fr_plant_digest(plant));
    fr_plant_free(same);
    plant->axes.flags[0] |= FR_POINT_SETS;
    static const uint16_t more[] = {9, 0};
    same = fr_plant_refined(plant, more);
    g_assert_cmpuint(fr_plant_digest(same), ==, fr_plant_digest(plant));
    fr_plant_free(same);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/plant/refine/nothing changes its place", places);
    g_test_add_func("/plant/refine/what has joints enough, or rings of its own, stays", enough);
    return g_test_run();
}
