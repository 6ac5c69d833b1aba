// Embree's answers against the triangle test of Möller and Trumbore 1997 applied to every triangle
// in world coordinates.
#include "frond/rays.h"

#include "frond/random.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct Hits {
    float distance;
    uint32_t stand, part, triangle;
    vec3s normal;
} Hits;

typedef struct Stand {
    const FrMesh *mesh;
    mat4s transform;
} Stand;

static float uniform(FrKey key, uint32_t k) {
    return (float)fr_random_signed(key, 1, k);
}

static vec3s random_point(FrKey key, uint32_t k) {
    return (vec3s){{uniform(key, 3 * k), uniform(key, 3 * k + 1), uniform(key, 3 * k + 2)}};
}

// `parts` parts of `triangles` small triangles each, scattered in a box of two metres.
static FrMesh *random_mesh(uint64_t seed, uint32_t parts, uint32_t triangles) {
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->part_count = parts;
    mesh->parts = g_new0(FrMeshPart, parts);
    mesh->vertex_count = mesh->index_count = (uint64_t)parts * triangles * 3;
    mesh->vertices = g_new0(FrVertex, mesh->vertex_count);
    mesh->indices = g_new0(uint32_t, mesh->index_count);
    FrKey key = fr_key_root(seed);
    for (uint32_t p = 0; p < parts; p++) {
        uint64_t first = (uint64_t)p * triangles * 3;
        mesh->parts[p] = (FrMeshPart){.material = FR_NONE,
                                      .first_vertex = first,
                                      .vertex_count = triangles * 3,
                                      .first_index = first,
                                      .index_count = triangles * 3};
        for (uint32_t i = 0; i < triangles * 3; i++) {
            FrKey triangle = fr_key_child(key, p * triangles + i / 3);
            vec3s at = glms_vec3_add(random_point(triangle, 0),
                                     glms_vec3_scale(random_point(triangle, 1 + i % 3), 0.2f));
            memcpy(mesh->vertices[first + i].position, at.raw, sizeof at.raw);
            mesh->indices[first + i] = i;
        }
    }
    return mesh;
}

static void free_mesh(FrMesh *mesh) {
    g_free(mesh->vertices);
    g_free(mesh->indices);
    g_free(mesh->parts);
    g_free(mesh);
}

static vec3s corner(const Stand *stand, const FrMeshPart *part, uint64_t index) {
    const FrMesh *mesh = stand->mesh;
    uint64_t vertex = part->first_vertex + mesh->indices[part->first_index + index];
    const float *p = mesh->vertices[vertex].position;
    return glms_mat4_mulv3(stand->transform, (vec3s){{p[0], p[1], p[2]}}, 1.0f);
}

static Hits nearest(const Stand *stands, uint32_t count, vec3s origin, vec3s direction, float near,
                    float far) {
    Hits best = {.distance = INFINITY};
    for (uint32_t s = 0; s < count; s++) {
        for (uint32_t p = 0; p < stands[s].mesh->part_count; p++) {
            const FrMeshPart *part = &stands[s].mesh->parts[p];
            for (uint32_t t = 0; t < part->index_count / 3; t++) {
                vec3s a = corner(&stands[s], part, 3 * (uint64_t)t);
                vec3s e1 = glms_vec3_sub(corner(&stands[s], part, 3 * (uint64_t)t + 1), a);
                vec3s e2 = glms_vec3_sub(corner(&stands[s], part, 3 * (uint64_t)t + 2), a);
                vec3s q = glms_vec3_cross(direction, e2);
                float determinant = glms_vec3_dot(e1, q);
                vec3s from = glms_vec3_sub(origin, a);
                float u = glms_vec3_dot(from, q) / determinant;
                vec3s r = glms_vec3_cross(from, e1);
                float v = glms_vec3_dot(direction, r) / determinant;
                float distance = glms_vec3_dot(e2, r) / determinant;
                if (u >= 0 && v >= 0 && u + v <= 1 && distance >= near && distance <= far &&
                    distance < best.distance) {
                    best = (Hits){distance, s, p, t, glms_vec3_normalize(glms_vec3_cross(e1, e2))};
                }
            }
        }
    }
    return best;
}

static void test_brute_force(void) {
    FrMesh *first = random_mesh(1, 2, 40);
    FrMesh *second = random_mesh(2, 1, 60);
    Stand stands[3];
    mat4s identity = glms_mat4_identity();
    stands[0] = (Stand){first, identity};
    stands[1] =
        (Stand){second, glms_rotate(glms_translate(identity, (vec3s){{1, 2, 0}}), 0.7f, GLMS_ZUP)};
    stands[2] = (Stand){first, glms_scale(glms_translate(identity, (vec3s){{-2, 0, 1}}),
                                          (vec3s){{1.0f, 2.0f, 0.5f}})};
    FrRays *rays = fr_rays_new(NULL, NULL);
    uint32_t a = fr_rays_add_mesh(rays, first);
    uint32_t b = fr_rays_add_mesh(rays, second);
    const uint32_t meshes[3] = {a, b, a};
    for (uint32_t i = 0; i < 3; i++) {
        g_assert_cmpuint(fr_rays_add_stand(rays, meshes[i], stands[i].transform), ==, i);
    }
    fr_rays_commit(rays);

    uint32_t hits = 0;
    for (uint32_t i = 0; i < 4000; i++) {
        FrKey key = fr_key_child(fr_key_root(3), i);
        vec3s origin = glms_vec3_scale(random_point(key, 0), 4.0f);
        vec3s towards = glms_vec3_scale(random_point(key, 1), 1.5f);
        vec3s direction = glms_vec3_normalize(glms_vec3_sub(towards, origin));
        float far = i % 2 == 0 ? 100.0f : 3.5f;
        Hits want = nearest(stands, 3, origin, direction, 0.01f, far);
        FrHit got = fr_rays_trace(rays, origin, direction, 0.01f, far);
        if (isinf(want.distance)) {
            g_assert_true(isinf(got.distance));
        } else {
            hits++;
            g_assert_cmpfloat_with_epsilon(got.distance, want.distance, 1e-4);
            g_assert_cmpuint(got.stand, ==, want.stand);
            g_assert_cmpuint(got.mesh, ==, meshes[want.stand]);
            g_assert_cmpuint(got.part, ==, want.part);
            g_assert_cmpuint(got.triangle, ==, want.triangle);
            g_assert_cmpfloat(glms_vec3_distance(got.normal, want.normal), <, 1e-3f);
        }
        g_assert_true(fr_rays_is_blocked(rays, origin, direction, 0.01f, far) ==
                      !isinf(want.distance));
    }
    g_assert_cmpuint(hits, >, 300);
    fr_rays_free(rays);
    free_mesh(first);
    free_mesh(second);
}

// The unit square in the plane z = 0, facing up, as two triangles.
static FrMesh *square_mesh(void) {
    static const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    FrMesh *mesh = g_new0(FrMesh, 1);
    mesh->part_count = 1;
    mesh->parts = g_new0(FrMeshPart, 1);
    mesh->parts[0] = (FrMeshPart){.material = FR_NONE, .vertex_count = 4, .index_count = 6};
    mesh->vertex_count = 4;
    mesh->index_count = 6;
    mesh->vertices = g_new0(FrVertex, 4);
    for (int i = 0; i < 4; i++) {
        mesh->vertices[i].position[0] = corners[i][0];
        mesh->vertices[i].position[1] = corners[i][1];
    }
    mesh->indices = g_memdup2(indices, sizeof indices);
    return mesh;
}

// The first triangle is (0,0) (1,0) (1,1): u + v is the x of the point.
static bool left_is_hole(void *user, uint32_t mesh, uint32_t part, uint32_t triangle, float u,
                         float v) {
    g_atomic_int_inc((gint *)user);
    g_assert_cmpuint(mesh, ==, 0);
    g_assert_cmpuint(part, ==, 0);
    return triangle == 0 && u + v < 0.5f;
}

static void test_holes(void) {
    gint calls = 0;
    FrMesh *square = square_mesh();
    FrRays *rays = fr_rays_new(left_is_hole, &calls);
    uint32_t mesh = fr_rays_add_mesh(rays, square);
    mat4s identity = glms_mat4_identity();
    fr_rays_add_stand(rays, mesh, identity);
    fr_rays_add_stand(rays, mesh, glms_translate(identity, (vec3s){{0.4f, 0, -1}}));
    fr_rays_commit(rays);
    vec3s down = {{0, 0, -1}};

    FrHit solid = fr_rays_trace(rays, (vec3s){{0.7f, 0.1f, 1}}, down, 0, 10);
    g_assert_cmpuint(solid.stand, ==, 0);
    g_assert_cmpfloat(solid.distance, ==, 1.0f);
    g_assert_cmpfloat(solid.normal.z, ==, 1.0f);
    g_assert_cmpint(calls, >, 0);
    // Through the hole of the first, and on its x = 0.05 of the second through that one's too.
    FrHit both = fr_rays_trace(rays, (vec3s){{0.45f, 0.02f, 1}}, down, 0, 10);
    g_assert_true(isinf(both.distance));
    g_assert_false(fr_rays_is_blocked(rays, (vec3s){{0.45f, 0.02f, 1}}, down, 0, 10));
    // Through the hole of the first on to the solid half of the second's other triangle.
    FrHit second = fr_rays_trace(rays, (vec3s){{0.45f, 0.3f, 1}}, down, 0, 10);
    g_assert_cmpuint(second.stand, ==, 1);
    g_assert_cmpuint(second.triangle, ==, 1);
    g_assert_true(fr_rays_is_blocked(rays, (vec3s){{0.45f, 0.3f, 1}}, down, 0, 10));
    fr_rays_free(rays);
    free_mesh(square);
}

static void test_mirrored(void) {
    FrMesh *square = square_mesh();
    FrRays *rays = fr_rays_new(NULL, NULL);
    uint32_t mesh = fr_rays_add_mesh(rays, square);
    fr_rays_add_stand(rays, mesh, glms_scale(glms_mat4_identity(), (vec3s){{-1, 1, 1}}));
    fr_rays_commit(rays);
    FrHit hit = fr_rays_trace(rays, (vec3s){{-0.5f, 0.2f, -3}}, (vec3s){{0, 0, 1}}, 0.0f, INFINITY);
    g_assert_cmpfloat(hit.distance, ==, 3.0f);
    // The mesh's outer side is +z, also of its mirror image.
    g_assert_cmpfloat(hit.normal.z, ==, 1.0f);
    fr_rays_free(rays);
    free_mesh(square);
}

static void test_nothing(void) {
    FrMesh empty = {0};
    FrMesh *square = square_mesh();
    FrMeshPart no_triangles = {.material = FR_NONE};
    FrMesh hollow = {.parts = &no_triangles, .part_count = 1};
    FrMesh *broken = square_mesh();
    broken->vertices[2].position[1] = NAN;
    FrRays *rays = fr_rays_new(NULL, NULL);
    mat4s identity = glms_mat4_identity();
    mat4s unusable = identity;
    unusable.m30 = NAN;
    fr_rays_add_stand(rays, fr_rays_add_mesh(rays, &empty), identity);
    fr_rays_add_stand(rays, fr_rays_add_mesh(rays, &hollow), identity);
    fr_rays_add_stand(rays, fr_rays_add_mesh(rays, broken), identity);
    uint32_t whole = fr_rays_add_mesh(rays, square);
    fr_rays_add_stand(rays, whole, unusable);
    fr_rays_add_stand(rays, whole, glms_scale(identity, (vec3s){{1, 0, 1}}));
    fr_rays_commit(rays);
    vec3s above = {{0.6f, 0.3f, 1}};
    vec3s down = {{0, 0, -1}};
    FrHit hit = fr_rays_trace(rays, above, down, 0, 10);
    g_assert_true(isinf(hit.distance));
    g_assert_cmpuint(hit.stand, ==, FR_NONE);
    g_assert_false(fr_rays_is_blocked(rays, above, down, 0, 10));
    fr_rays_free(rays);

    rays = fr_rays_new(NULL, NULL);
    fr_rays_add_stand(rays, fr_rays_add_mesh(rays, square), identity);
    fr_rays_commit(rays);
    g_assert_true(fr_rays_is_blocked(rays, above, down, 0, 10));
    g_assert_false(fr_rays_is_blocked(rays, (vec3s){{NAN, 0, 1}}, down, 0, 10));
    g_assert_false(fr_rays_is_blocked(rays, above, (vec3s){{0, INFINITY, 0}}, 0, 10));
    g_assert_false(fr_rays_is_blocked(rays, above, down, 0, NAN));
    fr_rays_free(rays);
    free_mesh(square);
    free_mesh(broken);
}

static void test_denormals(void) {
    FrMesh *square = square_mesh();
    FrRays *rays = fr_rays_new(NULL, NULL);
    fr_rays_add_stand(rays, fr_rays_add_mesh(rays, square), glms_mat4_identity());
    fr_rays_commit(rays);
    fr_rays_trace(rays, (vec3s){{0.6f, 0.3f, 1}}, (vec3s){{0, 0, -1}}, 0, 10);
    volatile float smallest = 1e-40f;
    g_assert_cmpfloat(smallest * 0.5f, >, 0.0f);
    fr_rays_free(rays);
    free_mesh(square);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/space/rays/hits are those of the test of every triangle", test_brute_force);
    g_test_add_func("/space/rays/a hole lets rays through", test_holes);
    g_test_add_func("/space/rays/a mirror image keeps its outer side", test_mirrored);
    g_test_add_func("/space/rays/empty, flat and broken things are never hit", test_nothing);
    g_test_add_func("/space/rays/a query leaves the caller's denormals alone", test_denormals);
    return g_test_run();
}
