#include "studio/model/picked.h"

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

static void add_axis(GArray *lines, const FrStand *stand, const FrPlant *plant, uint32_t axis) {
    vec3s from = fr_plant_axis_origin(plant, axis);
    for (uint32_t i = plant->axes.first[axis]; i != FR_NONE; i = plant->nodes.next[i]) {
        add_point(lines, stand, from);
        from = plant->nodes.position[i];
        add_point(lines, stand, from);
    }
}

// A diamond about the organ, as large as it is.
static void add_organ(GArray *lines, const FrStand *stand, const FrPlant *plant, uint32_t organ) {
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

StudioPicked studio_picked_of(const FrScene *scene, const FrPick *pick) {
    const FrStand *stand = &g_array_index(scene->stands, FrStand, pick->stand);
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, pick->plant).plant;
    StudioPicked picked = {
        .plant = g_strdup(plant->name),
        .component =
            pick->component < plant->components->len
                ? g_strdup(g_array_index(plant->components, FrComponent, pick->component).id)
                : NULL,
        .path = pick->path,
        .is_organ = pick->organ != FR_NONE,
        .distance = pick->distance,
        .lines = g_array_new(FALSE, FALSE, 3 * sizeof(float)),
    };
    if (picked.is_organ) {
        add_organ(picked.lines, stand, plant, pick->organ);
    } else {
        add_axis(picked.lines, stand, plant, plant->nodes.axis[pick->node]);
    }
    return picked;
}

void studio_picked_clear(StudioPicked *picked) {
    g_free(picked->plant);
    g_free(picked->component);
    g_array_unref(picked->lines);
}
