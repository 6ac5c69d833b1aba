// Leaves as rational surfaces that are not plain: teeth, lobes, leaflets.
#include "nurbs_plants.h"

#include <math.h>

static double area(const FrMesh *mesh) {
    double sum = 0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        const FrVertex *vertices = mesh->vertices + part->first_vertex;
        const uint32_t *index = mesh->indices + part->first_index;
        for (uint64_t i = 0; i < part->index_count; i += 3) {
            const float *a = vertices[index[i]].position, *b = vertices[index[i + 1]].position;
            const float *c = vertices[index[i + 2]].position;
            vec3s u = {{b[0] - a[0], b[1] - a[1], b[2] - a[2]}};
            vec3s v = {{c[0] - a[0], c[1] - a[1], c[2] - a[2]}};
            sum += 0.5 * (double)glms_vec3_norm(glms_vec3_cross(u, v));
        }
    }
    return sum;
}

/// The area of a leaf as surfaces: of its halves, without tubes.
static double area_of_surfaces(const FrShape *leaf, const FrNurbsParams *params) {
    FrContext context = fr_context_default();
    FrShape bare = *leaf;
    bare.blade.petiole_radius = 0;
    FrPlant *plant = with_organ(&bare);
    FrMesh *mesh;
    g_assert_cmpint(fr_nurbs_mesh(plant, params, 0, FR_UP_Z, (FrSpan){0}, &context, &mesh), ==,
                    FR_OK);
    double sum = area(mesh);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
    return sum;
}

/// The same of the plain skin.
static double area_of_triangles(const FrShape *leaf) {
    FrContext context = fr_context_default();
    FrSkinParams skin = fr_skin_default();
    FrShape bare = *leaf;
    bare.blade.petiole_radius = 0;
    FrPlant *plant = with_organ(&bare);
    FrMesh *mesh;
    g_assert_cmpint(fr_skin_plant(plant, &skin, FR_UP_Z, &context, &mesh), ==, FR_OK);
    double sum = area(mesh);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
    return sum;
}

static FrShape level_leaf(void) {
    FrShape leaf = leaf_shape();
    leaf.blade.fold = leaf.blade.curvature_along = leaf.blade.petiole_bend = 0;
    leaf.blade.segments_along = 24;
    leaf.blade.tooth_sharpness = 0.5F;
    return leaf;
}

/// An ellipse of 0.1 by 0.05 with triangles on it. Each has an area of half its foot times its
/// height; feet take 91 % of the margin, and heights have their factor of size.
static void teeth(void) {
    static const uint32_t margins[] = {FR_MARGIN_SERRATE, FR_MARGIN_DENTATE};
    FrShape leaf = level_leaf();
    for (size_t i = 0; i < G_N_ELEMENTS(margins); i++) {
        for (int exact = 0; exact < 2; exact++) {
            FrNurbsParams params = fr_nurbs_default();
            params.margins = exact;
            leaf.blade.margin = FR_MARGIN_ENTIRE;
            double whole = area_of_surfaces(&leaf, &params);
            g_assert_cmpfloat_with_epsilon(whole, G_PI / 4 * 0.1 * 0.05, 2e-5);
            leaf.blade.margin = margins[i];
            leaf.blade.teeth = 20;
            leaf.blade.tooth_depth = 0.08F;
            double a = 0.05, b = 0.025, h = (a - b) * (a - b) / ((a + b) * (a + b));
            double half_round = 0.5 * G_PI * (a + b) * (1 + 3 * h / (10 + sqrt(4 - 3 * h)));
            double heights = 0;
            for (int k = 0; k < 20; k++) {
                double place = (k + 0.5) / 20;
                heights += 0.08 * 0.05 * fmin(1, 4 * fmin(place, 1 - place) + 0.25);
            }
            double wanted = 2 * 0.5 * (0.91 * half_round / 20) * heights;
            g_assert_cmpfloat_with_epsilon(area_of_surfaces(&leaf, &params) - whole, wanted,
                                           0.06 * wanted);
        }
    }
}

static void as_triangles(void) {
    static const uint32_t margins[] = {FR_MARGIN_SERRATE, FR_MARGIN_DENTATE, FR_MARGIN_CRENATE,
                                       FR_MARGIN_LOBED};
    for (size_t i = 0; i < G_N_ELEMENTS(margins); i++) {
        FrShape leaf = level_leaf();
        leaf.blade.margin = margins[i];
        leaf.blade.teeth = 6;
        leaf.blade.tooth_depth = 0.3F;
        leaf.blade.curvature_along = 0.6F;
        leaf.blade.curvature_across = 0.4F;
        leaf.blade.segments_across = 6;
        double triangles = area_of_triangles(&leaf);
        FrNurbsParams params = fr_nurbs_default();
        g_assert_cmpfloat_with_epsilon(area_of_surfaces(&leaf, &params), triangles,
                                       0.05 * triangles);
    }
}

static uint32_t count_kind(const FrNurbsSkin *skin, uint32_t kind) {
    uint32_t count = 0;
    for (uint64_t i = 0; i < skin->count; i++) {
        count += skin->pieces[i].kind == kind;
    }
    return count;
}

static void compound(void) {
    static const struct {
        uint32_t compound, leaflets, stalks;
    } kinds[] = {{FR_COMPOUND_PINNATE, 9, 1},
                 {FR_COMPOUND_PALMATE, 4, 1},
                 {FR_COMPOUND_BIPINNATE, 7 * 9, 8}};
    for (size_t i = 0; i < G_N_ELEMENTS(kinds); i++) {
        FrShape leaf = level_leaf();
        leaf.blade.compound = kinds[i].compound;
        leaf.blade.leaflets = 4;
        leaf.blade.pinnae = 3;
        leaf.blade.is_terminal = 1;
        leaf.blade.rachis_length = 0.3F;
        leaf.blade.rachis_curvature = 0.5F;
        leaf.blade.leaflet_angle = 1;
        leaf.blade.leaflet_petiole = 0.01F;
        leaf.blade.margin = FR_MARGIN_SERRATE;
        leaf.blade.teeth = 5;
        leaf.blade.tooth_depth = 0.05F;
        FrNurbsParams params = fr_nurbs_default();
        FrPlant *plant = with_organ(&leaf);
        FrNurbsSkin *skin = skinned(plant, &params);
        g_assert_cmpuint(count_kind(skin, FR_NURBS_RIGHT), ==, kinds[i].leaflets);
        g_assert_cmpuint(count_kind(skin, FR_NURBS_LEFT), ==, kinds[i].leaflets);
        g_assert_cmpuint(count_kind(skin, FR_NURBS_TUBE), ==, kinds[i].leaflets + kinds[i].stalks);
        double triangles = area_of_triangles(&leaf);
        g_assert_cmpfloat_with_epsilon(area_of_surfaces(&leaf, &params), triangles,
                                       0.03 * triangles);
        fr_nurbs_skin_free(skin);
        fr_plant_free(plant);
    }
}

/// Leaflets bend in the wind, but stay where they grow.
static void blown(void) {
    FrShape leaf = level_leaf();
    leaf.blade.compound = FR_COMPOUND_PINNATE;
    leaf.blade.leaflets = 3;
    leaf.blade.rachis_length = 0.3F;
    leaf.blade.leaflet_angle = 1;
    for (int petioles = 0; petioles < 2; petioles++) {
        leaf.blade.leaflet_petiole = petioles == 0 ? 0 : 0.02F;
        FrPlant *plant = with_organ(&leaf);
        FrNurbsParams params = fr_nurbs_default();
        FrNurbsSkin *calm = skinned(plant, &params);
        params.wind = (vec3s){{0, 3, 0}};
        params.gust = 0;
        FrNurbsSkin *bent = skinned(plant, &params);
        g_assert_cmpuint(calm->count, ==, bent->count);
        double moved = 0;
        for (uint64_t i = 0; i < calm->count; i++) {
            const FrNurbsSurface *a = &calm->pieces[i].surface, *b = &bent->pieces[i].surface;
            bool is_foot = calm->pieces[i].kind == FR_NURBS_TUBE ||
                           (petioles == 0 && calm->pieces[i].kind == FR_NURBS_LEFT);
            size_t last = (size_t)a->count_u * (a->count_v - 1) + a->count_u / 2; // of the margin
            for (int k = 0; k < 3; k++) {
                g_assert_true(!is_foot || fabs(a->points[0][k] - b->points[0][k]) < 1e-6);
                moved = fmax(moved, fabs(a->points[last][k] - b->points[last][k]));
            }
        }
        g_assert_cmpfloat(moved, >, 0.001);
        fr_nurbs_skin_free(calm);
        fr_nurbs_skin_free(bent);
        fr_plant_free(plant);
    }
}

static void limits(void) {
    FrShape leaf = level_leaf();
    leaf.blade.compound = FR_COMPOUND_BIPINNATE;
    leaf.blade.leaflets = 60;
    leaf.blade.pinnae = 40;
    FrPlant *plant = with_organ(&leaf);
    FrNurbsParams params = fr_nurbs_default();
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.bytes = 10000000;
    FrNurbsSkin *skin = (FrNurbsSkin *)1;
    g_assert_cmpint(fr_nurbs_plant(plant, &params, &context, &skin), ==, FR_ERR_LIMIT);
    g_assert_null(skin);
    fr_diags_free(context.diags);
    fr_plant_free(plant);
}

#define NAME(text) "/skin/nurbs_leaf/" text

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(NAME("teeth add the areas of their triangles"), teeth);
    g_test_add_func(NAME("teeth and lobes are as large as those of the plain skin"), as_triangles);
    g_test_add_func(NAME("compound leaves have all their leaflets"), compound);
    g_test_add_func(NAME("leaflets bend where they grow"), blown);
    g_test_add_func(NAME("leaflets are counted before they are made"), limits);
    return g_test_run();
}
