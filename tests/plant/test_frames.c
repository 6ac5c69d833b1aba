#include "trees.h"

#include <math.h>
#include <string.h>

static void assert_point(vec3s got, float x, float y, float z) {
    g_assert_cmpfloat_with_epsilon(got.x, x, 1e-5f);
    g_assert_cmpfloat_with_epsilon(got.y, y, 1e-5f);
    g_assert_cmpfloat_with_epsilon(got.z, z, 1e-5f);
}

static versors turn(float degrees, float x, float y, float z) {
    return glms_quatv(degrees * (float)G_PI / 180.0f, (vec3s){{x, y, z}});
}

static void a_straight_stem(void) {
    FrPlant *plant = fr_plant_new("stem");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{1, 2, 3}}, 0.1f);
    for (int i = 0; i < 10; i++) {
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 0.1f, 0.1f);
    }
    assert_point(plant->nodes.position[9], 1, 2, 4);
    assert_point(fr_plant_axis_origin(plant, axis), 1, 2, 3);
    fr_plant_free(plant);
}

static void a_bent_branch(void) {
    // Up 1 m, then a branch that starts half a metre below the tip on the x side, turned by 90°
    // about y: its z axis points along +x, so one metre on it is at x = 1.1.
    FrPlant *plant = fr_plant_new("branch");
    uint32_t stem = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.1f);
    uint32_t bearer = fr_plant_add_node(plant, stem, GLMS_QUAT_IDENTITY, 1.0f, 0.1f);
    uint32_t branch = fr_plant_add_axis(plant, bearer, (vec3s){{0.1f, 0, -0.5f}}, 0.1f);
    fr_plant_add_node(plant, branch, turn(90, 0, 1, 0), 1.0f, 0.1f);
    // Again by 90° about the local y: now downwards.
    fr_plant_add_node(plant, branch, turn(90, 0, 1, 0), 0.25f, 0.1f);
    assert_point(fr_plant_axis_origin(plant, branch), 0.1f, 0, 0.5f);
    assert_point(plant->nodes.position[1], 1.1f, 0, 0.5f);
    assert_point(plant->nodes.position[2], 1.1f, 0, 0.25f);
    g_assert_cmpuint(plant->axes.order[branch], ==, 1);

    // A leaf on it, a tenth along the branch's left side, with the branch's own frame.
    uint32_t leaf = fr_plant_append_organs(plant, 1);
    plant->organs.node[leaf] = 1;
    plant->organs.offset[leaf] = (vec3s){{0.1f, 0, 0}};
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(plant, leaf, &position, &rotation);
    assert_point(position, 1.1f, 0, 0.4f); // local x was turned downwards
    assert_point(glms_quat_rotatev(rotation, (vec3s){{0, 0, 1}}), 1, 0, 0);
    fr_plant_free(plant);
}

/// A random plant of some hundred axes, positions and all, against cglm's own quaternions.
static void random_plant_against_cglm(void) {
    FrPlant *plant = fr_plant_new("random");
    GRand *rand = g_rand_new_with_seed(7);
    for (uint32_t a = 0; a < 200; a++) {
        uint32_t bearer =
            a == 0 ? FR_NONE : (uint32_t)g_rand_int_range(rand, 0, (gint32)plant->nodes.count);
        vec3s offset = {{(float)g_rand_double(rand), (float)g_rand_double(rand), 0.5f}};
        uint32_t axis = fr_plant_add_axis(plant, bearer, offset, 0.1f);
        for (uint32_t i = 0; i < 1 + a * a % 23; i++) {
            versors rotation = turn((float)g_rand_double_range(rand, -90, 90),
                                    (float)g_rand_double(rand), (float)g_rand_double(rand), 1);
            fr_plant_add_node(plant, axis, rotation, (float)g_rand_double(rand), 0.1f);
        }
    }
    g_rand_free(rand);
    const FrNodes *nodes = &plant->nodes;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        versors frame = parent == FR_NONE ? GLMS_QUAT_IDENTITY : nodes->frame[parent];
        vec3s start = parent == FR_NONE ? (vec3s){{0, 0, 0}} : nodes->position[parent];
        if (plant->axes.first[nodes->axis[i]] == i) {
            start =
                glms_vec3_add(start, glms_quat_rotatev(frame, plant->axes.offset[nodes->axis[i]]));
        }
        frame = glms_quat_mul(frame, nodes->rotation[i]);
        vec3s tip =
            glms_vec3_add(start, glms_quat_rotatev(frame, (vec3s){{0, 0, nodes->length[i]}}));
        g_assert_cmpfloat(glms_vec3_distance(tip, nodes->position[i]), <, 1e-5f);
    }
    // The pass over all, and from the middle, gives the bits the builder gave.
    FrPlant *copy = fr_plant_copy(plant);
    for (uint32_t i = 500; i < nodes->count; i++) {
        copy->nodes.position[i] = (vec3s){{9, 9, 9}};
        copy->nodes.frame[i] = GLMS_QUAT_IDENTITY;
    }
    fr_plant_update_frames(copy, 500);
    g_assert_true(memcmp(nodes->position, copy->nodes.position, nodes->count * sizeof(vec3s)) == 0);
    g_assert_true(memcmp(nodes->frame, copy->nodes.frame, nodes->count * sizeof(versors)) == 0);
    fr_plant_free(copy);
    fr_plant_free(plant);
}

static void frames_stay_unit(void) {
    FrPlant *plant = fr_plant_new("long");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.1f);
    uint32_t first = fr_plant_append_nodes(plant, 100000);
    versors rotation = turn(7, 0.6f, 0.8f, 0);
    for (uint32_t i = first; i < plant->nodes.count; i++) {
        plant->nodes.parent[i] = i == first ? FR_NONE : i - 1;
        plant->nodes.axis[i] = axis;
        plant->nodes.rotation[i] = rotation;
    }
    fr_plant_update_frames(plant, 0);
    float norm = glms_quat_norm(plant->nodes.frame[99999]);
    g_assert_cmpfloat_with_epsilon(norm, 1.0f, 1e-6f);
    fr_plant_free(plant);
}

static void bounds(void) {
    FrPlant *plant = fr_plant_new("bounds");
    vec3s min, max;
    fr_plant_bounds(plant, &min, &max);
    g_assert_cmpfloat(min.x, >, max.x);

    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{-1, 0, 0}}, 0.1f);
    fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 2, 0.1f);
    uint32_t leaf = fr_plant_append_organs(plant, 2);
    plant->organs.node[leaf] = 0;
    plant->organs.offset[leaf] = (vec3s){{0, 5, 0}};
    plant->organs.flags[leaf + 1] = FR_HIDDEN;
    plant->organs.offset[leaf + 1] = (vec3s){{0, 50, 0}};
    fr_plant_bounds(plant, &min, &max);
    assert_point(min, -1, 0, 0);
    assert_point(max, -1, 5, 2);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/plant/frames/ten internodes of ten centimetres reach a metre",
                    a_straight_stem);
    g_test_add_func("/plant/frames/a branch and a leaf stand where the drawing says",
                    a_bent_branch);
    g_test_add_func(
        "/plant/frames/a random plant agrees with cglm, builder and pass with each other",
        random_plant_against_cglm);
    g_test_add_func("/plant/frames/a hundred thousand joints leave the frame a rotation",
                    frames_stay_unit);
    g_test_add_func("/plant/frames/bounds hold tips, origins and organs but nothing hidden",
                    bounds);
    return g_test_run();
}
