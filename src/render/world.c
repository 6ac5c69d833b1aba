// Building the world of a scene. Tracing through it is in trace.c.
#include "render/world.h"

#include "render/colour.h"

#include <math.h>

#define GROUND_VARIATION 0.6f

// Embree asks from any thread; only reads.
static bool is_hole(void *user, uint32_t mesh, uint32_t part, uint32_t triangle, float u, float v) {
    const FrWorld *world = user;
    const FrWorldMesh *of = &g_array_index(world->meshes, FrWorldMesh, mesh);
    const FrLook *look = &of->looks[part];
    if (!look->has_holes) {
        return false;
    }
    float uv[2];
    fr_mesh_uv(of->mesh, part, triangle, u, v, uv);
    return fr_look_is_hole(look, uv[0], uv[1]);
}

FrWorld *fr_world_new(FrSky *sky, FrGround *ground) {
    FrWorld *world = g_new0(FrWorld, 1);
    world->rays = fr_rays_new(is_hole, world);
    world->meshes = g_array_new(FALSE, TRUE, sizeof(FrWorldMesh));
    world->stands = g_array_new(FALSE, TRUE, sizeof(FrWorldStand));
    fr_decoder_init(&world->decoder);
    world->sky = sky;
    world->ground = ground;
    return world;
}

void fr_world_free(FrWorld *world) {
    if (world == NULL) {
        return;
    }
    fr_rays_free(world->rays);
    for (guint i = 0; i < world->meshes->len; i++) {
        FrWorldMesh *mesh = &g_array_index(world->meshes, FrWorldMesh, i);
        fr_mesh_free(mesh->mesh);
        g_free(mesh->looks);
    }
    g_array_free(world->meshes, TRUE);
    g_array_free(world->stands, TRUE);
    fr_sky_free(world->sky);
    fr_ground_free(world->ground);
    fr_lamps_clear(&world->lamps);
    g_free(world);
}

uint32_t fr_world_add_mesh(FrWorld *world, FrMesh *mesh, FrLook *looks) {
    FrWorldMesh added = {mesh, looks};
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        world->has_clear |= looks[i].clear > 0.0f;
    }
    g_array_append_val(world->meshes, added);
    return fr_rays_add_mesh(world->rays, mesh);
}

void fr_world_add_stand(FrWorld *world, uint32_t mesh, mat4s transform) {
    FrWorldStand stand = {
        .mesh = mesh,
        .transform = transform,
        .normals = glms_mat3_transpose(glms_mat3_inv(glms_mat4_pick3(transform))),
    };
    g_array_append_val(world->stands, stand);
    fr_rays_add_stand(world->rays, mesh, transform);
}

/// Of the box around everything that stands in the world.
static vec3s size_of(const FrWorld *world) {
    vec3s min = {{INFINITY, INFINITY, INFINITY}}, max = glms_vec3_negate(min);
    for (guint i = 0; i < world->stands->len; i++) {
        const FrWorldStand *stand = &g_array_index(world->stands, FrWorldStand, i);
        const FrMesh *mesh = g_array_index(world->meshes, FrWorldMesh, stand->mesh).mesh;
        for (uint32_t corner = 0; corner < 8 * mesh->part_count; corner++) {
            const FrMeshPart *part = &mesh->parts[corner / 8];
            vec3s local = {{(corner & 1) != 0 ? part->max[0] : part->min[0],
                            (corner & 2) != 0 ? part->max[1] : part->min[1],
                            (corner & 4) != 0 ? part->max[2] : part->min[2]}};
            vec3s at = glms_mat4_mulv3(stand->transform, local, 1.0f);
            min = glms_vec3_minv(min, at);
            max = glms_vec3_maxv(max, at);
        }
    }
    return glms_vec3_sub(max, min);
}

void fr_world_commit(FrWorld *world) {
    fr_rays_commit(world->rays);
    world->white = world->sky->flat_irradiance;
    if (world->lamps.count > 0) {
        world->white = glms_vec3_add(world->white, fr_lamps_light(&world->lamps, size_of(world)));
    }
}

static FrStatus add_plant(FrWorld *world, const FrScenePlant *built, const FrSkinParams *skin,
                          const FrContext *context, uint32_t *index) {
    FrMesh *mesh = NULL;
    const FrPlant *plant = built->plant;
    FrStatus status = fr_scene_mesh(built, skin, FR_UP_Z, context, &mesh);
    if (status != FR_OK) {
        return status;
    }
    FrLook *looks = g_new0(FrLook, mesh->part_count);
    for (uint32_t i = 0; i < mesh->part_count && status == FR_OK; i++) {
        uint32_t material = mesh->parts[i].material;
        FrMaterial *of = material == FR_NONE ? NULL : g_ptr_array_index(plant->materials, material);
        status = fr_look_init(&looks[i], of, mesh->parts[i].is_foliage, context);
    }
    if (status != FR_OK) {
        fr_mesh_free(mesh);
        g_free(looks);
        return status;
    }
    *index = fr_world_add_mesh(world, mesh, looks);
    return FR_OK;
}

static void find_origin(FrWorld *world, const FrScene *scene) {
    double min[2] = {INFINITY, INFINITY};
    double max[2] = {-INFINITY, -INFINITY};
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        for (int c = 0; c < 2; c++) {
            min[c] = fmin(min[c], stand->at[c]);
            max[c] = fmax(max[c], stand->at[c]);
        }
    }
    for (int c = 0; c < 2 && scene->stands->len > 0; c++) {
        world->origin[c] = 0.5 * (min[c] + max[c]);
    }
}

static mat4s transform_of(const FrWorld *world, const FrStand *stand) {
    vec3s at = {{(float)(stand->at[0] - world->origin[0]), (float)(stand->at[1] - world->origin[1]),
                 (float)(stand->at[2] - world->origin[2])}};
    mat4s transform = glms_translate(glms_mat4_identity(), at);
    transform = glms_rotate(transform, (float)stand->turn, (vec3s){{0, 0, 1}});
    return glms_scale_uni(transform, (float)stand->scale);
}

FrStatus fr_world_of_scene(const FrScene *scene, const FrSkinParams *skin, const FrContext *context,
                           FrWorld **world) {
    *world = NULL;
    const FrSceneParams *params = scene->params;
    FrSky *sky = fr_sky_new(params, params->ground, context);
    FrGround *ground = params->ground
                           ? fr_ground_new(fr_srgb_decode3(params->ground_colour), GROUND_VARIATION)
                           : NULL;
    FrWorld *made = fr_world_new(sky, ground);
    find_origin(made, scene);
    made->lamps = fr_lamps_new(scene->surroundings, made->origin);
    made->is_framed = scene->is_framed;
    for (int k = 0; k < 3; k++) {
        made->frame_min.raw[k] = (float)(scene->frame_min[k] - made->origin[k]);
        made->frame_max.raw[k] = (float)(scene->frame_max[k] - made->origin[k]);
    }
    if (ground != NULL) {
        ground->origin[0] = made->origin[0];
        ground->origin[1] = made->origin[1];
    }
    uint32_t *mesh_of = g_new(uint32_t, scene->plants->len);
    FrStatus status = FR_OK;
    for (guint i = 0; i < scene->plants->len && status == FR_OK; i++) {
        const FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, i);
        status = add_plant(made, plant, skin, context, &mesh_of[i]);
        if (status == FR_OK && fr_progress_is_cancelled(context->progress)) {
            status = FR_CANCELLED;
        }
    }
    for (guint i = 0; i < scene->stands->len && status == FR_OK; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        fr_world_add_stand(made, mesh_of[stand->plant], transform_of(made, stand));
    }
    g_free(mesh_of);
    if (status != FR_OK) {
        fr_world_free(made);
        return status;
    }
    fr_world_commit(made);
    *world = made;
    return FR_OK;
}
