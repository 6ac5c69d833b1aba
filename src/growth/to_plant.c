// A grown plant as an FrPlant: axes as splines through their nodes, frames, radii, buds.
#include "growth/making.h"
#include "growth/spline.h"

#include <cglm/struct.h>
#include <math.h>

static uint32_t component_of(FrMaking *making, uint32_t order, uint32_t *known) {
    while (*known <= order) {
        char *id = g_strdup_printf("order-%u", *known);
        fr_plant_add_component(making->plant, id, (FrSpan){0});
        g_free(id);
        (*known)++;
    }
    return order;
}

static void add_axes(FrMaking *making) {
    const FrGrownPlant *from = making->from;
    FrPlant *plant = making->plant;
    FrMaterial *bark = making->species->bark;
    uint32_t wood = bark == NULL ? FR_NONE : fr_plant_add_material(plant, bark), known = 0;
    for (uint32_t i = 0; i < from->axis_count; i++) {
        const FrGrownAxis *axis = &from->axes[i];
        making->axis_of[i] = FR_NONE;
        if (axis->first == FR_NONE) {
            continue;
        }
        uint32_t made = fr_plant_append_axes(plant, 1);
        making->axis_of[i] = made;
        plant->axes.order[made] = axis->order;
        plant->axes.material[made] = wood;
        plant->axes.component[made] = component_of(making, axis->order, &known);
        plant->axes.path[made] = axis->key;
    }
    making->leaf_component = fr_plant_add_component(plant, "leaf", (FrSpan){0});
}

/// Appends a straight part from `from` to `to`, with the smallest turn.
static uint32_t add_part(FrMaking *making, uint32_t axis, uint32_t parent, vec3s from, vec3s to,
                         float radius) {
    FrPlant *plant = making->plant;
    vec3s along = glms_vec3_sub(to, from);
    float length = glms_vec3_norm(along);
    versors frame = {{0, 0, 0, 1}};
    if (parent != FR_NONE) {
        frame = plant->nodes.frame[parent];
    }
    vec3s ahead = fr_frame_heading(frame);
    vec3s heading = length > 0 ? glms_vec3_scale(along, 1 / length) : ahead;
    versors turned = glms_quat_mul(fr_rotation_between(ahead, heading), frame);
    versors local = glms_quat_mul(glms_quat_conjugate(frame), turned);
    return fr_plant_add_node(plant, axis, local, length, radius);
}

static void add_internode(FrMaking *making, const FrTangents *tangents, uint32_t i) {
    const FrGrownNodes *nodes = &making->from->nodes;
    FrPlant *plant = making->plant;
    uint32_t grown_parent = nodes->parent[i];
    uint32_t parent = grown_parent == FR_NONE ? FR_NONE : making->node_of[grown_parent];
    uint32_t axis = making->axis_of[nodes->axis[i]];
    bool is_first = plant->axes.first[axis] == FR_NONE;
    if (is_first) {
        plant->axes.bearer[axis] = parent;
        plant->axes.base_radius[axis] = making->radii[i];
    }
    FrInternodeParts drawn =
        fr_spline_parts(making->from, &making->species->params, tangents, making->radii, i);
    for (uint32_t part = 1; part <= drawn.count; part++) {
        parent =
            add_part(making, axis, parent, drawn.at[part - 1], drawn.at[part], drawn.radius[part]);
        plant->nodes.birth[parent] = nodes->birth[i];
        plant->nodes.flags[parent] |= part < drawn.count ? FR_PART : 0;
    }
    making->node_of[i] = parent;
}

static void add_buds(FrMaking *making) {
    const FrGrownPlant *from = making->from;
    FrBuds *buds = &making->plant->buds;
    uint32_t first = fr_plant_append_buds(making->plant, from->bud_count);
    for (uint32_t i = 0; i < from->bud_count; i++) {
        const FrLiveBud *bud = &from->buds[i];
        bool is_growing = bud->state == FR_LIVE_GROWING;
        buds->node[first + i] = bud->node == FR_NONE ? FR_NONE : making->node_of[bud->node];
        buds->kind[first + i] = is_growing ? FR_BUD_APICAL : FR_BUD_LATERAL;
        buds->state[first + i] = is_growing ? FR_BUD_ACTIVE : FR_BUD_DORMANT;
        buds->dormancy[first + i] = is_growing ? 0 : bud->age;
        buds->direction[first + i] = bud->direction;
        buds->id[first + i] = bud->key;
    }
}

FrStatus fr_growth_plant(const FrGrowth *growth, uint32_t plant, const FrContext *context,
                         FrPlant **grown) {
    *grown = NULL;
    FR_ASSERT(plant < growth->plant_count);
    const FrGrownPlant *from = &growth->plants[plant];
    const FrReadySpecies *species = fr_species_of(growth, from);
    uint64_t organs = fr_count_multiply(from->nodes.count, (uint64_t)species->params.leaves);
    FrStatus status =
        fr_limit_check(fr_count_multiply(from->nodes.count, FR_MOST_PARTS), context->limits.nodes,
                       "nodes", species->name, (FrSpan){0}, context->diags);
    if (status == FR_OK) {
        status = fr_limit_check(organs, context->limits.organs, "organs", species->name,
                                (FrSpan){0}, context->diags);
    }
    if (status != FR_OK) {
        return status;
    }
    FrMaking making = {.growth = growth,
                       .from = from,
                       .species = species,
                       .plant = fr_plant_new(species->name),
                       .node_of = g_new(uint32_t, from->nodes.count + 1),
                       .axis_of = g_new(uint32_t, from->axis_count + 1),
                       .radii = fr_growth_radii_of(growth, from)};
    add_axes(&making);
    FrTangents tangents = fr_spline_tangents(from);
    for (uint32_t i = 0; i < from->nodes.count; i++) {
        add_internode(&making, &tangents, i);
    }
    fr_making_add_leaves(&making);
    add_buds(&making);
    fr_spline_clear(&tangents);
    g_free(making.node_of);
    g_free(making.axis_of);
    g_free(making.radii);
    *grown = making.plant;
    return FR_OK;
}
