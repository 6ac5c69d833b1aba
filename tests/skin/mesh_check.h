// What tests ask of a mesh: is it closed, which way does it face, is every triangle sound.
#pragma once

#include "frond/skin.h"

#include <cglm/struct.h>
#include <glib.h>
#include <math.h>
#include <string.h>

static inline vec3s check_at(const FrVertex *v) {
    return (vec3s){{v->position[0], v->position[1], v->position[2]}};
}

static inline vec3s check_normal(const FrVertex *v) {
    return (vec3s){{v->normal[0], v->normal[1], v->normal[2]}};
}

/// Three corners of triangle `index` / 3 of a part.
static inline void check_corners(const FrMesh *mesh, const FrMeshPart *part, uint64_t index,
                                 const FrVertex *corners[3]) {
    for (int k = 0; k < 3; k++) {
        uint32_t at = mesh->indices[part->first_index + index + (uint64_t)k];
        g_assert_cmpuint(at, <, part->vertex_count);
        corners[k] = &mesh->vertices[part->first_vertex + at];
    }
}

static inline vec3s check_area_vector(const FrVertex *const c[3]) {
    vec3s a = check_at(c[0]), b = check_at(c[1]), d = check_at(c[2]);
    return glms_vec3_scale(glms_vec3_cross(glms_vec3_sub(b, a), glms_vec3_sub(d, a)), 0.5F);
}

static inline double check_volume(const FrMesh *mesh) {
    double volume = 0.0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        for (uint64_t i = 0; i < mesh->parts[p].index_count; i += 3) {
            const FrVertex *c[3];
            check_corners(mesh, &mesh->parts[p], i, c);
            vec3s cross = glms_vec3_cross(check_at(c[1]), check_at(c[2]));
            volume += (double)glms_vec3_dot(check_at(c[0]), cross) / 6.0;
        }
    }
    return volume;
}

static inline double check_area(const FrMesh *mesh) {
    double area = 0.0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        for (uint64_t i = 0; i < mesh->parts[p].index_count; i += 3) {
            const FrVertex *c[3];
            check_corners(mesh, &mesh->parts[p], i, c);
            area += (double)glms_vec3_norm(check_area_vector(c));
        }
    }
    return area;
}

/// How often a closed mesh goes around a point: 1 inside, 0 outside (sum of solid angles; Van
/// Oosterom, Strackee 1983).
static inline double check_winding(const FrMesh *mesh, vec3s at) {
    double angle = 0.0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        for (uint64_t i = 0; i < mesh->parts[p].index_count; i += 3) {
            const FrVertex *corner[3];
            double v[3][3], length[3], dot[3];
            check_corners(mesh, &mesh->parts[p], i, corner);
            for (int k = 0; k < 3; k++) {
                for (int j = 0; j < 3; j++) {
                    v[k][j] = (double)corner[k]->position[j] - (double)at.raw[j];
                }
                length[k] = sqrt(v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2]);
            }
            for (int k = 0; k < 3; k++) {
                const double *a = v[k], *b = v[(k + 1) % 3];
                dot[k] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            }
            double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                            v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                            v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
            double below = length[0] * length[1] * length[2] + dot[0] * length[2] +
                           dot[1] * length[0] + dot[2] * length[1];
            angle += 2.0 * atan2(volume, below);
        }
    }
    return angle / (4.0 * G_PI);
}

/// Everything finite, normals of length 1 and on the side the triangle faces, no triangle without
/// area, parts within the mesh and in exact bounds.
static inline void check_sound(const FrMesh *mesh) {
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        g_assert_cmpuint(part->first_vertex + part->vertex_count, <=, mesh->vertex_count);
        g_assert_cmpuint(part->first_index + part->index_count, <=, mesh->index_count);
        float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
        for (uint64_t i = 0; i < part->vertex_count; i++) {
            const FrVertex *v = &mesh->vertices[part->first_vertex + i];
            for (int k = 0; k < 3; k++) {
                g_assert_true(isfinite(v->position[k]));
                low[k] = fminf(low[k], v->position[k]);
                high[k] = fmaxf(high[k], v->position[k]);
            }
            g_assert_true(isfinite(v->uv[0]) && isfinite(v->uv[1]));
            g_assert_cmpfloat_with_epsilon(glms_vec3_norm(check_normal(v)), 1.0F, 1e-3F);
        }
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat(part->min[k], ==, low[k]);
            g_assert_cmpfloat(part->max[k], ==, high[k]);
        }
        for (uint64_t i = 0; i < part->index_count; i += 3) {
            const FrVertex *c[3];
            check_corners(mesh, part, i, c);
            g_assert_cmpfloat(glms_vec3_norm(check_area_vector(c)), >, 0.0F);
        }
    }
}

typedef struct CheckTopology {
    int64_t euler; ///< vertices − edges + faces, equal positions joined
    uint64_t open; ///< edges that do not have one triangle each way
} CheckTopology;

static inline guint check_hash(gconstpointer key) {
    const uint32_t *words = key;
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        hash = fr_mix64(hash + words[k] + 1);
    }
    return (guint)hash;
}

static inline gboolean check_equal(gconstpointer a, gconstpointer b) {
    return memcmp(a, b, 12) == 0;
}

/// Joins vertices by bit-equal position and counts directed edges.
static inline CheckTopology check_topology(const FrMesh *mesh) {
    GHashTable *joined = g_hash_table_new_full(check_hash, check_equal, g_free, NULL);
    GHashTable *edges = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    uint64_t faces = 0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        for (uint64_t i = 0; i < mesh->parts[p].index_count; i += 3) {
            const FrVertex *c[3];
            uint64_t id[3];
            check_corners(mesh, &mesh->parts[p], i, c);
            for (int k = 0; k < 3; k++) {
                float at[3];
                for (int j = 0; j < 3; j++) {
                    at[j] = c[k]->position[j] + 0.0F;
                }
                gpointer found = g_hash_table_lookup(joined, at);
                if (found == NULL) {
                    found = GUINT_TO_POINTER(g_hash_table_size(joined) + 1);
                    g_hash_table_insert(joined, g_memdup2(at, sizeof at), found);
                }
                id[k] = GPOINTER_TO_UINT(found);
            }
            for (int k = 0; k < 3; k++) {
                uint64_t edge = id[k] << 32 | id[(k + 1) % 3];
                uint64_t times = GPOINTER_TO_UINT(g_hash_table_lookup(edges, &edge)) + 1;
                g_hash_table_insert(edges, g_memdup2(&edge, sizeof edge),
                                    GUINT_TO_POINTER((guint)times));
            }
            faces++;
        }
    }
    CheckTopology result = {0};
    uint64_t twice = 0;
    GHashTableIter iter;
    gpointer key, times;
    g_hash_table_iter_init(&iter, edges);
    while (g_hash_table_iter_next(&iter, &key, &times)) {
        uint64_t edge = *(uint64_t *)key, back = edge << 32 | edge >> 32;
        guint against = GPOINTER_TO_UINT(g_hash_table_lookup(edges, &back));
        result.open += GPOINTER_TO_UINT(times) != 1 || against != 1;
        twice += against > 0 ? 1 : 2;
    }
    result.euler = (int64_t)g_hash_table_size(joined) - (int64_t)(twice / 2) + (int64_t)faces;
    g_hash_table_destroy(joined);
    g_hash_table_destroy(edges);
    return result;
}

static inline FrMesh *check_skin(const FrPlant *plant, const FrSkinParams *params) {
    FrSkinParams plain = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh = NULL;
    FrStatus status =
        fr_skin_plant(plant, params != NULL ? params : &plain, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_OK);
    return mesh;
}

static inline FrMesh *check_shape(const FrPlant *plant, const FrShape *shape) {
    FrSkinParams plain = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh = NULL;
    FrPlant *copy = fr_plant_copy(plant);
    uint32_t index = fr_plant_add_shape(copy, shape);
    FrStatus status = fr_skin_shape(copy, index, &plain, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_OK);
    fr_plant_free(copy);
    return mesh;
}

/// A stem of equal internodes from the origin; each is turned by `turn` against the one before.
static inline uint32_t check_stem(FrPlant *plant, uint32_t bearer, uint32_t nodes, float length,
                                  float base, float tip, versors first, versors turn) {
    uint32_t axis = fr_plant_add_axis(plant, bearer, (vec3s){{0, 0, 0}}, base);
    for (uint32_t i = 0; i < nodes; i++) {
        float part = (float)(i + 1) / (float)nodes;
        fr_plant_add_node(plant, axis, i == 0 ? first : turn, length / (float)nodes,
                          base + part * (tip - base));
    }
    plant->axes.path[axis] = fr_key_root(axis);
    return axis;
}

static const versors check_straight = {{0, 0, 0, 1}};
