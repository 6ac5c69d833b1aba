// Branch bases lie on their parents.
#include "mesh_check.h"

enum { SIDES = 12, COLUMNS = SIDES + 1 };

static FrSkinParams twelve_sides(void) {
    FrSkinParams params = fr_skin_default();
    params.min_sides = params.max_sides = SIDES;
    return params;
}

// The plant without the branch that was added last, whose vertices come after its own.
static FrMesh *without_branch(const FrPlant *plant) {
    FrPlant *bare = fr_plant_copy(plant);
    FrSkinParams params = twelve_sides();
    bare->axes.flags[bare->axes.count - 1] |= FR_HIDDEN;
    FrMesh *mesh = check_skin(bare, &params);
    fr_plant_free(bare);
    return mesh;
}

static float distance_from_segment(vec3s at, vec3s from, vec3s to, float *part) {
    vec3s step = glms_vec3_sub(to, from);
    float along = glms_vec3_dot(glms_vec3_sub(at, from), step) / glms_vec3_norm2(step);
    *part = fminf(fmaxf(along, 0.0F), 1.0F);
    return glms_vec3_distance(glms_vec3_add(from, glms_vec3_scale(step, *part)), at);
}

// How deep a point lies in the tube around axis 0, in its radii there: 1 on its axis, 0 on its
// surface, negative outside.
static float depth(const FrPlant *plant, vec3s at) {
    float deepest = -INFINITY, base = plant->axes.base_radius[0];
    vec3s from = fr_plant_axis_origin(plant, 0);
    for (uint32_t n = plant->axes.first[0]; n != FR_NONE; n = plant->nodes.next[n]) {
        float part, apart = distance_from_segment(at, from, plant->nodes.position[n], &part);
        float radius = base + part * (plant->nodes.radius[n] - base);
        deepest = fmaxf(deepest, 1.0F - apart / radius);
        from = plant->nodes.position[n];
        base = plant->nodes.radius[n];
    }
    return deepest;
}

// Whether the lowest ring of the branch added last is in its parent, at most `deepest` radii.
static void try_base(const FrPlant *plant, float deepest) {
    FrSkinParams params = twelve_sides();
    FrMesh *mesh = check_skin(plant, &params), *bare = without_branch(plant);
    check_sound(mesh);
    g_assert_cmpuint(mesh->vertex_count, >, bare->vertex_count + COLUMNS);
    const FrVertex *ring = mesh->vertices + bare->vertex_count;
    for (int i = 0; i < COLUMNS; i++) {
        vec3s at = check_at(&ring[i]), normal = check_normal(&ring[i]);
        g_assert_cmpfloat(check_winding(bare, at), >, 0.5);
        g_assert_cmpfloat(depth(plant, at), <, deepest);
        // It takes its light as the parent does.
        vec3s out = glms_vec3_add(at, glms_vec3_scale(normal, 0.02F));
        g_assert_cmpfloat(depth(plant, out), <, depth(plant, at));
    }
    fr_mesh_free(mesh);
    fr_mesh_free(bare);
}

static void try_branch(FrPlant *plant, uint32_t node, float degrees, float ratio, float deepest) {
    float angle = degrees * (float)G_PI / 180.0F, radius = ratio * plant->nodes.radius[node];
    vec3s hinge = glms_vec3_normalize((vec3s){{1, 0.3F, 0}});
    check_stem(plant, node, 6, 3.0F, radius, 0.3F * radius, fr_rotation_about(hinge, angle),
               check_straight);
    try_base(plant, deepest);
}

static void test_straight(void) {
    for (float degrees = 10; degrees <= 170; degrees += 20) {
        for (int k = 0; k < 6; k++) {
            const float ratio[] = {0.1F, 0.4F, 0.8F, 1.0F, 1.1F, 1.24F};
            FrPlant *plant = fr_plant_new("straight");
            check_stem(plant, FR_NONE, 20, 8.0F, 0.1F, 0.1F, check_straight, check_straight);
            // A polygon of twelve sides is 1 − cos 15° = 0.034 within its circle.
            try_branch(plant, 10, degrees, ratio[k], 0.06F);
            fr_plant_free(plant);
        }
    }
}

static void test_curved(void) {
    for (float degrees = 30; degrees <= 150; degrees += 30) {
        FrPlant *plant = fr_plant_new("curved");
        check_stem(plant, FR_NONE, 40, 8.0F, 0.12F, 0.06F, check_straight,
                   fr_rotation_about((vec3s){{1, 0, 0}}, 0.06F));
        try_branch(plant, 15, degrees, 0.5F, 0.25F);
        fr_plant_free(plant);
    }
}

static void test_end(void) {
    for (float degrees = 10; degrees <= 170; degrees += 20) {
        FrPlant *plant = fr_plant_new("end");
        check_stem(plant, FR_NONE, 10, 2.0F, 0.1F, 0.08F, check_straight, check_straight);
        check_stem(plant, 9, 6, 1.0F, 0.07F, 0.02F,
                   fr_rotation_about((vec3s){{1, 0, 0}}, degrees * (float)G_PI / 180.0F),
                   check_straight);
        FrSkinParams params = twelve_sides();
        FrMesh *mesh = check_skin(plant, &params);
        check_sound(mesh);
        FrPlant *forked = fr_plant_copy(plant);
        forked->axes.flags[0] |= FR_CUT;
        FrMesh *bare = without_branch(forked);
        for (int i = 0; i < COLUMNS; i++) {
            const FrVertex *v = &mesh->vertices[bare->vertex_count + (uint64_t)i];
            g_assert_cmpfloat(check_winding(bare, check_at(v)), >, 0.5);
        }
        uint64_t count = mesh->vertex_count - bare->vertex_count;
        fr_mesh_free(bare);
        fr_plant_free(forked);
        // The parent does not taper to a point beneath it.
        float widest = 0.0F;
        for (uint64_t i = 0; i < mesh->vertex_count - count; i++) {
            const float *at = mesh->vertices[i].position;
            widest = at[2] > 1.999F ? fmaxf(widest, hypotf(at[0], at[1])) : widest;
        }
        g_assert_cmpfloat_with_epsilon(widest, 0.08F, 1e-4F);
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
}

static void test_thicker(void) {
    FrPlant *plant = fr_plant_new("thicker");
    check_stem(plant, FR_NONE, 20, 2.0F, 0.05F, 0.05F, check_straight, check_straight);
    check_stem(plant, 10, 6, 1.0F, 0.15F, 0.15F, fr_rotation_about((vec3s){{1, 0, 0}}, 1.5707963F),
               check_straight);
    FrSkinParams params = twelve_sides();
    FrMesh *mesh = check_skin(plant, &params), *bare = without_branch(plant);
    check_sound(mesh);
    for (int i = 0; i < COLUMNS; i++) {
        const float *at = mesh->vertices[bare->vertex_count + (uint64_t)i].position;
        vec3s origin = plant->nodes.position[10];
        g_assert_cmpfloat_with_epsilon(hypotf(at[0] - origin.x, at[2] - origin.z), 0.15F, 1e-3F);
    }
    fr_mesh_free(mesh);
    fr_mesh_free(bare);
    fr_plant_free(plant);
}

// A little thicker, it has a collar as others have: no edge and no cap shows.
static void test_little_thicker(void) {
    FrPlant *plant = fr_plant_new("thicker");
    check_stem(plant, FR_NONE, 20, 2.0F, 0.05F, 0.05F, check_straight, check_straight);
    check_stem(plant, 10, 6, 1.0F, 0.058F, 0.058F,
               fr_rotation_about((vec3s){{1, 0, 0}}, 1.5707963F), check_straight);
    FrSkinParams params = twelve_sides();
    FrMesh *mesh = check_skin(plant, &params), *bare = without_branch(plant);
    check_sound(mesh);
    for (int i = 0; i < COLUMNS; i++) {
        const float *at = mesh->vertices[bare->vertex_count + (uint64_t)i].position;
        g_assert_cmpfloat(hypotf(at[0], at[1]), <, 0.05F);
    }
    fr_mesh_free(mesh);
    fr_mesh_free(bare);
    fr_plant_free(plant);
}

// Without a collar a branch still begins inside, with one it begins wider.
static void test_size(void) {
    float widest[3];
    for (int collar = 0; collar < 3; collar++) {
        FrPlant *plant = fr_plant_new("size");
        check_stem(plant, FR_NONE, 10, 4.0F, 0.2F, 0.2F, check_straight, check_straight);
        check_stem(plant, 4, 6, 1.0F, 0.05F, 0.02F,
                   fr_rotation_about((vec3s){{1, 0, 0}}, 1.5707963F), check_straight);
        FrSkinParams params = twelve_sides();
        params.collar = collar;
        FrMesh *mesh = check_skin(plant, &params);
        FrMesh *bare = without_branch(plant);
        const FrVertex *ring = mesh->vertices + bare->vertex_count;
        float low = INFINITY, high = -INFINITY;
        for (int i = 0; i < COLUMNS; i++) {
            low = fminf(low, ring[i].position[2]);
            high = fmaxf(high, ring[i].position[2]);
            g_assert_cmpfloat(check_winding(bare, check_at(&ring[i])), >, 0.5);
        }
        widest[collar] = high - low;
        fr_mesh_free(bare);
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
    g_assert_cmpfloat_with_epsilon(widest[0], 0.1F, 0.002F);
    g_assert_cmpfloat(widest[1], >, 1.2F * widest[0]);
    g_assert_cmpfloat(widest[2], >, 1.2F * widest[1]);
}

// Whatever way the stem points, where rounding makes the cosine between both less than −1 too.
static void test_back(void) {
    for (int i = 0; i < 64; i++) {
        FrPlant *plant = fr_plant_new("back");
        check_stem(plant, FR_NONE, 4, 4.0F, 0.2F, 0.1F,
                   fr_rotation_about((vec3s){{1, 0, 0}}, 0.05F * (float)i), check_straight);
        check_stem(plant, 3, 4, 1.0F, 0.05F, 0.02F,
                   fr_rotation_about((vec3s){{1, 0, 0}}, (float)G_PI), check_straight);
        FrSkinParams params = twelve_sides();
        FrMesh *mesh = check_skin(plant, &params);
        check_sound(mesh);
        fr_mesh_free(mesh);
        fr_plant_free(plant);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/collar/a branch begins on its parent's surface at any angle and width",
                    test_straight);
    g_test_add_func("/skin/collar/a branch begins on a curved parent's surface", test_curved);
    g_test_add_func("/skin/collar/a branch at its parent's tip begins within a blunt end",
                    test_end);
    g_test_add_func("/skin/collar/a branch thicker than its parent begins round", test_thicker);
    g_test_add_func("/skin/collar/a branch may turn straight back along its stem", test_back);
    g_test_add_func("/skin/collar/a branch a little thicker begins on its parent too",
                    test_little_thicker);
    g_test_add_func("/skin/collar/the size of a collar widens the base", test_size);
    return g_test_run();
}
