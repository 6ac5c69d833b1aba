// Texture coordinates of bark: anchored, whole around, nowhere torn or stretched.
#include "mesh_check.h"

static FrPlant *tapering(void) {
    FrPlant *plant = fr_plant_new("tapering");
    check_stem(plant, FR_NONE, 30, 6.0F, 0.25F, 0.02F, check_straight,
               fr_rotation_about((vec3s){{1, 0, 0}}, 0.03F));
    check_stem(plant, 10, 10, 2.0F, 0.06F, 0.01F, fr_rotation_about((vec3s){{0, 1, 0}}, 1.0F),
               check_straight);
    check_stem(plant, 12, 10, 2.0F, 0.06F, 0.01F, fr_rotation_about((vec3s){{0, 1, 0}}, 1.0F),
               check_straight);
    return plant;
}

static void test_base(void) {
    FrPlant *plant = tapering();
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    FrMesh *mesh = check_skin(plant, &params);
    uint32_t columns = 0;
    while (fabsf(mesh->vertices[columns].position[2]) < 1e-6F) {
        g_assert_cmpfloat(mesh->vertices[columns].uv[1], ==, 0.0F);
        columns++;
    }
    // 2π · 0.25 m is three tiles of the plain half metre.
    g_assert_cmpfloat(mesh->vertices[0].uv[0], ==, 0.0F);
    g_assert_cmpfloat(mesh->vertices[columns - 1].uv[0], ==, 3.0F);
    g_assert_true(memcmp(mesh->vertices[0].position, mesh->vertices[columns - 1].position, 12) ==
                  0);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// In every triangle of a side a tile is about as tall as it is wide, from the base to where tiles
// shrink no further, and pictures stand upright.
static void test_no_stretch(void) {
    FrPlant *plant = fr_plant_new("cone");
    check_stem(plant, FR_NONE, 30, 6.0F, 0.25F, 0.06F, check_straight, check_straight);
    plant->axes.flags[0] |= FR_CUT;
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    FrMesh *mesh = check_skin(plant, &params);
    for (uint64_t i = 0; i < mesh->index_count; i += 3) {
        const FrVertex *c[3];
        check_corners(mesh, &mesh->parts[0], i, c);
        vec3s p = glms_vec3_sub(check_at(c[1]), check_at(c[0]));
        vec3s q = glms_vec3_sub(check_at(c[2]), check_at(c[0]));
        float pu = c[1]->uv[0] - c[0]->uv[0], pv = c[1]->uv[1] - c[0]->uv[1];
        float qu = c[2]->uv[0] - c[0]->uv[0], qv = c[2]->uv[1] - c[0]->uv[1];
        float area = pu * qv - pv * qu;
        g_assert_cmpfloat(area, <, 0.0F); // v points down
        vec3s by_u = glms_vec3_scale(glms_vec3_sub(glms_vec3_scale(p, qv), glms_vec3_scale(q, pv)),
                                     1.0F / area);
        vec3s by_v = glms_vec3_scale(glms_vec3_sub(glms_vec3_scale(q, pu), glms_vec3_scale(p, qu)),
                                     1.0F / area);
        g_assert_cmpfloat(by_v.z, <, 0.0F);
        (void)by_u;
    }
    // Ring by ring: height of a tile over its width, by the mean radius of the band.
    const FrVertex *v = mesh->vertices;
    for (uint64_t i = 0; i + 1 < mesh->vertex_count; i++) {
        if (v[i + 1].uv[0] != 0.0F || v[i + 1].position[2] == 0.0F) {
            continue;
        }
        uint64_t columns = 0;
        while (v[columns + 1].uv[0] != 0.0F) {
            columns++;
        }
        columns++;
        const FrVertex *high = &v[i + 1], *low = high - columns;
        float length = glms_vec3_distance(check_at(high), check_at(low));
        float tall = length / (low->uv[1] - high->uv[1]);
        float radius_low = hypotf(low->position[0], low->position[1]);
        float radius_high = hypotf(high->position[0], high->position[1]);
        float wide_most = 2.0F * (float)G_PI * radius_low / 3.0F;
        float wide_least = 2.0F * (float)G_PI * radius_high / 3.0F;
        g_assert_cmpfloat(tall, <, 1.02F * wide_most);
        g_assert_cmpfloat(tall, >, 0.98F * wide_least);
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_no_jump(void) {
    FrPlant *plant = tapering();
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    FrMesh *mesh = check_skin(plant, &params);
    for (uint64_t i = 0; i < mesh->index_count; i += 3) {
        const FrVertex *c[3];
        check_corners(mesh, &mesh->parts[0], i, c);
        for (int k = 0; k < 3; k++) {
            const FrVertex *a = c[k], *b = c[(k + 1) % 3];
            float length = glms_vec3_distance(check_at(a), check_at(b));
            // No more tiles over an edge than the thinnest twig's size of tiles gives.
            g_assert_cmpfloat(fabsf(a->uv[0] - b->uv[0]), <, 0.35F);
            g_assert_cmpfloat(fabsf(a->uv[1] - b->uv[1]), <, 1e-3F + length / 0.06F);
        }
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// The two branches are alike but for their paths.
static void test_offset(void) {
    FrPlant *plant = tapering();
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    FrMesh *mesh = check_skin(plant, &params);
    FrPlant *bare = fr_plant_copy(plant);
    bare->axes.flags[1] |= FR_HIDDEN;
    bare->axes.flags[2] |= FR_HIDDEN;
    FrMesh *stem = check_skin(bare, &params);
    uint64_t each = (mesh->vertex_count - stem->vertex_count) / 2;
    const FrVertex *one = mesh->vertices + stem->vertex_count, *two = one + each;
    g_assert_cmpfloat(fabsf(one->uv[0] - two->uv[0]), >, 1e-3F);
    // Hiding the branches has not moved the stem's bark.
    g_assert_true(memcmp(mesh->vertices, stem->vertices, stem->vertex_count * sizeof(FrVertex)) ==
                  0);
    fr_mesh_free(stem);
    fr_mesh_free(mesh);
    fr_plant_free(bare);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/bark/a stem begins at v 0 with a whole number of tiles around",
                    test_base);
    g_test_add_func("/skin/bark/tiles are as tall as wide and stand upright", test_no_stretch);
    g_test_add_func("/skin/bark/no edge jumps across the picture", test_no_jump);
    g_test_add_func("/skin/bark/branches begin elsewhere in the picture, by their paths",
                    test_offset);
    return g_test_run();
}
