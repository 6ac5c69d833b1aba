/// Scenes: which plants are built, with which seeds, where they stand.
#include "built.h"

#include <math.h>

#define PLANT(id, seed)                                                                            \
    "<plant id='" id "' seed='" seed "'><pgraph><camera id='root'/>"                               \
    "<horn id='stem' length='2 ~ 0.5' radius='0.1' gnarl='20'/>"                                   \
    "<link from='root' to='stem'/></pgraph></plant>"
#define WOOD(scene) "<frond version='1'>" PLANT("oak", "7") PLANT("elm", "8") scene "</frond>"

static void test_without_places(void) {
    Built built = build(WOOD(""), -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    g_assert_cmpstr(built.scene->name, ==, "wood");
    g_assert_cmpuint(built.scene->plants->len, ==, 1);
    g_assert_cmpuint(built.scene->stands->len, ==, 1);
    g_assert_cmpuint(built.scene->seed, ==, 7);
    g_assert_cmpfloat(stand_at(&built, 0)->scale, ==, 1);
    g_assert_cmpuint(plant_at(&built, 0)->instances, ==, 2);
    g_assert_cmpuint(plant_at(&built, 0)->by_component[0], ==, 1);
    forget(&built);
}

static void test_built_once(void) {
    Built built = build(WOOD("<scene><place plant='oak'/><place plant='elm' at='3,0,1'/>"
                             "<place plant='oak' at='6,1,0' turn='90' scale='2'/>"
                             "<place plant='oak' seed='9'/><place plant='elm' seed='8'/></scene>"),
                        -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    g_assert_cmpuint(built.scene->plants->len, ==, 3);
    static const uint32_t plants[] = {0, 1, 0, 2, 1};
    g_assert_cmpuint(built.scene->stands->len, ==, G_N_ELEMENTS(plants));
    for (guint i = 0; i < G_N_ELEMENTS(plants); i++) {
        g_assert_cmpuint(stand_at(&built, i)->plant, ==, plants[i]);
    }
    g_assert_cmpfloat(stand_at(&built, 2)->at[0], ==, 6);
    g_assert_cmpfloat_with_epsilon(stand_at(&built, 2)->turn, G_PI / 2, 1e-15);
    g_assert_cmpfloat(stand_at(&built, 2)->scale, ==, 2);
    g_assert_cmpuint(fr_plant_digest(plant_at(&built, 0)->plant), !=,
                     fr_plant_digest(plant_at(&built, 2)->plant));
    forget(&built);
}

static FrDigest digest_of(const char *text, int64_t seed) {
    Built built = build(text, seed);
    g_assert_cmpint(built.status, ==, FR_OK);
    FrDigest digest = fr_plant_digest(plant_at(&built, built.scene->plants->len - 1)->plant);
    forget(&built);
    return digest;
}

/// A seed means the same wherever it is given.
static void test_seeds(void) {
    FrDigest own = digest_of(WOOD(""), -1);
    g_assert_cmpuint(digest_of(WOOD(""), 7), ==, own);
    g_assert_cmpuint(digest_of(WOOD(""), 9), !=, own);
    FrDigest nine = digest_of(WOOD("<scene><place plant='oak' seed='9'/></scene>"), -1);
    g_assert_cmpuint(digest_of(WOOD("<scene><place plant='oak'/></scene>"), 9), ==, nine);
    // A wood of different trees stays one under --seed.
    Built wood = build(WOOD("<scene><place plant='oak' seed='1'/><place plant='oak' seed='2'/>"
                            "</scene>"),
                       5);
    g_assert_cmpuint(wood.scene->plants->len, ==, 2);
    g_assert_cmpuint(wood.scene->seed, ==, 5);
    g_assert_cmpuint(fr_plant_digest(plant_at(&wood, 0)->plant), !=,
                     fr_plant_digest(plant_at(&wood, 1)->plant));
    forget(&wood);
}

static void test_threads(void) {
    FrDigest expected = 0;
    static const int threads[] = {1, 2, 3, 8};
    for (size_t i = 0; i < G_N_ELEMENTS(threads); i++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[i]);
        Built built = build_with(WOOD("<scene><place plant='oak'/><place plant='elm' seed='3'/>"
                                      "</scene>"),
                                 -1, context);
        FrDigest digest = fr_scene_digest(built.scene);
        g_assert_true(i == 0 || digest == expected);
        expected = digest;
        forget(&built);
        fr_pool_free(context.pool);
    }
}

static void test_bounds(void) {
    Built built = build(
        "<frond version='1'><plant id='pole'><pgraph><camera id='root'/>"
        "<horn id='stem' length='2' radius='0.1'/><link from='root' to='stem'/></pgraph></plant>"
        "<scene><place plant='pole'/><place plant='pole' at='5,0,1' scale='3'/></scene></frond>",
        -1);
    double min[3], max[3];
    fr_scene_bounds(built.scene, min, max);
    g_assert_cmpfloat_with_epsilon(max[2], 7, 0.4);
    g_assert_cmpfloat(max[2], >=, 7 - 1e-5);
    g_assert_cmpfloat_with_epsilon(min[2], 0, 0.4);
    g_assert_cmpfloat_with_epsilon(min[0], 0, 0.4);
    g_assert_cmpfloat_with_epsilon(max[0], 5, 0.4);
    forget(&built);
}

static void assert_refused(Built *built, FrStatus status, const char *code) {
    g_assert_cmpint(built->status, ==, status);
    g_assert_null(built->scene);
    g_assert_cmpuint(fr_diags_error_count(built->diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(built->diags, 0)->code, ==, code);
    g_assert_nonnull(fr_diags_get(built->diags, 0)->span.source);
    forget(built);
}

static void test_refused(void) {
    Built empty = build("<frond version='1'/>", -1);
    assert_refused(&empty, FR_ERR_DOCUMENT, "no-plant");
    FrContext context = fr_context_default();
    context.limits.plants = 1;
    Built many =
        build_with(WOOD("<scene><place plant='oak'/><place plant='oak'/></scene>"), -1, context);
    assert_refused(&many, FR_ERR_LIMIT, "limit-plants");
}

static void test_cancelled(void) {
    FrContext context = fr_context_default();
    context.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(context.progress);
    Built built = build_with(WOOD("<scene><place plant='oak'/></scene>"), -1, context);
    g_assert_cmpint(built.status, ==, FR_CANCELLED);
    g_assert_null(built.scene);
    g_assert_cmpuint(fr_diags_count(built.diags), ==, 0);
    forget(&built);
    fr_progress_free(context.progress);
}

static void test_nothing_to_see(void) {
    static const struct {
        const char *component;
        bool is_seen;
    } rows[] = {
        {"<phiball id='c'/>", false},
        {"<horn id='c' length='0'/>", false},
        {"<simple id='c' primitive='none'/>", false},
        {"<simple id='c'/>", true},
        {"<horn id='c'/>", true},
        {"<horn id='c' primitive='sphere'/>", true},
        {"<leaf id='c'/>", true},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text =
            g_strdup_printf("<frond version='1'><plant id='p'><pgraph>%s</pgraph></plant></frond>",
                            rows[i].component);
        Built built = build(text, -1);
        bool is_warned = false;
        for (size_t k = 0; k < fr_diags_count(built.diags); k++) {
            is_warned |= strcmp(fr_diags_get(built.diags, k)->code, "nothing-to-see") == 0;
        }
        g_test_message("%s", rows[i].component);
        g_assert_cmpint(built.status, ==, FR_OK);
        g_assert_true(is_warned == !rows[i].is_seen);
        forget(&built);
        g_free(text);
    }
}

#define SHOWN(surfaces)                                                                            \
    "<frond version='1'><plant id='p'>" surfaces "<pgraph><horn id='h'/></pgraph></plant></frond>"

static FrDigest scene_digest_of(const char *text) {
    Built built = build(text, -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    FrDigest digest = fr_scene_digest(built.scene);
    forget(&built);
    return digest;
}

static void test_surfaces_count(void) {
    FrDigest digests[] = {scene_digest_of(SHOWN("")), scene_digest_of(SHOWN("<nurbs/>")),
                          scene_digest_of(SHOWN("<nurbs circle='nine'/>")),
                          scene_digest_of(SHOWN("<nurbs tolerance='0.01'/>")),
                          scene_digest_of(SHOWN("<nurbs wind='1, 0, 0'/>"))};
    for (size_t i = 0; i < G_N_ELEMENTS(digests); i++) {
        for (size_t k = 0; k < i; k++) {
            g_assert_cmphex(digests[i], !=, digests[k]);
        }
    }
    g_assert_cmphex(scene_digest_of(SHOWN("<nurbs circle='triangle'/>")), ==, digests[1]);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/the first plant stands at the origin without places",
                    test_without_places);
    g_test_add_func("/scene/a plant is built once for every seed", test_built_once);
    g_test_add_func("/scene/a seed means the same wherever it is given", test_seeds);
    g_test_add_func("/scene/the digest is the same for any number of threads", test_threads);
    g_test_add_func("/scene/the digest tells how plants are shown as surfaces",
                    test_surfaces_count);
    g_test_add_func("/scene/bounds hold everything", test_bounds);
    g_test_add_func("/scene/nothing is built without plants or over a limit", test_refused);
    g_test_add_func("/scene/a plant with nothing to see gets a warning", test_nothing_to_see);
    g_test_add_func("/scene/building can be stopped", test_cancelled);
    return g_test_run();
}
