#include "studio/model/camera.h"
#include "studio/model/overlay.h"

#include <math.h>

static const float red[4] = {1, 0, 0, 1};

static const StudioMark *mark(const GArray *marks, guint i) {
    return &g_array_index(marks, StudioMark, i);
}

static double distance(const StudioMark *a, const StudioMark *b) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double d = (double)a->at[i] - (double)b->at[i];
        sum += d * d;
    }
    return sqrt(sum);
}

static void test_box(void) {
    StudioOverlay *overlay = studio_overlay_new();
    studio_overlay_box(overlay, (double[3]){0, 0, 0}, (double[3]){1, 2, 4}, 1, red);
    double length = 0;
    g_assert_cmpuint(overlay->lines->len, ==, 24);
    for (guint i = 0; i < overlay->lines->len; i += 2) {
        length += distance(mark(overlay->lines, i), mark(overlay->lines, i + 1));
    }
    g_assert_cmpfloat_with_epsilon(length, 4 * (1 + 2 + 4), 1e-6);
    studio_overlay_free(overlay);
}

static void test_circle(void) {
    StudioOverlay *overlay = studio_overlay_new();
    const StudioMark centre = {.at = {1, 2, 3}};
    studio_overlay_circle(overlay, (double[3]){1, 2, 3}, (double[3]){1, 0, 0}, (double[3]){0, 0, 1},
                          0.5, 2, red);
    guint count = overlay->lines->len;
    g_assert_cmpuint(count, >, 40);
    g_assert_cmpfloat_with_epsilon(
        distance(mark(overlay->lines, 0), mark(overlay->lines, count - 1)), 0, 1e-6);
    for (guint i = 0; i < count; i++) {
        g_assert_cmpfloat_with_epsilon(distance(mark(overlay->lines, i), &centre), 0.5, 1e-6);
    }
    studio_overlay_free(overlay);
}

static void test_arrow(void) {
    const double ends[][3] = {{0, 0, 2}, {3, 0, 0}, {1, 1, 1}, {-1, 2, 0}};
    for (size_t k = 0; k < G_N_ELEMENTS(ends); k++) {
        StudioOverlay *overlay = studio_overlay_new();
        studio_overlay_arrow(overlay, (double[3]){0, 0, 0}, ends[k], 1, red);
        g_assert_cmpuint(overlay->lines->len, ==, 10);
        double length = distance(mark(overlay->lines, 0), mark(overlay->lines, 1));
        double barb = 0;
        for (guint i = 2; i < 10; i += 2) {
            double d = distance(mark(overlay->lines, i), mark(overlay->lines, i + 1));
            barb = i == 2 ? d : barb;
            g_assert_cmpfloat_with_epsilon(d, barb, 1e-6);
            g_assert_cmpfloat(distance(mark(overlay->lines, 0), mark(overlay->lines, i + 1)), <,
                              length);
        }
        studio_overlay_free(overlay);
    }
    StudioOverlay *none = studio_overlay_new();
    studio_overlay_arrow(none, (double[3]){1, 1, 1}, (double[3]){1, 1, 1}, 1, red);
    g_assert_cmpuint(none->lines->len, ==, 2);
    studio_overlay_free(none);
}

static void test_project(void) {
    StudioCamera camera = studio_camera_default();
    double origin[3], direction[3], point[3], x, y;
    studio_camera_ray(&camera, 1.6, -0.3, 0.7, origin, direction);
    for (int i = 0; i < 3; i++) {
        point[i] = origin[i] + 2.5 * direction[i];
    }
    g_assert_true(studio_camera_project(&camera, 1.6, point, &x, &y));
    g_assert_cmpfloat_with_epsilon(x, -0.3, 1e-9);
    g_assert_cmpfloat_with_epsilon(y, 0.7, 1e-9);
    for (int i = 0; i < 3; i++) {
        point[i] = origin[i] - 2.5 * direction[i];
    }
    g_assert_false(studio_camera_project(&camera, 1.6, point, &x, &y));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/overlay/the edges of a box are as long as four of each side",
                    test_box);
    g_test_add_func("/studio/overlay/a circle closes and keeps its distance", test_circle);
    g_test_add_func("/studio/overlay/an arrow has four equal barbs, and none without length",
                    test_arrow);
    g_test_add_func("/studio/camera/a point on a ray is seen where the ray leaves", test_project);
    return g_test_run();
}
