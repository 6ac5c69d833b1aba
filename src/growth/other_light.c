// Light by a backend that the caller has made: leafy nodes are level squares, obstacles what they
// are.
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

/// Leaves let a part through and throw a part back; obstacles throw a part back.
static const FrLightMaterial materials[] = {
    {.front = {.diffuse = 0.1f, .transmit_diffuse = 0.1f},
     .back = {.diffuse = 0.1f, .transmit_diffuse = 0.1f}},
    {.front = {.diffuse = 0.3f}, .back = {.diffuse = 0.3f}},
};

struct FrOtherScene {
    FrMesh *meshes[2]; ///< leaves, obstacles
};

static FrMesh *new_mesh(uint64_t vertex_count, uint64_t index_count) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->vertices = g_new0(FrVertex, vertex_count + 1);
    mesh->indices = g_new(uint32_t, index_count + 1);
    mesh->parts = g_new0(FrMeshPart, 1);
    mesh->part_count = 1;
    mesh->parts[0].material = FR_NONE;
    return mesh;
}

static uint32_t add_vertex(FrMesh *mesh, vec3s at, vec3s normal) {
    FrVertex *vertex = &mesh->vertices[mesh->vertex_count];
    memcpy(vertex->position, at.raw, sizeof vertex->position);
    memcpy(vertex->normal, normal.raw, sizeof vertex->normal);
    return (uint32_t)mesh->vertex_count++;
}

static void add_triangle(FrMesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
    mesh->indices[mesh->index_count++] = a;
    mesh->indices[mesh->index_count++] = b;
    mesh->indices[mesh->index_count++] = c;
}

/// Counts and bounds of the one part.
static void close_mesh(FrMesh *mesh) {
    FrMeshPart *part = &mesh->parts[0];
    part->vertex_count = mesh->vertex_count;
    part->index_count = mesh->index_count;
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            float at = mesh->vertices[i].position[k];
            part->min[k] = i == 0 ? at : MIN(part->min[k], at);
            part->max[k] = i == 0 ? at : MAX(part->max[k], at);
        }
    }
}

static FrMesh *leaf_mesh(const FrGrowth *growth) {
    static const vec3s up = {{0, 0, 1}};
    uint64_t count = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        count += growth->plants[p].nodes.count;
    }
    FrMesh *mesh = new_mesh(4 * count, 6 * count);
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        float half = sqrtf((float)fr_species_of(growth, plant)->params.foliage) / 2;
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            if (!fr_grown_is_leafy(growth, plant, i)) {
                continue;
            }
            vec3s middle = fr_grown_tip(plant, i);
            uint32_t corner[4];
            for (int k = 0; k < 4; k++) {
                vec3s at = {{middle.x + (k == 1 || k == 2 ? half : -half),
                             middle.y + (k >= 2 ? half : -half), middle.z}};
                corner[k] = add_vertex(mesh, at, up);
            }
            add_triangle(mesh, corner[0], corner[1], corner[2]);
            add_triangle(mesh, corner[0], corner[2], corner[3]);
        }
    }
    close_mesh(mesh);
    return mesh;
}

static FrMesh *obstacle_mesh(const FrGrowth *growth) {
    uint64_t vertices = 0, indices = 0;
    for (uint32_t o = 0; o < growth->obstacle_count; o++) {
        vertices += growth->obstacles[o].vertex_count;
        indices += growth->obstacles[o].index_count;
    }
    FrMesh *mesh = new_mesh(vertices, indices);
    for (uint32_t o = 0; o < growth->obstacle_count; o++) {
        const FrGrowthObstacle *obstacle = &growth->obstacles[o];
        uint32_t first = (uint32_t)mesh->vertex_count;
        for (uint32_t i = 0; i < obstacle->vertex_count; i++) {
            add_vertex(mesh, obstacle->positions[i], (vec3s){{0, 0, 1}});
        }
        for (uint32_t i = 0; i + 2 < obstacle->index_count && !obstacle->is_clear; i += 3) {
            add_triangle(mesh, first + obstacle->indices[i], first + obstacle->indices[i + 1],
                         first + obstacle->indices[i + 2]);
        }
    }
    close_mesh(mesh);
    return mesh;
}

void fr_other_scene_free(FrOtherScene *scene) {
    if (scene != NULL) {
        fr_mesh_free(scene->meshes[0]);
        fr_mesh_free(scene->meshes[1]);
        g_free(scene);
    }
}

static FrStatus set_scene(FrGrowth *growth, const FrContext *context) {
    FrOtherScene *made = g_new(FrOtherScene, 1);
    made->meshes[0] = leaf_mesh(growth);
    made->meshes[1] = obstacle_mesh(growth);
    FrLightMesh meshes[2];
    FrLightStand stands[2];
    uint32_t count = 0;
    for (uint32_t i = 0; i < 2; i++) {
        if (made->meshes[i]->index_count > 0) {
            meshes[count] = (FrLightMesh){.mesh = made->meshes[i], .materials = &materials[i]};
            stands[count] = (FrLightStand){.mesh = count, .transform = glms_mat4_identity()};
            count++;
        }
    }
    FrLightScene scene = {.meshes = meshes,
                          .mesh_count = count,
                          .stands = stands,
                          .stand_count = count,
                          .lamps = growth->lamps,
                          .lamp_count = growth->lamp_count,
                          .min = growth->params.min,
                          .max = growth->params.max};
    FrStatus status = fr_light_set_scene(growth->light, &scene, context);
    fr_other_scene_free(growth->other_scene); // until now the light may have read it
    growth->other_scene = made;
    return status;
}

FrStatus fr_growth_ask_light(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                             const FrContext *context) {
    FrStatus status = set_scene(growth, context);
    if (status != FR_OK || count == 0) {
        return status;
    }
    vec3s *points = g_new(vec3s, count);
    FrLightAnswer *answers = g_new(FrLightAnswer, count);
    for (uint32_t i = 0; i < count; i++) { // above its own leaves
        points[i] = buds[i].world;
        points[i].z += buds[i].own_shade / 2;
    }
    status = fr_light_query(growth->light, points, count, context, answers);
    for (uint32_t i = 0; status == FR_OK && i < count; i++) {
        buds[i].bud->light = CLAMP(answers[i].intensity, 0, 1);
        buds[i].bud->brightest = answers[i].direction;
        buds[i].bud->slope = 1;
    }
    g_free(points);
    g_free(answers);
    fr_light_forget(growth->light);
    return status;
}
