// Rational surfaces from files: what is read, and what is refused.
#include "frond/mesh_file.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

/// Loads a file of that text. `wanted` is the code of the error it has, NULL if it has none; `said`
/// is a pattern of the first diagnostic, NULL if there is none.
static FrMeshFile *load_told(const char *name, const char *text, gssize size, const char *wanted,
                             const char *said) {
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
    g_assert_cmpuint(fr_diags_count(context.diags), ==, said != NULL);
    if (said != NULL && !g_pattern_match_simple(said, fr_diags_get(context.diags, 0)->text)) {
        g_error("'%s' is not like '%s'", fr_diags_get(context.diags, 0)->text, said);
    }
    fr_diags_free(context.diags);
    g_unlink(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
    return file;
}

static FrMeshFile *load(const char *name, const char *text, gssize size, const char *wanted) {
    return load_told(name, text, size, wanted, wanted != NULL ? "*" : NULL);
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

/// The range of the parameters is what the surface is cut to: from 0.5 on it is the upper part of
/// the arc (its middle is at 45 degrees), and half as high.
static void obj_range(void) {
    FrMeshFile *file = load("q.obj", QUARTER "surf 0.5 1 0 0.5 1 2 3 4 5 6\n" ENDED, -1, NULL);
    const FrNurbsSurface *s = &g_array_index(file->surfaces, FrNurbsSurface, 0);
    g_assert_cmpfloat_with_epsilon(s->points[0][0], sqrt(2), 1e-12);
    g_assert_cmpfloat_with_epsilon(s->points[0][1], sqrt(2), 1e-12);
    g_assert_cmpfloat_with_epsilon((double)file->max.x, sqrt(2), 1e-6);
    g_assert_cmpfloat_with_epsilon((double)file->max.z, 1.5, 1e-6);
    for (uint32_t i = 0; i < file->vertex_count; i++) {
        vec3s at = file->positions[i];
        g_assert_cmpfloat_with_epsilon(hypot((double)at.x, (double)at.y), 2, 1e-6);
    }
    fr_mesh_file_unref(file);
    file = load("q.obj", QUARTER "surf -1 3 0 1e9 1 2 3 4 5 6\n" ENDED, -1, NULL);
    g_assert_cmpfloat_with_epsilon((double)file->max.z, 3, 1e-6);
    fr_mesh_file_unref(file);
    static const char *const empty[] = {"surf 1 0 0 1", "surf 0.5 0.5 0 1", "surf 0 1 2 3",
                                        "surf 0 1 nan 1"};
    for (size_t i = 0; i < G_N_ELEMENTS(empty); i++) {
        char *text = g_strdup_printf(QUARTER "%s 1 2 3 4 5 6\n" ENDED, empty[i]);
        load_told("q.obj", text, -1, "bad-surfaces", "'q.obj', line 9: the range of*");
        g_free(text);
    }
}

#define FACES "usemtl wood\nf 1/1 2/2 3\nf 4 5 \\\n6\n"

/// Polygons beside surfaces are kept, as parts of their own.
static void obj_faces(void) {
    FrMeshFile *file = load(
        "q.obj", "vt 0 0\nvt 1 0\n" QUARTER FACES "surf 0 1 0 1 1 2 3 4 5 6\n" ENDED, -1, NULL);
    g_assert_cmpuint(file->surfaces->len, ==, 1);
    g_assert_cmpuint(file->part_count, ==, 2);
    g_assert_cmpuint(file->parts[0].index_count, >=, 3 * 2 * 4);
    g_assert_cmpuint(file->parts[1].index_count, ==, 3 * 2);
    // The corner of the triangle is where the vertex is: weights are for surfaces.
    bool has_corner = false;
    for (uint32_t i = 0; i < file->parts[1].index_count; i++) {
        vec3s at = file->positions[file->indices[file->parts[1].first_index + i]];
        has_corner |= at.x == 2 && at.y == 2 && at.z == 3;
    }
    g_assert_true(has_corner);
    fr_mesh_file_unref(file);
}

/// Its word and line are told, and nothing is taken for what it is not.
static void obj_words(void) {
#define SURF QUARTER "surf 0 1 0 1 1 2 3 4 5 6\n"
    static const char *const texts[][2] = {
        {QUARTER "surf 0 1 0 1 7 2 3 4 5 6\n" ENDED, "*line 9: there is no vertex '7'"},
        {SURF "parm w 0 0 0 1 1 1\nparm v 0 0 1 1\nend\n", "*line 10: 'parm' is followed by u*"},
        {SURF "parm u 0 0 0 1 1 1 x\nparm v 0 0 1 1\nend\n",
         "*line 10: here should be a knot, not 'x'"},
        {SURF "parm u 0 0 0 1 1 1\nparm v 0 0 1 1a\nend\n",
         "*line 11: here should be a knot, not '1a'"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        load_told("q.obj", texts[i][0], -1, "bad-surfaces", texts[i][1]);
    }
    // What stands behind a # is a comment.
    fr_mesh_file_unref(
        load("q.obj", SURF "parm u 0 0 0 1 1 1 # x\nparm v 0 0 1 1\nend\n", -1, NULL));
    // Those of curves are passed over.
    fr_mesh_file_unref(
        load("q.obj",
             QUARTER "curv 0 1 1 2 3\nparm u 0 0 0 1 1 1\nend\nsurf 0 1 0 1 1 2 3 4 5 6\n" ENDED,
             -1, NULL));
}

/// What has nothing to read is told in the words of its format.
static void obj_nothing(void) {
    static const char *const texts[] = {
        "", "# nothing\n", "v 0 0 0\nv 1 0 0\nl 1 2\n",
        "v 0 0 0\nv 1 0 0\ncstype bspline\ndeg 1\ncurv 0 1 1 2\nparm u 0 0 1 1\nend\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        load_told("q.obj", texts[i], -1, "empty-mesh", "'q.obj' has no faces*");
        load_told("q.OBJ", texts[i], -1, "empty-mesh", "'q.OBJ' has no faces*");
    }
}

/// Of a folder it is not said that it is not there.
static void folder_is_no_file(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL),
         *inner = g_strdup_printf("%s/a.igs", folder);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrStatus status = FR_OK;
    g_assert_cmpint(g_mkdir(inner, 0700), ==, 0);
    g_assert_null(fr_mesh_file_load(folder, "a.igs", (FrSpan){0}, &context, &status));
    g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_count(context.diags), ==, 1);
    g_assert_true(g_str_has_suffix(fr_diags_get(context.diags, 0)->text, "/a.igs' is not a file"));
    fr_diags_free(context.diags);
    g_rmdir(inner);
    g_rmdir(folder);
    g_free(inner);
    g_free(folder);
}

static void obj_cut_off(void) {
    load_told("q.obj", QUARTER "surf 0 1 0 1 1 2 3 4 5 6\nparm u 0 0 0 1 1 1\nparm v 0 0 1 1\n", -1,
              "bad-surfaces", "'q.obj', line 9: *no 'end'*");
    load_told("q.obj", QUARTER "surf 0 1 0 1 1 2 3 4 5 6\nsurf 0 1 0 1 1 2 3 4 5 6\n" ENDED, -1,
              "bad-surfaces", "'q.obj', line 9: *no 'end'*");
    // The knots of one surface are not those of the next.
    load_told("q.obj", QUARTER "surf 0 1 0 1 1 2 3 4 5 6\n" ENDED "surf 0 1 0 1 1 2 3 4 5 6\nend\n",
              -1, "bad-surfaces", "'q.obj', line 13: 'parm u' has 0 knots*");
}

/// Replaces every end of a line.
static char *with_ends(const char *text, const char *end) {
    char **lines = g_strsplit(text, "\n", -1), *joined = g_strjoinv(end, lines);
    g_strfreev(lines);
    return joined;
}

static void line_ends(void) {
    static const char *const ends[] = {"\r", "\r\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(ends); i++) {
        char *text = with_ends(QUARTER FACES "surf 0 1 0 1 1 2 \\\n3 4 5 6\n" ENDED, ends[i]);
        FrMeshFile *file = load("q.obj", text, -1, NULL);
        g_assert_cmpuint(file->surfaces->len, ==, 1);
        g_assert_cmpuint(file->parts[file->part_count - 1].index_count, ==, 3 * 2);
        fr_mesh_file_unref(file);
        g_free(text);
    }
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

static char *replaced(char *text, const char *old, const char *new) {
    g_assert_cmpuint(strlen(old), ==, strlen(new));
    char *at = strstr(text, old);
    g_assert_nonnull(at);
    memcpy(at, new, strlen(new));
    return text;
}

/// The patch is as wide as that along y.
static void assert_wide(char *text, double width, const char *said) {
    FrMeshFile *file = load_told("patch.igs", text, -1, NULL, said);
    g_assert_cmpfloat_with_epsilon((double)file->max.y - (double)file->min.y, width, 1e-6 * width);
    fr_mesh_file_unref(file);
    g_free(text);
}

static void iges_units(void) {
    assert_wide(iges_text("2", PATCH PLACES), 0.002, NULL);
    assert_wide(iges_text("", PATCH PLACES), 2 * 0.0254, NULL);
    assert_wide(iges_text("99", PATCH PLACES), 2, "*line 2: the unit with the flag 99 is unknown*");
    assert_wide(iges_text("3", PATCH PLACES), 2, "*line 2: the unit with the flag 3 is unknown*");
    assert_wide(replaced(iges_text("3", PATCH PLACES), "2HXX", "2HCM"), 0.02, NULL);
    assert_wide(replaced(iges_text("6", PATCH PLACES), "1Hp,1.,6", "1Hp,.5,6"), 4, NULL);
    assert_wide(replaced(iges_text("6", PATCH PLACES), "1Hp,1.,6", "1Hp,-1,6"), 2,
                "*line 2: the scale of model space -1*");
    char *text = iges_text("6", PATCH PLACES);
    assert_wide(with_ends(text, "\r"), 2, NULL);
    g_free(text);
}

static void iges_range(void) {
    assert_wide(iges_text("6", PATCH "0.,0.,0.,2.,0.,0.,0.,1.,0.,2.,1.,0.,.5,1.,0.,1.;"), 1, NULL);
    assert_wide(iges_text("6", PATCH "0.,0.,0.,2.,0.,0.,0.,1.,0.,2.,1.,0.;"), 2, NULL);
}

/// What an IGES file that is wrong is told.
static void refuse_iges(char *text, const char *said) {
    load_told("wrong.igs", text, -1, "bad-surfaces", said);
    g_free(text);
}

static void iges_errors(void) {
    refuse_iges(iges_text("6", "128,1,1,1,1,0,0,1,0,0,0.,0.,1.;"),
                "*line 5: a surface of 2 times 2 points has 33 numbers, not 12");
    refuse_iges(iges_text("6", "128,1,1,12,1,0,0,1,0,0,0.,0.,1.;"), "*degrees from 1 to 9, not 12");
    refuse_iges(iges_text("6", "128,1,1,2,1,0,0,1,0,0,0.,0.,1.;"),
                "*of degree 2 cannot have 2 control points");
    refuse_iges(iges_text("6", "126,1,1,1,1,0,0,1,0,0,0.;"), "*not those of an entity 128");
    refuse_iges(iges_text("6", "128,1;"), "*begins with 9 numbers, not 1");
    refuse_iges(iges_text("6", PATCH "0.,0.,0.,2.,0.,0.,0.,1.,0.,2.,1.,0.,1.,0.,0.,1.;"),
                "*the range of a parameter is empty*");
    // The matrix moves itself; the surface has one that is none; the matrix is short.
    char *matrix = "     124       1       0       0       0       0       0";
    char *circle = "     124       1       0       0       0       0       1";
    refuse_iges(replaced(iges_text("6", PATCH PLACES), matrix, circle), "*line 5: *in a circle");
    char *own = "     128       2       0       0       0       0       1";
    char *none = "     128       2       0       0       0       0       3";
    refuse_iges(replaced(iges_text("6", PATCH PLACES), own, none), "*its matrix is no entity 124");
    refuse_iges(replaced(iges_text("6", PATCH PLACES), "10.,1.,0.,0.,", "10.;1.,0.,0.,"),
                "*line 3: a matrix (entity 124) has 12 numbers, not 4");
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
    const char *texts[2] = {QUARTER FACES "surf .1 1 0 .9 1 2 3 4 5 6\n" ENDED, iges};
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
    g_test_add_func("/material/nurbs_file/an .obj with nothing to read is told", obj_nothing);
    g_test_add_func("/material/nurbs_file/free-form OBJ is read exactly", obj);
    g_test_add_func("/material/nurbs_file/surfaces are cut to their range", obj_range);
    g_test_add_func("/material/nurbs_file/faces beside surfaces are kept", obj_faces);
    g_test_add_func("/material/nurbs_file/a file that is cut off is told with its line",
                    obj_cut_off);
    g_test_add_func("/material/nurbs_file/words of OBJ that mean nothing are told", obj_words);
    g_test_add_func("/material/nurbs_file/a folder is told to be no file", folder_is_no_file);
    g_test_add_func("/material/nurbs_file/lines end in three ways", line_ends);
    g_test_add_func("/material/nurbs_file/IGES has units and a scale", iges_units);
    g_test_add_func("/material/nurbs_file/IGES surfaces are cut to their range", iges_range);
    g_test_add_func("/material/nurbs_file/what is wrong with IGES is told", iges_errors);
    g_test_add_func("/material/nurbs_file/IGES is read with its matrices and units", iges);
    g_test_add_func("/material/nurbs_file/what is unsound is refused", refused);
    g_test_add_func("/material/nurbs_file/changed bytes do no harm", mutated);
    return g_test_run();
}
