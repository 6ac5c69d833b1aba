/// Lamps, the probe and the sun: added, taken hold of and dragged, without a display.
#include "frond/daylight.h"
#include "studio.h"
#include "studio/model/lamps.h"

#include <math.h>

static const double reach = 0.2, aspect = 1.5, height = 800;

static StudioDocument *small(const char *scene) {
    char *text = g_strdup_printf("<frond version=\"1\">\n  <plant id=\"p\">\n    <pgraph>\n      "
                                 "<horn id=\"h\"/>\n    </pgraph>\n  </plant>\n%s</frond>\n",
                                 scene);
    StudioDocument *document = studio_document_new(text, strlen(text), "small", NULL);
    g_free(text);
    return document;
}

static StudioHandle at_lamp(const StudioDocument *document, const StudioCamera *camera,
                            const double place[3], double *x, double *y) {
    g_assert_true(studio_camera_project(camera, aspect, place, x, y));
    uint32_t lamp = studio_find_in_scene(document, "lamp");
    return studio_handle_at(document, lamp, reach, camera, aspect, height, *x, *y);
}

static void test_add(void) {
    StudioDocument *document = small("");
    FrDigest before = studio_document_digest(document);
    uint32_t first = studio_add_lamp(document, "spot", (const double[3]){1, 0.5, 2});
    g_assert_nonnull(strstr(text_of(document),
                            "<scene>\n    <lamp id=\"lamp\" kind=\"spot\" at=\"1, 0.5, 2\"/>"));
    uint32_t second = studio_add_lamp(document, "area", (const double[3]){0, 0, 1});
    GArray *lamps = studio_lamps(document);
    g_assert_cmpuint(lamps->len, ==, 2);
    g_assert_cmpuint(g_array_index(lamps, StudioLamp, 0).element, ==, first);
    g_assert_cmpuint(g_array_index(lamps, StudioLamp, 1).element, ==, second);
    g_assert_cmpfloat_with_epsilon((double)g_array_index(lamps, StudioLamp, 0).params.at.y, 0.5,
                                   1e-6);
    char *title = studio_lamp_title(document, second);
    g_assert_cmpstr(title, ==, "lamp2");
    g_free(title);
    g_array_unref(lamps);
    g_assert_true(studio_document_undo(document));
    g_assert_true(studio_document_undo(document));
    g_assert_cmpuint(studio_document_digest(document), ==, before);
    studio_document_free(document);
}

static void test_date(void) {
    StudioDocument *document = small("  <scene sun-azimuth=\"90\" ground=\"no\"/>\n");
    uint32_t sun = studio_make_of_scene(document, "sun");
    g_assert_cmpuint(sun, !=, FR_NONE);
    g_assert_null(strstr(text_of(document), "sun-azimuth"));
    g_assert_nonnull(strstr(text_of(document), "ground=\"no\""));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_cmpuint(studio_make_of_scene(document, "sun"), ==, sun);
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    studio_document_free(document);
}

static void test_broken(void) {
    StudioDocument *document = small("");
    studio_document_replace(document, "<frond", 6, "Type", NULL);
    g_assert_cmpuint(studio_add_lamp(document, "point", (const double[3]){0, 0, 0}), ==, FR_NONE);
    g_assert_cmpuint(studio_make_of_scene(document, "light"), ==, FR_NONE);
    studio_document_free(document);
}

static void test_drag(void) {
    StudioDocument *document = small("  <scene>\n    <lamp at=\"0.5, 0, 1\"/>\n  </scene>\n");
    StudioCamera camera = studio_camera_default();
    double x, y, to_x, to_y;
    StudioHandle handle = at_lamp(document, &camera, (const double[3]){0.5, 0, 1}, &x, &y);
    g_assert_cmpint(handle.kind, ==, STUDIO_HANDLE_PLACE);
    for (int i = 1; i <= 10; i++) {
        g_assert_true(studio_handle_drag(document, &handle, &camera, aspect, x + 0.02 * i, y));
    }
    studio_document_seal(document);
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Move a lamp");
    GArray *lamps = studio_lamps(document);
    vec3s at = g_array_index(lamps, StudioLamp, 0).params.at;
    const double now[3] = {(double)at.x, (double)at.y, (double)at.z};
    g_assert_true(studio_camera_project(&camera, aspect, now, &to_x, &to_y));
    g_assert_cmpfloat_with_epsilon(to_x, x + 0.2, 2e-3); // it follows the pointer
    g_assert_cmpfloat_with_epsilon(to_y, y, 2e-3);
    g_array_unref(lamps);
    studio_document_free(document);
}

static void test_axis(void) {
    StudioDocument *document = small("  <scene>\n    <lamp at=\"0.5, 0, 1\"/>\n  </scene>\n");
    StudioCamera camera = studio_camera_default();
    double x, y;
    StudioHandle handle = at_lamp(document, &camera, (const double[3]){0.5, 0, 1.15}, &x, &y);
    g_assert_cmpint(handle.kind, ==, STUDIO_HANDLE_Z);
    g_assert_true(studio_handle_drag(document, &handle, &camera, aspect, x + 0.05, y + 0.2));
    GArray *lamps = studio_lamps(document);
    vec3s at = g_array_index(lamps, StudioLamp, 0).params.at;
    g_assert_cmpfloat((double)at.x, ==, 0.5);
    g_assert_cmpfloat((double)at.y, ==, 0);
    g_assert_cmpfloat((double)at.z, >, 1.1);
    g_array_unref(lamps);
    g_assert_cmpint(at_lamp(document, &camera, (const double[3]){-0.5, 0, 0.2}, &x, &y).kind, ==,
                    STUDIO_HANDLE_NONE);
    studio_document_free(document);
}

static void test_aim(void) {
    StudioDocument *document =
        small("  <scene>\n    <lamp kind=\"spot\" at=\"0, 0, 1\"/>\n  </scene>\n");
    StudioCamera camera = studio_camera_default();
    double x, y;
    StudioHandle handle =
        at_lamp(document, &camera, (const double[3]){0, 0, 1 - 1.6 * reach}, &x, &y);
    g_assert_cmpint(handle.kind, ==, STUDIO_HANDLE_AIM);
    g_assert_true(studio_handle_drag(document, &handle, &camera, aspect, x + 0.2, y));
    GArray *lamps = studio_lamps(document);
    vec3s way = g_array_index(lamps, StudioLamp, 0).params.direction;
    g_assert_cmpfloat_with_epsilon((double)glms_vec3_norm(way), 1, 5e-3);
    g_assert_cmpfloat((double)way.x, >, 0.3); // the camera looks along +y and to the left
    g_assert_cmpfloat((double)way.z, <, -0.3);
    g_array_unref(lamps);
    studio_document_free(document);
}

static void test_probe(void) {
    StudioDocument *document =
        small("  <scene>\n    <light reference=\"0.2, 0, 0.8\"/>\n  </scene>\n");
    StudioCamera camera = studio_camera_default();
    double x, y;
    StudioHandle handle = at_lamp(document, &camera, (const double[3]){0.2, 0, 0.8}, &x, &y);
    g_assert_cmpint(handle.kind, ==, STUDIO_HANDLE_PLACE);
    g_assert_true(studio_handle_drag(document, &handle, &camera, aspect, x, y + 0.1));
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Move the probe");
    g_assert_null(strstr(text_of(document), "0.2, 0, 0.8"));
    studio_document_free(document);
}

// Every place of the sun between rise and set lies on the drawn way.
static void test_sun(void) {
    StudioDocument *document = small("  <scene>\n    <sun date=\"2025-04-10\" time=\"9\" "
                                     "latitude=\"40\"/>\n  </scene>\n");
    const double min[3] = {-1, -1, 0}, max[3] = {1, 1, 2};
    StudioOverlay *overlay = studio_sun_marks(document, min, max);
    FrSunPosition now = fr_light_sun(2025, 4, 10 + 9.0 / 24, 40 * G_PI / 180, 0);
    FrSunPath path = fr_light_sun_path(40 * G_PI / 180, now.azimuth, now.elevation);
    vec3s places[9];
    g_assert_cmpuint(fr_light_sun_places(path, 9, places), ==, 9);
    for (int k = 0; k < 9; k++) {
        double nearest = 9;
        for (guint i = 0; i < overlay->lines->len; i++) {
            const StudioMark *mark = &g_array_index(overlay->lines, StudioMark, i);
            vec3s at = glms_vec3_normalize((vec3s){{mark->at[0], mark->at[1], mark->at[2]}});
            nearest = fmin(nearest, (double)glms_vec3_distance(at, places[k]));
        }
        g_assert_cmpfloat(nearest, <, 0.035); // half of what lies between two of 96 marks
    }
    studio_overlay_free(overlay);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/lamps/lamps are added to a scene that is made for them, and undone",
                    test_add);
    g_test_add_func("/studio/lamps/a sun by date takes the place of its angles in one step",
                    test_date);
    g_test_add_func("/studio/lamps/a broken text is left alone", test_broken);
    g_test_add_func("/studio/lamps/a lamp follows the pointer, and a drag is one step", test_drag);
    g_test_add_func("/studio/lamps/an arrow moves along its axis alone", test_axis);
    g_test_add_func("/studio/lamps/a spot is aimed by its tip", test_aim);
    g_test_add_func("/studio/lamps/the probe is dragged as lamps are", test_probe);
    g_test_add_func("/studio/lamps/the sun is drawn where it stands from rise to set", test_sun);
    return g_test_run();
}
