/// @file rectangles.h
/// Light scenes of rectangles, for tests of the backends.
#pragma once

#include "frond/light.h"

#include <cglm/struct.h>

/// A mesh of one part: a rectangle of two triangles whose outer side is that of x × y.
static inline FrMesh *rectangle(vec3s corner, vec3s x, vec3s y) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->vertices = g_new0(FrVertex, 4);
    mesh->indices = g_new0(uint32_t, 6);
    mesh->parts = g_new0(FrMeshPart, 1);
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh->indices, indices, sizeof indices);
    vec3s corners[4] = {corner, glms_vec3_add(corner, x),
                        glms_vec3_add(glms_vec3_add(corner, x), y), glms_vec3_add(corner, y)};
    for (int i = 0; i < 4; i++) {
        memcpy(mesh->vertices[i].position, corners[i].raw, sizeof corners[i].raw);
        mesh->vertices[i].uv[0] = i == 1 || i == 2 ? 1 : 0;
        mesh->vertices[i].uv[1] = i >= 2 ? 1 : 0;
    }
    mesh->vertex_count = 4;
    mesh->index_count = 6;
    mesh->part_count = 1;
    mesh->parts[0] = (FrMeshPart){.material = FR_NONE, .vertex_count = 4, .index_count = 6};
    return mesh;
}

static inline void rectangle_free(FrMesh *mesh) {
    g_free(mesh->vertices);
    g_free(mesh->indices);
    g_free(mesh->parts);
    g_free(mesh);
}

/// A scene of one rectangle and some lamps, and what it is made of.
typedef struct Plate {
    FrMesh *mesh;
    FrLightMaterial material;
    FrLightMesh lit;
    FrLightStand stand;
    FrLightScene scene;
} Plate;

/// Fills `plate` in place: the scene points into it.
static inline void plate_init(Plate *plate, FrMesh *mesh, const FrLamp *lamps,
                              uint32_t lamp_count) {
    *plate = (Plate){.mesh = mesh};
    plate->lit = (FrLightMesh){.mesh = mesh, .materials = &plate->material};
    plate->stand = (FrLightStand){.transform = glms_mat4_identity()};
    plate->scene = (FrLightScene){.meshes = &plate->lit,
                                  .mesh_count = 1,
                                  .stands = &plate->stand,
                                  .stand_count = 1,
                                  .lamps = lamps,
                                  .lamp_count = lamp_count,
                                  .min = {{1, 1, 1}}};
}

static inline void plate_clear(Plate *plate) {
    rectangle_free(plate->mesh);
}
