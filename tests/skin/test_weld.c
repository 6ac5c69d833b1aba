// Welded branches: one closed surface with their parents, whatever they stand on.
#include "mesh_check.h"

enum { NODES = 20 };

static FrPlant *trunk(float twist, const FrFinish *finish) {
    FrPlant *plant = fr_plant_new("trunk");
    vec3s hinge = {{1, 0, 0}};
    check_stem(plant, FR_NONE, NODES, 4.0F, 0.2F, 0.12F, check_straight,
               fr_rotation_about(hinge, twist));
    if (finish != NULL) {
        plant->axes.finish[0] = fr_plant_add_finish(plant, finish);
    }
    return plant;
}

static FrFinish welded(void) {
    return (FrFinish){.junction = FR_JUNCTION_WELDED, .cap_height = 1.0F, .relief_stretch = 4.0F};
}

static void branch(FrPlant *plant, uint32_t node, float degrees, float azimuth, float radius) {
    FrFinish finish = welded();
    float up = degrees * (float)G_PI / 180.0F, side = azimuth * (float)G_PI / 180.0F;
    vec3s hinge = {{cosf(side), sinf(side), 0}};
    uint32_t axis = check_stem(plant, node, 6, 1.2F, radius, 0.4F * radius,
                               fr_rotation_about(hinge, up), check_straight);
    plant->axes.finish[axis] = fr_plant_add_finish(plant, &finish);
}

// No triangle is seen from behind by its own normals.
static void assert_upright(const FrPlant *plant, const FrSkinParams *params) {
    FrMesh *mesh = check_skin(plant, params);
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        for (uint64_t i = 0; i < mesh->parts[p].index_count; i += 3) {
            const FrVertex *c[3];
            check_corners(mesh, &mesh->parts[p], i, c);
            vec3s sum = glms_vec3_add(glms_vec3_add(check_normal(c[0]), check_normal(c[1])),
                                      check_normal(c[2]));
            g_assert_cmpfloat(glms_vec3_dot(sum, check_area_vector(c)), >, 0.0F);
        }
    }
    fr_mesh_free(mesh);
}

static void assert_one_surface(const FrPlant *plant, const FrSkinParams *params) {
    g_assert_true(fr_plant_is_valid(plant, NULL));
    FrMesh *mesh = check_skin(plant, params);
    check_sound(mesh);
    CheckTopology topology = check_topology(mesh);
    g_assert_cmpuint(topology.open, ==, 0);
    g_assert_cmpint(topology.euler, ==, 2);
    fr_mesh_free(mesh);
}

static void test_angles(void) {
    FrSkinParams params = fr_skin_default();
    params.side_length = 0.005;
    for (float degrees = 30; degrees <= 150; degrees += 20) {
        for (float azimuth = 0; azimuth < 360; azimuth += 45) {
            for (int k = 0; k < 3; k++) {
                const float ratio[] = {0.1F, 0.3F, 0.6F};
                FrPlant *plant = trunk(0.0F, NULL);
                branch(plant, 10, degrees, azimuth, ratio[k] * plant->nodes.radius[10]);
                assert_one_surface(plant, &params);
                assert_upright(plant, &params);
                fr_plant_free(plant);
            }
        }
    }
}

// A spiral of branches, each of which bears one more.
static FrPlant *crown(float twist, const FrFinish *finish) {
    FrPlant *plant = trunk(twist, finish);
    for (uint32_t i = 0; i < 12; i++) {
        branch(plant, 4 + i, 60.0F, 137.5F * (float)i, 0.05F);
        branch(plant, plant->axes.first[plant->axes.count - 1] + 3, 50.0F, 40.0F, 0.012F);
    }
    return plant;
}

static void test_crown(void) {
    for (int k = 0; k < 3; k++) {
        FrPlant *plant = crown(0.04F * (float)k, NULL);
        for (int lod = 0; lod < 2; lod++) {
            FrSkinParams params = fr_skin_default();
            params.lod = lod;
            assert_one_surface(plant, &params);
        }
        fr_plant_free(plant);
    }
}

// Plates and furrows stand out from the tube that the collar lies on.
static void test_rough(void) {
    FrFinish rough = {.buttresses = 5,
                      .cap_height = 1.0F,
                      .buttress_depth = 1.5F,
                      .buttress_height = 4.0F,
                      .buttress_width = 0.7F,
                      .irregularity = 0.6F,
                      .relief = 0.1F,
                      .relief_count = 14.0F,
                      .relief_stretch = 4.0F};
    FrPlant *plant = crown(0.0F, &rough);
    FrMesh *mesh = check_skin(plant, NULL);
    check_sound(mesh);
    g_assert_cmpuint(check_topology(mesh).open, ==, 0);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// Where the branch stands bark goes on as it was: as long, measured in tiles, as it is wide.
static void test_bark(void) {
    FrPlant *plant = trunk(0.0F, NULL), *bare = trunk(0.0F, NULL);
    branch(plant, 10, 60.0F, 10.0F, 0.05F);
    FrMesh *mesh = check_skin(plant, NULL), *plain = check_skin(bare, NULL);
    double most = 0.0, usual = 0.0;
    for (int which = 0; which < 2; which++) {
        const FrMesh *seen = which == 0 ? plain : mesh;
        for (uint64_t i = 0; i < seen->parts[0].index_count; i += 3) {
            const FrVertex *c[3];
            check_corners(seen, &seen->parts[0], i, c);
            for (int k = 0; k < 3; k++) {
                const FrVertex *a = c[k], *b = c[(k + 1) % 3];
                double apart = (double)glms_vec3_distance(check_at(a), check_at(b));
                double tiles = hypot((double)(b->uv[0] - a->uv[0]), (double)(b->uv[1] - a->uv[1]));
                double *to = which == 0 ? &usual : &most;
                *to = check_at(a).z > 1.0F && apart > 0.01 ? fmax(*to, tiles / apart) : *to;
            }
        }
    }
    g_assert_cmpfloat(usual, >, 0.0);
    // Bark of thin branches has smaller tiles: by the root of how much thinner they are.
    g_assert_cmpfloat(most, <, 12.0 * usual);
    fr_mesh_free(mesh);
    fr_mesh_free(plain);
    fr_plant_free(plant);
    fr_plant_free(bare);
}

// What is too coarse, too near another one or too thick keeps its collar, and nothing else changes.
static void test_refused(void) {
    FrSkinParams coarse = fr_skin_default();
    coarse.lod = 3;
    FrPlant *plant = crown(0.0F, NULL), *collars = crown(0.0F, NULL);
    for (uint32_t k = 0; k < collars->axes.count; k++) {
        collars->axes.finish[k] = FR_NONE;
    }
    FrMesh *a = check_skin(plant, &coarse), *b = check_skin(collars, &coarse);
    g_assert_cmphex(fr_mesh_digest(a), ==, fr_mesh_digest(b));
    fr_mesh_free(a);
    fr_mesh_free(b);
    fr_plant_free(plant);
    fr_plant_free(collars);
    FrPlant *crowded = trunk(0.0F, NULL);
    for (uint32_t i = 0; i < 30; i++) {
        branch(crowded, 10, 60.0F, 12.0F * (float)i, 0.08F);
    }
    FrMesh *mesh = check_skin(crowded, NULL);
    check_sound(mesh);
    g_assert_cmpuint(check_topology(mesh).open, >, 0);
    fr_mesh_free(mesh);
    fr_plant_free(crowded);
}

static void test_threads(void) {
    FrPlant *plant = crown(0.03F, NULL);
    FrSkinParams params = fr_skin_default();
    FrMesh *one = check_skin(plant, &params);
    const int threads[] = {2, 3, 8};
    for (int k = 0; k < 3; k++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[k]);
        FrMesh *mesh = NULL;
        g_assert_cmpint(fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh), ==, FR_OK);
        g_assert_cmphex(fr_mesh_digest(mesh), ==, fr_mesh_digest(one));
        fr_mesh_free(mesh);
        fr_pool_free(context.pool);
    }
    fr_mesh_free(one);
    fr_plant_free(plant);
}

// A kept skin has the bits of a new one, also after a branch has come to stand elsewhere.
static void test_kept(void) {
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    FrSkin *skin = fr_skin_new(&params, FR_UP_Z);
    for (int k = 0; k < 3; k++) {
        FrPlant *plant = crown(k == 1 ? 0.03F : 0.0F, NULL);
        plant->axes.finish[1] = k == 2 ? FR_NONE : plant->axes.finish[1];
        FrMesh *whole = check_skin(plant, &params);
        g_assert_cmpint(fr_skin_update(skin, plant, false, &context), ==, FR_OK);
        FrMesh *kept = fr_skin_mesh(skin);
        g_assert_cmphex(fr_mesh_digest(kept), ==, fr_mesh_digest(whole));
        fr_mesh_free(kept);
        fr_mesh_free(whole);
        fr_plant_free(plant);
    }
    fr_skin_free(skin);
}

static void test_limit(void) {
    FrPlant *plant = crown(0.0F, NULL);
    FrMesh *mesh = check_skin(plant, NULL);
    uint64_t triangles = mesh->index_count / 3;
    fr_mesh_free(mesh);
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.triangles = triangles - 1;
    g_assert_cmpint(fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh), ==, FR_ERR_LIMIT);
    g_assert_null(mesh);
    fr_diags_free(context.diags);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/weld/a branch and its parent are one closed surface", test_angles);
    g_test_add_func("/skin/weld/a crown is one closed surface", test_crown);
    g_test_add_func("/skin/weld/plates and furrows are closed around a branch", test_rough);
    g_test_add_func("/skin/weld/bark is not stretched", test_bark);
    g_test_add_func("/skin/weld/what cannot be welded keeps its collar", test_refused);
    g_test_add_func("/skin/weld/threads do not change a bit", test_threads);
    g_test_add_func("/skin/weld/a kept skin has the same bits", test_kept);
    g_test_add_func("/skin/weld/triangles are counted again", test_limit);
    return g_test_run();
}
