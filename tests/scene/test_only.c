/// Plants taken out of a scene that has been built.
#include "frond/only.h"

#include "built.h"

#define POLE(id)                                                                                   \
    "<plant id='" id "'><pgraph><camera id='root'/><horn id='stem' length='2 ~ 1'/>"               \
    "<link from='root' to='stem'/></pgraph></plant>"
#define WOOD                                                                                       \
    "<frond version='1'>" POLE("oak")                                                              \
        POLE("elm") "<scene>"                                                                      \
                    "<place plant='oak' at='1,2,3'/><place plant='elm' at='5,5,5' turn='90' "      \
                    "scale='2'/>"                                                                  \
                    "<row plants='elm' spacing='2' individuals='2'>0,0,0 6,0,0</row>"              \
                    "<row plants='oak' spacing='2' except='1'>0,9,0 6,9,0</row>"                   \
                    "<obstacle shape='box' at='30,0,0'/></scene></frond>"

/// The scene of the wood with what a name means.
static Built built_only(const char *name, bool in_place) {
    Built built = build(WOOD, -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    FrContext context = fr_context_default();
    context.diags = built.diags;
    FrOnly *only;
    g_assert_cmpint(fr_only_new(built.document, &name, 1, &context, &only), ==, FR_OK);
    g_assert_true(fr_only_apply(only, built.scene, in_place));
    fr_only_free(only);
    return built;
}

static void test_names(void) {
    static const struct {
        const char *name;
        guint stands;
    } cases[] = {{"oak", 4},   {"elm", 5},   {"place-1", 1}, {"place-2", 1},
                 {"row-1", 4}, {"row-2", 3}, {"row-1.0", 1}, {"row-2.3", 1}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        Built built = built_only(cases[i].name, false);
        g_assert_cmpuint(built.scene->stands->len, ==, cases[i].stands);
        g_assert_cmpuint(fr_scene_stand_count(built.scene), ==, cases[i].stands);
        bool is_used[16] = {false};
        for (guint k = 0; k < cases[i].stands; k++) {
            is_used[stand_at(&built, k)->plant] = true;
        }
        g_assert_cmpuint(built.scene->plants->len, <=, cases[i].stands);
        for (guint k = 0; k < built.scene->plants->len; k++) {
            g_assert_true(is_used[k]);
        }
        forget(&built);
    }
}

static void test_shape(void) {
    Built whole = build(WOOD, -1);
    const FrStand *elm = stand_at(&whole, 1);
    FrDigest shape = fr_plant_digest(plant_at(&whole, elm->plant)->plant);
    for (int in_place = 0; in_place < 2; in_place++) {
        Built lone = built_only("place-2", in_place != 0);
        g_assert_cmpuint(lone.scene->plants->len, ==, 1);
        g_assert_cmpuint(fr_plant_digest(plant_at(&lone, 0)->plant), ==, shape);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat(stand_at(&lone, 0)->at[k], ==, in_place != 0 ? elm->at[k] : 0);
        }
        g_assert_cmpfloat(stand_at(&lone, 0)->turn, ==, elm->turn);
        g_assert_cmpfloat(stand_at(&lone, 0)->scale, ==, 2);
        forget(&lone);
    }
    forget(&whole);
}

static void test_distances(void) {
    Built built = built_only("row-2", false);
    for (guint i = 0; i < 3; i++) { // 0, 2 and 3 of the row
        g_assert_cmpfloat_with_epsilon(stand_at(&built, i)->at[0], i == 0 ? 0 : 2.0 * i + 2, 1e-6);
        g_assert_cmpfloat(stand_at(&built, i)->at[1], ==, 0);
    }
    forget(&built);
}

static void test_one(void) {
    Built built = build(WOOD, -1);
    FrStand third = *stand_at(&built, 4);
    FrOnly *none = fr_only_one(third.origin, 17), *only = fr_only_one(third.origin, third.number);
    FrDigest before = fr_scene_digest(built.scene);
    g_assert_false(fr_only_apply(none, built.scene, false));
    g_assert_cmpuint(fr_scene_digest(built.scene), ==, before);
    g_assert_true(fr_only_apply(only, built.scene, true));
    g_assert_cmpuint(built.scene->stands->len, ==, 1);
    g_assert_cmpfloat(stand_at(&built, 0)->at[0], ==, third.at[0]);
    fr_only_free(none);
    fr_only_free(only);
    forget(&built);
}

static void test_copy(void) {
    Built built = build(WOOD, -1);
    FrStand third = *stand_at(&built, 4);
    FrOnly *only = fr_only_one(third.origin, third.number), *none = fr_only_one(third.origin, 17);
    FrDigest before = fr_scene_digest(built.scene);
    FrDigest elm = fr_plant_digest(plant_at(&built, third.plant)->plant);
    uint32_t stands = fr_scene_stand_count(built.scene);
    FrScene *whole = fr_only_copy(NULL, built.scene, true);
    FrScene *lone = fr_only_copy(only, built.scene, false);
    g_assert_null(fr_only_copy(none, built.scene, false));
    g_assert_cmpuint(fr_scene_digest(built.scene), ==, before);
    forget(&built); // they need neither the scene nor its document
    g_assert_cmpuint(fr_scene_digest(whole), ==, before);
    g_assert_cmpuint(fr_scene_stand_count(whole), ==, stands);
    g_assert_cmpuint(whole->obstacles, ==, 1);
    g_assert_cmpuint(lone->plants->len, ==, 1);
    g_assert_cmpuint(fr_plant_digest(g_array_index(lone->plants, FrScenePlant, 0).plant), ==, elm);
    g_assert_cmpfloat(g_array_index(lone->stands, FrStand, 0).at[0], ==, 0);
    fr_scene_free(whole);
    fr_scene_free(lone);
    fr_only_free(only);
    fr_only_free(none);
}

static void test_unknown(void) {
    Built built = build(WOOD, -1);
    FrContext context = fr_context_default();
    context.diags = built.diags;
    const char *names[] = {"oak", "row"}; // there are two
    FrOnly *only;
    g_assert_cmpint(fr_only_new(built.document, names, 2, &context, &only), ==, FR_ERR_USAGE);
    g_assert_null(only);
    g_assert_cmpuint(fr_diags_count(built.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(built.diags, 0)->code, ==, "unknown-stand");
    g_assert_nonnull(
        strstr(fr_diags_get(built.diags, 0)->text,
               "oak, elm, place-1, place-2, row-1.0 to row-1.3, row-2.0, row-2.2 to row-2.3"));
    forget(&built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/only/names mean plants, places, rows and one plant of a row",
                    test_names);
    g_test_add_func("/scene/only/a copy is the same and needs nothing of the scene", test_copy);
    g_test_add_func("/scene/only/a plant keeps its shape, turn and size, here or at the origin",
                    test_shape);
    g_test_add_func("/scene/only/several plants keep their distances", test_distances);
    g_test_add_func("/scene/only/one is found by origin and number, and none leaves all as it was",
                    test_one);
    g_test_add_func("/scene/only/a name that nothing has lists what there is", test_unknown);
    return g_test_run();
}
