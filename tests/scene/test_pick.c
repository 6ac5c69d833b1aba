/// Rays meet what is drawn where they go.
#include "frond/pick.h"

#include <math.h>
#include <string.h>

// A stem along z of 2 m and 0.1 m, in a stand, with a leaf at its tip.
#define STEM                                                                                       \
    "<frond version='1'><plant id='p'><pgraph><camera id='r'/>"                                    \
    "<horn id='stem' length='2' radius='0.1' taper='0'/>"                                          \
    "<leaf id='leaf' length='1' width='0.8' petiole-length='0'/>"                                  \
    "<link from='r' to='stem'/><link from='stem' to='leaf'/></pgraph></plant>"

static FrScene *scene_of(const char *text) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("pick", text, strlen(text));
    FrDocument *document;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    FrScene *scene;
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_OK);
    scene->params = NULL;
    scene->surroundings = NULL;
    fr_document_free(document);
    fr_source_unref(source);
    return scene;
}

static FrScene *stem_at(double x, double turn, double scale) {
    char *text = g_strdup_printf(
        STEM "<scene><place plant='p' at='%f, 0, 0' turn='%f' scale='%f'/></scene></frond>", x,
        turn, scale);
    FrScene *scene = scene_of(text);
    g_free(text);
    return scene;
}

// The stem and one obstacle.
static FrScene *stem_and(const char *obstacle) {
    char *text = g_strdup_printf(STEM "<scene><place plant='p'/>%s</scene></frond>", obstacle);
    FrScene *scene = scene_of(text);
    g_free(text);
    return scene;
}

static bool pick(const FrScene *scene, double x, double z, double spread, FrPick *result) {
    const double origin[3] = {x, -10, z}, direction[3] = {0, 1, 0};
    return fr_scene_pick(scene, origin, direction, spread, result);
}

static const char *component_of(const FrScene *scene, const FrPick *result) {
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, result->plant).plant;
    return g_array_index(plant->components, FrComponent, result->component).id;
}

static void test_stem(void) {
    FrScene *scene = stem_at(3, 0, 1);
    FrPick result;
    g_assert_true(pick(scene, 3.09, 1, 0, &result));
    g_assert_cmpstr(component_of(scene, &result), ==, "stem");
    g_assert_cmpuint(result.organ, ==, FR_NONE);
    g_assert_cmpfloat_with_epsilon(result.distance, 10, 0.1);
    g_assert_false(pick(scene, 3.11, 1, 0, &result));
    g_assert_false(pick(scene, 0, 1, 0, &result));
    fr_scene_free(scene);
}

static void test_leaf(void) {
    FrScene *scene = stem_at(0, 0, 1);
    FrPick result;
    g_assert_true(pick(scene, 0, 2.5, 0, &result));
    g_assert_cmpstr(component_of(scene, &result), ==, "leaf");
    g_assert_cmpuint(result.node, ==, FR_NONE);
    fr_scene_free(scene);
}

static void test_stand(void) {
    FrScene *scene = stem_at(-1, 77, 3);
    FrPick result;
    g_assert_true(pick(scene, -1.28, 5, 0, &result));
    g_assert_cmpstr(component_of(scene, &result), ==, "stem");
    g_assert_cmpfloat_with_epsilon(result.distance, 10, 0.3);
    g_assert_false(pick(scene, -1.32, 5, 0, &result));
    fr_scene_free(scene);
}

static void test_spread(void) {
    FrScene *scene = stem_at(0, 0, 1);
    FrPick result;
    g_assert_false(pick(scene, 0.15, 1, 0.01, &result));
    g_assert_true(pick(scene, 0.15, 1, 0.016, &result));
    const double origin[3] = {0, 10, 1}, away[3] = {0, 1, 0};
    g_assert_false(fr_scene_pick(scene, origin, away, 0.05, &result));
    fr_scene_free(scene);
}

static void test_box(void) {
    FrScene *scene = stem_and("<obstacle at='0, -4, 0' size='2, 1, 3' turn='90'/>");
    FrPick result;
    g_assert_true(pick(scene, 0.45, 2.9, 0, &result));
    g_assert_cmpuint(result.stand, ==, fr_scene_stand_count(scene));
    g_assert_cmpfloat_with_epsilon(result.distance, 5, 1e-5); // its 2 m lie along y now
    g_assert_false(pick(scene, 0.55, 2.9, 0, &result));
    g_assert_false(pick(scene, 0.45, 3.1, 0, &result));
    fr_scene_free(scene);
}

static void test_round(void) {
    FrScene *scene = stem_and("<obstacle shape='sphere' at='5, 0, 0' size='2, 2, 2'/>"
                              "<obstacle shape='cylinder' at='9, 0, 0' size='2, 2, 2'/>");
    FrPick result;
    g_assert_true(pick(scene, 5.6, 1, 0, &result));
    g_assert_cmpfloat_with_epsilon(result.distance, 10 - 0.8, 1e-5);
    g_assert_false(pick(scene, 5.6, 1.9, 0, &result)); // a corner of the box around it
    g_assert_true(pick(scene, 9.6, 1.9, 0, &result));
    g_assert_cmpfloat_with_epsilon(result.distance, 10 - 0.8, 1e-5);
    g_assert_cmpuint(result.organ, ==, 1);
    fr_scene_free(scene);
}

static void test_sweep(void) {
    FrScene *scene = stem_and("<obstacle shape='sweep' section='square' size='1, 1, 2'>"
                              "-9,-3,0 9,-3,0</obstacle>");
    FrPick result;
    g_assert_true(pick(scene, 7, 1.5, 0, &result));
    g_assert_cmpfloat_with_epsilon(result.distance, 6.5, 1e-5);
    g_assert_false(pick(scene, 7, 2.1, 0, &result));
    fr_scene_free(scene);
}

static void test_origin(void) {
    const char *text = STEM "<scene><place plant='p'/><row plants='p' spacing='1'>3,0,0 4,0,0</row>"
                            "</scene></frond>";
    FrScene *scene = scene_of(text);
    const char *elements[] = {"place ", "row ", "row "};
    for (guint i = 0; i < 3; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        g_assert_true(g_str_has_prefix(text + stand->origin, elements[i]));
    }
    fr_scene_free(scene);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/pick/a stem is as thick as it is", test_stem);
    g_test_add_func("/scene/pick/a leaf is met at its blade", test_leaf);
    g_test_add_func("/scene/pick/stands are moved, turned and scaled", test_stand);
    g_test_add_func("/scene/pick/a ray that spreads meets more, and nothing behind it",
                    test_spread);
    g_test_add_func("/scene/pick/a box is met on its turned side, and beside it nothing is",
                    test_box);
    g_test_add_func("/scene/pick/balls and cylinders are round", test_round);
    g_test_add_func("/scene/pick/what is drawn along a line is met on its triangles", test_sweep);
    g_test_add_func("/scene/pick/what stands knows the element that has placed it", test_origin);
    return g_test_run();
}
