// Whole plants: levels of detail, parts, threads, limits.
#include "mesh_check.h"

static FrPlant *tree(void) {
    FrPlant *plant = fr_plant_new("tree");
    check_stem(plant, FR_NONE, 120, 12.0F, 0.3F, 0.02F, check_straight,
               fr_rotation_about((vec3s){{1, 0, 0}}, 0.02F));
    for (uint32_t n = 20; n < 118; n += 2) {
        versors first = fr_frame_step(fr_rotation_about((vec3s){{0, 0, 1}}, 2.4F * (float)n),
                                      fr_rotation_about((vec3s){{0, 1, 0}}, 0.9F));
        check_stem(plant, n, 40, 3.0F, 0.4F * plant->nodes.radius[n], 0.004F, first,
                   fr_rotation_about((vec3s){{0, 1, 0}}, n % 4 ? 0.04F : -0.05F));
    }
    FrShape leaf = {.kind = FR_SHAPE_BLADE,
                    .blade = {.length = 0.1F,
                              .width = 0.05F,
                              .outline = FR_NONE,
                              .along_curve = FR_NONE,
                              .across_curve = FR_NONE,
                              .curvature_along = 0.5F,
                              .petiole_length = 0.02F,
                              .petiole_radius = 0.001F,
                              .fold = 0.2F,
                              .segments_along = 6,
                              .segments_across = 2}};
    uint32_t shape = fr_plant_add_shape(plant, &leaf);
    uint32_t first = fr_plant_append_organs(plant, 3000);
    for (uint32_t i = first; i < first + 3000; i++) {
        plant->organs.node[i] = 120 + i % (plant->nodes.count - 120);
        plant->organs.shape[i] = shape;
        plant->organs.path[i] = fr_key_root(i);
        plant->organs.rotation[i] = fr_rotation_about((vec3s){{0, 1, 0}}, (float)i);
    }
    return plant;
}

static void test_levels(void) {
    FrPlant *plant = tree();
    uint64_t before = 0;
    for (int lod = 0; lod < 4; lod++) {
        FrSkinParams params = fr_skin_default();
        params.lod = lod;
        FrMesh *mesh = check_skin(plant, &params);
        check_sound(mesh);
        if (lod > 0) {
            double part = (double)mesh->index_count / (double)before;
            g_test_message("level %d: %.3f", lod, part);
            g_assert_cmpfloat(part, >, 0.25);
            g_assert_cmpfloat(part, <, 0.55);
        }
        before = mesh->index_count;
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
}

// Every axis ends in a vertex that is its last node, at every level.
static void test_tips_stay(void) {
    FrPlant *plant = tree();
    for (int lod = 0; lod < 5; lod++) {
        FrSkinParams params = fr_skin_default();
        params.lod = lod;
        params.foliage = false;
        FrMesh *mesh = check_skin(plant, &params);
        g_assert_cmpuint(mesh->part_count, ==, 1);
        for (uint32_t k = 0; k < plant->axes.count; k++) {
            vec3s tip = plant->nodes.position[plant->axes.last[k]];
            bool is_found = false;
            for (uint64_t i = 0; i < mesh->vertex_count && !is_found; i++) {
                is_found = memcmp(mesh->vertices[i].position, tip.raw, sizeof tip.raw) == 0;
            }
            g_assert_true(is_found);
        }
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
}

// Leaves that are left out leave their area to those that stay.
static void test_leaf_area(void) {
    FrPlant *plant = tree();
    double area[7];
    for (int lod = 0; lod < 7; lod++) {
        FrSkinParams params = fr_skin_default();
        params.lod = lod;
        FrMesh *whole = check_skin(plant, &params);
        params.foliage = false;
        FrMesh *wood = check_skin(plant, &params);
        area[lod] = check_area(whole) - check_area(wood);
        fr_mesh_free(whole);
        fr_mesh_free(wood);
    }
    g_assert_cmpfloat_with_epsilon(area[2], area[1], 0.1 * area[1]);
    g_assert_cmpfloat_with_epsilon(area[3], area[1], 0.15 * area[1]);
    g_assert_cmpfloat_with_epsilon(area[4], area[1], 0.2 * area[1]);
    g_assert_cmpfloat(area[6], <, 0.6 * area[1]);
    fr_plant_free(plant);
}

static void test_last_leaf(void) {
    FrPlant *plant = tree();
    plant->organs.count = 1;
    // The area of one leaf does not grow when there are no others to stand for.
    float reach = 0.0F;
    for (uint32_t path = 1; path < 20; path++) {
        plant->organs.path[0] = fr_key_root(path);
        for (int lod = 0; lod <= 8; lod++) {
            FrSkinParams params = fr_skin_default();
            params.lod = lod;
            FrMesh *mesh = check_skin(plant, &params);
            g_assert_cmpuint(mesh->part_count, ==, 2);
            const FrMeshPart *part = &mesh->parts[1];
            g_assert_cmpuint(part->index_count, >, 0);
            float size = part->max[2] - part->min[2];
            reach = lod == 2 ? size : reach;
            if (lod > 2) {
                g_assert_cmpfloat(size, <, 1.2F * reach);
            }
            fr_mesh_free(mesh);
        }
    }
    fr_plant_free(plant);
}

static void test_threads(void) {
    FrPlant *plant = tree();
    FrSkinParams params = fr_skin_default();
    static const int threads[] = {1, 2, 3, 8};
    FrDigest first = 0;
    for (int i = 0; i < 4; i++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[i]);
        FrMesh *mesh;
        FrStatus status = fr_skin_plant(plant, &params, FR_UP_Y, &context, &mesh);
        g_assert_cmpint(status, ==, FR_OK);
        FrDigest digest = fr_mesh_digest(mesh);
        first = i == 0 ? digest : first;
        g_assert_cmpuint(digest, ==, first);
        fr_mesh_free(mesh);
        fr_pool_free(context.pool);
    }
    fr_plant_free(plant);
}

static void test_up(void) {
    FrPlant *plant = tree();
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *z = check_skin(plant, &params), *y;
    FrStatus status = fr_skin_plant(plant, &params, FR_UP_Y, &context, &y);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_cmpuint(z->vertex_count, ==, y->vertex_count);
    g_assert_true(memcmp(z->indices, y->indices, z->index_count * 4) == 0);
    for (uint64_t i = 0; i < z->vertex_count; i++) {
        const FrVertex *a = &z->vertices[i], *b = &y->vertices[i];
        g_assert_cmpfloat_with_epsilon(b->position[0], a->position[0], 1e-5F);
        g_assert_cmpfloat_with_epsilon(b->position[1], a->position[2], 1e-5F);
        g_assert_cmpfloat_with_epsilon(b->position[2], -a->position[1], 1e-5F);
        g_assert_cmpfloat_with_epsilon(b->normal[2], -a->normal[1], 1e-5F);
    }
    fr_mesh_free(z);
    fr_mesh_free(y);
    fr_plant_free(plant);
}

static void test_parts(void) {
    FrPlant *plant = tree();
    FrMesh *mesh = check_skin(plant, NULL);
    g_assert_cmpuint(mesh->part_count, ==, 2);
    g_assert_false(mesh->parts[0].is_foliage);
    g_assert_true(mesh->parts[1].is_foliage);
    g_assert_cmpuint(mesh->parts[1].first_vertex, ==, mesh->parts[0].vertex_count);
    g_assert_cmpuint(mesh->parts[1].first_index + mesh->parts[1].index_count, ==,
                     mesh->index_count);
    uint64_t leaf = mesh->parts[1].index_count / 3000;
    fr_mesh_free(mesh);
    plant->organs.flags[5] |= FR_SHED;
    plant->organs.flags[6] |= FR_HIDDEN;
    mesh = check_skin(plant, NULL);
    g_assert_cmpuint(mesh->parts[1].index_count, ==, 2998 * leaf);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_limits(void) {
    FrPlant *plant = tree();
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrMesh *mesh = (FrMesh *)&params;
    context.limits.triangles = 1000;
    FrStatus status = fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    g_assert_null(mesh);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-triangles");
    context.limits = fr_limits_default();
    context.limits.bytes = 100000;
    status = fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    g_assert_cmpstr(fr_diags_get(context.diags, 1)->code, ==, "limit-bytes");
    // The shapes alone may be too much.
    FrShape leaf = g_array_index(plant->shapes, FrShape, 0);
    leaf.blade.segments_along = leaf.blade.segments_across = UINT16_MAX;
    plant->organs.shape[0] = fr_plant_add_shape(plant, &leaf);
    context.limits.bytes = 500000;
    status = fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    g_assert_nonnull(strstr(fr_diags_get(context.diags, 2)->text, "shapes"));
    context.limits = fr_limits_default();
    context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(context.progress);
    status = fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_CANCELLED);
    g_assert_null(mesh);
    fr_progress_free(context.progress);
    fr_diags_free(context.diags);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/detail/each level has some 40 % of the triangles", test_levels);
    g_test_add_func("/skin/detail/no level moves a tip", test_tips_stay);
    g_test_add_func("/skin/detail/fewer leaves keep the area, enlarged at most twice",
                    test_leaf_area);
    g_test_add_func("/skin/detail/no level draws the last leaf of a component away",
                    test_last_leaf);
    g_test_add_func("/skin/detail/1, 2, 3 and 8 threads make the same bits", test_threads);
    g_test_add_func("/skin/detail/y up is z up turned", test_up);
    g_test_add_func("/skin/detail/wood and foliage are parts, shed and hidden organs are none",
                    test_parts);
    g_test_add_func("/skin/detail/limits and cancelling leave nothing", test_limits);
    return g_test_run();
}
