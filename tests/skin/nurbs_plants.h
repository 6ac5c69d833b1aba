/// @file nurbs_plants.h
/// Plants for tests of rational skins.
#pragma once

#include "frond/nurbs_skin.h"

#include <cglm/struct.h>

static inline FrNurbsSkin *skinned(const FrPlant *plant, const FrNurbsParams *params) {
    FrContext context = fr_context_default();
    FrNurbsSkin *skin;
    g_assert_cmpint(fr_nurbs_plant(plant, params, &context, &skin), ==, FR_OK);
    for (uint64_t i = 0; i < skin->count; i++) {
        g_assert_true(fr_nurbs_surface_is_valid(&skin->pieces[i].surface));
    }
    return skin;
}

static inline versors about_x(float degrees) {
    return glms_quatv(degrees * (float)G_PI / 180, (vec3s){{1, 0, 0}});
}

/// A straight stem of four internodes, 0.1 m thick.
static inline FrPlant *stem(void) {
    FrPlant *plant = fr_plant_new("stem");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.0625F);
    for (int i = 0; i < 4; i++) {
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 0.5F, 0.0625F);
    }
    return plant;
}

/// A stem of four internodes with a branch of three at its third node, to the side.
static inline FrPlant *forked(void) {
    FrPlant *plant = fr_plant_new("fork");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.05F);
    for (int i = 0; i < 5; i++) {
        fr_plant_add_node(plant, axis, about_x(6), 0.4F, 0.05F);
    }
    uint32_t branch = fr_plant_add_axis(plant, 2, (vec3s){{0, 0, 0}}, 0.02F);
    fr_plant_add_node(plant, branch, about_x(-50), 0.3F, 0.02F);
    fr_plant_add_node(plant, branch, about_x(10), 0.3F, 0.015F);
    fr_plant_add_node(plant, branch, about_x(10), 0.3F, 0.01F);
    return plant;
}

/// An S: bends one way, then the other, in one plane.
static inline FrPlant *letter_s(void) {
    FrPlant *plant = fr_plant_new("S");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.02F);
    for (int i = 0; i < 12; i++) {
        fr_plant_add_node(plant, axis, about_x(i < 6 ? 12 : -12), 0.2F, 0.02F);
    }
    return plant;
}

static inline FrShape leaf_shape(void) {
    return (FrShape){
        .kind = FR_SHAPE_BLADE,
        .blade = {.length = 0.1F,
                  .width = 0.05F,
                  .petiole_length = 0.03F,
                  .petiole_radius = 0.001F,
                  .petiole_bend = 0.3F,
                  .curvature_along = -0.5F,
                  .fold = 0.3F,
                  .outline = FR_NONE,
                  .along_curve = FR_NONE,
                  .across_curve = FR_NONE,
                  .segments_along = 6,
                  .segments_across = 2},
    };
}

static inline FrPlant *with_organ(const FrShape *shape) {
    FrPlant *plant = fr_plant_new("organ");
    uint32_t organ = fr_plant_append_organs(plant, 1);
    plant->organs.shape[organ] = fr_plant_add_shape(plant, shape);
    return plant;
}

/// Many forks with leaves.
static inline FrPlant *bush(void) {
    FrPlant *plant = fr_plant_new("bush");
    FrShape shape = leaf_shape();
    uint32_t form = fr_plant_add_shape(plant, &shape);
    for (int stem = 0; stem < 300; stem++) {
        uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{(float)stem, 0, 0}}, 0.05F);
        uint32_t node = 0;
        for (int i = 0; i < 2 + stem % 7; i++) {
            node = fr_plant_add_node(plant, axis, about_x((float)(stem % 13)), 0.3F, 0.04F);
        }
        axis = fr_plant_add_axis(plant, node, (vec3s){{0, 0, 0}}, 0.02F);
        fr_plant_add_node(plant, axis, about_x(40), 0.2F, 0.01F);
        uint32_t organ = fr_plant_append_organs(plant, 1);
        plant->organs.node[organ] = node;
        plant->organs.shape[organ] = form;
    }
    return plant;
}
