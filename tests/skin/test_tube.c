// Tubes: closed, sound, untwisted, thinned without losing their shape.
#include "mesh_check.h"

static FrPlant *helix(uint32_t nodes) {
    FrPlant *plant = fr_plant_new("helix");
    versors turn = fr_frame_step(fr_rotation_about((vec3s){{0, 1, 0}}, 8.0F / (float)nodes),
                                 fr_rotation_about((vec3s){{0, 0, 1}}, 4.0F / (float)nodes));
    check_stem(plant, FR_NONE, nodes, 4.0F, 0.05F, 0.02F, check_straight, turn);
    return plant;
}

static void test_closed(void) {
    FrPlant *plant = helix(40);
    FrMesh *mesh = check_skin(plant, NULL);
    check_sound(mesh);
    CheckTopology topology = check_topology(mesh);
    g_assert_cmpint(topology.euler, ==, 2);
    g_assert_cmpuint(topology.open, ==, 0);
    g_assert_cmpfloat(check_volume(mesh), >, 0.0);
    fr_mesh_free(mesh);
    plant->axes.flags[0] |= FR_CUT;
    mesh = check_skin(plant, NULL);
    topology = check_topology(mesh);
    g_assert_cmpint(topology.euler, ==, 2);
    g_assert_cmpuint(topology.open, ==, 0);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_volume(void) {
    FrPlant *plant = fr_plant_new("cylinder");
    check_stem(plant, FR_NONE, 7, 2.0F, 0.3F, 0.3F, check_straight, check_straight);
    plant->axes.flags[0] |= FR_CUT;
    FrSkinParams params = fr_skin_default();
    params.max_sides = 128;
    params.side_length = 0.001;
    FrMesh *mesh = check_skin(plant, &params);
    g_assert_cmpfloat_with_epsilon(check_volume(mesh), G_PI * 0.09 * 2.0, 1e-3);
    // Straight and of one thickness: two rings say it all.
    g_assert_cmpuint(mesh->index_count, ==, 3 * (2 * 128 + 2 * 126));
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_cone_normals(void) {
    FrPlant *plant = fr_plant_new("cone");
    check_stem(plant, FR_NONE, 1, 1.0F, 0.5F, 0.0F, check_straight, check_straight);
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    FrMesh *mesh = check_skin(plant, &params);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        // The side rises by 1 over 0.5: its normal's z is sin(atan(0.5)).
        g_assert_cmpfloat_with_epsilon(mesh->vertices[i].normal[2], 0.4472136F, 1e-4F);
    }
    g_assert_cmpfloat(mesh->parts[0].max[2], ==, plant->nodes.position[0].z);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// Corresponding vertices of neighbouring rings are joined along the tube, not around it.
static void test_no_twist(void) {
    FrPlant *plant = helix(60);
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    params.max_sides = params.min_sides = 12;
    FrMesh *mesh = check_skin(plant, &params);
    uint64_t columns = 13, rings = (mesh->vertex_count - 12) / columns;
    g_assert_cmpuint(rings, >, 20);
    for (uint64_t r = 0; r + 1 < rings; r++) {
        const FrVertex *a = &mesh->vertices[r * columns], *b = a + columns;
        vec3s centre_a = {{0, 0, 0}}, centre_b = {{0, 0, 0}};
        for (int i = 0; i < 12; i++) {
            centre_a = glms_vec3_add(centre_a, glms_vec3_scale(check_at(&a[i]), 1.0F / 12.0F));
            centre_b = glms_vec3_add(centre_b, glms_vec3_scale(check_at(&b[i]), 1.0F / 12.0F));
        }
        vec3s along = glms_vec3_normalize(glms_vec3_sub(centre_b, centre_a));
        for (int i = 0; i < 12; i++) {
            vec3s spoke = glms_vec3_sub(check_at(&a[i]), centre_a);
            spoke = glms_vec3_normalize(
                glms_vec3_sub(spoke, glms_vec3_scale(along, glms_vec3_dot(spoke, along))));
            vec3s edge = glms_vec3_sub(check_at(&b[i]), check_at(&a[i]));
            vec3s around = glms_vec3_cross(along, spoke);
            g_assert_cmpfloat(fabsf(glms_vec3_dot(edge, around)), <, 0.003F);
        }
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// The distance of every node from the nearest ring-to-ring chord stays below a radius.
static void test_thinning_keeps_shape(void) {
    FrPlant *plant = helix(400);
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    params.max_sides = params.min_sides = 4;
    FrMesh *mesh = check_skin(plant, &params);
    uint64_t rings = (mesh->vertex_count - 4) / 5;
    g_assert_cmpuint(rings, <, 200);
    for (uint32_t n = 0; n < plant->nodes.count; n++) {
        float nearest = INFINITY;
        for (uint64_t r = 0; r < rings; r++) {
            const FrVertex *a = &mesh->vertices[r * 5];
            const FrVertex *b = r + 1 < rings ? a + 5 : &mesh->vertices[rings * 5];
            vec3s from = glms_vec3_center(check_at(&a[0]), check_at(&a[2]));
            vec3s to =
                r + 1 < rings ? glms_vec3_center(check_at(&b[0]), check_at(&b[2])) : check_at(b);
            vec3s step = glms_vec3_sub(to, from), at = plant->nodes.position[n];
            float part = glms_vec3_dot(glms_vec3_sub(at, from), step) / glms_vec3_norm2(step);
            part = fminf(fmaxf(part, 0.0F), 1.0F);
            vec3s on = glms_vec3_add(from, glms_vec3_scale(step, part));
            nearest = fminf(nearest, glms_vec3_distance(on, at));
        }
        g_assert_cmpfloat(nearest, <, 0.2F * plant->nodes.radius[n] + 0.0015F);
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// The outline of a thick stem that swells and narrows is round along it and around it.
static void test_thick(void) {
    FrPlant *plant = fr_plant_new("vase");
    check_stem(plant, FR_NONE, 26, 0.46F, 0.1F, 0.1F, check_straight, check_straight);
    plant->axes.flags[0] |= FR_CUT;
    for (uint32_t n = 0; n < 26; n++) {
        plant->nodes.radius[n] = 0.1F + 0.18F * sinf((float)G_PI * (float)(n + 1) / 26.0F);
    }
    FrSkinParams params = fr_skin_default();
    params.caps = false;
    FrMesh *mesh = check_skin(plant, &params);
    const uint64_t columns = 49, rings = mesh->vertex_count / columns;
    g_assert_cmpuint(mesh->vertex_count, ==, rings * columns);
    for (uint32_t n = 0; n < 26; n++) {
        float z = plant->nodes.position[n].z, missed = INFINITY;
        for (uint64_t r = 0; r + 1 < rings; r++) {
            const float *a = mesh->vertices[r * columns].position;
            const float *b = mesh->vertices[(r + 1) * columns].position;
            float part = (z - a[2]) / (b[2] - a[2]);
            if (part >= -1e-4F && part <= 1.0001F) {
                float low = hypotf(a[0], a[1]), high = hypotf(b[0], b[1]);
                missed = fabsf(low + part * (high - low) - plant->nodes.radius[n]);
            }
        }
        g_assert_cmpfloat(missed, <, 0.01F * plant->nodes.radius[n] + 0.0005F);
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_hostile(void) {
    FrPlant *plant = fr_plant_new("hostile");
    versors back = fr_rotation_about((vec3s){{1, 0, 0}}, (float)G_PI);
    versors right = fr_rotation_about((vec3s){{1, 0, 0}}, 1.5707963F);
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.1F);
    const float lengths[] = {0.5F, 0, 0, 0.3F, 1e-9F, 0.4F, 0, 0.2F, 0};
    const float radii[] = {0.1F, 0, 0.1F, 0, 0.2F, 0.05F, 0.05F, 0, 0};
    for (int i = 0; i < 9; i++) {
        versors turn = i == 3 ? back : i == 5 ? right : check_straight;
        fr_plant_add_node(plant, axis, turn, lengths[i], radii[i]);
    }
    for (uint32_t n = 0; n < 9; n++) { // branches of no length, no radius, no angle, great angle
        check_stem(plant, n, 3, 0.2F, 0.05F, 0.01F, n % 2 ? back : check_straight, right);
        check_stem(plant, n, 2, 0.0F, 0.05F, 0.01F, right, right);
        check_stem(plant, n, 2, 0.3F, 0.0F, 0.0F, right, check_straight);
        check_stem(plant, n, 4, 0.3F, 0.5F, 0.1F, right, back);
    }
    fr_plant_add_axis(plant, 3, (vec3s){{0, 0, 0}}, 0.1F); // without nodes
    for (int lod = 0; lod < 5; lod++) {
        FrSkinParams params = fr_skin_default();
        params.lod = lod;
        FrMesh *mesh = check_skin(plant, &params);
        g_assert_cmpuint(mesh->index_count, >, 0);
        check_sound(mesh);
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
    plant = fr_plant_new("empty");
    FrMesh *mesh = check_skin(plant, NULL);
    g_assert_cmpuint(mesh->part_count, ==, 0);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// The thinnest twigs go from the parent's surface to their point at once.
static void test_thin_twigs(void) {
    for (int lod = 0; lod < 4; lod++) {
        FrPlant *plant = fr_plant_new("twigs");
        check_stem(plant, FR_NONE, 12, 4.0F, 0.2F, 0.15F, check_straight, check_straight);
        for (uint32_t n = 1; n < 11; n++) {
            check_stem(plant, n, 1, 0.2F, 0.003F, 0.001F,
                       fr_rotation_about((vec3s){{1, 0, 0}}, 0.25F * (float)n), check_straight);
        }
        FrSkinParams params = fr_skin_default();
        params.lod = lod;
        FrMesh *mesh = check_skin(plant, &params);
        check_sound(mesh);
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
}

// n points and m sets: Tube n·(m − 1) quads, Area (n − 1)·(m − 1).
static void test_point_sets(void) {
    static const double points[][2] = {{1, 0}, {0.3, 0.3}, {0, 1}, {-1, 0}, {0, -1}};
    for (int is_closed = 0; is_closed < 2; is_closed++) {
        FrPlant *plant = fr_plant_new("sets");
        uint32_t axis =
            check_stem(plant, FR_NONE, 4, 1.0F, 0.1F, 0.1F, check_straight, check_straight);
        plant->axes.profile[axis] = fr_plant_add_profile(plant, points, 5, is_closed);
        plant->axes.flags[axis] |= FR_POINT_SETS;
        FrSkinParams params = fr_skin_default();
        params.caps = false;
        FrMesh *mesh = check_skin(plant, &params);
        check_sound(mesh);
        g_assert_cmpuint(mesh->index_count, ==, 6 * (is_closed ? 5U * 4U : 4U * 4U));
        fr_mesh_free(mesh);
        params.caps = true;
        mesh = check_skin(plant, &params);
        if (is_closed) {
            CheckTopology topology = check_topology(mesh);
            g_assert_cmpint(topology.euler, ==, 2);
            g_assert_cmpuint(topology.open, ==, 0);
            // Shoelace: 1.8 in units of the radius squared.
            g_assert_cmpfloat_with_epsilon(check_volume(mesh), 1.8 * 0.01, 1e-5);
        }
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
}

static void test_flat_stem(void) {
    FrPlant *plant = fr_plant_new("flat");
    check_stem(plant, FR_NONE, 5, 1.0F, 0.2F, 0.2F, check_straight, check_straight);
    for (uint32_t n = 0; n < 5; n++) {
        plant->nodes.flatness[n] = 0.25F;
    }
    FrMesh *mesh = check_skin(plant, NULL);
    check_sound(mesh);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[0], 0.2F, 1e-3F);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[1], 0.05F, 1e-3F);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// Two axes of which one continues the other give the very mesh of one axis.
static void test_continues(void) {
    versors turn = fr_rotation_about((vec3s){{0, 1, 0}}, 0.15F);
    FrPlant *one = fr_plant_new("one"), *two = fr_plant_new("two");
    uint32_t a = fr_plant_add_axis(one, FR_NONE, (vec3s){{0, 0, 0}}, 0.1F);
    uint32_t b = fr_plant_add_axis(two, FR_NONE, (vec3s){{0, 0, 0}}, 0.1F);
    for (int i = 0; i < 20; i++) {
        float radius = 0.1F - 0.004F * (float)(i + 1);
        if (i == 10) {
            b = fr_plant_add_axis(two, two->axes.last[b], (vec3s){{0, 0, 0}}, 0.1F - 0.04F);
            two->axes.flags[b] |= FR_CONTINUES;
        }
        fr_plant_add_node(one, a, turn, 0.1F, radius);
        fr_plant_add_node(two, b, turn, 0.1F, radius);
    }
    FrMesh *left = check_skin(one, NULL), *right = check_skin(two, NULL);
    g_assert_cmpuint(fr_mesh_digest(left), ==, fr_mesh_digest(right));
    fr_mesh_free(left);
    fr_mesh_free(right);
    fr_plant_free(one);
    fr_plant_free(two);
}

static void test_hidden(void) {
    FrPlant *plant = fr_plant_new("hidden");
    check_stem(plant, FR_NONE, 9, 0.9F, 0.1F, 0.1F, check_straight, check_straight);
    check_stem(plant, 7, 3, 0.3F, 0.03F, 0.01F, fr_rotation_about((vec3s){{1, 0, 0}}, 1.0F),
               check_straight);
    plant->nodes.flags[4] |= FR_HIDDEN; // two pieces, the branch stays
    FrMesh *mesh = check_skin(plant, NULL);
    check_sound(mesh);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        float z = mesh->vertices[i].position[2];
        g_assert_true(z < 0.401F || z > 0.499F);
    }
    g_assert_cmpfloat(mesh->parts[0].max[1] - mesh->parts[0].min[1], >, 0.25F);
    fr_mesh_free(mesh);
    plant->nodes.flags[4] = FR_SHED; // everything beyond falls with it
    mesh = check_skin(plant, NULL);
    g_assert_cmpfloat(mesh->parts[0].max[2], <, 0.401F);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/tube/a thick stem keeps its outline within a hundredth", test_thick);
    g_test_add_func("/skin/tube/C5 a closed tube has Euler number two and no open edge",
                    test_closed);
    g_test_add_func("/skin/tube/a straight tube has the volume of a cylinder", test_volume);
    g_test_add_func("/skin/tube/a tapered tube has slanted normals and ends in its tip",
                    test_cone_normals);
    g_test_add_func("/skin/tube/a tube along a helix does not twist", test_no_twist);
    g_test_add_func("/skin/tube/thinned rings stay within the tolerance of the skeleton",
                    test_thinning_keeps_shape);
    g_test_add_func("/skin/tube/no lengths, no radii and half turns give sound triangles",
                    test_hostile);
    g_test_add_func("/skin/tube/twigs of one band have normals up to their points",
                    test_thin_twigs);
    g_test_add_func("/skin/tube/B2 point sets have the quads of their points and sets",
                    test_point_sets);
    g_test_add_func("/skin/tube/flatness is the ratio of the radii", test_flat_stem);
    g_test_add_func("/skin/tube/an axis that continues another leaves no trace of the joint",
                    test_continues);
    g_test_add_func("/skin/tube/hidden internodes leave a gap and shed ones take all they bear",
                    test_hidden);
    return g_test_run();
}
