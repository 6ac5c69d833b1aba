/// @file world_by_hand.h
/// Small meshes and looks for tests of the renderer.
#pragma once

#include "render/colour.h"
#include "render/world.h"

#include <math.h>
#include <string.h>

static inline FrMesh *mesh_of(const FrVertex *vertices, uint64_t vertex_count,
                              const uint32_t *indices, uint64_t index_count) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->vertices = g_memdup2(vertices, vertex_count * sizeof *vertices);
    mesh->vertex_count = vertex_count;
    mesh->indices = g_memdup2(indices, index_count * sizeof *indices);
    mesh->index_count = index_count;
    mesh->parts = g_new0(FrMeshPart, 1);
    mesh->part_count = 1;
    mesh->parts[0] = (FrMeshPart){.material = FR_NONE,
                                  .is_foliage = true,
                                  .vertex_count = vertex_count,
                                  .index_count = index_count};
    return mesh;
}

/// A square of side 2 in the plane z = 0 that faces up; uv (0, 0) … (1, 1).
static inline FrMesh *square(void) {
    FrVertex vertices[4];
    for (int i = 0; i < 4; i++) {
        float x = i == 1 || i == 2 ? 1.0f : -1.0f;
        float y = i >= 2 ? 1.0f : -1.0f;
        vertices[i] = (FrVertex){{x, y, 0}, {0, 0, 1}, {0.5f + 0.5f * x, 0.5f - 0.5f * y}};
    }
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    return mesh_of(vertices, 4, indices, 6);
}

/// A smooth sphere of radius 1 about the origin.
static inline FrMesh *sphere(void) {
    enum { AROUND = 48, UP = 24 };
    FrVertex vertices[(AROUND + 1) * (UP + 1)];
    uint32_t indices[AROUND * UP * 6];
    uint32_t count = 0;
    for (uint32_t row = 0; row <= UP; row++) {
        float polar = FR_PI_F * (float)row / UP;
        for (uint32_t column = 0; column <= AROUND; column++) {
            float turn = 2.0f * FR_PI_F * (float)column / AROUND;
            vec3s at = {{sinf(polar) * cosf(turn), sinf(polar) * sinf(turn), -cosf(polar)}};
            vertices[row * (AROUND + 1) + column] =
                (FrVertex){{at.x, at.y, at.z}, {at.x, at.y, at.z}, {0, 0}};
            if (row < UP && column < AROUND) {
                uint32_t k = row * (AROUND + 1) + column;
                const uint32_t two[6] = {k,     k + 1,          k + AROUND + 1,
                                         k + 1, k + AROUND + 2, k + AROUND + 1};
                memcpy(indices + count, two, sizeof two);
                count += 6;
            }
        }
    }
    return mesh_of(vertices, G_N_ELEMENTS(vertices), indices, count);
}

/// The look of a blade without gloss; it lets the part `translucency` of its colour through.
static inline FrLook *matt(vec3s colour, float translucency) {
    FrLook *look = g_new0(FrLook, 1);
    *look = (FrLook){
        .tint = colour,
        .roughness_factor = 1.0f,
        .translucency = translucency,
        .is_foliage = true,
    };
    return look;
}
