/// @file plants.h
/// Plants for the tests of variation.
#pragma once

#include "frond/variation.h"

#include <cglm/struct.h>

static inline FrVaryParams vary_params(void) {
    FrVaryParams params;
    fr_params_init(fr_vary_table(), &params);
    return params;
}

/// Adds `count` internodes, the first turned away from the bearer by `angle` about its x axis.
static inline uint32_t add_branch(FrPlant *plant, uint32_t bearer, float angle, uint32_t count,
                                  float length) {
    uint32_t axis = fr_plant_add_axis(plant, bearer, (vec3s){{0, 0, 0}}, 0.02f);
    plant->axes.path[axis] = fr_key_child(fr_key_root(9), axis);
    for (uint32_t i = 0; i < count; i++) {
        versors turn = i == 0 ? fr_rotation_about((vec3s){{1, 0, 0}}, angle) : GLMS_QUAT_IDENTITY;
        fr_plant_add_node(plant, axis, turn, length / (float)count, 0.02f);
    }
    return axis;
}

/// A tree of three orders, 4 m high: a stem of 64 joints, limbs all around, a twig on each.
static inline FrPlant *small_tree(void) {
    FrPlant *plant = fr_plant_new("tree");
    uint32_t stem = fr_plant_add_component(plant, "stem", (FrSpan){0});
    uint32_t limb = fr_plant_add_component(plant, "limb", (FrSpan){0});
    uint32_t twig = fr_plant_add_component(plant, "twig", (FrSpan){0});
    uint32_t axis = add_branch(plant, FR_NONE, 0, 64, 4);
    plant->axes.component[axis] = stem;
    for (uint32_t k = 0; k < 10; k++) {
        // Around the stem: the roll comes before the turn away from it.
        uint32_t branch = add_branch(plant, 20 + 4 * k, 0, 16, 1.2f);
        versors roll = fr_rotation_about((vec3s){{0, 0, 1}}, 2.4f * (float)k);
        versors away = fr_rotation_about((vec3s){{1, 0, 0}}, 1.0f);
        uint32_t first = plant->axes.first[branch];
        plant->nodes.rotation[first] = fr_frame_step(roll, away);
        plant->axes.component[branch] = limb;
        uint32_t small = add_branch(plant, first + 8, 0.8f, 8, 0.4f);
        plant->axes.component[small] = twig;
    }
    fr_plant_update_frames(plant, 0);
    return plant;
}

static inline void assert_sound(const FrPlant *plant) {
    char *why = NULL;
    if (!fr_plant_is_valid(plant, &why)) {
        g_test_message("%s", why);
        g_test_fail();
    }
    g_free(why);
}
