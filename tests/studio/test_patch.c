/// Control points of a Hyperpatch taken hold of in the picture.
#include "studio.h"

#include "studio/model/patch.h"

#include <math.h>

static const char text[] =
    "<frond version=\"1\">\n"
    "  <plant id=\"p\"><pgraph>\n"
    "    <hyperpatch id=\"patch\" degree-x=\"2\" degree-y=\"1\" degree-z=\"2\"/>\n"
    "    <horn id=\"h\"/>\n"
    "    <link from=\"patch\" to=\"h\"/>\n"
    "  </pgraph></plant>\n"
    "  <scene><place plant=\"p\" at=\"1, 2, 3\" turn=\"90\" scale=\"2\"/></scene>\n"
    "</frond>\n";

typedef struct Fixture {
    StudioDocument *document;
    StudioPatch patch;
    StudioCamera camera;
} Fixture;

static void read_patch(Fixture *fixture) {
    FrContext context = fr_context_default();
    FrDocument *parsed;
    FrScene *scene;
    g_assert_cmpint(
        fr_document_parse(studio_document_source(fixture->document), NULL, &context, &parsed), ==,
        FR_OK);
    g_assert_cmpint(fr_scene_build(parsed, -1, &context, &scene), ==, FR_OK);
    GArray *footings = studio_footings_of(scene);
    g_assert_cmpuint(footings->len, ==, 1);
    const StudioFooting *footing = &g_array_index(footings, StudioFooting, 0);
    g_assert_cmpstr(footing->plant, ==, "p");
    g_assert_cmpstr(footing->component, ==, "patch");
    g_assert_true(studio_patch_read(fixture->document, element_of(fixture->document, "patch"),
                                    footing, &fixture->patch));
    g_array_unref(footings);
    fr_scene_free(scene);
    fr_document_free(parsed);
}

static void set_up(Fixture *fixture, gconstpointer data) {
    (void)data;
    fixture->document = studio_document_new(text, sizeof text - 1, "patch.frond", NULL);
    const double min[3] = {0, 1, 3}, max[3] = {2, 3, 5};
    fixture->camera = studio_camera_default();
    studio_camera_frame(&fixture->camera, min, max, 1);
    read_patch(fixture);
}

static void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    studio_document_free(fixture->document);
}

static void assert_at(const StudioPatch *patch, uint32_t point, double x, double y, double z) {
    double at[3];
    studio_patch_place(patch, point, at);
    g_assert_cmpfloat_with_epsilon(at[0], x, 1e-5);
    g_assert_cmpfloat_with_epsilon(at[1], y, 1e-5);
    g_assert_cmpfloat_with_epsilon(at[2], z, 1e-5);
}

// A quarter turn takes x to y and y to −x, twice as large.
static void test_places(Fixture *fixture, gconstpointer data) {
    (void)data;
    assert_at(&fixture->patch, fr_lattice_index(&fixture->patch.lattice, 0, 0, 0), 2, 1, 3);
    assert_at(&fixture->patch, fr_lattice_index(&fixture->patch.lattice, 2, 1, 2), 0, 3, 5);
    assert_at(&fixture->patch, fr_lattice_index(&fixture->patch.lattice, 1, 0, 1), 2, 2, 4);
}

static void seen_at(const Fixture *fixture, uint32_t point, double *x, double *y) {
    double at[3];
    studio_patch_place(&fixture->patch, point, at);
    g_assert_true(studio_camera_project(&fixture->camera, 1, at, x, y));
}

static void test_drag(Fixture *fixture, gconstpointer data) {
    (void)data;
    uint32_t point = fr_lattice_index(&fixture->patch.lattice, 2, 1, 2);
    double before[3], after[3], eye[3], x, y;
    studio_patch_place(&fixture->patch, point, before);
    seen_at(fixture, point, &x, &y);
    g_assert_cmpuint(studio_patch_under(&fixture->patch, &fixture->camera, 1, 800, x, y + 0.01), ==,
                     point);
    StudioPatch begun = fixture->patch;
    for (int i = 1; i <= 5; i++) {
        g_assert_true(studio_patch_drag(fixture->document, &begun, point, &fixture->camera, 1,
                                        x + 0.02 * i, y - 0.03 * i, false));
    }
    g_assert_cmpuint(studio_document_steps(fixture->document), ==, 1);
    g_assert_cmpstr(studio_document_undo_name(fixture->document), ==, "Move a control point");
    read_patch(fixture);
    double now_x, now_y, along = 0;
    seen_at(fixture, point, &now_x, &now_y);
    g_assert_cmpfloat_with_epsilon(now_x, x + 0.1, 0.002);
    g_assert_cmpfloat_with_epsilon(now_y, y - 0.15, 0.002);
    studio_patch_place(&fixture->patch, point, after);
    studio_camera_eye(&fixture->camera, eye);
    for (int k = 0; k < 3; k++) { // parallel to the picture's plane
        along += (after[k] - before[k]) * (fixture->camera.target[k] - eye[k]);
    }
    g_assert_cmpfloat_with_epsilon(along, 0, 0.02);
    g_assert_true(studio_patch_reset(fixture->document, &fixture->patch, point));
    g_assert_null(strstr(text_of(fixture->document), "points="));
    studio_document_undo(fixture->document);
    studio_document_undo(fixture->document);
    g_assert_cmpstr(text_of(fixture->document), ==, text);
}

static void test_mirror(Fixture *fixture, gconstpointer data) {
    (void)data;
    const FrLattice *lattice = &fixture->patch.lattice;
    uint32_t left = fr_lattice_index(lattice, 0, 1, 2), right = fr_lattice_index(lattice, 2, 1, 2);
    double x, y;
    seen_at(fixture, right, &x, &y);
    StudioPatch begun = fixture->patch;
    studio_patch_drag(fixture->document, &begun, right, &fixture->camera, 1, x + 0.2, y, true);
    read_patch(fixture);
    g_assert_cmpfloat(fabs(fixture->patch.moves[right][0]), >, 0.01);
    for (int k = 0; k < 3; k++) {
        double sign = k == 0 ? -1 : 1;
        g_assert_cmpfloat_with_epsilon(fixture->patch.moves[left][k],
                                       sign * fixture->patch.moves[right][k], 1e-6);
    }
    g_assert_cmpuint(studio_document_steps(fixture->document), ==, 1);
    g_assert_true(studio_patch_reset(fixture->document, &fixture->patch, FR_NONE));
    g_assert_cmpstr(text_of(fixture->document), ==, text);
}

static void test_marks(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioOverlay *overlay = studio_patch_marks(&fixture->patch, FR_NONE);
    g_assert_cmpuint(overlay->points->len, ==, 3 * 2 * 3);
    g_assert_cmpuint(overlay->lines->len, ==, 2 * (2 * 2 * 3 + 3 * 1 * 3 + 3 * 2 * 2));
    studio_overlay_free(overlay);
}

static void test_wrong(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char *const wrong[] = {"0,0", "0,0,0", "3,0,0:1,1,1", "0,0,0:1,1", "a:b"};
    uint32_t element = element_of(fixture->document, "patch");
    StudioFooting footing = {.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    StudioPatch patch;
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        studio_set(fixture->document, element, "points", wrong[i], false);
        g_assert_false(studio_patch_read(fixture->document, element, &footing, &patch));
    }
    studio_set(fixture->document, element, "points", NULL, false);
    studio_set(fixture->document, element, "degree-x", "= 2", false);
    g_assert_false(studio_patch_read(fixture->document, element, &footing, &patch));
    g_assert_false(
        studio_patch_read(fixture->document, element_of(fixture->document, "h"), &footing, &patch));
}

#define ADD(name, function) g_test_add(name, Fixture, NULL, set_up, function, tear_down)

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/studio/patch/points stand where the component stands", test_places);
    ADD("/studio/patch/a drag is parallel to the picture and one step", test_drag);
    ADD("/studio/patch/a mirrored drag moves both sides", test_mirror);
    ADD("/studio/patch/neighbours are joined by lines", test_marks);
    ADD("/studio/patch/what says something wrong has no handles", test_wrong);
    return g_test_run();
}
