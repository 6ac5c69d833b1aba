/// @file light_scenes.h
/// Small light scenes for tests.
#pragma once

#include "frond/light_density.h"
#include "frond/random.h"

#include <cglm/struct.h>
#include <glib.h>
#include <math.h>

/// A light scene that owns what it is made of.
typedef struct TestScene {
    FrLightScene scene;
    GArray *meshes; ///< FrLightMesh
    GArray *stands; ///< FrLightStand
    GArray *lamps;  ///< FrLamp
} TestScene;

static inline TestScene *test_scene_new(void) {
    TestScene *test = g_new0(TestScene, 1);
    test->meshes = g_array_new(FALSE, TRUE, sizeof(FrLightMesh));
    test->stands = g_array_new(FALSE, TRUE, sizeof(FrLightStand));
    test->lamps = g_array_new(FALSE, TRUE, sizeof(FrLamp));
    test->scene.min = (vec3s){{1, 1, 1}};
    return test;
}

static inline void test_scene_free(TestScene *test) {
    for (guint i = 0; i < test->meshes->len; i++) {
        FrLightMesh *mesh = &g_array_index(test->meshes, FrLightMesh, i);
        g_free(mesh->mesh->vertices);
        g_free(mesh->mesh->indices);
        g_free(mesh->mesh->parts);
        g_free((FrMesh *)mesh->mesh);
        g_free((FrLightMaterial *)mesh->materials);
        g_free((uint32_t *)mesh->elements);
    }
    g_array_unref(test->meshes);
    g_array_unref(test->stands);
    g_array_unref(test->lamps);
    g_free(test);
}

/// The scene as it is now.
static inline const FrLightScene *test_scene(TestScene *test) {
    test->scene.meshes = (const FrLightMesh *)(void *)test->meshes->data;
    test->scene.mesh_count = test->meshes->len;
    test->scene.stands = (const FrLightStand *)(void *)test->stands->data;
    test->scene.stand_count = test->stands->len;
    test->scene.lamps = (const FrLamp *)(void *)test->lamps->data;
    test->scene.lamp_count = test->lamps->len;
    return &test->scene;
}

/// Both sides alike.
static inline FrLightMaterial alike(float diffuse, float specular, float transmit_diffuse,
                                    float transmit_specular) {
    FrOptics optics = {diffuse, specular, transmit_diffuse, transmit_specular};
    return (FrLightMaterial){.front = optics, .back = optics};
}

/// A mesh of four-cornered faces, each an element; stands it at the origin.
static inline uint32_t add_faces(TestScene *test, const vec3s *corners, uint32_t face_count,
                                 FrLightMaterial material) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->vertex_count = 4 * (uint64_t)face_count;
    mesh->index_count = 6 * (uint64_t)face_count;
    mesh->vertices = g_new0(FrVertex, mesh->vertex_count);
    mesh->indices = g_new(uint32_t, mesh->index_count);
    mesh->parts = g_new0(FrMeshPart, 1);
    mesh->part_count = 1;
    mesh->parts[0] =
        (FrMeshPart){.vertex_count = mesh->vertex_count, .index_count = mesh->index_count};
    uint32_t *elements = g_new(uint32_t, 2 * (size_t)face_count);
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    static const float uv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (uint32_t f = 0; f < face_count; f++) {
        for (uint32_t i = 0; i < 4; i++) {
            FrVertex *vertex = &mesh->vertices[4 * f + i];
            memcpy(vertex->position, corners[4 * f + i].raw, sizeof vertex->position);
            memcpy(vertex->uv, uv[i], sizeof vertex->uv);
        }
        for (uint32_t i = 0; i < 6; i++) {
            mesh->indices[6 * f + i] = 4 * f + order[i];
        }
        elements[2 * f] = f;
        elements[2 * f + 1] = f;
    }
    FrLightMesh added = {.mesh = mesh,
                         .materials = g_memdup2(&material, sizeof material),
                         .elements = elements,
                         .element_count = face_count};
    FrLightStand stand = {test->meshes->len, glms_mat4_identity()};
    g_array_append_val(test->meshes, added);
    g_array_append_val(test->stands, stand);
    return test->stands->len - 1;
}

/// The walls of a cube of the given side about the origin, outer sides inwards.
static inline void cube_faces(float side, vec3s corners[24]) {
    for (int f = 0; f < 6; f++) {
        int axis = f / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        float sign = f % 2 == 0 ? -1.0f : 1.0f;
        for (int i = 0; i < 4; i++) {
            float a = i == 1 || i == 2 ? 0.5f : -0.5f, b = i >= 2 ? 0.5f : -0.5f;
            vec3s *corner = &corners[4 * f + i];
            corner->raw[axis] = 0.5f * sign * side;
            corner->raw[u] = (sign < 0.0f ? a : b) * side;
            corner->raw[v] = (sign < 0.0f ? b : a) * side;
        }
    }
}

static inline uint32_t add_cube(TestScene *test, float side, FrLightMaterial material) {
    vec3s corners[24];
    cube_faces(side, corners);
    return add_faces(test, corners, 6, material);
}

/// A level square that faces up.
static inline uint32_t add_plate(TestScene *test, vec3s middle, float side,
                                 FrLightMaterial material) {
    vec3s corners[4];
    for (int i = 0; i < 4; i++) {
        float a = i == 1 || i == 2 ? 0.5f : -0.5f, b = i >= 2 ? 0.5f : -0.5f;
        corners[i] = (vec3s){{middle.x + a * side, middle.y + b * side, middle.z}};
    }
    return add_faces(test, corners, 1, material);
}

/// Small squares anywhere in a box, turned anyhow.
static inline uint32_t add_leaves(TestScene *test, uint32_t count, uint64_t seed, vec3s min,
                                  vec3s max, float side, FrLightMaterial material) {
    vec3s *corners = g_new(vec3s, 4 * (size_t)count);
    for (uint32_t i = 0; i < count; i++) {
        FrKey key = fr_key_child(fr_key_root(seed), i);
        vec3s middle;
        for (int c = 0; c < 3; c++) {
            middle.raw[c] =
                min.raw[c] + (float)fr_random(key, 1, (uint32_t)c) * (max.raw[c] - min.raw[c]);
        }
        vec3s normal = {{(float)fr_random_normal(key, 2, 0), (float)fr_random_normal(key, 2, 1),
                         (float)fr_random_normal(key, 2, 2)}};
        normal = glms_vec3_normalize(normal);
        vec3s u = glms_vec3_scale(glms_vec3_normalize(glms_vec3_ortho(normal)), 0.5f * side);
        vec3s v = glms_vec3_cross(normal, u);
        corners[4 * i] = glms_vec3_sub(glms_vec3_sub(middle, u), v);
        corners[4 * i + 1] = glms_vec3_sub(glms_vec3_add(middle, u), v);
        corners[4 * i + 2] = glms_vec3_add(glms_vec3_add(middle, u), v);
        corners[4 * i + 3] = glms_vec3_add(glms_vec3_sub(middle, u), v);
    }
    uint32_t stand = add_faces(test, corners, count, material);
    g_free(corners);
    return stand;
}

static inline void add_lamp(TestScene *test, FrLamp lamp) {
    g_array_append_val(test->lamps, lamp);
}

/// Ray density of the scene, or the test fails.
static inline FrLight *light_of(const FrDensityParams *params, TestScene *test,
                                const FrContext *context) {
    FrLight *light = NULL;
    g_assert_cmpint(fr_light_density_new(params, context, &light), ==, FR_OK);
    g_assert_cmpint(fr_light_set_scene(light, test_scene(test), context), ==, FR_OK);
    return light;
}

static inline FrLightAnswer ask(FrLight *light, vec3s point, const FrContext *context) {
    FrLightAnswer answer;
    g_assert_cmpint(fr_light_query(light, &point, 1, context, &answer), ==, FR_OK);
    return answer;
}
