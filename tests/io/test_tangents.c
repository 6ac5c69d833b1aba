#include "io/tangents.h"

#include <glib.h>
#include <math.h>

/// The unit square in the xy plane, seen from +z, with a picture upright on it (u to the right, v
/// downwards), stretched by `u_scale`.
static void tangents_of_square(float u_scale, float v_scale, float tangent[4][4]) {
    static const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    FrVertex vertices[4];
    for (int i = 0; i < 4; i++) {
        vertices[i] = (FrVertex){
            .position = {corners[i][0], corners[i][1], 0},
            .normal = {0, 0, 1},
            .uv = {u_scale * corners[i][0], v_scale * (1 - corners[i][1])},
        };
    }
    uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    FrMeshPart part = {.vertex_count = 4, .index_count = 6};
    FrMesh mesh = {.vertices = vertices,
                   .vertex_count = 4,
                   .indices = indices,
                   .index_count = 6,
                   .parts = &part,
                   .part_count = 1};
    FrContext context = fr_context_default();
    float(*made)[4] = fr_tangents_new(&mesh, &part, &context);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 4; k++) {
            tangent[i][k] = made[i][k];
        }
    }
    g_free(made);
}

static void upright(void) {
    float tangent[4][4];
    tangents_of_square(3, 0.5f, tangent);
    for (int i = 0; i < 4; i++) {
        // normal × tangent is y, which is up in the picture: the sign is +1.
        g_assert_cmpfloat_with_epsilon(tangent[i][0], 1, 1e-6f);
        g_assert_cmpfloat_with_epsilon(tangent[i][1], 0, 1e-6f);
        g_assert_cmpfloat_with_epsilon(tangent[i][2], 0, 1e-6f);
        g_assert_cmpfloat(tangent[i][3], ==, 1);
    }
}

static void mirrored(void) {
    float tangent[4][4];
    tangents_of_square(-1, 1, tangent);
    g_assert_cmpfloat_with_epsilon(tangent[2][0], -1, 1e-6f);
    g_assert_cmpfloat(tangent[2][3], ==, -1);
    tangents_of_square(1, -1, tangent); // upside down
    g_assert_cmpfloat_with_epsilon(tangent[2][0], 1, 1e-6f);
    g_assert_cmpfloat(tangent[2][3], ==, -1);
}

static void without_picture(void) {
    float tangent[4][4];
    tangents_of_square(0, 0, tangent);
    for (int i = 0; i < 4; i++) {
        float norm = tangent[i][0] * tangent[i][0] + tangent[i][1] * tangent[i][1];
        g_assert_cmpfloat_with_epsilon(norm, 1, 1e-6f);
        g_assert_cmpfloat_with_epsilon(tangent[i][2], 0, 1e-6f);
        g_assert_cmpfloat(fabsf(tangent[i][3]), ==, 1);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/io/tangents/they follow u, and the sign puts up upwards", upright);
    g_test_add_func("/io/tangents/mirrored pictures change the sign", mirrored);
    g_test_add_func("/io/tangents/without coordinates they still are unit and perpendicular",
                    without_picture);
    return g_test_run();
}
