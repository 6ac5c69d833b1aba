#include "studio/model/outline.h"

#include <cglm/struct.h>
#include <math.h>

static void add_point(GArray *lines, const FrStand *stand, vec3s point) {
    float c = (float)(stand->scale * cos(stand->turn)),
          s = (float)(stand->scale * sin(stand->turn));
    float at[3] = {(float)stand->at[0] + c * point.x - s * point.y,
                   (float)stand->at[1] + s * point.x + c * point.y,
                   (float)stand->at[2] + (float)stand->scale * point.z};
    g_array_append_val(lines, at);
}

void studio_outline_axis(GArray *lines, const FrStand *stand, const FrPlant *plant, uint32_t axis) {
    vec3s from = fr_plant_axis_origin(plant, axis);
    for (uint32_t i = plant->axes.first[axis]; i != FR_NONE; i = plant->nodes.next[i]) {
        add_point(lines, stand, from);
        from = plant->nodes.position[i];
        add_point(lines, stand, from);
    }
}

void studio_outline_node(GArray *lines, const FrStand *stand, const FrPlant *plant, uint32_t node) {
    uint32_t axis = plant->nodes.axis[node];
    bool is_first = plant->axes.first[axis] == node;
    add_point(lines, stand,
              is_first ? fr_plant_axis_origin(plant, axis)
                       : plant->nodes.position[plant->nodes.parent[node]]);
    add_point(lines, stand, plant->nodes.position[node]);
}

void studio_outline_organ(GArray *lines, const FrStand *stand, const FrPlant *plant,
                          uint32_t organ) {
    vec3s at;
    versors turn;
    fr_plant_organ_pose(plant, organ, &at, &turn);
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    bool is_blade = shape->kind == FR_SHAPE_BLADE;
    float scale = plant->organs.scale[organ];
    float length =
        scale * (is_blade ? shape->blade.petiole_length + shape->blade.length : shape->size.z);
    float width = 0.5f * scale * (is_blade ? shape->blade.width : shape->size.x);
    vec3s corners[] = {
        {{0, 0, 0}}, {{width, 0, 0.5f * length}}, {{0, 0, length}}, {{-width, 0, 0.5f * length}}};
    for (int i = 0; i < 4; i++) {
        add_point(lines, stand, glms_vec3_add(at, glms_quat_rotatev(turn, corners[i])));
        add_point(lines, stand, glms_vec3_add(at, glms_quat_rotatev(turn, corners[(i + 1) % 4])));
    }
}
