/// @file trees.h
/// Plants for tests, given as the list of every internode's parent.
#pragma once

#include "frond/plant.h"

#include <cglm/struct.h>

/// A plant whose node i grows from parent[i] < i. The first child of a node goes on along its axis,
/// further ones begin axes of their own.
static inline FrPlant *tree_from_parents(const uint32_t *parent, uint32_t count) {
    FrPlant *plant = fr_plant_new("tree");
    for (uint32_t i = 0; i < count; i++) {
        uint32_t axis = FR_NONE;
        if (parent[i] != FR_NONE && plant->nodes.next[parent[i]] == FR_NONE) {
            axis = plant->nodes.axis[parent[i]];
        } else {
            axis = fr_plant_add_axis(plant, parent[i], (vec3s){{0, 0, 0}}, 0.1f);
        }
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 1.0f, 0.1f);
    }
    return plant;
}

/// The perfect binary tree of `levels` levels: node i has children 2i + 1 and 2i + 2.
static inline FrPlant *tree_perfect(uint32_t levels) {
    uint32_t count = (1u << levels) - 1;
    uint32_t *parent = g_new(uint32_t, count);
    for (uint32_t i = 0; i < count; i++) {
        parent[i] = i == 0 ? FR_NONE : (i - 1) / 2;
    }
    FrPlant *plant = tree_from_parents(parent, count);
    g_free(parent);
    return plant;
}

static inline void assert_valid(const FrPlant *plant) {
    char *why = NULL;
    if (!fr_plant_is_valid(plant, &why)) {
        g_test_message("%s", why);
        g_test_fail();
    }
    g_free(why);
}
