#include "plants.h"

#include <math.h>

enum { A, B, C, D, E, BRANCHES };

/// Figure 5: A bears B and C, C bears D and E. All in the plane of x and z.
static FrPlant *figure_5(void) {
    FrPlant *plant = fr_plant_new("figure 5");
    add_branch(plant, FR_NONE, 0, 4, 1);
    add_branch(plant, 3, 0, 4, 0.8f);  // B to the left
    add_branch(plant, 3, 0, 4, 0.8f);  // C to the right
    add_branch(plant, 11, 0, 4, 0.6f); // D upright, on C
    add_branch(plant, 11, 0, 4, 0.6f); // E on C
    static const float lean[] = {0, -0.7f, 0.5f, -0.5f, 0.5f};
    for (uint32_t a = 0; a < BRANCHES; a++) {
        plant->nodes.rotation[4 * a] = fr_rotation_about((vec3s){{0, 1, 0}}, lean[a]);
    }
    fr_plant_update_frames(plant, 0);
    return plant;
}

static void assert_states(const FrSelection *selection, const char *wanted) {
    char found[BRANCHES + 1] = {0};
    for (uint32_t a = 0; a < BRANCHES; a++) {
        found[a] = "-su"[fr_selection_state(selection, a)];
    }
    g_assert_cmpstr(found, ==, wanted);
}

static void published_example(void) {
    FrPlant *plant = figure_5();
    FrSelection *selection = fr_selection_new(plant);
    assert_states(selection, "-----");
    fr_selection_touch(selection, A);
    assert_states(selection, "s----");
    fr_selection_touch(selection, B);
    assert_states(selection, "su---");
    fr_selection_touch(selection, C);
    assert_states(selection, "suu--");
    fr_selection_touch(selection, D);
    assert_states(selection, "s-su-");
    fr_selection_touch(selection, FR_NONE);
    fr_selection_end(selection, FR_END_PUBLISHED);
    assert_states(selection, "s-ss-");
    fr_selection_free(selection);
    fr_plant_free(plant);
}

static void ends(void) {
    FrPlant *plant = figure_5();
    FrSelection *selection = fr_selection_new(plant);
    static const uint32_t touched[] = {A, C, D, E, E};
    for (int published = 0; published < 2; published++) {
        fr_selection_clear(selection);
        for (size_t i = 0; i < G_N_ELEMENTS(touched); i++) {
            fr_selection_touch(selection, touched[i]);
        }
        assert_states(selection, "s-suu");
        fr_selection_end(selection, published ? FR_END_PUBLISHED : FR_END_KEEPS_PATH);
        assert_states(selection, published ? "s-sss" : "s-s-s"); // E has more pixels than D
    }
    fr_selection_free(selection);
    fr_plant_free(plant);
}

static void never_upwards(void) {
    FrPlant *plant = figure_5();
    FrSelection *selection = fr_selection_new(plant);
    fr_selection_touch(selection, C);
    fr_selection_touch(selection, A); // bears C
    fr_selection_touch(selection, B);
    fr_selection_touch(selection, 77); // there is none
    assert_states(selection, "--s--");
    fr_selection_free(selection);
    fr_plant_free(plant);
}

static void two_ends(void) {
    FrPlant *plant = figure_5();
    FrSelection *selection = fr_selection_new(plant);
    g_assert_true(fr_selection_between(selection, D, A));
    assert_states(selection, "s-ss-");
    g_assert_false(fr_selection_between(selection, B, D));
    g_assert_false(fr_selection_between(selection, B, 77));
    assert_states(selection, "s-ss-");
    g_assert_true(fr_selection_between(selection, C, E));
    assert_states(selection, "--s-s");
    char *choice = fr_selection_choice(selection);
    char *wanted = g_strdup_printf("#%016" G_GINT64_MODIFIER "x #%016" G_GINT64_MODIFIER "x",
                                   plant->axes.path[C], plant->axes.path[E]);
    g_assert_cmpstr(choice, ==, wanted);
    g_free(choice);
    g_free(wanted);
    fr_selection_free(selection);
    fr_plant_free(plant);
}

/// From the front: x to the right, z up; 2.4 m are the view's height.
static mat4s front_view(void) {
    mat4s project = GLMS_MAT4_ZERO;
    project.m00 = 1 / 1.2f;
    project.m21 = 1 / 1.2f;
    project.m31 = -1;
    project.m12 = 1 / 10.0f;
    project.m33 = 1;
    return project;
}

static void pixel_of(vec3s at, const FrIdBuffer *view, double *x, double *y) {
    *x = (0.5 + 0.5 * (double)at.x / 1.2) * view->width;
    *y = (0.5 - 0.5 * ((double)at.z / 1.2 - 1)) * view->height;
}

static void by_pen(void) {
    FrPlant *plant = figure_5();
    FrContext context = fr_context_default();
    FrIdBuffer *view;
    g_assert_cmpint(fr_id_buffer_draw(plant, front_view(), 200, 200, 5, &context, &view), ==,
                    FR_OK);
    FrSelection *selection = fr_selection_new(plant);
    // Up along A, over B's foot, along C, along D.
    static const uint32_t way[] = {1, 3, 4, 3, 9, 11, 13, 15};
    static const char *const states[] = {"s----", NULL, "su---", NULL,
                                         "suu--", NULL, "s-su-", "s-su-"};
    for (size_t i = 0; i < G_N_ELEMENTS(way); i++) {
        double x, y;
        pixel_of(plant->nodes.position[way[i]], view, &x, &y);
        fr_selection_move(selection, view, x, y);
        if (states[i] != NULL) {
            assert_states(selection, states[i]);
        }
    }
    fr_selection_move(selection, view, -1e300, 5);
    fr_selection_move(selection, view, NAN, 5);
    fr_selection_end(selection, FR_END_KEEPS_PATH);
    assert_states(selection, "s-ss-");
    fr_selection_free(selection);
    fr_id_buffer_free(view);
    fr_plant_free(plant);
}

static void in_front(void) {
    // Two stems that cross in the view; the nearer (smaller y) is seen.
    FrPlant *plant = fr_plant_new("crossing");
    add_branch(plant, FR_NONE, 0, 1, 2);
    add_branch(plant, FR_NONE, 0, 1, 2);
    plant->axes.offset[0] = (vec3s){{0, 1, 0}};
    plant->axes.offset[1] = (vec3s){{-1, -1, 1}};
    plant->nodes.rotation[1] = fr_rotation_about((vec3s){{0, 1, 0}}, (float)G_PI_2);
    fr_plant_update_frames(plant, 0);
    FrContext context = fr_context_default();
    FrIdBuffer *view;
    g_assert_cmpint(fr_id_buffer_draw(plant, front_view(), 101, 101, 3, &context, &view), ==,
                    FR_OK);
    size_t crossing = (size_t)(100 - 42) * 101 + 50;
    g_assert_cmpuint(view->branch[crossing], ==, 1);
    g_assert_cmpuint(view->branch[crossing + 5 * 101], ==, 0);
    g_assert_cmpuint(view->branch[crossing + 5 * 101 + 5], ==, FR_NONE);
    fr_id_buffer_free(view);
    context.limits.pixels = 100;
    g_assert_cmpint(fr_id_buffer_draw(plant, front_view(), 101, 101, 3, &context, &view), ==,
                    FR_ERR_LIMIT);
    g_assert_null(view);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/variation/selection/A, B, C and D of figure 5", published_example);
    g_test_add_func("/variation/selection/lifting the pen keeps one path, or all as published",
                    ends);
    g_test_add_func("/variation/selection/what bears the path is not selected", never_upwards);
    g_test_add_func("/variation/selection/a path by its two ends", two_ends);
    g_test_add_func("/variation/selection/a pen moves over a view", by_pen);
    g_test_add_func("/variation/selection/what is in front is touched", in_front);
    return g_test_run();
}
