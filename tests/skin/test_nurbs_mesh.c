// Triangles of rational surfaces: near them, closed, without cracks, one solid.
#include "nurbs_plants.h"

#include "skin/solid.h"

#include <math.h>
#include <string.h>

static FrMesh *meshed(const FrPlant *plant, const FrNurbsParams *params) {
    FrContext context = fr_context_default();
    FrMesh *mesh;
    g_assert_cmpint(fr_nurbs_mesh(plant, params, 0, FR_UP_Z, (FrSpan){0}, &context, &mesh), ==,
                    FR_OK);
    return mesh;
}

/// Corner k of the n-th triangle of a mesh.
static const FrVertex *corner(const FrMesh *mesh, uint64_t n, uint64_t k) {
    for (uint32_t p = 0;; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        if (3 * n < part->first_index + part->index_count) {
            return &mesh->vertices[part->first_vertex + mesh->indices[3 * n + k]];
        }
    }
}

static double volume(const FrMesh *mesh) {
    double sum = 0;
    for (uint64_t n = 0; n < mesh->index_count / 3; n++) {
        double p[3][3];
        for (uint64_t k = 0; k < 3; k++) {
            for (int d = 0; d < 3; d++) {
                p[k][d] = (double)corner(mesh, n, k)->position[d];
            }
        }
        sum += (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
                p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
                p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
               6;
    }
    return sum;
}

/// Ericson. Real-Time Collision Detection, section 5.1.5.
static double distance_to(const double p[3], const FrMesh *mesh, uint64_t n) {
    double a[3], ab[3], ac[3], ap[3];
    for (int d = 0; d < 3; d++) {
        a[d] = (double)corner(mesh, n, 0)->position[d];
        ab[d] = (double)corner(mesh, n, 1)->position[d] - a[d];
        ac[d] = (double)corner(mesh, n, 2)->position[d] - a[d];
        ap[d] = p[d] - a[d];
    }
    double bb = 0, bc = 0, cc = 0, pb = 0, pc = 0, best = INFINITY;
    for (int d = 0; d < 3; d++) {
        bb += ab[d] * ab[d];
        bc += ab[d] * ac[d];
        cc += ac[d] * ac[d];
        pb += ap[d] * ab[d];
        pc += ap[d] * ac[d];
    }
    double det = bb * cc - bc * bc, s = (pb * cc - pc * bc) / det, t = (pc * bb - pb * bc) / det;
    double tries[4][2] = {{s, t}, {CLAMP(pb / bb, 0, 1), 0}, {0, CLAMP(pc / cc, 0, 1)}, {0, 0}};
    double along = CLAMP((pc - pb + bb - bc) / (bb - 2 * bc + cc), 0, 1);
    tries[3][0] = 1 - along;
    tries[3][1] = along;
    for (int i = s >= 0 && t >= 0 && s + t <= 1 ? 0 : 1; i < 4; i++) {
        double square = 0;
        for (int d = 0; d < 3; d++) {
            double off = ap[d] - tries[i][0] * ab[d] - tries[i][1] * ac[d];
            square += off * off;
        }
        best = fmin(best, sqrt(square));
    }
    return best;
}

static void assert_near(const FrPlant *plant, double tolerance) {
    FrNurbsParams params = fr_nurbs_default();
    params.tolerance = tolerance;
    FrNurbsSkin *skin = skinned(plant, &params);
    FrMesh *mesh = meshed(plant, &params);
    for (uint64_t i = 0; i < skin->count; i++) {
        for (int n = 0; n < 21 * 21; n++) {
            double p[3], nearest = INFINITY;
            fr_nurbs_surface_at(&skin->pieces[i].surface, (n % 21) / 20.0, (n / 21) / 20.0, p, NULL,
                                NULL);
            for (uint64_t t = 0; t < mesh->index_count / 3 && nearest > tolerance; t++) {
                nearest = fmin(nearest, distance_to(p, mesh, t));
            }
            g_assert_cmpfloat(nearest, <=, tolerance);
        }
    }
    fr_mesh_free(mesh);
    fr_nurbs_skin_free(skin);
}

static void near_surface(void) {
    FrPlant *plant = letter_s();
    assert_near(plant, 1e-3);
    assert_near(plant, 1e-2);
    fr_plant_free(plant);
    FrShape leaf = leaf_shape();
    leaf.blade.curvature_across = 0.8F;
    leaf.blade.twist = 0.5F;
    plant = with_organ(&leaf);
    assert_near(plant, 2e-4);
    assert_near(plant, 2e-3);
    fr_plant_free(plant);
    FrShape ball = {.kind = FR_SHAPE_SPHERE, .size = {{1, 1, 1}}, .detail = 8, .outline = FR_NONE};
    plant = with_organ(&ball);
    assert_near(plant, 5e-3);
    fr_plant_free(plant);
}

static void adapts(void) {
    FrPlant *plant = stem(), *bent = letter_s();
    FrNurbsParams params = fr_nurbs_default();
    params.tolerance = 1e-3;
    FrMesh *straight = meshed(plant, &params), *curved = meshed(bent, &params);
    // A straight tube is cut around only: n quads, and n triangles on each cap.
    g_assert_cmpuint(straight->index_count % 12, ==, 0);
    uint64_t sides = straight->index_count / 12;
    g_assert_cmpuint(straight->index_count / 3, ==, 4 * sides);
    g_assert_cmpuint(curved->index_count / 3, >, 10 * sides);
    params.tolerance = 1e-4;
    FrMesh *finer = meshed(plant, &params);
    g_assert_cmpuint(finer->index_count, >, 2 * straight->index_count);
    fr_mesh_free(straight);
    fr_mesh_free(curved);
    fr_mesh_free(finer);
    fr_plant_free(plant);
    fr_plant_free(bent);
}

static void closed(void) {
    FrPlant *plant = stem();
    FrNurbsParams params = fr_nurbs_default();
    for (int form = 0; form < 4; form++) {
        params.circle = form;
        params.tolerance = 1e-5;
        FrMesh *mesh = meshed(plant, &params);
        g_assert_cmpuint(fr_mesh_open_edges(mesh, NULL), ==, 0);
        g_assert_cmpfloat_with_epsilon(volume(mesh) / (G_PI * 0.0625 * 0.0625 * 2), 1, 1e-3);
        fr_mesh_free(mesh);
        params.tolerance = 10; // as coarse as it gets
        mesh = meshed(plant, &params);
        g_assert_cmpuint(fr_mesh_open_edges(mesh, NULL), ==, 0);
        g_assert_cmpfloat(volume(mesh), >, 0.008);
        fr_mesh_free(mesh);
    }
    params.caps = false;
    FrMesh *open = meshed(plant, &params);
    g_assert_cmpuint(fr_mesh_open_edges(open, NULL), >, 0);
    fr_mesh_free(open);
    fr_plant_free(plant);
}

/// A straight stem is seen from the side or from an end; where a cap closes to a point, rounding
/// must not lend that point a direction.
static void caps_are_flat(void) {
    FrPlant *plant = fr_plant_new("leaning");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0.3F, 0.1F, 0}}, 0.1F);
    versors lean = fr_rotation_about(glms_vec3_normalize((vec3s){{1, 0.7F, 0.2F}}), 0.3F);
    fr_plant_add_node(plant, axis, lean, 0.4F, 0.1F);
    plant->axes.flags[axis] = FR_CUT;
    vec3s towards = glms_quat_rotatev(lean, (vec3s){{0, 0, 1}});
    FrNurbsParams params = fr_nurbs_default();
    for (int form = 0; form < 4; form++) {
        params.circle = form;
        FrMesh *mesh = meshed(plant, &params);
        uint64_t on_caps = 0;
        for (uint64_t v = 0; v < mesh->vertex_count; v++) {
            const float *n = mesh->vertices[v].normal;
            double along = fabs((double)glms_vec3_dot(towards, (vec3s){{n[0], n[1], n[2]}}));
            g_assert_true(along < 1e-3 || along > 1 - 1e-3);
            on_caps += along > 0.5;
        }
        g_assert_cmpuint(on_caps, >, 6);
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
}

/// Open edges of the halves of a blade: all but those at the midrib are its outline.
static void uncracked(void) {
    FrShape leaf = leaf_shape();
    leaf.blade.petiole_length = 0;
    leaf.blade.curvature_across = 0.9F;
    FrPlant *plant = with_organ(&leaf);
    FrNurbsParams params = fr_nurbs_default();
    params.tolerance = 1e-4;
    FrMesh *mesh = meshed(plant, &params);
    uint32_t *places = fr_mesh_places(mesh);
    uint32_t places_used = 0;
    for (uint64_t i = 0; i < mesh->index_count; i++) {
        bool is_new = true;
        for (uint64_t k = 0; k < i && is_new; k++) {
            is_new = places[k] != places[i];
        }
        places_used += is_new;
    }
    // Euler: a disc has one more vertex and face than edges; edges are all sides, inner ones twice.
    uint64_t faces = mesh->index_count / 3, open = fr_mesh_open_edges(mesh, NULL);
    uint64_t edges = (3 * faces + open) / 2;
    g_assert_cmpuint(places_used + faces, ==, edges + 1);
    g_free(places);
    fr_mesh_free(mesh);
    params.thickness = 0.002;
    mesh = meshed(plant, &params);
    g_assert_cmpuint(fr_mesh_open_edges(mesh, NULL), ==, 0);
    double area = 0.1 * 0.05 * G_PI / 4; // of the ellipse that was bent
    g_assert_cmpfloat_with_epsilon(volume(mesh) / (area * 0.002), 1, 0.05);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void whole_leaf(void) {
    FrShape leaf = leaf_shape();
    FrPlant *plant = with_organ(&leaf);
    FrNurbsParams params = fr_nurbs_default();
    params.thickness = 0.001;
    FrMesh *mesh = meshed(plant, &params);
    g_assert_cmpuint(fr_mesh_open_edges(mesh, NULL), ==, 0);
    g_assert_cmpfloat(volume(mesh), >, 0);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void threads(void) {
    FrPlant *plant = bush();
    FrNurbsParams params = fr_nurbs_default();
    FrDigest first = 0;
    const int counts[] = {1, 2, 3, 8};
    for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(counts[i]);
        FrMesh *mesh;
        g_assert_cmpint(fr_nurbs_mesh(plant, &params, 0, FR_UP_Y, (FrSpan){0}, &context, &mesh), ==,
                        FR_OK);
        FrDigest digest = fr_mesh_digest(mesh);
        g_assert_true(i == 0 || digest == first);
        first = digest;
        fr_mesh_free(mesh);
        fr_pool_free(context.pool);
    }
    fr_plant_free(plant);
}

static void limits(void) {
    FrPlant *plant = bush();
    FrNurbsParams params = fr_nurbs_default();
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.triangles = 100;
    FrMesh *mesh = (FrMesh *)1;
    g_assert_cmpint(fr_nurbs_mesh(plant, &params, 0, FR_UP_Z, (FrSpan){0}, &context, &mesh), ==,
                    FR_ERR_LIMIT);
    g_assert_null(mesh);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-triangles");
    fr_diags_free(context.diags);
    fr_plant_free(plant);
}

/// What floats cannot keep is told once, with its place, and not tried.
static void finest(void) {
    FrPlant *plant = forked();
    FrNurbsParams params = fr_nurbs_default();
    FrSource *source = fr_source_new("a.frond", "<nurbs/>", 8);
    const FrSpan span = {source, 1, 6};
    uint64_t triangles[2];
    for (int i = 0; i < 2; i++) {
        params.tolerance = i == 0 ? 1e-9 : 1e-300;
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        for (int again = 0; again < 2; again++) {
            FrMesh *mesh;
            g_assert_cmpint(fr_nurbs_mesh(plant, &params, 0, FR_UP_Z, span, &context, &mesh), ==,
                            FR_OK);
            triangles[i] = mesh->index_count / 3;
            fr_mesh_free(mesh);
        }
        g_assert_cmpuint(fr_diags_count(context.diags), ==, 1);
        g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "fine-tolerance");
        g_assert_true(fr_diags_get(context.diags, 0)->span.source == source);
        fr_diags_free(context.diags);
    }
    g_assert_cmpuint(triangles[0], ==, triangles[1]);
    fr_source_unref(source);
    fr_plant_free(plant);
}

/// A limit is told where the plant is written.
static void limit_has_place(void) {
    FrPlant *plant = forked();
    FrSource *source = fr_source_new("a.frond", "<horn/>", 7);
    fr_plant_add_component(plant, "stem", (FrSpan){source, 1, 5});
    FrNurbsParams params = fr_nurbs_default();
    for (int i = 0; i < 2; i++) {
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        *(i == 0 ? &context.limits.bytes : &context.limits.triangles) = 100;
        FrMesh *mesh;
        g_assert_cmpint(fr_nurbs_mesh(plant, &params, 0, FR_UP_Z, (FrSpan){0}, &context, &mesh), ==,
                        FR_ERR_LIMIT);
        g_assert_cmpuint(fr_diags_count(context.diags), ==, 1);
        g_assert_true(fr_diags_get(context.diags, 0)->span.source == source);
        g_assert_cmpuint(fr_diags_get(context.diags, 0)->span.begin, ==, 1);
        fr_diags_free(context.diags);
    }
    fr_plant_free(plant);
    fr_source_unref(source);
}

// ---- one solid ---------------------------------------------------------------------------------

static FrPlant *boxes(float shift) {
    FrShape box = {.kind = FR_SHAPE_BOX, .size = {{1, 1, 1}}, .detail = 8, .outline = FR_NONE};
    FrPlant *plant = with_organ(&box);
    uint32_t other = fr_plant_append_organs(plant, 1);
    plant->organs.shape[other] = 0;
    plant->organs.offset[other] = (vec3s){{shift, 0.25F, 0.125F}};
    return plant;
}

static void assert_solid(const FrPlant *plant, double width, double wanted, double within) {
    FrNurbsParams params = fr_nurbs_default();
    params.voxel = width;
    FrMesh *mesh = meshed(plant, &params);
    g_assert_cmpuint(fr_mesh_open_edges(mesh, NULL), ==, 0);
    g_assert_cmpfloat_with_epsilon(volume(mesh), wanted, within);
    fr_mesh_free(mesh);
}

static void one_solid(void) {
    FrPlant *apart = boxes(3), *overlapping = boxes(0.5F);
    assert_solid(apart, 0.05, 2, 0.02);
    assert_solid(overlapping, 0.05, 2 - 0.5 * 0.75 * 0.875, 0.02);
    fr_plant_free(apart);
    fr_plant_free(overlapping);
    FrPlant *plant = forked();
    FrNurbsParams params = fr_nurbs_default();
    params.tolerance = 1e-4;
    FrMesh *shells = meshed(plant, &params);
    params.voxel = 0.004;
    FrMesh *solid = meshed(plant, &params);
    // The branch begins inside the stem: what both fill counts once.
    g_assert_cmpuint(fr_mesh_open_edges(solid, NULL), ==, 0);
    g_assert_cmpfloat(volume(solid), <, volume(shells));
    g_assert_cmpfloat(volume(solid), >, 0.95 * volume(shells));
    for (uint64_t i = 0; i < solid->index_count; i += 3) {
        const uint32_t *t = solid->indices + i;
        g_assert_true(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    fr_mesh_free(shells);
    fr_mesh_free(solid);
    fr_plant_free(plant);
}

static void assert_solid_refused(const FrPlant *plant, const FrNurbsParams *params, FrStatus status,
                                 const char *const *codes) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrMesh *mesh = (FrMesh *)1;
    FrSource *source = fr_source_new("a.frond", "<nurbs/>", 8);
    const FrSpan span = {source, 1, 6};
    g_assert_cmpint(fr_nurbs_mesh(plant, params, 0, FR_UP_Z, span, &context, &mesh), ==, status);
    g_assert_null(mesh);
    size_t count = 0;
    for (; codes[count] != NULL; count++) {
        g_assert_cmpuint(fr_diags_count(context.diags), >, count);
        g_assert_cmpstr(fr_diags_get(context.diags, count)->code, ==, codes[count]);
        g_assert_true(fr_diags_get(context.diags, count)->span.source == source);
    }
    g_assert_cmpuint(fr_diags_count(context.diags), ==, count);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

static void open_is_told(void) {
    FrShape leaf = leaf_shape();
    FrPlant *plant = with_organ(&leaf);
    FrNurbsParams params = fr_nurbs_default();
    params.voxel = 0.001;
    static const char *const open[] = {"not-closed", "nothing-closed", NULL};
    assert_solid_refused(plant, &params, FR_ERR_DOCUMENT, open);
    params.voxel = 1e-6;
    params.thickness = 0.001;
    static const char *const large[] = {"limit-triangles", NULL};
    assert_solid_refused(plant, &params, FR_ERR_LIMIT, large);
    fr_plant_free(plant);
}

static void coarse_is_refused(void) {
    FrPlant *plant = forked();
    FrNurbsParams params = fr_nurbs_default();
    params.voxel = 5;
    static const char *const coarse[] = {"voxel-too-coarse", NULL};
    assert_solid_refused(plant, &params, FR_ERR_DOCUMENT, coarse);
    fr_plant_free(plant);
    FrShape leaf = leaf_shape();
    plant = with_organ(&leaf);
    params.thickness = 0.0001;
    static const char *const thin[] = {"thinner-than-voxel", "voxel-too-coarse", NULL};
    assert_solid_refused(plant, &params, FR_ERR_DOCUMENT, thin);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/nurbs_mesh/no point of a surface is farther away than asked",
                    near_surface);
    g_test_add_func("/skin/nurbs_mesh/what bends more or is larger has more triangles", adapts);
    g_test_add_func("/skin/nurbs_mesh/a tube with caps is closed and has its volume", closed);
    g_test_add_func("/skin/nurbs_mesh/caps are flat up to their middle", caps_are_flat);
    g_test_add_func("/skin/nurbs_mesh/halves of a blade meet without a crack", uncracked);
    g_test_add_func("/skin/nurbs_mesh/a leaf with a thickness is closed", whole_leaf);
    g_test_add_func("/skin/nurbs_mesh/any number of threads makes the same triangles", threads);
    g_test_add_func("/skin/nurbs_mesh/too many triangles are refused", limits);
    g_test_add_func("/skin/nurbs_mesh/a limit is told where the plant is written", limit_has_place);
    g_test_add_func("/skin/nurbs_mesh/a tolerance that floats cannot keep is told", finest);
    g_test_add_func("/skin/nurbs_mesh/overlapping surfaces become one watertight solid", one_solid);
    g_test_add_func("/skin/nurbs_mesh/open surfaces are no part of a solid, and that is told",
                    open_is_told);
    g_test_add_func("/skin/nurbs_mesh/a lattice through which everything falls is refused",
                    coarse_is_refused);
    return g_test_run();
}
