/// Obstacles as a plant: whoever meshes, draws, writes or counts plants does so with them.
#include "scene/obstacles.h"

#include "scene/swept.h"

#include <cglm/struct.h>

enum { SIDES = 64 }; // of round obstacles

static FrMaterial *plain(const char *name, vec3s colour, FrSpan span) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.colour = colour;
    FrMaterial *material = fr_material_new(name, &params, NULL, span);
    fr_params_clear(fr_material_table(), &params);
    return material;
}

static FrShapeKind kind_of(const FrObstacle *obstacle) {
    static const FrShapeKind kinds[] = {FR_SHAPE_BOX,  FR_SHAPE_SPHERE, FR_SHAPE_CYLINDER,
                                        FR_SHAPE_CONE, FR_SHAPE_SQUARE, FR_SHAPE_CIRCLE};
    return kinds[obstacle->shape];
}

/// Where a piece stands.
typedef struct Pose {
    vec3s at;
    float tilt, turn;
} Pose;

static void add_piece(FrPlant *plant, const Pose *pose, const FrShape *shape,
                      FrMaterial *material) {
    uint32_t organ = fr_plant_append_organs(plant, 1);
    versors turn = fr_rotation_about((vec3s){{0, 0, 1}}, pose->turn);
    versors tilt = fr_rotation_about((vec3s){{1, 0, 0}}, pose->tilt);
    plant->organs.offset[organ] = pose->at;
    plant->organs.rotation[organ] = glms_quat_mul(turn, tilt);
    plant->organs.shape[organ] = fr_plant_add_shape(plant, shape);
    plant->organs.material[organ] = fr_plant_add_material(plant, material);
}

/// Adds all parts of a mesh; `material` NULL: what the file says, else `other`.
static void add_mesh(FrPlant *plant, const Pose *pose, FrMeshFile *mesh, vec3s size,
                     FrMaterial *material, FrMaterial *other) {
    FrShape shape = {.kind = FR_SHAPE_FILE, .size = size, .detail = fr_plant_add_file(plant, mesh)};
    for (uint32_t part = 0; part < mesh->part_count; part++) {
        FrMaterial *own = mesh->parts[part].material;
        shape.outline = part;
        add_piece(plant, pose, &shape, material != NULL ? material : own != NULL ? own : other);
    }
}

static FrStatus add_obstacle(FrPlant *plant, const FrObstacle *obstacle, FrMaterial *grey,
                             const FrContext *context) {
    Pose pose = {obstacle->at, (float)obstacle->tilt, (float)obstacle->turn};
    if (obstacle->shape == FR_OBSTACLE_SWEEP && obstacle->along != NULL) {
        FrMeshFile *mesh;
        FrStatus status = fr_swept_mesh(obstacle, context, &mesh);
        if (status == FR_OK) {
            add_mesh(plant, &pose, mesh, (vec3s){{1, 1, 1}}, obstacle->made_of, grey);
            fr_mesh_file_unref(mesh);
        }
        return status;
    }
    if (obstacle->mesh != NULL) {
        add_mesh(plant, &pose, obstacle->mesh, obstacle->size, obstacle->made_of, grey);
        return FR_OK;
    }
    FrShape shape = {
        .kind = kind_of(obstacle), .size = obstacle->size, .detail = SIDES, .outline = FR_NONE};
    add_piece(plant, &pose, &shape, obstacle->made_of == NULL ? grey : obstacle->made_of);
    return FR_OK;
}

static void add_terrain(FrPlant *plant, const FrTerrain *terrain, const FrHills *hills) {
    Pose pose = {terrain->at, 0, (float)terrain->turn};
    vec3s size = terrain->mesh != NULL ? terrain->size : (vec3s){{1, 1, 1}};
    FrMaterial *earth = plain("earth", (vec3s){{0.42F, 0.42F, 0.31F}}, terrain->span);
    add_mesh(plant, &pose, fr_hills_mesh(hills), size, terrain->made_of, earth);
    fr_material_unref(earth);
}

static uint64_t count_pieces(const GPtrArray *obstacles) {
    uint64_t count = 0;
    for (guint i = 0; i < obstacles->len; i++) {
        const FrObstacle *obstacle = g_ptr_array_index(obstacles, i);
        count += !obstacle->visible ? 0 : obstacle->mesh == NULL ? 1 : obstacle->mesh->part_count;
    }
    return count;
}

FrStatus fr_obstacles_plant(const FrSurroundings *surroundings, const FrHills *hills,
                            const FrContext *context, FrPlant **plant) {
    *plant = NULL;
    const GPtrArray *obstacles = surroundings->obstacles;
    uint64_t pieces = count_pieces(obstacles);
    if (pieces == 0 && hills == NULL) {
        return FR_OK;
    }
    FrSpan span = obstacles->len > 0 ? ((const FrObstacle *)g_ptr_array_index(obstacles, 0))->span
                                     : surroundings->terrain->span;
    FrStatus status =
        fr_limit_check(pieces, context->limits.organs, "organs", "the scene", span, context->diags);
    FrPlant *made = fr_plant_new("obstacles");
    FrMaterial *grey = plain("grey", (vec3s){{0.7F, 0.7F, 0.7F}}, span);
    for (guint i = 0; i < obstacles->len && status == FR_OK; i++) {
        const FrObstacle *obstacle = g_ptr_array_index(obstacles, i);
        status = obstacle->visible ? add_obstacle(made, obstacle, grey, context) : FR_OK;
    }
    if (hills != NULL) {
        add_terrain(made, surroundings->terrain, hills);
    }
    fr_material_unref(grey);
    if (status != FR_OK) {
        fr_plant_free(made);
        return status;
    }
    *plant = made;
    return FR_OK;
}

FrStatus fr_obstacle_plant(const FrObstacle *obstacle, const FrContext *context, FrPlant **plant) {
    *plant = fr_plant_new("obstacle");
    FrMaterial *grey = plain("grey", (vec3s){{0.7F, 0.7F, 0.7F}}, obstacle->span);
    FrStatus status = add_obstacle(*plant, obstacle, grey, context);
    fr_material_unref(grey);
    if (status != FR_OK) {
        g_clear_pointer(plant, fr_plant_free);
    }
    return status;
}
