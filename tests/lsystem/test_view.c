// View files and what they name.
#include "lsystems.h"

#include <glib/gstdio.h>
#include <math.h>

static FrLview *read_view(const char *text, const char *folder, FrDiags *diags, FrStatus wanted) {
    FrContext context = fr_context_default();
    context.diags = diags;
    FrSource *source = fr_source_new("test.v", text, strlen(text));
    FrLview *view;
    g_assert_cmpint(fr_lview_read(source, folder, &context, &view), ==, wanted);
    fr_source_unref(source);
    return view;
}

typedef struct Drawn {
    FrPlant *plant;
    FrLdrawn drawn;
    char *string;
} Drawn;

static Drawn draw(const char *text, const FrLview *view) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("test.l", text, strlen(text));
    FrLoptions options = {.view = view};
    FrLsettings settings = fr_lsettings_default();
    settings.view = view;
    FrLsystem *system;
    FrLderivation *derivation;
    Drawn made;
    g_assert_cmpint(fr_lsystem_compile(source, &options, &context, &system), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_new(system, &settings, &context, &derivation), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_plant(derivation, &context, &made.plant, &made.drawn), ==,
                    FR_OK);
    g_assert_true(fr_plant_is_valid(made.plant, NULL));
    GString *string = g_string_new(NULL);
    fr_lstring_print(fr_lderivation_string(derivation), string);
    made.string = g_string_free(string, FALSE);
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_source_unref(source);
    return made;
}

static void clear(Drawn *made) {
    fr_plant_free(made->plant);
    g_free(made->string);
}

static void test_angles(void) {
    FrLview *view = read_view("angle factor: 4\ninitial scale: 2\ninitial line width: 0.5 s\n",
                              NULL, NULL, FR_OK);
    Drawn made = draw("w : +F(3)\n", view);
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.position[0].x, -6, 1e-5F);
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.radius[0], 0.25, 1e-6F);
    clear(&made);
    fr_lview_free(view);
}

// T = (0,−1,0), e = 0.2, H horizontal: 0.2 rad in the first step, then 0.2 times the sine.
static void test_tropism(void) {
    FrLview *view = read_view("tropism: T: 0 -1 0 E: 0.2\n", NULL, NULL, FR_OK);
    Drawn made = draw("w : +(90)FF\n", view);
    double first = 0.2, second = first + 0.2 * cos(first);
    double x = -cos(first) - cos(second), z = -sin(first) - sin(second);
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.position[1].x, (float)x, 1e-5F);
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.position[1].z, (float)z, 1e-5F);
    clear(&made);
    fr_lview_free(view);
}

static void test_unknown(void) {
    FrDiags *diags = fr_diags_new();
    FrLview *view = read_view("angel increment: 30\nz buffer: on\n", NULL, diags, FR_OK);
    g_assert_cmpuint(fr_diags_count(diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "unknown-command");
    g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, "'angle increment'"));
    fr_lview_free(view);
    g_assert_null(read_view("contour: 1 nowhere.con\n", NULL, diags, FR_ERR_DOCUMENT));
    g_assert_cmpstr(fr_diags_get(diags, 1)->code, ==, "missing-file");
    FrLview *without = read_view("surface: l nowhere.s 1\n", NULL, diags, FR_OK);
    g_assert_cmpint(fr_diags_get(diags, 2)->severity, ==, FR_WARNING);
    fr_lview_free(without);
    fr_diags_free(diags);
}

static void write_file(const char *folder, const char *name, const char *text) {
    char *path = g_build_filename(folder, name, NULL);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    g_free(path);
}

static void test_companions(void) {
    char *folder = g_dir_make_tmp("frond-view-XXXXXX", NULL);
    // A straight line as control points: the function is its own x.
    write_file(
        folder, "f.func",
        "fver 1 1\nname: ramp\nsamples: 5\nflip: off\npoints: 4\n0 0\n0.3 0.3\n0.7 0.7\n1 1\n");
    write_file(folder, "c.con",
               "cver 1 3\nname: square\npoints: 4 4\ntype: cr\nsamples: 8\n"
               "1 0 0 1\n0 1 0 1\n-1 0 0 1\n0 -1 0 1\n");
    write_file(folder, "l.s",
               "0 1\n0 1\n0 0\nCONTACT POINT X: 0 Y: 0 Z: 0\nEND POINT X: 0 Y: 2 Z: 0\n"
               "HEADING X: 0 Y: 1 Z: 0\nUP X: 0 Y: 0 Z: 1\nSIZE: 1\nleaf\n"
               "0 0 0 0.3 0 0 0.6 0 0 1 0 0\n0 0.3 0 0.3 0.3 0 0.6 0.3 0 1 0.3 0\n"
               "0 0.6 0 0.3 0.6 0 0.6 0.6 0 1 0.6 0\n0 1 0 0.3 1 0 0.6 1 0 1 1 0\n");
    FrLview *view = read_view("function set: f.func\ncontour: 1 c.con\nsurface: l l.s 3 2 2\n"
                              "line style: cylinder\n",
                              folder, NULL, FR_OK);
    Drawn made = draw("Lsystem: 1\naxiom: A(func(ramp,0.25))~lF@#(1)@GsFf@GeF\nX --> X\n"
                      "endlsystem\n",
                      view);
    // Values are found by bisection to a thousandth (test_drawn.c has them exactly).
    double value = g_ascii_strtod(made.string + strlen("A("), NULL);
    g_assert_cmpfloat_with_epsilon(value, 0.25, 0.001);
    g_assert_cmpuint(made.drawn.surfaces, ==, 1);
    g_assert_cmpuint(made.drawn.cylinders, ==, 1);
    // The surface has moved the turtle to its end point, 2 · 3 ahead.
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.position[0].z, 7, 1e-4F);
    g_assert_cmpuint(made.plant->organs.count, ==, 1);
    g_assert_cmpfloat_with_epsilon(made.plant->organs.scale[0], (float)(3 * sqrt(2)), 1e-3F);
    bool has_profile = false;
    for (uint32_t i = 0; i < made.plant->axes.count; i++) {
        has_profile |= made.plant->axes.profile[i] != FR_NONE;
    }
    g_assert_true(has_profile);
    clear(&made);
    fr_lview_free(view);
    const char *const names[] = {"f.func", "c.con", "l.s"};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        char *path = g_build_filename(folder, names[i], NULL);
        g_remove(path);
        g_free(path);
    }
    g_rmdir(folder);
    g_free(folder);
}

// cpfg's own models assign to variables called like functions of `function:` lines.
static void test_names(void) {
    char *folder = g_dir_make_tmp("frond-view-XXXXXX", NULL);
    write_file(folder, "f.func", "fver 1 1\nname: rho\npoints: 4\n0 0\n0.3 0.3\n0.7 0.7\n1 1\n");
    FrLview *view = read_view("function: f.func 100\n", folder, NULL, FR_OK);
    Drawn made = draw("Lsystem: 1\nStart: {rho = 0.5;}\naxiom: A(rho)\nX --> X\n"
                      "endlsystem\n",
                      view);
    g_assert_cmpstr(made.string, ==, "A(0.5)");
    clear(&made);
    fr_lview_free(view);
    char *path = g_build_filename(folder, "f.func", NULL);
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

// Two half shells, 1.4 wide at their control points and 1 high for a line as wide as 1.
static void test_line(void) {
    char *folder = g_dir_make_tmp("frond-view-XXXXXX", NULL);
    write_file(folder, "line.s",
               "-14 14 0 20 0 20\nCONTACT POINT X: 0 Y: 0 Z: 10\nEND POINT X: 0 Y: 20 Z: 10\n"
               "HEADING X: 0 Y: 1 Z: 0\nUP X: 0 Y: 0 Z: 1\nSIZE: 20\nLine_1\n"
               "0 0 0 0 6 0 0 13 0 0 20 0\n-14 0 0 -14 6 0 -14 13 0 -14 20 0\n"
               "-14 0 20 -14 6 20 -14 13 20 -14 20 20\n0 0 20 0 6 20 0 13 20 0 20 20\nLine_2\n"
               "0 0 20 0 6 20 0 13 20 0 20 20\n14 0 20 14 6 20 14 13 20 14 20 20\n"
               "14 0 0 14 6 0 14 13 0 14 20 0\n0 0 0 0 6 0 0 13 0 0 20 0\n");
    FrLview *view = read_view("line style: cylinder\nline: ~ line.s 1\n", folder, NULL, FR_OK);
    Drawn made = draw("w : F[+F]F\n", view);
    g_assert_cmpuint(made.plant->axes.profile[0], ==, made.plant->axes.profile[1]);
    const FrProfile *profile =
        &g_array_index(made.plant->profiles, FrProfile, made.plant->axes.profile[0]);
    double wide = 0, high = 0;
    for (uint32_t i = 0; i < profile->count; i++) {
        wide = fmax(wide, fabs(profile->points[i][0]));
        high = fmax(high, fabs(profile->points[i][1]));
    }
    g_assert_true(profile->is_closed);
    g_assert_cmpfloat_with_epsilon(wide, 0.75 * 1.4, 1e-6); // Bernstein: 3/8 + 3/8 in the middle
    g_assert_cmpfloat_with_epsilon(high, 1, 1e-6);
    clear(&made);
    fr_lview_free(view);
    char *path = g_build_filename(folder, "line.s", NULL);
    g_remove(path);
    g_rmdir(folder);
    g_free(path);
    g_free(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/view/angles, scale and width begin as it says", test_angles);
    g_test_add_func("/lsystem/view/a tropism bends by the sine of the angle", test_tropism);
    g_test_add_func("/lsystem/view/unknown commands are warnings, missing files errors",
                    test_unknown);
    g_test_add_func("/lsystem/view/functions, contours and surfaces are read", test_companions);
    g_test_add_func("/lsystem/view/only functions of a set have names", test_names);
    g_test_add_func("/lsystem/view/segments have the section of a line's surface", test_line);
    return g_test_run();
}
