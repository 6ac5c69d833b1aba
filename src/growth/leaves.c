// Leaves of a grown plant: placements of one blade at the leafy nodes, as they grow, level (Beneš,
// Andrysco, Šťava 2009, section 3.9), or facing the light.
#include "growth/making.h"

#include <cglm/struct.h>
#include <math.h>

static uint32_t add_blade(FrPlant *plant, const FrSpeciesParams *params) {
    FrShape shape;
    memset(&shape, 0, sizeof shape); // shapes are compared byte by byte
    shape.kind = FR_SHAPE_BLADE;
    shape.blade = (FrBlade){.length = (float)params->leaf_length,
                            .width = (float)params->leaf_width,
                            .petiole_length = (float)params->leaf_length * 0.25f,
                            .petiole_radius = (float)params->leaf_length * 0.008f,
                            .curvature_along = -0.5f,
                            .fold = 0.25f,
                            .outline = FR_NONE,
                            .along_curve = FR_NONE,
                            .across_curve = FR_NONE,
                            .segments_along = 4,
                            .segments_across = 1};
    return fr_plant_add_shape(plant, &shape);
}

/// Where the light is brightest, by node; up where no live bud tells.
static vec3s *light_by_node(const FrMaking *making) {
    const FrGrownPlant *from = making->from;
    vec3s *light = g_new(vec3s, from->nodes.count + 1);
    for (uint32_t i = 0; i < from->nodes.count; i++) {
        light[i] = making->growth->up;
    }
    for (uint32_t i = 0; i < from->bud_count; i++) {
        const FrLiveBud *bud = &from->buds[i];
        if (bud->node != FR_NONE && glms_vec3_norm2(bud->brightest) > 0) {
            light[bud->node] = bud->brightest;
        }
    }
    return light;
}

static vec3s without(vec3s vector, vec3s unit) {
    return glms_vec3_sub(vector, glms_vec3_scale(unit, glms_vec3_dot(vector, unit)));
}

/// A frame whose z is `along`, made perpendicular to the exact y `face`.
static versors frame_facing(vec3s face, vec3s along) {
    vec3s flat = without(along, face);
    if (glms_vec3_norm2(flat) < 1e-8f) {
        flat = without((vec3s){{1, 0, 0}}, face);
    }
    if (glms_vec3_norm2(flat) < 1e-8f) {
        flat = without((vec3s){{0, 1, 0}}, face);
    }
    vec3s z = glms_vec3_normalize(flat);
    vec3s x = glms_vec3_cross(face, z);
    mat3s matrix = {{{x.x, x.y, x.z}, {face.x, face.y, face.z}, {z.x, z.y, z.z}}};
    return glms_mat3_quat(matrix);
}

/// Like tiles of a roof: away from what is climbed, tips down and a little out.
static versors tile_frame(const FrHold *hold, vec3s along, vec3s up) {
    const float down = 1.2f, out = 0.35f;
    vec3s flat = without(glms_vec3_sub(along, glms_vec3_scale(up, down)), hold->away);
    flat = glms_vec3_norm2(flat) > 1e-4f ? glms_vec3_normalize(flat) : flat;
    vec3s face = glms_vec3_sub(hold->away, glms_vec3_scale(flat, out));
    return frame_facing(glms_vec3_normalize(face), flat);
}

static versors leaf_frame(const FrMaking *making, uint32_t node, vec3s along, vec3s light) {
    vec3s up = making->growth->up;
    FrHold hold = {0};
    if (making->species->params.leaf_facing == FR_LEAVES_OUTWARD) {
        hold = fr_climb_feel(making->growth, &making->species->params,
                             fr_grown_tip(making->from, node));
    }
    switch (making->species->params.leaf_facing) {
    case FR_LEAVES_HORIZONTAL:
        return frame_facing(up, along);
    case FR_LEAVES_LIT:
        return frame_facing(light, along);
    case FR_LEAVES_OUTWARD:
        return hold.is_near ? tile_frame(&hold, along, up) : fr_frame_from_heading(along, up);
    default:
        return fr_frame_from_heading(along, up);
    }
}

static void add_leaves(FrMaking *making, uint32_t node, uint32_t shape, uint32_t material,
                       vec3s light) {
    const FrSpeciesParams *params = &making->species->params;
    FrPlant *plant = making->plant;
    uint32_t made = making->node_of[node];
    versors frame = plant->nodes.frame[made];
    vec3s heading = fr_frame_heading(frame), left = fr_frame_left(frame), up = fr_frame_up(frame);
    const FrGrownAxis *axis = &making->from->axes[making->from->nodes.axis[node]];
    uint32_t count = (uint32_t)params->leaves;
    uint32_t first = fr_plant_append_organs(plant, count);
    for (uint32_t i = 0; i < count; i++) {
        FrKey key = fr_key_child(fr_key_child(axis->key, node), i);
        double around = params->divergence * node + 2 * G_PI * i / count +
                        0.5 * fr_random_signed(key, FR_CHANCE_LEAF, 0);
        double angle = params->leaf_angle * (1 + 0.25 * fr_random_signed(key, FR_CHANCE_LEAF, 1));
        vec3s out = glms_vec3_add(glms_vec3_scale(left, (float)cos(around)),
                                  glms_vec3_scale(up, (float)sin(around)));
        vec3s along = glms_vec3_add(glms_vec3_scale(heading, (float)cos(angle)),
                                    glms_vec3_scale(out, (float)sin(angle)));
        versors world = leaf_frame(making, node, glms_vec3_normalize(along), light);
        uint32_t organ = first + i;
        plant->organs.node[organ] = made;
        plant->organs.rotation[organ] = glms_quat_mul(glms_quat_conjugate(frame), world);
        plant->organs.scale[organ] = (float)(1 + 0.2 * fr_random_signed(key, FR_CHANCE_LEAF, 2));
        plant->organs.shape[organ] = shape;
        plant->organs.material[organ] = material;
        plant->organs.birth[organ] = making->from->nodes.birth[node];
        plant->organs.path[organ] = key;
        plant->organs.component[organ] = making->leaf_component;
    }
}

void fr_making_add_leaves(FrMaking *making) {
    const FrGrownPlant *from = making->from;
    if (making->species->params.leaves == 0) {
        return;
    }
    FrPlant *plant = making->plant;
    uint32_t shape = add_blade(plant, &making->species->params);
    uint32_t material = making->species->leaf == NULL
                            ? FR_NONE
                            : fr_plant_add_material(plant, making->species->leaf);
    vec3s *light = light_by_node(making);
    for (uint32_t i = 0; i < from->nodes.count; i++) {
        if (fr_grown_is_leafy(making->growth, from, i)) {
            add_leaves(making, i, shape, material, light[i]);
        }
    }
    g_free(light);
}
