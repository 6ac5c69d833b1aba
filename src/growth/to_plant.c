// A grown plant as an FrPlant: axes and frames, radii by the pipe model, leaves, buds.
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct Making {
    const FrGrowth *growth;
    const FrGrownPlant *from;
    const FrReadySpecies *species;
    FrPlant *plant;
    uint32_t *node_of; ///< by grown node; FR_NONE: shed
    uint32_t *axis_of; ///< by grown axis
} Making;

static vec3s from_of(const FrGrownPlant *plant, uint32_t node) {
    uint32_t parent = plant->nodes.parent[node];
    return parent == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[parent];
}

static void add_axes(Making *making) {
    const FrGrownPlant *from = making->from;
    FrPlant *plant = making->plant;
    uint32_t wood = fr_plant_add_material(plant, making->species->bark);
    for (uint32_t i = 0; i < from->axis_count; i++) {
        const FrGrownAxis *axis = &from->axes[i];
        making->axis_of[i] = FR_NONE;
        if (axis->first == FR_NONE || from->nodes.is_shed[axis->first]) {
            continue;
        }
        uint32_t made = fr_plant_append_axes(plant, 1);
        making->axis_of[i] = made;
        plant->axes.order[made] = axis->order;
        plant->axes.material[made] = wood;
        plant->axes.path[made] = axis->key;
    }
}

static void add_node(Making *making, uint32_t i) {
    const FrGrownPlant *from = making->from;
    FrPlant *plant = making->plant;
    uint32_t axis = making->axis_of[from->nodes.axis[i]];
    vec3s along = glms_vec3_sub(from->nodes.at[i], from_of(from, i));
    float length = glms_vec3_norm(along);
    uint32_t parent =
        from->nodes.parent[i] == FR_NONE ? FR_NONE : making->node_of[from->nodes.parent[i]];
    versors frame = parent == FR_NONE
                        ? fr_frame_from_heading((vec3s){{0, 0, 1}}, (vec3s){{0, 1, 0}})
                        : plant->nodes.frame[parent];
    vec3s heading = length > 0 ? glms_vec3_scale(along, 1 / length) : fr_frame_heading(frame);
    if (plant->axes.first[axis] == FR_NONE) {
        plant->axes.bearer[axis] = parent;
    }
    versors turned = glms_quat_mul(fr_rotation_between(fr_frame_heading(frame), heading), frame);
    versors local = parent == FR_NONE ? turned : glms_quat_mul(glms_quat_conjugate(frame), turned);
    making->node_of[i] = fr_plant_add_node(plant, axis, local, length, 0);
    plant->nodes.birth[making->node_of[i]] = from->nodes.birth[i];
}

FrStatus fr_growth_plant(const FrGrowth *growth, uint32_t plant, const FrContext *context,
                         FrPlant **grown) {
    *grown = NULL;
    FR_ASSERT(plant < growth->plant_count);
    (void)context;
    Making making = {.growth = growth,
                     .from = &growth->plants[plant],
                     .species = fr_species_of(growth, &growth->plants[plant])};
    making.plant = fr_plant_new(making.species->name);
    making.node_of = g_new(uint32_t, making.from->nodes.count + 1);
    making.axis_of = g_new(uint32_t, making.from->axis_count + 1);
    fr_plant_reserve(making.plant, making.from->nodes.count, making.from->axis_count);
    add_axes(&making);
    for (uint32_t i = 0; i < making.from->nodes.count; i++) {
        if (!making.from->nodes.is_shed[i]) {
            add_node(&making, i);
        }
    }
    const FrSpeciesParams *params = &making.species->params;
    fr_plant_pipe_radii(making.plant, params->pipe_exponent, params->tip_radius);
    g_free(making.node_of);
    g_free(making.axis_of);
    *grown = making.plant;
    return FR_OK;
}
