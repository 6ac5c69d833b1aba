/// Texts of attributes as handles move them, views as they are turned, settings, places of
/// elements.
#include "studio/model/values.h"

#include "frond/curve.h"
#include "studio.h"
#include "studio/model/camera.h"
#include "studio/model/place.h"
#include "studio/model/profile.h"
#include "studio/model/settings.h"

#include <glib/gstdio.h>
#include <math.h>

static void assert_text(double value, double span, const char *should) {
    char *text = studio_value_text(value, span);
    g_assert_cmpstr(text, ==, should);
    g_free(text);
}

static void test_numbers(void) {
    assert_text(0.5, 1, "0.5");
    assert_text(0.123456, 1, "0.123");
    assert_text(12.3456, 100, "12.3");
    assert_text(7, 1000, "7");
    assert_text(0.00012345, 0.001, "0.000123");
    assert_text(-0.0001, 1, "0");
    double value;
    g_assert_true(studio_value_is_number(" -3.5e1 ", &value));
    g_assert_cmpfloat(value, ==, -35);
    g_assert_false(studio_value_is_number("3..4", &value));
    g_assert_false(studio_value_is_number("= t", &value));
    g_assert_false(studio_value_is_number("inf", &value));
    char *one = studio_count_words(1, "leaf", "leaves");
    char *none = studio_count_words(0, "leaf", "leaves");
    g_assert_cmpstr(one, ==, "1 leaf");
    g_assert_cmpstr(none, ==, "0 leaves");
    g_free(none);
    g_free(one);
    char *count = studio_count_text(2640981);
    g_assert_cmpstr(count, ==, "2\u202f640\u202f981");
    g_free(count);
}

static void assert_short(const char *text, const char *should) {
    char *given = studio_value_short(text);
    g_assert_cmpstr(given, ==, should);
    g_free(given);
}

static void test_short(void) {
    assert_short("222.49223594996", "222.492");
    assert_short("-0.000123456789", "-0.000123457");
    assert_short("137.5", "137.5");
    assert_short("123456789", "123456789");
    assert_short("12345678.25", "12345678.25");
    assert_short("222.49223594996(5)", "222.49223594996(5)");
    assert_short("thick", "thick");
    assert_short("", "");
}

static void test_ranges(void) {
    const FrParamTable *tree = fr_pgraph_table(FR_COMPONENT_TREE);
    for (size_t i = 0; i < tree->count; i++) {
        const FrParam *row = &tree->rows[i];
        if (row->kind != FR_PARAM_NUMBER && row->kind != FR_PARAM_REAL) {
            continue;
        }
        for (double value = row->min; value <= row->max; value += (row->max - row->min) / 7) {
            double min, max;
            studio_value_range(row, value, &min, &max);
            g_assert_cmpfloat(min, <=, value);
            g_assert_cmpfloat(max, >=, value);
            g_assert_cmpfloat(min, <, max);
            g_assert_cmpfloat(min, >=, row->min);
            g_assert_cmpfloat(studio_value_step(row, min, max), >, 0);
        }
    }
    double min, max;
    studio_value_range(fr_params_find(tree, "length"), 10.5, &min, &max);
    g_assert_cmpfloat(min, ==, 0);
    g_assert_cmpfloat(max, ==, 50);
}

static void test_points(void) {
    GArray *points = studio_points_read("0,1  0.5,0.25 1,0");
    g_assert_cmpuint(points->len, ==, 3);
    g_assert_cmpuint(studio_points_add(points, 0.25, 0.9, true), ==, 1);
    studio_points_move(points, 1, 0.9, 0.8, true);
    studio_points_move(points, 0, 0.7, 0.5, true);
    char *text = studio_points_write(points);
    g_assert_cmpstr(text, ==, "0,0.5 0.499,0.8 0.5,0.25 1,0");
    g_free(text);
    g_array_unref(points);
    g_assert_null(studio_points_read("stem"));
    g_assert_null(studio_points_read(""));
    g_assert_null(studio_points_read("0,1 2"));
    points = studio_points_read("0,0 0.5,0.5 1,0");
    g_assert_cmpuint(studio_points_add(points, 0.8, 0.3, false), ==, 2);
    g_array_unref(points);
}

static void test_camera(void) {
    StudioCamera camera = studio_camera_default();
    const double min[3] = {-2, -1, 0}, max[3] = {2, 1, 6};
    studio_camera_frame(&camera, min, max, 1.5);
    mat4s clip =
        glms_mat4_mul(studio_camera_projection(&camera, 1.5, 4), studio_camera_view(&camera));
    for (int corner = 0; corner < 8; corner++) {
        vec4s point = {{(float)(corner & 1 ? max : min)[0], (float)(corner & 2 ? max : min)[1],
                        (float)(corner & 4 ? max : min)[2], 1}};
        vec4s shown = glms_mat4_mulv(clip, point);
        for (int i = 0; i < 3; i++) {
            g_assert_cmpfloat(fabsf(shown.raw[i]), <=, shown.w);
        }
    }
    // The ray through a point of the picture is where that point is drawn.
    double origin[3], direction[3];
    studio_camera_ray(&camera, 1.5, 0.4, -0.3, origin, direction);
    vec4s along = {{(float)(origin[0] + 5 * direction[0]), (float)(origin[1] + 5 * direction[1]),
                    (float)(origin[2] + 5 * direction[2]), 1}};
    vec4s shown = glms_mat4_mulv(clip, along);
    g_assert_cmpfloat_with_epsilon(shown.x / shown.w, 0.4, 1e-4);
    g_assert_cmpfloat_with_epsilon(shown.y / shown.w, -0.3, 1e-4);
    studio_camera_orbit(&camera, 0, 100);
    g_assert_cmpfloat(camera.elevation, <, 0.5 * G_PI);
}

static void assert_length(double length, const char *should) {
    char *text = studio_length_text(length);
    g_assert_cmpstr(text, ==, should);
    g_free(text);
}

static void test_scale(void) {
    // At right angles from top to bottom a picture shows twice the distance.
    StudioCamera camera = studio_camera_default();
    camera.field_of_view = 0.5 * G_PI;
    camera.distance = 3;
    StudioScale scale = studio_camera_scale(&camera, 600, 120); // 100 pixels for a metre
    g_assert_cmpfloat_with_epsilon(scale.length, 1, 1e-9);
    g_assert_cmpfloat_with_epsilon(scale.pixels, 100, 1e-6);
    scale = studio_camera_scale(&camera, 600, 90);
    g_assert_cmpfloat_with_epsilon(scale.length, 0.5, 1e-9);
    g_assert_cmpfloat_with_epsilon(scale.pixels, 50, 1e-6);
    for (camera.distance = 0.001; camera.distance < 1e5; camera.distance *= 1.07) {
        scale = studio_camera_scale(&camera, 700, 120);
        g_assert_cmpfloat(scale.pixels, <, 120.001);
        g_assert_cmpfloat(scale.pixels, >, 47.999);
    }
    assert_length(0.0005, "0.5\u202fmm");
    assert_length(0.005, "5\u202fmm");
    assert_length(0.01, "1\u202fcm");
    assert_length(pow(10, -2), "1\u202fcm");
    assert_length(0.5, "50\u202fcm");
    assert_length(1, "1\u202fm");
    assert_length(100, "100\u202fm");
    assert_length(20000, "20\u202fkm");
}

static void test_floor(void) {
    StudioCamera camera = studio_camera_default();
    camera.target[2] = 8;
    camera.distance = 20;
    camera.elevation = -0.2; // from below: the eye is at 4
    double eye[3], last = 5;
    for (int i = 0; i < 40; i++) {
        studio_camera_zoom(&camera, 1.12);
        studio_camera_eye(&camera, eye);
        g_assert_cmpfloat(eye[2], >=, -1e-9);
        g_assert_cmpfloat(eye[2], <=, fmax(last, 0.021 * camera.distance));
        last = eye[2];
    }
    // Nearer it goes straight; and who is below the floor stays there.
    double elevation = camera.elevation;
    studio_camera_zoom(&camera, 0.1);
    g_assert_cmpfloat(camera.elevation, ==, elevation);
    camera.elevation = -1;
    camera.distance = 20;
    studio_camera_zoom(&camera, 2);
    g_assert_cmpfloat(camera.elevation, ==, -1);
}

static void test_settings(void) {
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    char *file = g_build_filename(folder, "deep", "studio.ini", NULL);
    char *first = project_file("examples/oak.frond"), *second = project_file("README.md");
    StudioSettings *settings = studio_settings_new(file);
    g_assert_cmpint(studio_settings_int(settings, "width", 7), ==, 7);
    studio_settings_set_int(settings, "width", 900);
    studio_settings_set_bool(settings, "dark", false);
    studio_settings_add_recent(settings, first);
    studio_settings_add_recent(settings, second);
    studio_settings_add_recent(settings, "/nowhere/x.frond");
    studio_settings_add_recent(settings, second);
    studio_settings_free(settings);
    settings = studio_settings_new(file);
    g_assert_cmpint(studio_settings_int(settings, "width", 7), ==, 900);
    g_assert_false(studio_settings_bool(settings, "dark", true));
    char **recent = studio_settings_recent(settings);
    g_assert_cmpstr(recent[0], ==, second);
    g_assert_false(g_strv_contains((const char *const *)recent, "/nowhere/x.frond"));
    g_strfreev(recent);
    studio_settings_free(settings);
    g_unlink(file);
    char *deep = g_path_get_dirname(file);
    g_rmdir(deep);
    g_rmdir(folder);
    g_free(deep);
    g_free(first);
    g_free(second);
    g_free(file);
    g_free(folder);
}

// Each curve that Frond knows can be begun from: its points, as they are written, make it again.
static void test_shapes(void) {
    size_t count;
    const char *const *names = fr_curve_builtin_names(&count);
    g_assert_cmpuint(count, >, 5);
    for (size_t i = 0; i < count; i++) {
        char *text = studio_points_of_shape(names[i]);
        GArray *points = studio_points_read(text);
        FrCurve *curve = fr_curve_builtin(names[i]);
        g_assert_nonnull(points);
        g_assert_cmpuint(points->len, ==, fr_curve_point_count(curve));
        for (guint k = 0; k < points->len; k++) {
            const double *point = &g_array_index(points, double, 2 * k);
            g_assert_cmpfloat(fabs(point[1] - fr_curve_eval(curve, point[0])), <, 0.01);
        }
        fr_curve_unref(curve);
        g_array_unref(points);
        g_free(text);
    }
    g_assert_null(studio_points_of_shape("no such shape"));
}

static void test_places(void) {
    StudioDocument *document = open_example("examples/sunflower.frond");
    const FrContents *contents = studio_document_contents(document);
    for (uint32_t i = 0; i < fr_contents_count(contents); i++) {
        char *place = studio_place_of(contents, i);
        g_assert_cmpuint(studio_place_find(contents, place), ==, i);
        g_free(place);
    }
    char *place = studio_place_of(contents, element_of(document, "stem"));
    g_assert_cmpstr(place, ==, "frond/plant:sunflower/pgraph/tree:stem");
    g_assert_cmpuint(studio_place_plant(contents, element_of(document, "stem")), ==,
                     first_plant(document));
    studio_remove_component(document, first_plant(document), "stem");
    g_assert_cmpuint(studio_place_find(studio_document_contents(document), place), ==, FR_NONE);
    g_free(place);
    studio_document_free(document);
}

static void test_place_numbers(void) {
    StudioDocument *document = open_example("examples/forest-road.frond");
    const FrContents *contents = studio_document_contents(document);
    uint32_t *numbers = studio_place_numbers(contents), orders[20], count = 0;
    g_assert_cmpuint(numbers[0], ==, 0);
    for (uint32_t i = 0; i < fr_contents_count(contents) && count < 20; i++) {
        if (strcmp(fr_contents_at(contents, i)->name, "order") == 0) {
            orders[count++] = numbers[i];
        }
    }
    // Each species has four of them.
    g_assert_cmpuint(count, >=, 8);
    for (uint32_t i = 0; i < 8; i++) {
        g_assert_cmpuint(orders[i], ==, i % 4 + 1);
    }
    g_free(numbers);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/values/numbers have the digits a handle needs", test_numbers);
    g_test_add_func("/studio/values/only digits behind a point are left out", test_short);
    g_test_add_func("/studio/values/sliders hold every value within its range", test_ranges);
    g_test_add_func("/studio/values/points are added, moved and kept in order", test_points);
    g_test_add_func("/studio/values/a curve begins as one that Frond knows", test_shapes);
    g_test_add_func("/studio/values/a framed box is within the picture", test_camera);
    g_test_add_func("/studio/values/a scale is a plain length with room in the picture",
                    test_scale);
    g_test_add_func("/studio/values/who goes away from plants stays above the floor", test_floor);
    g_test_add_func("/studio/values/settings are remembered", test_settings);
    g_test_add_func("/studio/values/places find their elements again", test_places);
    g_test_add_func("/studio/values/what has no name has a number among its like",
                    test_place_numbers);
    return g_test_run();
}
