/// How much is drawn while a view moves.
#include "studio/model/pace.h"

#include "studio.h"

// Pictures on a machine that takes so long for a triangle, and for all its pixels; slower by
// `richness` where light is for pixels.
static void draw(StudioPacing *pacing, int count, double triangle, double pixels, double richness) {
    for (int i = 0; i < count; i++) {
        double each = pacing->is_plain ? triangle : richness * triangle;
        double seconds = each * pacing->triangles + pixels * pacing->scale * pacing->scale;
        studio_pacing_learn(pacing, seconds, (uint64_t)pacing->triangles);
    }
}

static void test_slow(void) {
    StudioPacing pacing = studio_pacing_new();
    draw(&pacing, 40, 1e-6, 0.005, 5);
    g_assert_true(pacing.is_plain);
    g_assert_cmpfloat(pacing.scale, ==, 0.5);
    double pixels = 0.005 * pacing.scale * pacing.scale;
    g_assert_cmpfloat(1e-6 * pacing.triangles + pixels, <, 0.038);
    g_assert_cmpfloat(1e-6 * pacing.triangles + pixels, >, 0.023);
}

static void test_quick(void) {
    StudioPacing pacing = studio_pacing_new();
    draw(&pacing, 60, 1e-9, 0.0001, 2);
    g_assert_false(pacing.is_plain);
    g_assert_cmpfloat(pacing.scale, ==, 1);
    g_assert_cmpfloat(pacing.triangles, ==, 4e6);
}

static void test_floor(void) {
    StudioPacing pacing = studio_pacing_new();
    draw(&pacing, 60, 1e-4, 0.1, 5);
    g_assert_cmpfloat(pacing.triangles, ==, 20000);
    g_assert_cmpfloat(pacing.scale, ==, 0.5);
    draw(&pacing, 60, 1e-7, 0.001, 5); // the machine has time again
    g_assert_cmpfloat(pacing.scale, ==, 1);
}

static void test_still(void) {
    StudioPacing pacing = studio_pacing_new();
    draw(&pacing, 40, 1e-6, 0.005, 5);
    double before = pacing.triangles;
    for (int i = 0; i < 20; i++) { // a little slower and quicker in turn
        studio_pacing_learn(&pacing, i % 2 == 0 ? 0.033 : 0.027, (uint64_t)pacing.triangles);
    }
    g_assert_cmpfloat(pacing.triangles, ==, before);
    studio_pacing_learn(&pacing, 0.001, 100); // a scene of few triangles tells nothing of more
    g_assert_cmpfloat(pacing.triangles, ==, before);
}

static void test_between(void) {
    StudioPacing pacing = studio_pacing_new();
    int changes = 0;
    for (int i = 0; i < 400; i++) {
        bool was_plain = pacing.is_plain;
        draw(&pacing, 1, 5e-8, 0.001, 10);
        changes += pacing.is_plain != was_plain;
    }
    g_assert_cmpint(changes, ==, 2); // tried once, and not again for long
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/pace/a slow machine draws as much as it has time for", test_slow);
    g_test_add_func("/studio/pace/a quick machine draws all in the best light", test_quick);
    g_test_add_func("/studio/pace/there is a least picture and a way back from it", test_floor);
    g_test_add_func("/studio/pace/small differences change nothing", test_still);
    g_test_add_func("/studio/pace/a machine between the two does not go to and fro", test_between);
    return g_test_run();
}
