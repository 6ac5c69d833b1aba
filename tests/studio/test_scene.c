/// Scenes arranged: what is planted, moved, painted, drawn and taken out.
#include "studio.h"

#include "studio/model/adopt.h"
#include "studio/model/brush.h"
#include "studio/model/drawn_line.h"
#include "studio/model/gizmo.h"
#include "studio/model/scene_edit.h"

#include <math.h>

#define STEM                                                                                       \
    "<frond version=\"1\">\n  <plant id=\"stem\">\n    <pgraph>\n      <camera id=\"r\"/>\n"       \
    "      <horn id=\"h\" length=\"2\"/>\n      <link from=\"r\" to=\"h\"/>\n"                     \
    "    </pgraph>\n  </plant>\n"
#define TREE "  <plant id=\"tree\">\n    <species/>\n  </plant>\n"

static StudioDocument *document_of(const char *text) {
    return studio_document_new(text, strlen(text), "scene", NULL);
}

// ---- planting ----------------------------------------------------------------------------------

static void test_plant(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    const StudioSpot spot = {{2, 3.5, 0}, 30, 1.5, 7};
    g_assert_true(studio_plant(document, "stem", &spot, 1, NULL));
    g_assert_nonnull(strstr(text_of(document),
                            "<scene>\n    <place plant=\"stem\" at=\"0, 0, 0\"/>\n"
                            "    <place plant=\"stem\" at=\"2, 3.5, 0\" turn=\"30\" scale=\"1.5\" "
                            "seed=\"7\"/>\n  </scene>"));
    g_assert_true(studio_plant(document, "stem", &spot, 1, NULL));
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    g_assert_true(studio_document_undo(document) && studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, STEM "</frond>\n");
    studio_document_free(document);
}

static void test_species(void) {
    StudioDocument *document =
        document_of("<frond version=\"1\">\n" TREE "  <scene>\n  </scene>\n</frond>\n");
    const StudioSpot spot = {{1, 0, 0}, 30, 1.5, 7};
    g_assert_true(studio_plant(document, "tree", &spot, 1, NULL));
    g_assert_nonnull(strstr(text_of(document), "<place plant=\"tree\" at=\"1, 0, 0\"/>"));
    studio_document_free(document);
}

static void test_copy(void) {
    static const char text[] =
        STEM "  <scene>\n    <place plant=\"stem\" at=\"1, 0, 0\" seed=\"3\"/>\n"
             "    <row plants=\"stem\">0,0,0 1,0,0</row>\n    <lamp id=\"bulb\"/>\n"
             "  </scene>\n</frond>\n";
    StudioDocument *document = document_of(text);
    uint32_t place = studio_scene_last(document, "place");
    uint32_t made = studio_copy(document, place, "drag");
    g_assert_cmpuint(made, ==, place + 1);
    StudioStanding from, to;
    g_assert_true(studio_standing_read(document, made, &from));
    to = from;
    to.at[1] = 4;
    g_assert_true(studio_standing_move(document, made, &from, &to, "drag"));
    g_assert_nonnull(strstr(text_of(document),
                            "    <place plant=\"stem\" at=\"1, 0, 0\" seed=\"3\"/>\n"
                            "    <place plant=\"stem\" at=\"1, 4, 0\" seed=\"3\"/>\n"));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_cmpuint(studio_copy(document, studio_scene_last(document, "row"), NULL), !=, FR_NONE);
    g_assert_cmpuint(studio_copy(document, studio_scene_last(document, "lamp"), NULL), ==, FR_NONE);
    g_assert_cmpuint(studio_copy(document, first_plant(document), NULL), ==, FR_NONE);
    g_assert_true(studio_document_undo(document) && studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, text);
    studio_document_free(document);
}

static void test_stroke(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    for (int i = 0; i < 5; i++) {
        const StudioSpot spot = {{i, 0, 0}, 0, 1, -1};
        g_assert_true(studio_plant(document, "stem", &spot, 1, "stroke"));
    }
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, STEM "</frond>\n");
    studio_document_free(document);
}

static void test_broken(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    g_assert_true(studio_document_replace(document, "<frond", 6, "Type", NULL));
    const StudioSpot spot = {{1, 0, 0}, 0, 1, -1};
    g_assert_false(studio_plant(document, "stem", &spot, 1, NULL));
    g_assert_cmpstr(text_of(document), ==, "<frond");
    studio_document_free(document);
}

static void test_brush(void) {
    const StudioBrush brush = {.radius = 5, .density = 0.5, .seed = 3};
    const double at[2] = {10, -4};
    GArray *taken = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    GArray *first = studio_brush_dab(&brush, 0, at, taken);
    g_assert_cmpuint(first->len, ==, taken->len);
    // As dense as it says, give or take what chance leaves free.
    g_assert_cmpfloat(first->len, >, 0.5 * 0.5 * G_PI * 25);
    g_assert_cmpfloat(first->len, <, 1.3 * 0.5 * G_PI * 25);
    for (guint i = 0; i < first->len; i++) {
        const double *a = &g_array_index(first, double, 2 * i);
        g_assert_cmpfloat(hypot(a[0] - 10, a[1] + 4), <=, 5);
        for (guint k = 0; k < i; k++) {
            const double *b = &g_array_index(first, double, 2 * k);
            g_assert_cmpfloat(hypot(a[0] - b[0], a[1] - b[1]), >=, studio_brush_spacing(0.5));
        }
    }
    guint before = first->len;
    for (uint64_t dab = 1; dab < 6; dab++) {
        GArray *more = studio_brush_dab(&brush, dab, at, taken);
        before += more->len;
        g_array_unref(more);
    }
    g_assert_cmpfloat(before, <, 1.6 * first->len); // gaps are filled, and no more
    g_array_unref(first);
    g_array_unref(taken);
}

// ---- taking over -------------------------------------------------------------------------------

#define OTHER                                                                                      \
    "<frond version=\"1\">\n  <curve id=\"dome\" points=\"0,1 1,0\"/>\n"                           \
    "  <material id=\"bark\" colour=\"#112233\"/>\n  <plant id=\"oak\">\n    <pgraph>\n"           \
    "      <camera id=\"r\"/>\n      <horn id=\"h\" material=\"bark\" length=\"1..2 : dome\"/>\n"  \
    "      <link from=\"r\" to=\"h\"/>\n    </pgraph>\n  </plant>\n</frond>\n"

static void test_adopt(void) {
    StudioDocument *document =
        document_of("<frond version=\"1\">\n"
                    "  <curve id=\"dome\" points=\"0,0 1,1\"/>\n"
                    "  <material id=\"bark\" colour=\"#ffffff\"/>\n" TREE "</frond>\n");
    FrSource *other = fr_source_new("other", OTHER, strlen(OTHER));
    char *id;
    g_assert_true(studio_adopt(document, other, NULL, NULL, &id));
    g_assert_cmpstr(id, ==, "oak");
    const char *text = text_of(document);
    g_assert_nonnull(strstr(text, "<material id=\"bark\" colour=\"#ffffff\"/>"));
    g_assert_nonnull(strstr(text, "\n  <material id=\"oak_bark\" colour=\"#112233\"/>"));
    g_assert_nonnull(strstr(text, "\n  <curve id=\"oak_dome\" points=\"0,1 1,0\"/>"));
    g_assert_nonnull(strstr(text, "\n      <horn id=\"h\" material=\"oak_bark\" "
                                  "length=\"1..2 : oak_dome\"/>\n"));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_free(id);
    fr_source_unref(other);
    studio_document_free(document);
}

static void test_adopt_and_plant(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    FrSource *other = fr_source_new("other", OTHER, strlen(OTHER));
    StudioSpot spot = {.at = {1, 2}, .scale = 1, .seed = -1};
    char *id;
    g_assert_true(studio_adopt(document, other, NULL, "plant", &id));
    g_assert_true(studio_plant(document, id, &spot, 1, "plant"));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Plant oak");
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, STEM "</frond>\n");
    g_free(id);
    fr_source_unref(other);
    studio_document_free(document);
}

static void test_adopt_same(void) {
    StudioDocument *document = document_of(OTHER);
    FrSource *other = fr_source_new("other", OTHER, strlen(OTHER));
    char *id;
    g_assert_true(studio_adopt(document, other, "oak", NULL, &id));
    g_assert_cmpstr(id, ==, "oak");
    g_assert_cmpstr(text_of(document), ==, OTHER);
    g_free(id);
    g_assert_false(studio_adopt(document, other, "elm", NULL, &id));
    g_assert_null(id);
    fr_source_unref(other);
    studio_document_free(document);
}

static void test_adopt_presets(void) {
    // Each of these has a bark, a crown and so on of its own.
    static const char *const presets[] = {"oak", "birch", "cherry", "maple"};
    StudioDocument *document = document_of(STEM "</frond>\n");
    for (size_t i = 0; i < G_N_ELEMENTS(presets); i++) {
        char *name = g_strdup_printf("data/presets/%s.frond", presets[i]);
        char *path = project_file(name), *id;
        FrStatus status;
        FrSource *source = fr_source_load(path, 1000000, NULL, &status);
        g_assert_true(studio_adopt(document, source, NULL, NULL, &id));
        g_assert_cmpstr(id, ==, presets[i]);
        g_free(id);
        fr_source_unref(source);
        g_free(path);
        g_free(name);
    }
    FrContext context = fr_context_default();
    FrDocument *read;
    g_assert_cmpint(fr_document_parse(studio_document_source(document), NULL, &context, &read), ==,
                    FR_OK);
    g_assert_cmpuint(fr_document_plants(read)->len, ==, 5);
    fr_document_free(read);
    studio_document_free(document);
}

// ---- what stands -------------------------------------------------------------------------------

#define SCENE                                                                                      \
    STEM TREE "  <scene>\n"                                                                        \
              "    <place plant=\"stem\" at=\"1, 2, 0\"/>\n"                                       \
              "    <place plant=\"tree\" at=\"5, 2, 0\"/>\n"                                       \
              "    <row plants=\"stem\">0,0,0 4,2,0</row>\n"                                       \
              "    <obstacle size=\"2, 4, 6\"/>\n"                                                 \
              "    <lamp at=\"0, 0, 3\"/>\n"                                                       \
              "    <place plant=\"stem\" at=\"= 1, 2, 3\"/>\n"                                     \
              "  </scene>\n</frond>\n"

static uint32_t nth(const StudioDocument *document, const char *tag, int n) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t element = fr_contents_child(contents, fr_contents_child(contents, 0, "scene"), tag);
    while (n-- > 0) {
        element = fr_contents_sibling(contents, element);
    }
    return element;
}

static void test_stands(void) {
    StudioDocument *document = document_of(SCENE);
    StudioStanding standing;
    g_assert_true(studio_standing_read(document, nth(document, "place", 0), &standing));
    g_assert_true(standing.can_turn && standing.can_scale && standing.is_on_ground);
    g_assert_true(studio_standing_read(document, nth(document, "place", 1), &standing));
    g_assert_false(standing.can_turn || standing.can_scale); // it grows upright
    g_assert_true(studio_standing_read(document, nth(document, "row", 0), &standing));
    g_assert_cmpfloat(standing.at[0], ==, 2);
    g_assert_true(studio_standing_read(document, nth(document, "obstacle", 0), &standing));
    g_assert_false(standing.is_on_ground);
    g_assert_false(studio_standing_read(document, nth(document, "lamp", 0), &standing));
    g_assert_false(studio_standing_read(document, nth(document, "place", 2), &standing));
    g_assert_false(studio_standing_read(document, 0, &standing));
    g_assert_false(studio_standing_read(document, FR_NONE, &standing));
    studio_document_free(document);
}

static void test_move(void) {
    StudioDocument *document = document_of(SCENE);
    StudioStanding from, to;
    g_assert_true(studio_standing_read(document, nth(document, "place", 0), &from));
    to = from;
    for (int i = 1; i <= 3; i++) { // a drag
        StudioStanding last = to;
        to.at[0] = 1 + i;
        to.turn = 400;
        to.scale = 2;
        g_assert_true(
            studio_standing_move(document, nth(document, "place", 0), &last, &to, "drag"));
    }
    g_assert_nonnull(strstr(text_of(document),
                            "<place plant=\"stem\" at=\"4, 2, 0\" turn=\"40\" scale=\"2\"/>"));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_true(studio_standing_read(document, nth(document, "row", 0), &from));
    to = from;
    to.at[1] += 1.5;
    g_assert_true(studio_standing_move(document, nth(document, "row", 0), &from, &to, NULL));
    g_assert_nonnull(strstr(text_of(document), ">0,1.5,0 4,3.5,0</row>"));
    while (studio_document_undo(document)) {
    }
    g_assert_cmpstr(text_of(document), ==, SCENE);
    studio_document_free(document);
}

static void test_size(void) {
    StudioDocument *document = document_of(SCENE);
    uint32_t obstacle = nth(document, "obstacle", 0);
    StudioStanding from, to;
    g_assert_true(studio_standing_read(document, obstacle, &from));
    to = from;
    for (int i = 1; i <= 4; i++) { // 1.5 times in all, not with each step
        StudioStanding last = to;
        to.scale = 1 + 0.125 * i;
        g_assert_true(studio_standing_move(document, obstacle, &last, &to, "drag"));
    }
    g_assert_nonnull(strstr(text_of(document), "<obstacle size=\"3, 6, 9\"/>"));
    studio_document_free(document);
}

static void test_road(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    const double line[3][3] = {{0, 0, 0}, {5, 1, 0}, {9, 0, 0}};
    GArray *points = g_array_new(FALSE, FALSE, sizeof line[0]);
    g_array_append_vals(points, line, 3);
    g_assert_true(studio_add_road(document, points, 3, 4));
    uint32_t seen = studio_scene_last(document, "obstacle");
    uint32_t twin = studio_standing_twin(document, seen);
    g_assert_cmpuint(twin, ==, nth(document, "obstacle", 0));
    g_assert_cmpuint(studio_standing_twin(document, twin), ==, seen);
    StudioStanding from, to;
    g_assert_true(studio_standing_read(document, seen, &from));
    to = from;
    to.at[0] = 2;
    g_assert_true(studio_standing_move(document, seen, &from, &to, NULL));
    g_assert_cmpuint(studio_standing_twin(document, seen), ==, twin); // both have moved
    FrContext context = fr_context_default();
    FrDocument *read;
    g_assert_cmpint(fr_document_parse(studio_document_source(document), NULL, &context, &read), ==,
                    FR_OK);
    fr_document_free(read);
    g_assert_true(studio_take_out(document, &seen, 1, NULL));
    g_assert_cmpuint(studio_scene_last(document, "obstacle"), ==, FR_NONE);
    g_array_unref(points);
    studio_document_free(document);
}

static void test_envelope(void) {
    StudioDocument *document = document_of(SCENE);
    // Drawn from above, beside the axis, with trembling and below the ground at its end.
    const double drawn[][2] = {{-0.2, 5}, {-2, 3}, {-2.001, 2.9}, {-1, 0.2}, {-0.5, -0.3}};
    GArray *points = g_array_new(FALSE, FALSE, sizeof drawn[0]);
    g_array_append_vals(points, drawn, G_N_ELEMENTS(drawn));
    GArray *outline = studio_line_to_outline(points, 0.05);
    uint32_t tree = element_of(document, "tree");
    g_assert_true(studio_set_envelope(document, tree, outline, NULL));
    g_assert_nonnull(strstr(text_of(document), "<species envelope=\"0.5,0 1,0.2 2,3 0.2,5\"/>"));
    g_assert_false(studio_set_envelope(document, element_of(document, "stem"), outline, NULL));
    g_array_unref(outline);
    g_array_unref(points);
    studio_document_free(document);
}

static void test_view(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    StudioCamera camera = studio_camera_default(), seen = studio_camera_default();
    camera.azimuth = 1;
    camera.distance = 7;
    g_assert_true(studio_save_view(document, "a & b", &camera));
    camera.elevation = 0.7;
    g_assert_true(studio_save_view(document, "a & b", &camera)); // in the place of the other
    g_assert_cmpuint(studio_find_view(document, "a & b"), !=, FR_NONE);
    g_assert_cmpuint(studio_find_view(document, "a"), ==, FR_NONE);
    FrContext context = fr_context_default();
    FrDocument *read;
    g_assert_cmpint(fr_document_parse(studio_document_source(document), NULL, &context, &read), ==,
                    FR_OK);
    g_assert_cmpuint(fr_document_views(read)->len, ==, 1);
    const FrViewParams *view = g_ptr_array_index(fr_document_views(read), 0);
    const double min[3] = {0, 0, 0}, max[3] = {1, 1, 1};
    g_assert_cmpstr(view->name, ==, "a & b");
    studio_camera_see(&seen, view, min, max, 1.5);
    g_assert_cmpfloat_with_epsilon(seen.azimuth, camera.azimuth, 1e-3);
    g_assert_cmpfloat_with_epsilon(seen.elevation, camera.elevation, 1e-3);
    g_assert_cmpfloat_with_epsilon(seen.distance, camera.distance, 1e-2);
    fr_document_free(read);
    studio_document_free(document);
}

static void test_view_names(void) {
    StudioDocument *document = document_of(STEM "</frond>\n");
    StudioCamera camera = studio_camera_default();
    for (int i = 0; i < 2; i++) {
        char *name = studio_free_view(document);
        g_assert_cmpstr(name, ==, i == 0 ? "view 1" : "view 2");
        g_assert_true(studio_save_view(document, name, &camera));
        g_free(name);
    }
    uint64_t before = studio_document_digest(document);
    g_assert_false(studio_rename_view(document, "view 1", "view 2"));
    g_assert_false(studio_rename_view(document, "view 1", ""));
    g_assert_false(studio_rename_view(document, "view 3", "front"));
    g_assert_cmpuint(studio_document_digest(document), ==, before);
    g_assert_true(studio_rename_view(document, "view 1", "front & <back>"));
    g_assert_cmpuint(studio_find_view(document, "front & <back>"), !=, FR_NONE);
    char *name = studio_free_view(document); // one that is free, not how many there are
    g_assert_cmpstr(name, ==, "view 1");
    g_free(name);
    studio_document_undo(document);
    g_assert_cmpuint(studio_document_digest(document), ==, before);
    studio_document_free(document);
}

// ---- handles -----------------------------------------------------------------------------------

static StudioEye eye_above(void) {
    StudioEye eye = {studio_camera_default(), 800, 600};
    eye.camera.target[2] = 0;
    eye.camera.elevation = 0.6;
    eye.camera.distance = 20;
    return eye;
}

static void test_project(void) {
    StudioEye eye = eye_above();
    const double point[3] = {2, -1, 0.5};
    double pixel[2], origin[3], direction[3], away = 0;
    g_assert_true(studio_eye_project(&eye, point, pixel));
    studio_eye_ray(&eye, pixel, origin, direction);
    double along = 0;
    for (int k = 0; k < 3; k++) {
        along += (point[k] - origin[k]) * direction[k];
    }
    for (int k = 0; k < 3; k++) {
        away += pow(origin[k] + along * direction[k] - point[k], 2);
    }
    g_assert_cmpfloat(sqrt(away), <, 1e-4);
}

static void test_handles(void) {
    StudioEye eye = eye_above();
    const StudioStanding from = {
        .at = {1, 2, 0}, .scale = 1, .can_turn = true, .can_scale = true, .is_on_ground = true};
    StudioGizmo gizmo;
    double pivot[3];
    studio_gizmo_pivot(NULL, &from, pivot);
    g_assert_true(studio_gizmo_place(&eye, pivot, &from, &gizmo));
    for (int k = 0; k < 3; k++) {
        const double middle[2] = {0.3 * gizmo.middle[0] + 0.7 * gizmo.tips[k][0],
                                  0.3 * gizmo.middle[1] + 0.7 * gizmo.tips[k][1]};
        const double end[3] = {1 + (k == 0) * 3, 2 + (k == 1) * 3, (k == 2) * 3};
        double to[2], begin[2];
        g_assert_true(studio_eye_project(&eye, end, to) && studio_eye_project(&eye, pivot, begin));
        StudioGrip handle = studio_gizmo_under(&gizmo, middle);
        g_assert_cmpint(handle, ==, STUDIO_GRIP_X + k);
        StudioStanding now = studio_gizmo_drag(&eye, NULL, handle, &from, begin, to, 0, 0);
        for (int i = 0; i < 3; i++) {
            g_assert_cmpfloat_with_epsilon(now.at[i], end[i], 1e-3);
        }
    }
    g_assert_cmpint(studio_gizmo_under(&gizmo, gizmo.middle), ==, STUDIO_GRIP_GROUND);
    g_assert_cmpint(studio_gizmo_under(&gizmo, gizmo.scale), ==, STUDIO_GRIP_SCALE);
    const double nowhere[2] = {5, 5};
    g_assert_cmpint(studio_gizmo_under(&gizmo, nowhere), ==, STUDIO_GRIP_NONE);
}

static void test_turn(void) {
    StudioEye eye = eye_above();
    const StudioStanding from = {.at = {1, 2, 0}, .turn = 10, .scale = 2};
    const double east[3] = {3, 2, 0}, north[3] = {1, 4.2, 0};
    double begin[2], end[2];
    g_assert_true(studio_eye_project(&eye, east, begin) && studio_eye_project(&eye, north, end));
    StudioStanding now = studio_gizmo_drag(&eye, NULL, STUDIO_GRIP_TURN, &from, begin, end, 0, 0);
    g_assert_cmpfloat_with_epsilon(now.turn, 100, 1e-2);
    now = studio_gizmo_drag(&eye, NULL, STUDIO_GRIP_TURN, &from, begin, end, 0, 15);
    g_assert_cmpfloat_with_epsilon(now.turn, 105, 1e-6);
    now = studio_gizmo_drag(&eye, NULL, STUDIO_GRIP_GROUND, &from, begin, end, 0.5, 0);
    g_assert_cmpfloat_with_epsilon(now.at[0], -1, 1e-9);
    g_assert_cmpfloat_with_epsilon(now.at[1], 4, 1e-9);
}

static void test_reach(void) {
    const double min[3] = {-3, 0, 0}, max[3] = {0, 4, 9}, none[3] = {1, 1, 1},
                 less[3] = {-1, -1, -1};
    g_assert_cmpfloat(studio_ground_reach(10, min, max), ==, 30);
    g_assert_cmpfloat(studio_ground_reach(10, none, less), ==, 20);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(
        "/studio/scene/what is planted stands where it was planted, and the first plant "
        "stays",
        test_plant);
    g_test_add_func("/studio/scene/a species is planted without turn and size", test_species);
    g_test_add_func("/studio/scene/a stroke of the brush is one step", test_stroke);
    g_test_add_func("/studio/scene/nothing is planted into a broken text", test_broken);
    g_test_add_func("/studio/scene/a brush fills gaps and no more", test_brush);
    g_test_add_func("/studio/scene/what is taken over keeps its bark and its curves", test_adopt);
    g_test_add_func("/studio/scene/a preset is taken over and planted in one step",
                    test_adopt_and_plant);
    g_test_add_func("/studio/scene/what is there already is not taken over again", test_adopt_same);
    g_test_add_func("/studio/scene/presets go into one document", test_adopt_presets);
    g_test_add_func("/studio/scene/places, rows and obstacles stand somewhere", test_stands);
    g_test_add_func("/studio/scene/a move is one step and can be undone to the byte", test_move);
    g_test_add_func("/studio/scene/a drag makes an obstacle larger once", test_size);
    g_test_add_func("/studio/scene/the parts of a road keep together", test_road);
    g_test_add_func("/studio/scene/an envelope is drawn from either end", test_envelope);
    g_test_add_func("/studio/scene/things are set down near what is seen", test_reach);
    g_test_add_func("/studio/scene/a copy is moved and the first one stays", test_copy);
    g_test_add_func("/studio/scene/a view gets another name, but not one that is taken",
                    test_view_names);
    g_test_add_func("/studio/scene/a view is kept under its name and seen again", test_view);
    g_test_add_func("/studio/scene/a point is seen where its ray goes", test_project);
    g_test_add_func("/studio/scene/arrows move along their axes", test_handles);
    g_test_add_func("/studio/scene/the ring turns, the middle moves along the ground", test_turn);
    return g_test_run();
}
