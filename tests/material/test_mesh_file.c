// Files of triangles: what is taken from them, and what is refused.
#include "frond/mesh_file.h"
#include "frond/random.h"

#include <glib.h>
#include <glib/gstdio.h>
#include <string.h>

static const char tetrahedron[] = "mtllib t.mtl\n"
                                  "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n"
                                  "usemtl red\nf 1 3 2\nf 1 2 4\nusemtl blue\nf 2 3 4\nf 1 4 3\n";
static const char materials[] = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd sky.png\n";

typedef struct Place {
    char *folder;
    FrDiags *diags;
    FrContext context;
} Place;

static Place place_new(void) {
    Place place = {.folder = g_dir_make_tmp("frond-mesh-XXXXXX", NULL), .diags = fr_diags_new()};
    place.context = fr_context_default();
    place.context.diags = place.diags;
    return place;
}

static void place_put(const Place *place, const char *name, const void *bytes, size_t size) {
    char *path = g_build_filename(place->folder, name, NULL);
    g_assert_true(g_file_set_contents(path, bytes, (gssize)size, NULL));
    g_free(path);
}

static void place_free(Place *place) {
    GDir *folder = g_dir_open(place->folder, 0, NULL);
    for (const char *name; (name = g_dir_read_name(folder)) != NULL;) {
        char *path = g_build_filename(place->folder, name, NULL);
        g_unlink(path);
        g_free(path);
    }
    g_dir_close(folder);
    g_rmdir(place->folder);
    g_free(place->folder);
    fr_diags_free(place->diags);
}

static FrMeshFile *load(const Place *place, const char *name, FrStatus *status) {
    return fr_mesh_file_load(place->folder, name, (FrSpan){0}, &place->context, status);
}

static void taken(void) {
    Place place = place_new();
    place_put(&place, "t.obj", tetrahedron, strlen(tetrahedron));
    place_put(&place, "t.mtl", materials, strlen(materials));
    FrStatus status;
    FrMeshFile *file = load(&place, "t.obj", &status);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_cmpuint(file->index_count, ==, 12);
    g_assert_true(file->is_closed);
    // y was up.
    g_assert_cmpfloat(file->max.z, ==, 2);
    g_assert_cmpfloat(file->min.y, ==, -3);
    g_assert_cmpuint(file->part_count, ==, 2);
    for (uint32_t p = 0; p < 2; p++) {
        const FrMaterialParams *params = fr_material_params(file->parts[p].material);
        bool is_red = strcmp(fr_material_name(file->parts[p].material), "t.obj-red") == 0;
        g_assert_cmpfloat_with_epsilon(params->colour.x, is_red ? 1 : 0, 1e-6);
        g_assert_cmpfloat_with_epsilon(params->colour.z, is_red ? 0 : 1, 1e-6);
        g_assert_cmpstr(is_red ? "sky.png" : params->picture, ==, "sky.png");
    }
    fr_mesh_file_unref(file);
    place_free(&place);
}

static void refused(void) {
    static const char *const names[] = {"/etc/passwd.obj", "../t.obj", "a/../../t.obj", "t.ply",
                                        "none.obj",        "",         "t.obj/x.obj"};
    Place place = place_new();
    place_put(&place, "t.ply", tetrahedron, strlen(tetrahedron));
    for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
        FrStatus status = FR_OK;
        g_assert_null(load(&place, names[k], &status));
        g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
        g_assert_cmpuint(fr_diags_count(place.diags), ==, k + 1);
    }
    place_free(&place);
}

static void limited(void) {
    Place place = place_new();
    place_put(&place, "t.obj", tetrahedron, strlen(tetrahedron));
    FrStatus status;
    place.context.limits.document_bytes = 20;
    g_assert_null(load(&place, "t.obj", &status));
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    place.context.limits = fr_limits_default();
    place.context.limits.triangles = 3;
    g_assert_null(load(&place, "t.obj", &status));
    g_assert_cmpint(status, ==, FR_ERR_LIMIT);
    place_free(&place);
}

static void unsound(void) {
    // Corners that are no places take their triangles with them.
    static const char wild[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e30 0 0\nf 1 2 3\nf 1 2 4\n";
    static const char empty[] = "v 0 0 0\nv 1 0 0\n";
    Place place = place_new();
    place_put(&place, "w.obj", wild, strlen(wild));
    place_put(&place, "e.obj", empty, strlen(empty));
    FrStatus status;
    FrMeshFile *file = load(&place, "w.obj", &status);
    g_assert_nonnull(file);
    g_assert_cmpuint(file->index_count, ==, 3);
    g_assert_false(file->is_closed);
    fr_mesh_file_unref(file);
    g_assert_null(load(&place, "e.obj", &status));
    g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
    place_free(&place);
}

// What the importer would read as 0.
static void no_numbers(void) {
    static const char *const texts[] = {
        "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 0 1e999 0\nf 1 2 3\n"};
    Place place = place_new();
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        place_put(&place, "n.obj", texts[k], strlen(texts[k]));
        FrStatus status = FR_OK;
        g_assert_null(load(&place, "n.obj", &status));
        g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
        const FrDiag *diag = fr_diags_get(place.diags, fr_diags_count(place.diags) - 1);
        g_assert_cmpstr(diag->code, ==, "wrong-mesh");
        g_assert_nonnull(strstr(diag->text, "line 3"));
    }
    place_free(&place);
}

// Broken copies of a small file in each format: read or refused.
static void broken(void) {
    static const char stl[] = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                              "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":[{\"uri\":"
        "\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
        "\",\"byteLength\":36}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{"
        "\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]}";
    const struct {
        const char *name, *text;
    } files[] = {{"t.obj", tetrahedron}, {"t.stl", stl}, {"t.gltf", gltf}};
    Place place = place_new();
    for (size_t f = 0; f < G_N_ELEMENTS(files); f++) {
        size_t size = strlen(files[f].text);
        for (uint32_t turn = 0; turn < 60; turn++) {
            char *bytes = g_strdup(files[f].text);
            FrKey key = fr_key_child(fr_key_root(f), turn);
            for (uint32_t k = 0; k < turn % 6; k++) {
                bytes[fr_random_bits(key, 0, k) % size] = (char)fr_random_bits(key, 1, k);
            }
            size_t left = turn % 7 == 6 ? (size_t)(fr_random_bits(key, 2, 0) % size) : size;
            place_put(&place, files[f].name, bytes, left);
            FrStatus status = FR_OK;
            FrMeshFile *file = load(&place, files[f].name, &status);
            g_assert_true((file != NULL) == (status == FR_OK));
            g_assert_true(turn > 0 || file != NULL);
            fr_mesh_file_unref(file);
            g_free(bytes);
        }
    }
    place_free(&place);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/material/mesh_file/" name, function)
    TEST("triangles, parts and colours are taken as they are", taken);
    TEST("paths that lead out and unknown formats are refused", refused);
    TEST("places in .obj files that are no numbers are told with their line", no_numbers);
    TEST("large files are refused before they are read", limited);
    TEST("triangles without a place are left out", unsound);
    TEST("broken files are read or refused", broken);
    return g_test_run();
}
