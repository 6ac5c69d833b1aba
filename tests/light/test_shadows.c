/// Shadow voxels against the published formulas.
#include "frond/random.h"
#include "frond/shadows.h"

#include <cglm/struct.h>
#include <math.h>

static void assert_near(double value, double wanted, double tolerance) {
    if (!(fabs(value - wanted) <= tolerance)) {
        g_error("%.9g is not within %.3g of %.9g", value, tolerance, wanted);
    }
}

static FrShadows *make(FrShadowForm form, int cells, const FrContext *context) {
    FrShadowSettings settings = fr_shadows_default();
    settings.form = form;
    for (int axis = 0; axis < 3; axis++) {
        settings.cells[axis] = cells;
        settings.origin[axis] = 0;
    }
    FrShadows *shadows;
    g_assert_cmpint(fr_shadows_new(&settings, context, &shadows), ==, FR_OK);
    return shadows;
}

/// Palubicki 2009, section 4.1: Δs = a b^−q in layer q, which is 2q + 1 wide; Q = max(C − s + a,
/// 0).
static void test_paper(void) {
    FrContext context = fr_context_default();
    FrShadows *shadows = make(FR_SHADOWS_SUBTRACT, 32, &context);
    vec3s point = {{16.5f, 16.5f, 20.5f}};
    fr_shadows_cast(shadows, &point, 1, false, &context);
    fr_shadows_cast(shadows, &point, 1, false, &context);
    for (int q = 0; q <= 6; q++) {
        double shade = 2 * 0.441 * pow(6.31, -q);
        for (int side = -8; side <= 8; side++) {
            vec3s at = {{16.5f + (float)side, 16.5f, 20.5f - (float)q}};
            double wanted = abs(side) <= q ? fmin(fmax(1 - shade + 0.441, 0), 1) : 1;
            assert_near((double)fr_shadows_at(shadows, at, 1).light, wanted, 1e-5);
        }
    }
    vec3s above = {{16.5f, 16.5f, 21.5f}};
    g_assert_cmpfloat(fr_shadows_at(shadows, above, 1).light, ==, 1);
    fr_shadows_free(shadows);
}

/// The authors' program: light times 1 − a b^−d, d the distance in voxels, in layers 1 … depth − 1.
static void test_program(void) {
    FrContext context = fr_context_default();
    FrShadows *shadows = make(FR_SHADOWS_MULTIPLY, 32, &context);
    vec3s points[2] = {{{16.5f, 16.5f, 20.5f}}, {{17.5f, 16.5f, 20.5f}}};
    fr_shadows_cast(shadows, points, 2, false, &context);
    vec3s at = {{16.5f, 16.5f, 19.5f}};
    double wanted = (1 - 0.441 / 6.31) * (1 - 0.441 * pow(6.31, -sqrt(2)));
    assert_near((double)fr_shadows_at(shadows, at, 1).light, wanted, 1e-5);
    g_assert_cmpfloat(fr_shadows_at(shadows, points[0], 1).light, ==, 1);
    fr_shadows_free(shadows);
}

static void test_direction(void) {
    FrContext context = fr_context_default();
    FrShadows *shadows = make(FR_SHADOWS_MULTIPLY, 32, &context);
    vec3s point = {{16.5f, 16.5f, 20.5f}};
    vec3s beside = {{17.5f, 16.5f, 19.5f}};
    FrShadowSample open = fr_shadows_at(shadows, beside, 1.6);
    g_assert_cmpfloat(open.direction.z, ==, 1);
    g_assert_cmpfloat(open.slope, ==, 0);
    fr_shadows_cast(shadows, &point, 1, false, &context);
    FrShadowSample shaded = fr_shadows_at(shadows, beside, 1.6);
    g_assert_cmpfloat(shaded.direction.x, >, 0.5f);
    assert_near((double)shaded.direction.y, 0, 1e-5);
    fr_shadows_free(shadows);
}

static vec3s *random_points(size_t count, float from, float to) {
    vec3s *points = g_new(vec3s, count);
    FrKey key = fr_key_root(5);
    for (size_t i = 0; i < count; i++) {
        for (uint32_t axis = 0; axis < 3; axis++) {
            float part = (float)fr_random(key, axis, (uint32_t)i);
            points[i].raw[axis] = from + (to - from) * part;
        }
    }
    return points;
}

static void test_exact(void) {
    FrContext context = fr_context_default();
    FrShadows *shadows = make(FR_SHADOWS_MULTIPLY, 24, &context);
    FrDigest empty = fr_shadows_digest(shadows);
    vec3s *points = random_points(5000, -10, 40);
    fr_shadows_cast(shadows, points, 5000, false, &context);
    g_assert_cmpuint(fr_shadows_digest(shadows), !=, empty);
    fr_shadows_cast(shadows, points + 2500, 2500, true, &context);
    fr_shadows_cast(shadows, points, 2500, true, &context);
    g_assert_cmpuint(fr_shadows_digest(shadows), ==, empty);
    g_free(points);
    fr_shadows_free(shadows);
}

static void test_threads(void) {
    vec3s *points = random_points(2000, 0, 24);
    FrDigest first = 0;
    static const int threads[] = {1, 2, 3, 8};
    for (size_t i = 0; i < G_N_ELEMENTS(threads); i++) {
        FrContext context = fr_context_default();
        context.pool = fr_pool_new(threads[i]);
        FrShadows *shadows = make(FR_SHADOWS_MULTIPLY, 24, &context);
        fr_shadows_cast(shadows, points, 2000, false, &context);
        FrDigest digest = fr_shadows_digest(shadows);
        first = i == 0 ? digest : first;
        g_assert_cmpuint(digest, ==, first);
        fr_shadows_free(shadows);
        fr_pool_free(context.pool);
    }
    g_free(points);
}

static void test_far(void) {
    FrContext context = fr_context_default();
    FrShadows *shadows = make(FR_SHADOWS_MULTIPLY, 8, &context);
    FrDigest empty = fr_shadows_digest(shadows);
    vec3s points[] = {{{NAN, 0, 0}}, {{1e30f, -1e30f, 1e30f}}, {{INFINITY, 0, -INFINITY}}};
    fr_shadows_cast(shadows, points, 3, false, &context);
    g_assert_cmpuint(fr_shadows_digest(shadows), ==, empty);
    for (int i = 0; i < 3; i++) {
        g_assert_cmpfloat(fr_shadows_at(shadows, points[i], 1.6).light, ==, 1);
    }
    fr_shadows_free(shadows);
}

static void test_limit(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrShadowSettings settings = fr_shadows_default();
    settings.cells[0] = settings.cells[1] = settings.cells[2] = 2000000000;
    FrShadows *shadows;
    g_assert_cmpint(fr_shadows_new(&settings, &context, &shadows), ==, FR_ERR_LIMIT);
    g_assert_null(shadows);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-bytes");
    fr_diags_free(context.diags);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/shadows/a subtracted shadow is the paper's pyramid", test_paper);
    g_test_add_func("/light/shadows/a multiplied shadow is that of the authors' program",
                    test_program);
    g_test_add_func("/light/shadows/light comes from beside what shades", test_direction);
    g_test_add_func("/light/shadows/what was cast can be taken back exactly", test_exact);
    g_test_add_func("/light/shadows/the bits are the same for any number of threads", test_threads);
    g_test_add_func("/light/shadows/points that are nowhere cast no shadow", test_far);
    g_test_add_func("/light/shadows/too many voxels are refused before memory is taken",
                    test_limit);
    return g_test_run();
}
