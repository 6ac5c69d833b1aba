// Blades: area, arc lengths, turns, coordinates, numbers of triangles.
#include "mesh_check.h"

static FrShape plain_blade(void) {
    return (FrShape){.kind = FR_SHAPE_BLADE,
                     .blade = {.length = 0.1F,
                               .width = 0.06F,
                               .outline = FR_NONE,
                               .along_curve = FR_NONE,
                               .across_curve = FR_NONE,
                               .segments_along = 6,
                               .segments_across = 2}};
}

// Twice the area of the half outline, by the shoelace formula.
static double polygon_area(const double (*points)[2], uint32_t count) {
    double area = 0.0;
    for (uint32_t i = 0; i + 1 < count; i++) {
        area += (points[i + 1][0] - points[i][0]) * (points[i][1] + points[i + 1][1]);
    }
    return area;
}

static void test_area(void) {
    static const double ovate[][2] = {{0, 0},      {0.05, 0.25}, {0.15, 0.42}, {0.3, 0.5},
                                      {0.5, 0.42}, {0.7, 0.25},  {0.9, 0.08},  {1, 0}};
    static const double kite[][2] = {{0, 0}, {0.4, 0.5}, {1, 0}};
    FrPlant *plant = fr_plant_new("blade");
    for (uint16_t segments = 1; segments < 12; segments++) {
        FrShape shape = plain_blade();
        shape.blade.segments_along = segments;
        FrMesh *mesh = check_shape(plant, &shape);
        check_sound(mesh);
        double ellipse = G_PI / 4.0 * 0.1 * 0.06;
        g_assert_cmpfloat_with_epsilon(check_area(mesh), ellipse, 0.01 * ellipse);
        fr_mesh_free(mesh);
        for (int k = 0; k < 2; k++) {
            const double(*points)[2] = k ? kite : ovate;
            uint32_t count = k ? 3 : 8;
            shape.blade.outline = fr_plant_add_profile(plant, points, count, false);
            mesh = check_shape(plant, &shape);
            double area = polygon_area(points, count) * 0.1 * 0.06;
            g_assert_cmpfloat_with_epsilon(check_area(mesh), area, 0.01 * area);
            fr_mesh_free(mesh);
        }
    }
    fr_plant_free(plant);
}

// Both halves of a closed outline may differ.
static void test_closed_outline(void) {
    static const double lopsided[][2] = {{0, 0}, {0.3, 0.5}, {1, 0}, {0.6, -0.2}};
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    shape.blade.outline = fr_plant_add_profile(plant, lopsided, 4, true);
    FrMesh *mesh = check_shape(plant, &shape);
    double area = (0.5 + 0.2) / 2.0 * 0.1 * 0.06;
    g_assert_cmpfloat_with_epsilon(check_area(mesh), area, 0.01 * area);
    // The half with positive widths is on the right: towards −x, where u is large.
    g_assert_cmpfloat(-mesh->parts[0].min[0], >, 2.0F * mesh->parts[0].max[0]);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static const FrVertex *tip_of(const FrMesh *mesh) {
    const FrVertex *tip = &mesh->vertices[0];
    for (uint64_t i = 1; i < mesh->vertex_count; i++) {
        tip = mesh->vertices[i].uv[1] < tip->uv[1] ? &mesh->vertices[i] : tip;
    }
    return tip;
}

// κ constant over L turns the tip by κL and puts it at the end of an arc.
static void test_along(void) {
    FrPlant *plant = fr_plant_new("blade");
    for (float turn = -2.0F; turn <= 2.0F; turn += 0.5F) {
        FrShape shape = plain_blade();
        shape.blade.curvature_along = turn;
        FrMesh *mesh = check_shape(plant, &shape);
        const FrVertex *tip = tip_of(mesh);
        g_assert_cmpfloat_with_epsilon(tip->normal[1], cosf(turn), 2e-3F);
        g_assert_cmpfloat_with_epsilon(tip->normal[2], -sinf(turn), 2e-3F);
        float y = turn != 0 ? 0.1F * (1 - cosf(turn)) / turn : 0.0F;
        float z = turn != 0 ? 0.1F * sinf(turn) / turn : 0.1F;
        g_assert_cmpfloat_with_epsilon(tip->position[1], y, 1e-5F);
        g_assert_cmpfloat_with_epsilon(tip->position[2], z, 1e-5F);
        fr_mesh_free(mesh);
    }
    // A curve only spreads the turn: all of it lies in the second half here.
    static const double late[][2] = {{0, 0}, {0.5, 0}, {0.5001, 1}, {1, 1}};
    FrShape shape = plain_blade();
    shape.blade.curvature_along = 1.0F;
    shape.blade.along_curve = fr_plant_add_profile(plant, late, 4, false);
    FrMesh *mesh = check_shape(plant, &shape);
    const FrVertex *tip = tip_of(mesh);
    g_assert_cmpfloat_with_epsilon(tip->normal[1], cosf(1.0F), 1e-2F);
    g_assert_cmpfloat_with_epsilon(tip->position[2], 0.05F + 0.05F * sinf(1.0F), 1e-3F);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// The widest row of a rectangle, measured along its surface, is as long as the blade is wide.
static void test_across(void) {
    static const double oblong[][2] = {{0, 0.5}, {1, 0.5}};
    FrPlant *plant = fr_plant_new("blade");
    for (float turn = -2.0F; turn <= 2.0F; turn += 1.0F) {
        FrShape shape = plain_blade();
        shape.blade.outline = fr_plant_add_profile(plant, oblong, 2, false);
        shape.blade.curvature_across = turn;
        shape.blade.fold = 0.3F;
        shape.blade.segments_across = 32;
        FrMesh *mesh = check_shape(plant, &shape);
        float length = 0.0F;
        for (int i = 0; i < 64; i++) {
            length +=
                glms_vec3_distance(check_at(&mesh->vertices[i]), check_at(&mesh->vertices[i + 1]));
        }
        g_assert_cmpfloat_with_epsilon(length, 0.06F, 0.0002F);
        // Both margins have turned by fold and curvature, towards y.
        vec3s normal = check_normal(&mesh->vertices[0]);
        g_assert_cmpfloat_with_epsilon(normal.x, -sinf(0.3F + turn), 5e-3F);
        fr_mesh_free(mesh);
    }
    fr_plant_free(plant);
}

static void test_twist(void) {
    static const double oblong[][2] = {{0, 0.5}, {1, 0.5}};
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    shape.blade.outline = fr_plant_add_profile(plant, oblong, 2, false);
    shape.blade.twist = 1.5707963F;
    FrMesh *mesh = check_shape(plant, &shape);
    check_sound(mesh);
    const FrVertex *tip = &mesh->vertices[mesh->vertex_count - 1];
    g_assert_cmpfloat_with_epsilon(tip->position[0], 0.0F, 1e-5F);
    g_assert_cmpfloat_with_epsilon(fabsf(tip->position[1]), 0.03F, 1e-4F);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_texture(void) {
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    shape.blade.petiole_length = 0.03F;
    shape.blade.petiole_radius = 0.001F;
    shape.blade.petiole_bend = 0.5F;
    shape.blade.wave = 0.05F;
    shape.blade.waves = 2.0F;
    FrMesh *mesh = check_shape(plant, &shape);
    check_sound(mesh);
    g_assert_true(mesh->parts[0].is_foliage);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        const FrVertex *v = &mesh->vertices[i];
        g_assert_true(v->uv[0] >= 0 && v->uv[0] <= 1 && v->uv[1] >= 0 && v->uv[1] <= 1);
    }
    g_assert_cmpfloat(tip_of(mesh)->uv[0], ==, 0.5F);
    g_assert_cmpfloat(tip_of(mesh)->uv[1], ==, 0.0F);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_frugal(void) {
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    shape.blade.segments_along = 3;
    shape.blade.segments_across = 1;
    FrMesh *mesh = check_shape(plant, &shape);
    g_assert_cmpuint(mesh->index_count / 3, ==, 4);
    g_assert_cmpuint(mesh->vertex_count, ==, 6);
    fr_mesh_free(mesh);
    shape.blade.fold = 0.3F;
    mesh = check_shape(plant, &shape);
    g_assert_cmpuint(mesh->index_count / 3, ==, 8);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// The half width of a flat blade's margin at `z`, between its rows of five vertices.
static float margin_at(const FrVertex *rows, uint64_t count, float z) {
    for (uint64_t i = 0; i + 9 < count; i += 5) {
        const float *low = rows[i].position, *high = rows[i + 5].position;
        if (z <= high[2]) {
            return fabsf(low[0] + (z - low[2]) / (high[2] - low[2]) * (high[0] - low[0]));
        }
    }
    return 0.0F;
}

static void test_base(void) {
    // y ~ x^1.4 (1 - x)^0.7, sharp at its base.
    double oblanceolate[33][2], area = 0.0;
    for (int i = 0; i <= 32; i++) {
        double x = i / 32.0;
        oblanceolate[i][0] = x;
        oblanceolate[i][1] = 1.9 * pow(x, 1.4) * pow(1.0 - x, 0.7);
    }
    area = polygon_area((const double(*)[2])oblanceolate, 33) * 0.1 * 0.06;
    FrPlant *plant = fr_plant_new("blade");
    for (int k = 0; k < 4; k++) {
        const float radii[] = {0.0F, 0.0005F, 0.001F, 0.003F};
        FrShape shape = plain_blade();
        shape.blade.outline =
            fr_plant_add_profile(plant, (const double(*)[2])oblanceolate, 33, false);
        FrMesh *bare = check_shape(plant, &shape);
        g_assert_cmpfloat_with_epsilon(check_area(bare), area, 0.01 * area);
        g_assert_cmpfloat(bare->vertices[0].position[0], !=, 0.0F);
        shape.blade.petiole_length = k > 0 ? 0.01F : 0.0F;
        shape.blade.petiole_radius = radii[k];
        FrMesh *mesh = check_shape(plant, &shape);
        check_sound(mesh);
        uint64_t petiole = k > 0 ? 6 : 0;
        for (float z = 0.0F; z < 0.05F; z += 0.0005F) {
            float half = margin_at(mesh->vertices + petiole, mesh->vertex_count - petiole,
                                   z + shape.blade.petiole_length);
            g_assert_cmpfloat(half, >=, 0.999F * radii[k]);
        }
        double sides = 3.0 * sqrt(3.0) * (double)(radii[k] * shape.blade.petiole_length);
        g_assert_cmpfloat_with_epsilon(check_area(mesh) - sides, area, 0.01 * area);
        fr_mesh_free(mesh);
        fr_mesh_free(bare);
    }
    fr_plant_free(plant);
}

static void test_hostile(void) {
    static const double spikes[][2] = {{0, 0},      {0.2, 0.5}, {0.3, 0},   {0.31, 0.4},
                                       {0.25, 0.1}, {0.6, 0},   {0.7, 0.9}, {1.5, -3}};
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    shape.blade.outline = fr_plant_add_profile(plant, spikes, 8, false);
    shape.blade.segments_along = shape.blade.segments_across = UINT16_MAX;
    FrMesh *mesh = check_shape(plant, &shape);
    g_assert_cmpuint(mesh->index_count, >, 0);
    check_sound(mesh);
    fr_mesh_free(mesh);
    shape.blade.length = 0.0F;
    mesh = check_shape(plant, &shape);
    g_assert_cmpuint(mesh->index_count, ==, 0);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// ---- edges, bumps, leaflets
// ----------------------------------------------------------------------

// Normals are on the side that triangles face: teeth and leaflets are not turned over.
static void assert_one_side(const FrMesh *mesh) {
    for (uint64_t i = 0; i < mesh->index_count; i += 3) {
        const FrVertex *c[3];
        check_corners(mesh, &mesh->parts[0], i, c);
        vec3s area = check_area_vector(c);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat(glms_vec3_dot(area, check_normal(c[k])), >, 0.0F);
        }
    }
}

// Triangular teeth of height d on an edge of length e add d · e / 2, whatever their number.
static void test_teeth(void) {
    FrPlant *plant = fr_plant_new("blade");
    static const double strip[][2] = {{0, 0.5}, {1, 0.5}};
    FrShape shape = plain_blade();
    shape.blade.outline = fr_plant_add_profile(plant, strip, 2, false);
    for (uint32_t margin = FR_MARGIN_SERRATE; margin <= FR_MARGIN_CRENATE; margin++) {
        for (uint32_t teeth = 8; teeth <= 200; teeth += 64) {
            shape.blade.margin = margin;
            shape.blade.teeth = teeth;
            shape.blade.tooth_depth = 0.05F;
            shape.blade.tooth_sharpness = 0.5F;
            FrMesh *mesh = check_shape(plant, &shape);
            check_sound(mesh);
            double each = 0.0, full = 0.05 * 0.06 * 0.1 * 0.91 / teeth;
            for (uint32_t k = 0; k < teeth; k++) {
                double place = (k + 0.5) / teeth;
                each += full * fmin(1.0, 4.0 * fmin(place, 1.0 - place) + 0.25);
            }
            // A half circle's polygon of six sides is less than its π / 4.
            double part = margin == FR_MARGIN_CRENATE ? 0.75 : 0.5;
            double area = 0.1 * 0.06 + 2.0 * part * each;
            g_assert_cmpfloat_with_epsilon(check_area(mesh), area, 0.01 * 2.0 * part * each);
            assert_one_side(mesh);
            // Outside of the strip on both sides.
            g_assert_cmpfloat(mesh->parts[0].max[0], >, 0.032F);
            g_assert_cmpfloat(mesh->parts[0].min[0], <, -0.032F);
            fr_mesh_free(mesh);
        }
    }
    fr_plant_free(plant);
}

static void test_lobes(void) {
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    FrMesh *whole = check_shape(plant, &shape);
    shape.blade.margin = FR_MARGIN_LOBED;
    shape.blade.teeth = 4;
    shape.blade.tooth_depth = 0.6F;
    shape.blade.tooth_sharpness = 0.5F;
    FrMesh *mesh = check_shape(plant, &shape);
    check_sound(mesh);
    assert_one_side(mesh);
    // A cosine cuts half of the depth away.
    double part = check_area(mesh) / check_area(whole);
    g_assert_cmpfloat_with_epsilon(part, 1.0 - 0.5 * 0.6, 0.06);
    fr_mesh_free(mesh);
    fr_mesh_free(whole);
    fr_plant_free(plant);
}

// The tip turns by the droop; the edges by the curl; lengths stay.
static void test_late_turns(void) {
    FrPlant *plant = fr_plant_new("blade");
    static const double strip[][2] = {{0, 0.5}, {1, 0.5}};
    FrShape shape = plain_blade();
    shape.blade.outline = fr_plant_add_profile(plant, strip, 2, false);
    shape.blade.segments_along = 64;
    shape.blade.segments_across = 16;
    shape.blade.tip_droop = 1.2F;
    FrMesh *mesh = check_shape(plant, &shape);
    g_assert_cmpfloat_with_epsilon(check_area(mesh), 0.006, 2e-5);
    vec3s tip = {{0, 0, 0}};
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        vec3s at = check_at(&mesh->vertices[i]);
        // The first half is as straight as without.
        g_assert_true(at.z > 0.0501F || fabsf(at.y) < 1e-6F);
        tip = at.z > tip.z ? at : tip;
        if (mesh->vertices[i].uv[1] < 1e-6F) {
            g_assert_cmpfloat_with_epsilon(asin((double)mesh->vertices[i].normal[2]), 1.2, 0.03);
        }
    }
    g_assert_cmpfloat(tip.y, <, -0.01F);
    fr_mesh_free(mesh);
    shape.blade.tip_droop = 0.0F;
    shape.blade.edge_curl = 1.0F;
    mesh = check_shape(plant, &shape);
    g_assert_cmpfloat_with_epsilon(check_area(mesh), 0.006, 2e-5);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        const FrVertex *v = &mesh->vertices[i];
        if (v->uv[0] < 1e-6F || v->uv[0] > 1.0F - 1e-6F) {
            g_assert_cmpfloat_with_epsilon(acos((double)v->normal[1]), 1.0, 0.05);
        }
        g_assert_true(fabsf(v->position[0]) > 0.02F || fabsf(v->position[1]) < 1e-6F);
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_bumps(void) {
    FrPlant *plant = fr_plant_new("blade");
    FrShape shape = plain_blade();
    shape.blade.undulation = 0.2F;
    shape.blade.undulations = 5.0F;
    float heights[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        shape.blade.phase = (float)(17 * k);
        FrMesh *mesh = check_shape(plant, &shape);
        check_sound(mesh);
        for (uint64_t i = 0; i < mesh->vertex_count; i++) {
            heights[k] = fmaxf(heights[k], fabsf(mesh->vertices[i].position[1]));
        }
        g_assert_cmpfloat(heights[k], <=, 0.2F * 0.06F);
        g_assert_cmpfloat(heights[k], >, 0.02F * 0.06F);
        fr_mesh_free(mesh);
    }
    g_assert_cmpfloat(heights[0], !=, heights[1]);
    fr_plant_free(plant);
}

static FrShape compound_leaf(FrCompound compound, uint32_t leaflets) {
    FrShape shape = plain_blade();
    shape.blade.compound = compound;
    shape.blade.leaflets = leaflets;
    shape.blade.pinnae = 4;
    shape.blade.is_terminal = 1;
    shape.blade.petiole_length = 0.1F;
    shape.blade.rachis_length = 0.5F;
    shape.blade.leaflet_angle = 1.0F;
    shape.blade.leaflet_petiole = 0.01F;
    return shape;
}

// As many leaflets as told, each with the area of the blade.
static void test_leaflets(void) {
    FrPlant *plant = fr_plant_new("leaf");
    FrShape one = plain_blade();
    FrMesh *blade = check_shape(plant, &one);
    double area = check_area(blade);
    fr_mesh_free(blade);
    const struct {
        FrCompound compound;
        uint32_t leaflets;
        double count;
    } cases[] = {{FR_COMPOUND_PINNATE, 5, 11},
                 {FR_COMPOUND_PALMATE, 7, 7},
                 {FR_COMPOUND_BIPINNATE, 6, 9 * 13}};
    for (size_t k = 0; k < G_N_ELEMENTS(cases); k++) {
        FrShape shape = compound_leaf(cases[k].compound, cases[k].leaflets);
        double wanted = cases[k].count * area;
        if (cases[k].compound == FR_COMPOUND_PALMATE) {
            wanted = 0; // smaller to both sides
            for (int i = -3; i <= 3; i++) {
                double size = 1.0 - 0.4 * (i / 3.0) * (i / 3.0);
                wanted += size * size * area;
            }
        }
        FrMesh *mesh = check_shape(plant, &shape);
        check_sound(mesh);
        assert_one_side(mesh);
        g_assert_cmpfloat_with_epsilon(check_area(mesh), wanted, 1e-4 * wanted);
        // Both sides are alike, but for the shapes' own.
        g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[0], -mesh->parts[0].min[0], 1e-5);
        fr_mesh_free(mesh);
    }
    FrShape shape = compound_leaf(FR_COMPOUND_PINNATE, 5);
    FrMesh *mesh = check_shape(plant, &shape);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[2], 0.1 + 0.5 + 0.01 + 0.1, 1e-4);
    fr_mesh_free(mesh);
    shape.blade.petiole_radius = 0.004F;
    mesh = check_shape(plant, &shape);
    check_sound(mesh);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].min[2], 0.0, 1e-6);
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

static void test_normals(void) {
    FrPlant *plant = fr_plant_new("leaf");
    FrShape shape = plain_blade();
    shape.blade.fold = 0.7F;
    for (uint32_t normals = FR_NORMALS_FLAT; normals <= FR_NORMALS_ROUND; normals++) {
        shape.blade.normals = normals;
        FrMesh *mesh = check_shape(plant, &shape);
        check_sound(mesh);
        for (uint64_t i = 0; i < mesh->vertex_count; i++) {
            vec3s normal = check_normal(&mesh->vertices[i]), at = check_at(&mesh->vertices[i]);
            bool is_flat = normals == FR_NORMALS_FLAT;
            g_assert_true(!is_flat || normal.y == 1.0F);
            g_assert_true(is_flat || normal.y > 0.0F);
            // Round ones lean to the ends.
            g_assert_true(is_flat || at.z < 0.09F || normal.z > 0.1F);
            g_assert_true(is_flat || at.z > 0.01F || normal.z < -0.1F);
        }
        fr_mesh_free(mesh);
    }
    // Three leaves in a row: those at the ends are shaded away from the middle one.
    shape.blade.normals = FR_NORMALS_CROWN;
    uint32_t form = fr_plant_add_shape(plant, &shape), first = fr_plant_append_organs(plant, 3);
    for (uint32_t i = 0; i < 3; i++) {
        plant->organs.shape[first + i] = form;
        plant->organs.offset[first + i] = (vec3s){{4.0F * ((float)i - 1.0F), 0, 0}};
    }
    FrMesh *mesh = check_skin(plant, NULL);
    check_sound(mesh);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        float x = mesh->vertices[i].position[0];
        g_assert_true(fabsf(x) < 1.0F || mesh->vertices[i].normal[0] * x > 0.99F * fabsf(x));
    }
    fr_mesh_free(mesh);
    fr_plant_free(plant);
}

// Everything at once at its extremes, at every level: finite, and no larger than was counted.
static void test_wild_leaves(void) {
    FrPlant *plant = fr_plant_new("leaf");
    FrContext context = fr_context_default();
    for (uint32_t k = 0; k < 40; k++) {
        FrShape shape = compound_leaf((FrCompound)(k % 4), k % 3 == 0 ? 60 : 1);
        shape.blade.pinnae = k % 5 == 0 ? 40 : 1;
        shape.blade.margin = k % 5;
        shape.blade.teeth = k % 2 ? 200 : 1;
        shape.blade.tooth_depth = 1.0F;
        shape.blade.tooth_sharpness = (float)(k % 7) / 6.0F;
        shape.blade.undulation = 1.0F;
        shape.blade.undulations = 20.0F;
        shape.blade.edge_curl = 12.0F;
        shape.blade.tip_droop = -12.0F;
        shape.blade.rachis_curvature = 12.0F;
        shape.blade.rachis_length = k % 6 == 0 ? 0.0F : 1.0F;
        shape.blade.normals = k % 4;
        shape.blade.segments_along = 1;
        shape.blade.segments_across = 1;
        uint32_t index = fr_plant_add_shape(plant, &shape);
        for (int lod = 0; lod < 5; lod += k % 3 == 0 ? 4 : 2) {
            FrSkinParams params = fr_skin_default();
            FrMesh *mesh = NULL;
            params.lod = lod;
            g_assert_cmpint(fr_skin_shape(plant, index, &params, FR_UP_Z, &context, &mesh), ==,
                            FR_OK);
            for (uint64_t i = 0; i < mesh->vertex_count; i++) {
                g_assert_true(isfinite(glms_vec3_norm(check_at(&mesh->vertices[i]))));
                float length = glms_vec3_norm(check_normal(&mesh->vertices[i]));
                g_assert_cmpfloat_with_epsilon(length, 1.0F, 1e-3F);
            }
            fr_mesh_free(mesh);
        }
    }
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/blade/C8: a flat blade has the area of its outline", test_area);
    g_test_add_func("/skin/blade/a closed outline gives both halves", test_closed_outline);
    g_test_add_func("/skin/blade/C9: curvature along turns the tip by curvature times length",
                    test_along);
    g_test_add_func("/skin/blade/C9: curvature across keeps arc length", test_across);
    g_test_add_func("/skin/blade/twist turns the tip about the midrib", test_twist);
    g_test_add_func("/skin/blade/C12: the picture's tip is the blade's tip", test_texture);
    g_test_add_func("/skin/blade/C7 three segments make four triangles, eight if folded",
                    test_frugal);
    g_test_add_func("/skin/blade/a blade begins no narrower than its petiole", test_base);
    g_test_add_func("/skin/blade/wild outlines and numbers give sound triangles", test_hostile);
    g_test_add_func("/skin/blade/teeth add the area of their triangles outside the edge",
                    test_teeth);
    g_test_add_func("/skin/blade/lobes cut their depth out of the outline", test_lobes);
    g_test_add_func("/skin/blade/droop and curl turn the end by their angle and keep area",
                    test_late_turns);
    g_test_add_func("/skin/blade/bumps are no higher than told, others for another phase",
                    test_bumps);
    g_test_add_func("/skin/blade/a compound leaf has its leaflets on both sides", test_leaflets);
    g_test_add_func("/skin/blade/normals are flat, round, or away from the crown", test_normals);
    g_test_add_func("/skin/blade/extreme leaves are finite at every level", test_wild_leaves);
    return g_test_run();
}
