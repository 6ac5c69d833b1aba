/// Obstacles as a plant: whoever meshes, draws, writes or counts plants does so with them.
#include "scene/obstacles.h"

#include <cglm/struct.h>

enum { SIDES = 64 }; // of round obstacles

static FrMaterial *grey(FrSpan span) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.colour = (vec3s){{0.7F, 0.7F, 0.7F}};
    FrMaterial *material = fr_material_new("grey", &params, NULL, span);
    fr_params_clear(fr_material_table(), &params);
    return material;
}

static FrShapeKind kind_of(const FrObstacle *obstacle) {
    static const FrShapeKind kinds[] = {FR_SHAPE_BOX,  FR_SHAPE_SPHERE, FR_SHAPE_CYLINDER,
                                        FR_SHAPE_CONE, FR_SHAPE_SQUARE, FR_SHAPE_CIRCLE,
                                        FR_SHAPE_FILE};
    return kinds[obstacle->shape];
}

static void add_piece(FrPlant *plant, const FrObstacle *obstacle, const FrShape *shape,
                      FrMaterial *material) {
    uint32_t organ = fr_plant_append_organs(plant, 1);
    versors turn = fr_rotation_about((vec3s){{0, 0, 1}}, (float)obstacle->turn);
    versors tilt = fr_rotation_about((vec3s){{1, 0, 0}}, (float)obstacle->tilt);
    plant->organs.offset[organ] = obstacle->at;
    plant->organs.rotation[organ] = glms_quat_mul(turn, tilt);
    plant->organs.shape[organ] = fr_plant_add_shape(plant, shape);
    plant->organs.material[organ] = fr_plant_add_material(plant, material);
}

static void add_obstacle(FrPlant *plant, const FrObstacle *obstacle, FrMaterial *plain) {
    FrMaterial *material = obstacle->made_of == NULL ? plain : obstacle->made_of;
    FrShape shape = {
        .kind = kind_of(obstacle), .size = obstacle->size, .detail = SIDES, .outline = FR_NONE};
    if (obstacle->mesh == NULL) {
        add_piece(plant, obstacle, &shape, material);
        return;
    }
    shape.detail = fr_plant_add_file(plant, obstacle->mesh);
    for (uint32_t part = 0; part < obstacle->mesh->part_count; part++) {
        FrMaterial *own = obstacle->mesh->parts[part].material;
        shape.outline = part;
        add_piece(plant, obstacle, &shape,
                  own != NULL && obstacle->made_of == NULL ? own : material);
    }
}

static uint64_t count_pieces(const GPtrArray *obstacles) {
    uint64_t count = 0;
    for (guint i = 0; i < obstacles->len; i++) {
        const FrObstacle *obstacle = g_ptr_array_index(obstacles, i);
        count += obstacle->mesh == NULL ? 1 : obstacle->mesh->part_count;
    }
    return count;
}

FrStatus fr_obstacles_plant(const FrSurroundings *surroundings, const FrContext *context,
                            FrPlant **plant) {
    *plant = NULL;
    const GPtrArray *obstacles = surroundings->obstacles;
    const FrObstacle *first = g_ptr_array_index(obstacles, 0);
    FrStatus status = fr_limit_check(count_pieces(obstacles), context->limits.organs, "organs",
                                     "the scene", first->span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    *plant = fr_plant_new("obstacles");
    FrMaterial *plain = grey(first->span);
    for (guint i = 0; i < obstacles->len; i++) {
        add_obstacle(*plant, g_ptr_array_index(obstacles, i), plain);
    }
    fr_material_unref(plain);
    return FR_OK;
}
