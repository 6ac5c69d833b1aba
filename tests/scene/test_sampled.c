/// Plants of linked components that are drawn to the light of their scene.
#include "frond/scene.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

#define DOCUMENT(light)                                                                            \
    "<frond version='1'><plant id='p'><pgraph><camera id='root'/><world id='here' sampled='yes' "  \
    "light-x='-1' light-z='0'/><horn id='stem' length='1' radius='0.01' phototropism='3'/>"        \
    "<link from='root' to='here'/><link from='here' to='stem'/></pgraph></plant>"                  \
    "<scene ground='no' sun-strength='0' sky-strength='0'>" light                                  \
    "<lamp at='4, 0, 0.5' power='100'/><place plant='p'/>"                                         \
    "<place plant='p' at='0, 3, 0' turn='90'/></scene></frond>"

typedef struct Built {
    FrDocument *document;
    FrScene *scene;
} Built;

static Built build(const char *text) {
    Built built;
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("sampled.frond", text, strlen(text));
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &built.document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(built.document, -1, &context, &built.scene), ==, FR_OK);
    fr_source_unref(source);
    return built;
}

static void forget(Built *built) {
    fr_scene_free(built->scene);
    fr_document_free(built->document);
}

/// The direction of a plant's tip in the world.
static vec3s tip_of(const Built *built, guint stand) {
    const FrStand *at = &g_array_index(built->scene->stands, FrStand, stand);
    const FrPlant *plant = g_array_index(built->scene->plants, FrScenePlant, at->plant).plant;
    vec3s heading = fr_frame_heading(plant->nodes.frame[plant->nodes.count - 1]);
    return glms_vec3_rotate(heading, (float)at->turn, (vec3s){{0, 0, 1}});
}

static void test_lamp(void) {
    Built built = build(DOCUMENT("<light near='0.001'/>"));
    g_assert_cmpuint(built.scene->plants->len, ==, 2);
    vec3s first = tip_of(&built, 0), second = tip_of(&built, 1);
    g_assert_cmpfloat(first.x, >, 0.9f);
    g_assert_cmpfloat(fabsf(first.y), <, 0.02f);
    // The second stands 3 m further to the north: the lamp is to the south-east of it.
    g_assert_cmpfloat(second.x, >, 0.6f);
    g_assert_cmpfloat(second.y, <, -0.4f);
    forget(&built);
}

/// As of plants that grow in the light.
static void test_told(void) {
    Built built = build(DOCUMENT("<light by='density' photons='1000'/>"));
    g_assert_cmpuint(built.scene->light.photons, ==, 1000);
    g_assert_cmpuint(built.scene->light.rays, >, 0);
    g_assert_cmpfloat(built.scene->light_seconds, >, 0);
    forget(&built);
}

/// The sun goes through the south, and a tall stem bends to it up to its tip as a small one does.
static void test_tall(void) {
    Built built = build("<frond version='1'><plant id='p'><pgraph><camera id='root'/>"
                        "<world id='here' sampled='yes'/><horn id='stem' length='30' "
                        "radius='0.01' phototropism='3'/><link from='root' to='here'/>"
                        "<link from='here' to='stem'/></pgraph></plant><scene ground='no' "
                        "sky-strength='0'><light by='density' photons='400000' distance='0.5'/>"
                        "<place plant='p'/></scene></frond>");
    g_assert_cmpfloat(tip_of(&built, 0).y, <, -0.3f);
    forget(&built);
}

static void test_without_light(void) {
    Built built = build(DOCUMENT(""));
    g_assert_cmpuint(built.scene->plants->len, ==, 1);
    g_assert_cmpfloat(tip_of(&built, 0).x, <, -0.9f);
    forget(&built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/sampled/stems are drawn to the lamp from where they stand", test_lamp);
    g_test_add_func("/scene/sampled/photons and time of the light are told", test_told);
    g_test_add_func("/scene/sampled/a tall stem is drawn to the sun up to its tip", test_tall);
    g_test_add_func("/scene/sampled/without a light the formulas hold", test_without_light);
    return g_test_run();
}
