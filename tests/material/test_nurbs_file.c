// Rational surfaces from files: what is read, and what is refused.
#include "frond/mesh_file.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static FrMeshFile *load(const char *name, const char *text, gssize size, const char *wanted) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL),
         *path = g_build_filename(folder, name, NULL);
    g_assert_true(g_file_set_contents(path, text, size, NULL));
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.triangles = 100000;
    FrStatus status = FR_OK;
    FrMeshFile *file = fr_mesh_file_load(folder, name, (FrSpan){0}, &context, &status);
    if (wanted == NULL) {
        g_assert_cmpint(status, ==, FR_OK);
        g_assert_nonnull(file);
    } else {
        g_assert_null(file);
        g_assert_cmpuint(fr_diags_count(context.diags), >, 0);
        g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, wanted);
    }
    fr_diags_free(context.diags);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return file;
}

// A quarter of a cylinder of radius 2 from y = 0 to 3 (up), its weight √½ at the corner.
#define QUARTER                                                                                    \
    "v 2 0 0 1\nv 2 0 -2 0.70710678118654752\nv 0 0 -2 1\n"                                        \
    "v 2 3 0 1\nv 2 3 -2 0.70710678118654752\nv 0 3 -2 1\n"                                        \
    "cstype rat bspline\ndeg 2 1\n"
#define ENDED "parm u 0 0 0 1 1 1\nparm v 0 0 1 1\nend\n"

static void obj(void) {
    FrMeshFile *file =
        load("q.nurbs.obj", QUARTER "surf 0 1 0 1 1 2 \\\n 3 -3 -2 -1\n" ENDED, -1, NULL);
    g_assert_cmpuint(file->surfaces->len, ==, 1);
    g_assert_cmpuint(file->part_count, ==, 1);
    for (uint32_t i = 0; i < file->vertex_count; i++) {
        vec3s at = file->positions[i], normal = file->normals[i];
        g_assert_cmpfloat_with_epsilon(hypot((double)at.x, (double)at.y), 2, 1e-6);
        g_assert_cmpfloat_with_epsilon(at.x * normal.x + at.y * normal.y, 2, 1e-5);
    }
    g_assert_cmpfloat_with_epsilon((double)file->max.z, 3, 1e-6); // z is up
    g_assert_cmpuint(file->index_count, >=, 3 * 2 * 4);
    fr_mesh_file_unref(file);
}

/// A file of a plane patch in inches, moved by a matrix, of lines of 80 columns.
static char *iges_text(const char *unit, const char *parameters) {
    GString *text = g_string_new(NULL);
    g_string_append_printf(text, "%-72sS%7d\n", "a patch", 1);
    char *global =
        g_strdup_printf("1H,,1H;,1Hp,1Hp,1Hf,1Hf,32,38,7,308,15,1Hp,1.,%s,2HXX,1,0.01;", unit);
    g_string_append_printf(text, "%-72sG%7d\n", global, 1);
    const int entries[2][3] = {{124, 1, 0}, {128, 2, 1}};
    for (int i = 0; i < 2; i++) {
        g_string_append_printf(text, "%8d%8d%8d%8d%8d%8d%8d%8d%8sD%7d\n", entries[i][0],
                               entries[i][1], 0, 0, 0, 0, entries[i][2], 0, "00000000", 2 * i + 1);
        g_string_append_printf(text, "%8d%8d%8d%8d%8d%8s%8s%8s%8dD%7d\n", entries[i][0], 0, 0,
                               i == 0 ? 1 : 2, 0, "", "", "", 0, 2 * i + 2);
    }
    g_string_append_printf(text, "%-64s%8dP%7d\n", "124,0.,-1.,0.,10.,1.,0.,0.,0.,0.,0.,1.,0.;", 1,
                           1);
    g_string_append_printf(text, "%-64.64s%8dP%7d\n", parameters, 3, 2);
    g_string_append_printf(text, "%-64s%8dP%7d\n", strlen(parameters) > 64 ? parameters + 64 : "",
                           3, 3);
    g_string_append_printf(text, "S%7dG%7dD%7dP%7d%40sT%7d\n", 1, 1, 4, 3, "", 1);
    g_free(global);
    return g_string_free(text, FALSE);
}

#define PATCH "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.D0,1.,1.,1.,1.,    "
#define PLACES "0.,0.,0.,2.,0.,0.,0.,1.,0.,2.,1.,0.,0.,1.,0.,1.;"

static void iges(void) {
    g_assert_cmpuint(strlen(PATCH), ==, 64);
    char *text = iges_text("1", PATCH PLACES);
    FrMeshFile *file = load("patch.igs", text, -1, NULL);
    g_assert_cmpuint(file->surfaces->len, ==, 1);
    // (x, y) goes to (10 − y, x), and an inch is 25.4 mm.
    g_assert_cmpfloat_with_epsilon((double)file->min.x, 9 * 0.0254, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)file->max.x, 10 * 0.0254, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)file->max.y, 2 * 0.0254, 1e-6);
    g_assert_cmpuint(file->index_count, ==, 6); // a plane is two triangles
    fr_mesh_file_unref(file);
    g_free(text);
}

static void refused(void) {
    static const char *const objs[] = {
        QUARTER "surf 0 1 0 1 1 2 3 4 5\n" ENDED,
        QUARTER "surf 0 1 0 1 1 2 3 4 5 7\n" ENDED,
        QUARTER "surf 0 1 0 1 1 2 3 4 5 0\n" ENDED,
        QUARTER "surf 0 1 0 1 1 2 3 4 5 6\nend\n",
        QUARTER "deg 0 1\nsurf 0 1 0 1 1 2 3 4 5 6\n" ENDED,
        QUARTER "cstype bezier\nsurf 0 1 0 1 1 2 3 4 5 6\n" ENDED,
        QUARTER "v 1 1 1 -1\nsurf 0 1 0 1 1 2 3 4 5 7\n" ENDED,
        QUARTER "surf 0 1 0 1 1 2 3 4 5 6\nparm u 0 0 0 -1 1 1\nparm v 0 0 1 1\nend\n",
        QUARTER "surf 0 1 0 1 1 2 3 4 5 6\nparm u 0 0 0 nan 1 1\nparm v 0 0 1 1\nend\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(objs); i++) {
        load("wrong.obj", objs[i], -1, "bad-surfaces");
    }
    static const char *const patches[] = {"128,1,1,1,1,0,0,1,0,0,0.,0.,1.;", "128;",
                                          "128,999999,999999,9,9,0,0,1,0,0,0.;",
                                          "128,-1,1,1,1,0,0,1,0,0,0.;", "128,99H,1;"};
    for (size_t i = 0; i < G_N_ELEMENTS(patches); i++) {
        char *text = iges_text("6", patches[i]);
        load("wrong.igs", text, -1, "bad-surfaces");
        g_free(text);
    }
    load("empty.igs", "", 0, "empty-mesh");
    load("binary.iges", "\0\1\2D\n", 5, "empty-mesh");
}

// Bytes of a sound file changed by a plain generator: nothing hangs or ends the program.
static void mutated(void) {
    char *iges = iges_text("6", PATCH PLACES);
    const char *texts[2] = {QUARTER "surf 0 1 0 1 1 2 3 4 5 6\n" ENDED, iges};
    static const char *const names[2] = {"m.nurbs.obj", "m.igs"};
    uint32_t state = 1;
    for (int n = 0; n < 600; n++) {
        char *text = g_strdup(texts[n % 2]);
        size_t size = strlen(text);
        for (int k = 0; k < 4; k++) {
            state = state * 1664525 + 1013904223;
            text[(state >> 8) % size] = "0123456789-.,;HD \n9e"[(state >> 27) % 20];
        }
        char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
        char *path = g_build_filename(folder, names[n % 2], NULL);
        g_assert_true(g_file_set_contents(path, text, -1, NULL));
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        context.limits.triangles = 100000;
        FrStatus status = FR_OK;
        FrMeshFile *file = fr_mesh_file_load(folder, names[n % 2], (FrSpan){0}, &context, &status);
        g_assert_true((file != NULL) == (status == FR_OK));
        fr_mesh_file_unref(file);
        fr_diags_free(context.diags);
        g_unlink(path);
        g_rmdir(folder);
        g_free(path);
        g_free(folder);
        g_free(text);
    }
    g_free(iges);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/material/nurbs_file/free-form OBJ is read exactly", obj);
    g_test_add_func("/material/nurbs_file/IGES is read with its matrices and units", iges);
    g_test_add_func("/material/nurbs_file/what is unsound is refused", refused);
    g_test_add_func("/material/nurbs_file/changed bytes do no harm", mutated);
    return g_test_run();
}
