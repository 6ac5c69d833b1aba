// Finishes: what is neutral changes nothing; ends are closed, hollow or open as they are told to
// be; ridges and relief stand out from the tube and close around it.
#include "mesh_check.h"

static const FrFinish neutral = {.cap_height = 1.0F,
                                 .buttress_depth = 1.5F,
                                 .buttress_height = 4.0F,
                                 .buttress_width = 0.7F,
                                 .irregularity = 0.6F,
                                 .relief_count = 14.0F,
                                 .relief_stretch = 4.0F};

static FrPlant *trunk(const FrFinish *finish) {
    FrPlant *plant = fr_plant_new("trunk");
    check_stem(plant, FR_NONE, 24, 2.0F, 0.2F, 0.2F, check_straight, check_straight);
    plant->axes.flags[0] |= FR_CUT;
    if (finish != NULL) {
        plant->axes.finish[0] = fr_plant_add_finish(plant, finish);
    }
    g_assert_true(fr_plant_is_valid(plant, NULL));
    return plant;
}

static FrMesh *mesh_of(FrFinish finish, const FrSkinParams *params) {
    FrPlant *plant = trunk(&finish);
    FrMesh *mesh = check_skin(plant, params);
    check_sound(mesh);
    fr_plant_free(plant);
    return mesh;
}

static void assert_closed(const FrMesh *mesh, int64_t euler) {
    CheckTopology topology = check_topology(mesh);
    g_assert_cmpuint(topology.open, ==, 0);
    g_assert_cmpint(topology.euler, ==, euler);
    g_assert_cmpfloat(check_volume(mesh), >, 0.0);
}

static void test_neutral(void) {
    FrPlant *plain = trunk(NULL);
    FrMesh *a = check_skin(plain, NULL), *b = mesh_of(neutral, NULL);
    g_assert_cmphex(fr_mesh_digest(a), ==, fr_mesh_digest(b));
    fr_mesh_free(a);
    fr_mesh_free(b);
    fr_plant_free(plain);
}

static void test_dome(void) {
    FrFinish finish = neutral;
    finish.cap = FR_CAP_ROUND;
    FrSkinParams params = fr_skin_default();
    params.max_sides = 128;
    params.side_length = 0.002;
    FrMesh *mesh = mesh_of(finish, &params);
    assert_closed(mesh, 2);
    // A cylinder and half a ball, of which five rings are a little less.
    double volume = G_PI * 0.04 * 2.0 + 2.0 / 3.0 * G_PI * 0.008;
    g_assert_cmpfloat_with_epsilon(check_volume(mesh), volume, 0.005 * volume);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[2], 2.2F, 1e-5F);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        vec3s at = check_at(&mesh->vertices[i]);
        vec3s out = glms_vec3_sub(at, (vec3s){{0, 0, 2.0F}});
        if (at.z > 2.01F && at.z < 2.19F) {
            float cosine =
                glms_vec3_dot(glms_vec3_normalize(out), check_normal(&mesh->vertices[i]));
            g_assert_cmpfloat(cosine, >, 0.995F);
        }
    }
    fr_mesh_free(mesh);
}

static void test_break(void) {
    FrFinish finish = neutral;
    finish.cap = FR_CAP_BROKEN;
    FrMesh *mesh = mesh_of(finish, NULL);
    assert_closed(mesh, 2);
    g_assert_cmpfloat(mesh->parts[0].max[2], >, 2.05F);
    g_assert_cmpfloat(mesh->parts[0].max[2], <, 2.2001F);
    FrPlant *other = trunk(&finish);
    other->axes.path[0] = fr_key_root(77);
    FrMesh *another = check_skin(other, NULL);
    g_assert_cmphex(fr_mesh_digest(mesh), !=, fr_mesh_digest(another));
    fr_mesh_free(another);
    fr_plant_free(other);
    fr_mesh_free(mesh);
}

static void test_hollow(void) {
    FrFinish finish = neutral;
    finish.wall = 0.25F;
    FrSkinParams params = fr_skin_default();
    params.max_sides = 128;
    params.side_length = 0.001;
    FrMesh *mesh = mesh_of(finish, &params);
    assert_closed(mesh, 2);
    double wall = G_PI * (0.04 - 0.0225) * 2.0;
    g_assert_cmpfloat_with_epsilon(check_volume(mesh), wall, 1e-3 * wall);
    g_assert_cmpfloat_with_epsilon(check_winding(mesh, (vec3s){{0, 0, 1}}), 0.0, 1e-3);
    g_assert_cmpfloat_with_epsilon(check_winding(mesh, (vec3s){{0.18F, 0, 1}}), 1.0, 1e-3);
    fr_mesh_free(mesh);
    finish.is_open = 1;
    mesh = mesh_of(finish, &params);
    assert_closed(mesh, 0); // a ring
    g_assert_cmpfloat_with_epsilon(check_volume(mesh), wall, 1e-3 * wall);
    fr_mesh_free(mesh);
    finish.cap = FR_CAP_BROKEN;
    finish.relief = 0.1F;
    mesh = mesh_of(finish, NULL);
    assert_closed(mesh, 0);
    fr_mesh_free(mesh);
}

static void test_open(void) {
    FrFinish finish = neutral;
    finish.cap = FR_CAP_OPEN;
    FrMesh *mesh = mesh_of(finish, NULL);
    g_assert_cmpuint(check_topology(mesh).open, ==, 48);
    fr_mesh_free(mesh);
}

// Every vertex of a rough tube is at least as far out as the tube is.
static void test_outwards(void) {
    FrFinish finish = neutral;
    finish.relief = 0.2F;
    finish.buttresses = 6;
    FrMesh *mesh = mesh_of(finish, NULL);
    assert_closed(mesh, 2);
    float most_low = 0, most_high = 0;
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        vec3s at = check_at(&mesh->vertices[i]);
        float out = hypotf(at.x, at.y);
        bool is_middle = out < 1e-6F; // of a disc
        g_assert_true(is_middle || out > 0.2F - 1e-5F);
        most_low = fmaxf(most_low, at.z < 0.01F ? out : 0);
        most_high = fmaxf(most_high, at.z > 0.9F ? out : 0);
    }
    g_assert_cmpfloat(most_low, >, 0.4F);
    g_assert_cmpfloat(most_low, <=, 0.2F * (1 + 0.2F + 1.5F) + 1e-5F);
    g_assert_cmpfloat(most_high, >, 0.22F);
    g_assert_cmpfloat(most_high, <=, 0.24F + 1e-5F);
    fr_mesh_free(mesh);
}

// As many ridges as were asked for, counted at the ground.
static void test_buttresses(void) {
    for (uint32_t count = 1; count < 12; count += 2) {
        FrFinish finish = neutral;
        finish.buttresses = count;
        finish.irregularity = 0.0F;
        FrMesh *mesh = mesh_of(finish, NULL);
        uint32_t crests = 0, sides = 0;
        while (mesh->vertices[sides].position[2] < 1e-6F) {
            sides++;
        }
        sides -= 1;
        for (uint32_t i = 0; i < sides; i++) {
            float out[3];
            for (uint32_t k = 0; k < 3; k++) {
                const float *at = mesh->vertices[(i + sides + k - 1) % sides].position;
                out[k] = hypotf(at[0], at[1]);
            }
            crests += out[1] > out[0] + 1e-4F && out[1] > out[2] + 1e-4F;
        }
        g_assert_cmpuint(crests, ==, count);
        fr_mesh_free(mesh);
    }
}

static void test_levels(void) {
    FrFinish finish = neutral;
    finish.relief = 0.2F;
    finish.buttresses = 5;
    finish.cap = FR_CAP_ROUND;
    uint64_t before = UINT64_MAX;
    for (int lod = 0; lod <= 5; lod++) {
        FrSkinParams params = fr_skin_default();
        params.lod = lod;
        FrMesh *mesh = mesh_of(finish, &params);
        assert_closed(mesh, 2);
        g_assert_cmpuint(mesh->index_count, <, before);
        before = mesh->index_count;
        fr_mesh_free(mesh);
    }
}

// A branch that begins within its parent is a closed tube of its own.
static void test_plain_junction(void) {
    FrPlant *plant = trunk(NULL);
    uint32_t twig = check_stem(plant, 12, 3, 0.8F, 0.05F, 0.01F,
                               fr_rotation_about((vec3s){{0, 1, 0}}, 1.0F), check_straight);
    FrMesh *collar = check_skin(plant, NULL);
    FrFinish finish = neutral;
    finish.junction = FR_JUNCTION_PLAIN;
    plant->axes.finish[twig] = fr_plant_add_finish(plant, &finish);
    FrMesh *mesh = check_skin(plant, NULL);
    check_sound(mesh);
    assert_closed(mesh, 4); // two of them
    g_assert_cmpuint(check_topology(collar).open, >, 0);
    g_assert_cmpuint(mesh->index_count, <, collar->index_count);
    fr_mesh_free(mesh);
    fr_mesh_free(collar);
    fr_plant_free(plant);
}

static FrPlant *felled(FrFinish finish, float wall) {
    FrPlant *plant = fr_plant_new("felled");
    check_stem(plant, FR_NONE, 24, 2.0F, 0.2F, 0.2F, check_straight, check_straight);
    plant->axes.flags[0] |= FR_CUT;
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    FrMaterial *wood = fr_material_new("wood", &params, ".", (FrSpan){0});
    finish.face = fr_plant_add_material(plant, wood) + 1;
    finish.wall = wall;
    plant->axes.finish[0] = fr_plant_add_finish(plant, &finish);
    fr_material_unref(wood);
    fr_params_clear(fr_material_table(), &params);
    return plant;
}

// What a saw or a storm lays bare has a material of its own; the surface is closed all the same.
static void test_face(void) {
    const uint32_t caps[] = {FR_CAP_FLAT, FR_CAP_BROKEN};
    for (int i = 0; i < 4; i++) {
        FrFinish finish = neutral;
        finish.cap = caps[i % 2];
        FrPlant *plant = felled(finish, i < 2 ? 0.0F : 0.3F);
        FrMesh *mesh = check_skin(plant, NULL);
        check_sound(mesh);
        g_assert_cmpuint(mesh->part_count, ==, 2);
        g_assert_cmpuint(mesh->parts[0].material, ==, FR_NONE);
        g_assert_cmpuint(mesh->parts[1].material, ==, 0);
        assert_closed(mesh, 2);
        g_assert_cmpfloat(mesh->parts[1].max[2], >=, 2.0F);
        if (i == 0) {
            g_assert_cmpfloat(mesh->parts[1].min[2], >, 1.9999F); // a disc
        }
        FrSkinParams params = fr_skin_default();
        FrContext context = fr_context_default();
        FrSkin *skin = fr_skin_new(&params, FR_UP_Z);
        g_assert_cmpint(fr_skin_update(skin, plant, false, &context), ==, FR_OK);
        FrMesh *kept = fr_skin_mesh(skin);
        g_assert_cmphex(fr_mesh_digest(kept), ==, fr_mesh_digest(mesh));
        fr_mesh_free(kept);
        fr_skin_free(skin);
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
}

// No lengths, no radii, all at its extremes.
static void test_hostile(void) {
    const uint32_t caps[] = {FR_CAP_FLAT, FR_CAP_ROUND, FR_CAP_BROKEN, FR_CAP_OPEN};
    for (uint32_t i = 0; i < 64; i++) {
        FrFinish finish = {.cap = caps[i % 4],
                           .is_open = i / 4 % 2,
                           .buttresses = i / 8 % 2 ? 32 : 0,
                           .cap_height = i / 16 % 2 ? 50.0F : 0.05F,
                           .wall = i / 32 % 2 ? 1.0F : 0.0F,
                           .buttress_depth = 20.0F,
                           .buttress_height = 100.0F,
                           .buttress_width = 0.05F,
                           .irregularity = 1.0F,
                           .relief = 1.0F,
                           .relief_count = 128.0F,
                           .relief_stretch = 0.1F};
        for (int form = 0; form < 3; form++) {
            FrPlant *plant = fr_plant_new("hostile");
            float length = form == 0 ? 0.0F : 1e-5F, radius = form == 2 ? 0.0F : 0.1F;
            check_stem(plant, FR_NONE, 3, length, radius, radius, check_straight,
                       fr_rotation_about((vec3s){{0, 1, 0}}, 3.1F));
            plant->axes.flags[0] |= FR_CUT;
            plant->axes.finish[0] = fr_plant_add_finish(plant, &finish);
            FrMesh *mesh = check_skin(plant, NULL);
            for (uint64_t v = 0; v < mesh->vertex_count; v++) {
                g_assert_true(isfinite(glms_vec3_norm(check_at(&mesh->vertices[v]))));
                g_assert_cmpfloat_with_epsilon(glms_vec3_norm(check_normal(&mesh->vertices[v])),
                                               1.0F, 1e-3F);
            }
            fr_mesh_free(mesh);
            fr_plant_free(plant);
        }
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/finish/one that asks for nothing changes no bit", test_neutral);
    g_test_add_func("/skin/finish/a round end is half a ball with its normals", test_dome);
    g_test_add_func("/skin/finish/a break is closed, no higher than told, another for each path",
                    test_break);
    g_test_add_func("/skin/finish/a hollow stem is a cup or a pipe with the volume of its wall",
                    test_hollow);
    g_test_add_func("/skin/finish/an open end has a free edge around", test_open);
    g_test_add_func("/skin/finish/ridges and relief stand out and never in", test_outwards);
    g_test_add_func("/skin/finish/there are as many buttresses as were asked for", test_buttresses);
    g_test_add_func("/skin/finish/each level of detail is closed and smaller", test_levels);
    g_test_add_func("/skin/finish/an end may be of another material", test_face);
    g_test_add_func("/skin/finish/a plain junction is a closed tube within its parent",
                    test_plain_junction);
    g_test_add_func("/skin/finish/extremes on stems without length or radius stay finite",
                    test_hostile);
    return g_test_run();
}
