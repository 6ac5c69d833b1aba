// Making, copying and growing a plant.
#include "frond/plant.h"

#include "plant/columns.h"
#include "plant/frames.h"
#include "plant/shapes.h"

#include <string.h>

static void profile_clear(gpointer data) {
    g_free(((FrProfile *)data)->points);
}

static void component_clear(gpointer data) {
    FrComponent *component = data;
    g_free(component->id);
    if (component->span.source != NULL) {
        fr_source_unref(component->span.source);
    }
}

static void deformation_clear(gpointer data) {
    FrDeformation *deformation = data;
    for (int axis = 0; axis < 3; axis++) {
        fr_expr_unref(deformation->map[axis]);
    }
}

static void material_unref(gpointer material) {
    fr_material_unref(material);
}

static void file_unref(gpointer file) {
    fr_mesh_file_unref(file);
}

FrPlant *fr_plant_new(const char *name) {
    FrPlant *plant = g_new0(FrPlant, 1);
    plant->name = g_strdup(name != NULL ? name : "");
    plant->shapes = g_array_new(FALSE, FALSE, sizeof(FrShape));
    plant->profiles = g_array_new(FALSE, FALSE, sizeof(FrProfile));
    g_array_set_clear_func(plant->profiles, profile_clear);
    plant->finishes = g_array_new(FALSE, FALSE, sizeof(FrFinish));
    plant->materials = g_ptr_array_new_with_free_func(material_unref);
    plant->files = g_ptr_array_new_with_free_func(file_unref);
    plant->deformers = g_array_new(FALSE, FALSE, sizeof(FrDeformer));
    plant->deformations = g_array_new(FALSE, FALSE, sizeof(FrDeformation));
    g_array_set_clear_func(plant->deformations, deformation_clear);
    plant->components = g_array_new(FALSE, FALSE, sizeof(FrComponent));
    g_array_set_clear_func(plant->components, component_clear);
    plant->shape_index = fr_shape_index_new();
    plant->profile_index = fr_profile_index_new();
    return plant;
}

void fr_plant_free(FrPlant *plant) {
    if (plant == NULL) {
        return;
    }
    g_free(plant->name);
    fr_columns_free(&plant->nodes, &fr_node_columns);
    fr_columns_free(&plant->axes, &fr_axis_columns);
    fr_columns_free(&plant->organs, &fr_organ_columns);
    fr_columns_free(&plant->buds, &fr_bud_columns);
    g_array_unref(plant->shapes);
    g_array_unref(plant->profiles);
    g_array_unref(plant->finishes);
    g_ptr_array_unref(plant->materials);
    g_ptr_array_unref(plant->files);
    g_array_unref(plant->deformers);
    g_array_unref(plant->deformations);
    g_array_unref(plant->components);
    g_hash_table_unref(plant->shape_index);
    g_hash_table_unref(plant->profile_index);
    g_free(plant);
}

FrPlant *fr_plant_copy(const FrPlant *plant) {
    FrPlant *copy = fr_plant_new(plant->name);
    fr_columns_copy(&copy->nodes, &plant->nodes, &fr_node_columns);
    fr_columns_copy(&copy->axes, &plant->axes, &fr_axis_columns);
    fr_columns_copy(&copy->organs, &plant->organs, &fr_organ_columns);
    fr_columns_copy(&copy->buds, &plant->buds, &fr_bud_columns);
    // Equal entries are already shared, so each gets the index it had.
    for (guint i = 0; i < plant->shapes->len; i++) {
        fr_plant_add_shape(copy, &g_array_index(plant->shapes, FrShape, i));
    }
    for (guint i = 0; i < plant->profiles->len; i++) {
        const FrProfile *profile = &g_array_index(plant->profiles, FrProfile, i);
        fr_plant_add_profile(copy, (const double(*)[2])profile->points, profile->count,
                             profile->is_closed);
    }
    g_array_append_vals(copy->finishes, plant->finishes->data, plant->finishes->len);
    for (guint i = 0; i < plant->materials->len; i++) {
        fr_plant_add_material(copy, g_ptr_array_index(plant->materials, i));
    }
    for (guint i = 0; i < plant->files->len; i++) {
        fr_plant_add_file(copy, g_ptr_array_index(plant->files, i));
    }
    g_array_append_vals(copy->deformers, plant->deformers->data, plant->deformers->len);
    for (guint i = 0; i < plant->deformations->len; i++) {
        fr_plant_add_deformation(copy, &g_array_index(plant->deformations, FrDeformation, i));
    }
    for (guint i = 0; i < plant->components->len; i++) {
        const FrComponent *component = &g_array_index(plant->components, FrComponent, i);
        fr_plant_add_component(copy, component->id, component->span);
    }
    return copy;
}

uint32_t fr_plant_append_nodes(FrPlant *plant, uint32_t count) {
    return fr_columns_append(&plant->nodes, &fr_node_columns, count);
}

void fr_plant_reserve(FrPlant *plant, uint32_t nodes, uint32_t axes) {
    fr_columns_reserve(&plant->nodes, &fr_node_columns, nodes);
    fr_columns_reserve(&plant->axes, &fr_axis_columns, axes);
}

uint32_t fr_plant_append_axes(FrPlant *plant, uint32_t count) {
    return fr_columns_append(&plant->axes, &fr_axis_columns, count);
}

uint32_t fr_plant_append_organs(FrPlant *plant, uint32_t count) {
    return fr_columns_append(&plant->organs, &fr_organ_columns, count);
}

uint32_t fr_plant_append_buds(FrPlant *plant, uint32_t count) {
    return fr_columns_append(&plant->buds, &fr_bud_columns, count);
}

uint32_t fr_plant_add_node(FrPlant *plant, uint32_t axis, versors rotation, float length,
                           float radius) {
    FR_ASSERT(axis < plant->axes.count);
    uint32_t node = fr_plant_append_nodes(plant, 1);
    FrNodes *nodes = &plant->nodes;
    FrAxes *axes = &plant->axes;
    uint32_t last = axes->last[axis];
    if (last == FR_NONE) {
        axes->first[axis] = node;
        nodes->parent[node] = axes->bearer[axis];
    } else {
        nodes->next[last] = node;
        nodes->parent[node] = last;
    }
    axes->last[axis] = node;
    nodes->axis[node] = axis;
    nodes->rotation[node] = rotation;
    nodes->length[node] = length;
    nodes->radius[node] = radius;
    fr_update_frame(nodes, axes, node);
    return node;
}

uint32_t fr_plant_add_axis(FrPlant *plant, uint32_t bearer, vec3s offset, float base_radius) {
    FR_ASSERT(bearer == FR_NONE || bearer < plant->nodes.count);
    uint32_t axis = fr_plant_append_axes(plant, 1);
    FrAxes *axes = &plant->axes;
    axes->bearer[axis] = bearer;
    axes->offset[axis] = offset;
    axes->base_radius[axis] = base_radius;
    if (bearer != FR_NONE) {
        uint16_t order = axes->order[plant->nodes.axis[bearer]];
        axes->order[axis] = (uint16_t)MIN(order + 1, UINT16_MAX);
    }
    return axis;
}

uint64_t fr_plant_bytes(const FrPlant *plant) {
    return fr_columns_bytes(&plant->nodes, &fr_node_columns) +
           fr_columns_bytes(&plant->axes, &fr_axis_columns) +
           fr_columns_bytes(&plant->organs, &fr_organ_columns) +
           fr_columns_bytes(&plant->buds, &fr_bud_columns);
}
