/// Obstacles, ground and finished plants as triangles. Whatever skin makes of them is what growing
/// plants keep off.
#include "scene/solids.h"

#include "scene/obstacles.h"

#include <cglm/struct.h>
#include <math.h>

static void clear_solid(void *data) {
    FrGrowthObstacle *solid = data;
    g_free((void *)solid->positions);
    g_free((void *)solid->indices);
}

FrSolids fr_solids_new(void) {
    FrSolids solids = {g_array_new(FALSE, FALSE, sizeof(FrGrowthObstacle))};
    g_array_set_clear_func(solids.all, clear_solid);
    return solids;
}

void fr_solids_clear(FrSolids *solids) {
    g_clear_pointer(&solids->all, g_array_unref);
}

static vec3s stand_point(const FrStand *stand, const float at[3]) {
    double sine = sin(stand->turn), cosine = cos(stand->turn);
    double x = (double)at[0] * stand->scale, y = (double)at[1] * stand->scale;
    return (vec3s){{(float)(stand->at[0] + cosine * x - sine * y),
                    (float)(stand->at[1] + sine * x + cosine * y),
                    (float)(stand->at[2] + (double)at[2] * stand->scale)}};
}

static FrGrowthObstacle solid_of(const FrMesh *mesh, const FrStand *stand) {
    vec3s *positions = g_new(vec3s, mesh->vertex_count);
    uint32_t *indices = g_new(uint32_t, mesh->index_count);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        positions[i] = stand_point(stand, mesh->vertices[i].position);
    }
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        for (uint64_t i = part->first_index; i < part->first_index + part->index_count; i++) {
            indices[i] = mesh->indices[i] + (uint32_t)part->first_vertex;
        }
    }
    return (FrGrowthObstacle){.positions = positions,
                              .vertex_count = (uint32_t)mesh->vertex_count,
                              .indices = indices,
                              .index_count = (uint32_t)mesh->index_count};
}

static FrStatus mesh_solid(const FrPlant *plant, const FrStand *stand, int lod, bool has_leaves,
                           const FrContext *context, FrGrowthObstacle *solid) {
    FrSkinParams skin = fr_skin_default();
    skin.lod = lod;
    skin.collar = 0;
    skin.foliage = has_leaves;
    FrMesh *mesh;
    FrStatus status = fr_skin_plant(plant, &skin, FR_UP_Z, context, &mesh);
    if (status == FR_OK) {
        *solid = solid_of(mesh, stand);
        fr_mesh_free(mesh);
    }
    return status;
}

static FrStatus add_plant(FrSolids *solids, const FrPlant *plant, const FrStand *stand,
                          bool has_leaves, const FrContext *context) {
    enum { LOD = 2 };
    FrGrowthObstacle solid;
    FrStatus status = mesh_solid(plant, stand, LOD, has_leaves, context, &solid);
    if (status == FR_OK) {
        g_array_append_val(solids->all, solid);
    }
    return status;
}

FrStatus fr_solids_add_plant(FrSolids *solids, const FrPlant *plant, const FrStand *stand,
                             const FrContext *context) {
    return add_plant(solids, plant, stand, true, context);
}

FrStatus fr_solids_add_wood(FrSolids *solids, const FrPlant *plant, const FrStand *stand,
                            const FrContext *context) {
    return add_plant(solids, plant, stand, false, context);
}

static FrStatus add_obstacle(FrSolids *solids, const FrObstacle *obstacle,
                             const FrContext *context) {
    FrPlant *plant;
    FrStatus status = fr_obstacle_plant(obstacle, context, &plant);
    if (status != FR_OK) {
        return status;
    }
    const FrStand origin = {.scale = 1};
    FrGrowthObstacle solid;
    status = mesh_solid(plant, &origin, 0, true, context, &solid);
    if (status == FR_OK) {
        solid.is_clear = !obstacle->visible;
        solid.span = obstacle->span;
        g_array_append_val(solids->all, solid);
    }
    fr_plant_free(plant);
    return status;
}

static void add_hills(FrSolids *solids, const FrTerrain *terrain, const FrHills *hills) {
    const FrMeshFile *mesh = fr_hills_mesh(hills);
    vec3s *positions = g_new(vec3s, mesh->vertex_count);
    FrStand stand = {.turn = terrain->turn, .scale = 1};
    for (int axis = 0; axis < 3; axis++) {
        stand.at[axis] = (double)terrain->at.raw[axis];
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        vec3s at = mesh->positions[i];
        at = terrain->mesh != NULL ? glms_vec3_mul(at, terrain->size) : at;
        positions[i] = stand_point(&stand, at.raw);
    }
    FrGrowthObstacle solid = {
        .positions = positions,
        .vertex_count = mesh->vertex_count,
        .indices = g_memdup2(mesh->indices, mesh->index_count * sizeof *mesh->indices),
        .index_count = mesh->index_count,
        .is_ground = true,
        .span = terrain->span};
    g_array_append_val(solids->all, solid);
}

void fr_solids_add_level(FrSolids *solids, const vec3s box[2]) {
    if (box[0].z >= 0 || box[1].z <= 0) {
        return;
    }
    static const uint32_t corners[6] = {0, 1, 3, 0, 3, 2};
    vec3s *positions = g_new(vec3s, 4);
    for (int i = 0; i < 4; i++) {
        positions[i] = (vec3s){{box[i & 1].x, box[i >> 1].y, 0}};
    }
    FrGrowthObstacle solid = {.positions = positions,
                              .vertex_count = 4,
                              .indices = g_memdup2(corners, sizeof corners),
                              .index_count = G_N_ELEMENTS(corners),
                              .is_ground = true};
    g_array_append_val(solids->all, solid);
}

FrStatus fr_solids_add_surroundings(FrSolids *solids, const FrScene *scene, const FrHills *hills,
                                    const vec3s box[2], const FrContext *context) {
    if (hills != NULL) {
        add_hills(solids, scene->surroundings->terrain, hills);
    } else if (scene->params->ground) {
        fr_solids_add_level(solids, box);
    }
    const GPtrArray *obstacles = scene->surroundings->obstacles;
    FrStatus status = FR_OK;
    for (guint i = 0; i < obstacles->len && status == FR_OK; i++) {
        status = add_obstacle(solids, g_ptr_array_index(obstacles, i), context);
    }
    return status;
}

void fr_solids_tell_open(const FrSurroundings *surroundings, const FrContext *context) {
    for (guint i = 0; i < surroundings->obstacles->len; i++) {
        const FrObstacle *obstacle = g_ptr_array_index(surroundings->obstacles, i);
        if (obstacle->mesh != NULL && !obstacle->mesh->is_closed) {
            fr_diags_add(context->diags, FR_WARNING, "open-obstacle", obstacle->span,
                         "'%s' is not closed: where it is open only its surface is in the way",
                         obstacle->file);
        }
    }
}

FrDigest fr_solids_digest(const FrSolids *solids) {
    FrDigest digest = 0;
    for (guint i = 0; i < solids->all->len; i++) {
        const FrGrowthObstacle *solid = &g_array_index(solids->all, FrGrowthObstacle, i);
        digest = fr_digest(digest, solid->positions, solid->vertex_count * sizeof(vec3s));
        digest = fr_digest(digest, solid->indices, solid->index_count * sizeof(uint32_t));
    }
    return digest;
}
