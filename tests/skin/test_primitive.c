// Primitives: closed, facing outwards, of the wanted size.
#include "mesh_check.h"

static const struct {
    FrShapeKind kind;
    int euler;
    double volume; ///< of extent 1 with very many segments
} closed[] = {
    {FR_SHAPE_BOX, 2, 1.0},
    {FR_SHAPE_SPHERE, 2, G_PI / 6.0},
    {FR_SHAPE_CONE, 2, G_PI / 12.0},
    {FR_SHAPE_CYLINDER, 2, G_PI / 4.0},
};

static void test_closed(void) {
    FrPlant *plant = fr_plant_new("primitive");
    for (size_t i = 0; i < G_N_ELEMENTS(closed); i++) {
        for (uint32_t detail = 3; detail < 130; detail += detail < 8 ? 1 : 40) {
            FrShape shape = {.kind = closed[i].kind, .size = {{2, 3, 0.5F}}, .detail = detail};
            FrMesh *mesh = check_shape(plant, &shape);
            check_sound(mesh);
            CheckTopology topology = check_topology(mesh);
            g_assert_cmpint(topology.euler, ==, closed[i].euler);
            g_assert_cmpuint(topology.open, ==, 0);
            g_assert_cmpfloat(check_volume(mesh), >, 0.0);
            if (detail > 100) {
                double volume = 3.0 * closed[i].volume;
                g_assert_cmpfloat_with_epsilon(check_volume(mesh), volume, 0.01 * volume);
                g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[0], 1.0F, 1e-2F);
                g_assert_cmpfloat_with_epsilon(mesh->parts[0].min[1], -1.5F, 1e-2F);
                g_assert_cmpfloat_with_epsilon(mesh->parts[0].min[2], 0.0F, 1e-6F);
                g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[2], 0.5F, 1e-6F);
            }
            fr_mesh_free(mesh);
        }
    }
    fr_plant_free(plant);
}

static void test_torus(void) {
    FrPlant *plant = fr_plant_new("torus");
    FrShape shape = {.kind = FR_SHAPE_TORUS, .size = {{4, 4, 1}}, .detail = 128};
    FrMesh *mesh = check_shape(plant, &shape);
    check_sound(mesh);
    CheckTopology topology = check_topology(mesh);
    g_assert_cmpint(topology.euler, ==, 0);
    g_assert_cmpuint(topology.open, ==, 0);
    // Pappus: 2π · 1.5 times π · 0.5².
    double volume = 2.0 * G_PI * 1.5 * G_PI * 0.25;
    g_assert_cmpfloat_with_epsilon(check_volume(mesh), volume, 0.01 * volume);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// Its hole is a point where it is half as thick as wide, and a line where it is flat besides.
static void test_torus_without_hole(void) {
    static const vec3s sizes[] = {{{1, 1, 1}}, {{2, 1, 4}}, {{5, 0, 3}}, {{0, 5, 3}}};
    for (size_t i = 0; i < G_N_ELEMENTS(sizes); i++) {
        FrPlant *plant = fr_plant_new("torus");
        FrShape shape = {.kind = FR_SHAPE_TORUS, .size = sizes[i], .detail = 24};
        FrMesh *mesh = check_shape(plant, &shape);
        for (uint64_t v = 0; v < mesh->vertex_count; v++) {
            g_assert_cmpfloat_with_epsilon(glms_vec3_norm(check_normal(&mesh->vertices[v])), 1.0F,
                                           1e-3F);
        }
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
}

static void test_flat(void) {
    static const struct {
        FrShapeKind kind;
        double area;
    } flat[] = {{FR_SHAPE_SQUARE, 1.0}, {FR_SHAPE_CIRCLE, G_PI / 4.0}, {FR_SHAPE_TRIANGLE, 0.5}};
    FrPlant *plant = fr_plant_new("flat");
    for (size_t i = 0; i < G_N_ELEMENTS(flat); i++) {
        FrShape shape = {.kind = flat[i].kind, .size = {{2, 1, 3}}, .detail = 100};
        FrMesh *mesh = check_shape(plant, &shape);
        check_sound(mesh);
        g_assert_true(mesh->parts[0].is_foliage);
        g_assert_cmpfloat_with_epsilon(check_area(mesh), 6.0 * flat[i].area, 0.01);
        for (uint64_t k = 0; k < mesh->index_count; k += 3) {
            const FrVertex *c[3];
            check_corners(mesh, &mesh->parts[0], k, c);
            g_assert_cmpfloat(check_area_vector(c).y, >, 0.0F);
        }
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
}

static void test_facing(void) {
    FrPlant *plant = fr_plant_new("facing");
    for (int kind = FR_SHAPE_BOX; kind <= FR_SHAPE_TRIANGLE; kind++) {
        FrShape shape = {.kind = (FrShapeKind)kind, .size = {{1, 1, 0.4F}}, .detail = 16};
        FrMesh *mesh = check_shape(plant, &shape);
        for (uint64_t k = 0; k < mesh->index_count; k += 3) {
            const FrVertex *c[3];
            check_corners(mesh, &mesh->parts[0], k, c);
            for (int j = 0; j < 3; j++) {
                float facing = glms_vec3_dot(check_area_vector(c), check_normal(c[j]));
                g_assert_cmpfloat(facing, >, 0.0F);
            }
        }
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/primitive/B1 closed ones have Euler number two and their volume",
                    test_closed);
    g_test_add_func("/skin/primitive/a torus has Euler number zero and Pappus' volume", test_torus);
    g_test_add_func("/skin/primitive/a torus without a hole has normals", test_torus_without_hole);
    g_test_add_func("/skin/primitive/flat ones face y and have their area", test_flat);
    g_test_add_func("/skin/primitive/normals are on the side that triangles face", test_facing);
    return g_test_run();
}
