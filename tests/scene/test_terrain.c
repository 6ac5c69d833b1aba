/// Hills that plants stand on, and solids drawn along lines.
#include "built.h"

#include "frond/terrain.h"
#include "scene/swept.h"

#include <math.h>
#include <unistd.h>

#define POLE                                                                                       \
    "<plant id='pole'><pgraph><camera id='root'/><horn id='stem'/>"                                \
    "<link from='root' to='stem'/></pgraph></plant>"
#define SCENE(scene) "<frond version='1'>" POLE "<scene>" scene "</scene></frond>"

/// A PNG that is black at its left and white at its right edge.
static char *write_ramp(const char *folder) {
    FrImage *image = fr_image_new(52, 3, 1); // levels are whole: 255 = 5 · 51
    for (uint32_t i = 0; i < 52 * 3; i++) {
        image->pixels[i] = (uint8_t)(5 * (i % 52));
    }
    GBytes *png = fr_image_to_png(image);
    char *path = g_build_filename(folder, "ramp.png", NULL);
    gsize size;
    const void *data = g_bytes_get_data(png, &size);
    g_assert_true(g_file_set_contents(path, data, (gssize)size, NULL));
    g_bytes_unref(png);
    fr_image_unref(image);
    return path;
}

static Built build_in(const char *folder, const char *text) {
    Built built = {.diags = fr_diags_new()};
    FrContext context = fr_context_default();
    context.diags = built.diags;
    FrSource *source = fr_source_new("hills.frond", text, strlen(text));
    built.status = fr_document_parse(source, folder, &context, &built.document);
    if (built.status == FR_OK) {
        built.status = fr_scene_build(built.document, -1, &context, &built.scene);
    }
    fr_source_unref(source);
    return built;
}

static void test_heights(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *path = write_ramp(folder);
    Built built =
        build_in(folder, SCENE("<terrain file='ramp.png' size='102, 40, 10' at='1, 2, 3'/>"
                               "<place plant='pole' at='1, 0, 0'/>"
                               "<place plant='pole' at='26.5, 19, 0.5'/>"
                               "<place plant='pole' at='-50, 5, 0'/>"
                               "<place plant='pole' at='90, 5, 7'/>"));
    g_assert_cmpint(built.status, ==, FR_OK);
    // Heights are 3 to 13 over 102 m, and nothing beyond the edge.
    static const double heights[] = {8, 11, 3, 7};
    for (guint i = 0; i < G_N_ELEMENTS(heights); i++) {
        g_assert_cmpfloat_with_epsilon(stand_at(&built, i)->at[2], heights[i], 1e-4);
    }
    // The ground is in the scene, as an obstacle.
    g_assert_cmpuint(built.scene->obstacles, ==, 1);
    double min[3], max[3];
    fr_scene_bounds(built.scene, min, max);
    g_assert_cmpfloat(max[0] - min[0], >=, 102);
    forget(&built);
    built = build_in(folder, SCENE("<terrain file='ramp.png' size='102, 40, 10' turn='90'/>"
                                   "<place plant='pole' at='0, 25.5, 0'/>"));
    g_assert_cmpfloat_with_epsilon(stand_at(&built, 0)->at[2], 7.5, 1e-4);
    forget(&built);
    unlink(path);
    rmdir(folder);
    g_free(path);
    g_free(folder);
}

static void test_mesh(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *path = g_build_filename(folder, "roof.stl", NULL);
    // Two slopes that meet over x = 0, and a floor below them.
    static const char stl[] =
        "solid roof\n"
        "facet normal 0 0 1\nouter loop\nvertex -4 -4 0\nvertex 0 -4 2\nvertex 0 4 2\nendloop\n"
        "endfacet\n"
        "facet normal 0 0 1\nouter loop\nvertex -4 -4 0\nvertex 0 4 2\nvertex -4 4 0\nendloop\n"
        "endfacet\n"
        "facet normal 0 0 1\nouter loop\nvertex 0 -4 2\nvertex 4 -4 0\nvertex 4 4 0\nendloop\n"
        "endfacet\n"
        "facet normal 0 0 1\nouter loop\nvertex -9 -9 -1\nvertex 9 -9 -1\nvertex 0 9 -1\nendloop\n"
        "endfacet\n"
        "endsolid roof\n";
    g_assert_true(g_file_set_contents(path, stl, -1, NULL));
    Built built = build_in(folder, SCENE("<terrain file='roof.stl' size='1, 1, 3' at='0, 0, 1'/>"
                                         "<place plant='pole' at='-1, -2, 0'/>"
                                         "<place plant='pole' at='3, -2, 0'/>"
                                         "<place plant='pole' at='0, -6, 0'/>"));
    g_assert_cmpint(built.status, ==, FR_OK);
    static const double heights[] = {1 + 3 * 1.5, 1 + 3 * 0.5, 1 - 3};
    for (guint i = 0; i < G_N_ELEMENTS(heights); i++) {
        g_assert_cmpfloat_with_epsilon(stand_at(&built, i)->at[2], heights[i], 1e-5);
    }
    forget(&built);
    unlink(path);
    rmdir(folder);
    g_free(path);
    g_free(folder);
}

static FrMeshFile *sweep(const char *attributes, const char *line) {
    char *text = g_strdup_printf(
        "<frond version='1'><scene><obstacle shape='sweep' %s>%s</obstacle></scene></frond>",
        attributes, line);
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("road.frond", text, strlen(text));
    FrDocument *document;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    FrMeshFile *mesh;
    const GPtrArray *obstacles = fr_document_surroundings(document)->obstacles;
    g_assert_cmpint(fr_swept_mesh(g_ptr_array_index(obstacles, 0), &context, &mesh), ==, FR_OK);
    fr_document_free(document);
    fr_source_unref(source);
    g_free(text);
    return mesh;
}

/// By the theorem of Gauss: positive if triangles turn outwards.
static double volume_of(const FrMeshFile *mesh) {
    double sum = 0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const float *a = mesh->positions[mesh->indices[i]].raw;
        const float *b = mesh->positions[mesh->indices[i + 1]].raw;
        const float *c = mesh->positions[mesh->indices[i + 2]].raw;
        sum += (double)(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0])) /
               6;
    }
    return sum;
}

static void test_sweeps(void) {
    static const struct {
        const char *attributes, *line;
        double volume, slack;
    } rows[] = {
        {"section='square' size='3, 1, 2'", "0,0,0 10,0,0", 60, 1e-3},
        // A mitre keeps the length of the middle line.
        {"section='square' size='3, 1, 2'", "0,0,0 10,0,0 10,8,0", 108, 1e-2},
        {"section='square' size='3, 1, 2'", "0,0,0 0,0,0 0,0,7 0,0,7", 42, 1e-3},
        {"size='3, 1, 2'", "5,5,0 5,15,0", G_PI * 1.5 * 1 * 10, 0.4},
        // A ring by Pappus and Guldin.
        {"size='2, 1, 2' line='smooth'", "9,0,0 6.364,6.364,0 0,9,0 -6.364,6.364,0 -9,0,0",
         G_PI * 9 * G_PI, 2},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        FrMeshFile *mesh = sweep(rows[i].attributes, rows[i].line);
        g_test_message("%s along %s", rows[i].attributes, rows[i].line);
        g_assert_true(mesh->is_closed);
        g_assert_cmpfloat_with_epsilon(volume_of(mesh), rows[i].volume, rows[i].slack);
        fr_mesh_file_unref(mesh);
    }
    FrMeshFile *mesh = sweep("size='3, 1, 2'", "0,0,1 10,0,1");
    g_assert_cmpfloat_with_epsilon((double)mesh->min.z, 1, 1e-6); // stands on its line
    g_assert_cmpfloat_with_epsilon((double)mesh->max.z, 3, 1e-6);
    fr_mesh_file_unref(mesh);
}

static void test_invisible(void) {
    Built built = build(SCENE("<obstacle visible='no'/><place plant='pole'/>"), -1);
    g_assert_cmpuint(built.scene->obstacles, ==, 0);
    forget(&built);
    built =
        build(SCENE("<obstacle visible='no'/><obstacle shape='sweep'>0,0,0 1,1,1</obstacle>"), -1);
    g_assert_cmpuint(built.scene->obstacles, ==, 1);
    g_assert_cmpuint(plant_at(&built, 1)->plant->organs.count, ==, 1);
    forget(&built);
}

static void assert_wrong(const char *scene, FrStatus status, const char *code) {
    Built built = build(scene, -1);
    g_test_message("%s", scene);
    g_assert_cmpint(built.status, ==, status);
    g_assert_cmpuint(fr_diags_error_count(built.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(built.diags, 0)->code, ==, code);
    g_assert_nonnull(fr_diags_get(built.diags, 0)->span.source);
    forget(&built);
}

static void test_wrong(void) {
    assert_wrong(SCENE("<terrain/>"), FR_ERR_DOCUMENT, "missing-attribute");
    assert_wrong(SCENE("<terrain file='no.png'/>"), FR_ERR_DOCUMENT, "picture-missing");
    assert_wrong(SCENE("<terrain file='no.obj'/>"), FR_ERR_DOCUMENT, "missing-file");
    assert_wrong(SCENE("<terrain file='no.jpg'/>"), FR_ERR_DOCUMENT, "unknown-format");
    assert_wrong(SCENE("<terrain file='/etc/hills.png'/>"), FR_ERR_DOCUMENT, "absolute-path");
    assert_wrong(SCENE("<obstacle>0,0,0 1,1,1</obstacle>"), FR_ERR_DOCUMENT, "unexpected-text");
    assert_wrong(SCENE("<obstacle shape='sweep'/>"), FR_ERR_DOCUMENT, "bad-stroke");
    assert_wrong(SCENE("<obstacle shape='sweep'>1,1</obstacle>"), FR_ERR_DOCUMENT, "bad-stroke");
    assert_wrong(SCENE("<obstacle shape='sweep' line='smooth' size='0.001, 1, 1'>0,0,0 1e8,0,0 "
                       "</obstacle>"),
                 FR_ERR_LIMIT, "limit-triangles");
}

static void test_damaged(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *path = write_ramp(folder), *bytes;
    gsize size;
    g_assert_true(g_file_get_contents(path, &bytes, &size, NULL));
    for (gsize cut = 0; cut < size; cut++) { // a file that ends too early, or has a wrong byte
        FrContext context = fr_context_default();
        FrStatus status;
        char kept = bytes[cut];
        bytes[cut] = (char)(kept ^ 0x55);
        g_assert_true(g_file_set_contents(path, bytes, (gssize)size, NULL));
        FrHeightMap *map = fr_height_map_load(path, (FrSpan){0}, &context, &status);
        g_assert_true((map != NULL) == (status == FR_OK));
        fr_height_map_free(map);
        bytes[cut] = kept;
        g_assert_true(g_file_set_contents(path, bytes, (gssize)cut, NULL));
        map = fr_height_map_load(path, (FrSpan){0}, &context, &status);
        bool is_trailer = cut >= size - 12; // nothing is missing but the mark of the end
        g_assert_true(map == NULL || is_trailer);
        fr_height_map_free(map);
    }
    unlink(path);
    rmdir(folder);
    g_free(bytes);
    g_free(path);
    g_free(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/terrain/plants stand on a height map, turned with it", test_heights);
    g_test_add_func("/scene/terrain/plants stand on the highest triangle of a mesh", test_mesh);
    g_test_add_func("/scene/terrain/sweeps are closed and have the volume of their line",
                    test_sweeps);
    g_test_add_func("/scene/terrain/what is not visible is in no scene", test_invisible);
    g_test_add_func("/scene/terrain/wrong terrain and sweeps have a place and a code", test_wrong);
    g_test_add_func("/scene/terrain/damaged height maps are refused", test_damaged);
    return g_test_run();
}
