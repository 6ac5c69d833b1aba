// Frames and rotations.
#include "frond/random.h"
#include "frond/vector.h"

#include <cglm/struct.h>

#include <glib.h>
#include <math.h>

static vec3s random_direction(uint32_t k) {
    float height = (float)fr_random_signed(1, 0, k);
    float angle = (float)(2 * G_PI * fr_random(1, 1, k));
    float radius = sqrtf(1 - height * height);
    return (vec3s){{radius * cosf(angle), radius * sinf(angle), height}};
}

static void assert_near(vec3s a, vec3s b, double tolerance) {
    g_assert_cmpfloat_with_epsilon((double)a.x, (double)b.x, tolerance);
    g_assert_cmpfloat_with_epsilon((double)a.y, (double)b.y, tolerance);
    g_assert_cmpfloat_with_epsilon((double)a.z, (double)b.z, tolerance);
}

static void test_axes(void) {
    versors identity = {{0, 0, 0, 1}};
    assert_near(fr_frame_left(identity), (vec3s){{1, 0, 0}}, 1e-9);
    assert_near(fr_frame_up(identity), (vec3s){{0, 1, 0}}, 1e-9);
    assert_near(fr_frame_heading(identity), (vec3s){{0, 0, 1}}, 1e-9);
    // A quarter turn about x takes y to z and z to −y.
    versors turn = fr_rotation_about((vec3s){{1, 0, 0}}, (float)G_PI_2);
    assert_near(fr_frame_left(turn), (vec3s){{1, 0, 0}}, 1e-6);
    assert_near(fr_frame_up(turn), (vec3s){{0, 0, 1}}, 1e-6);
    assert_near(fr_frame_heading(turn), (vec3s){{0, -1, 0}}, 1e-6);
}

static void test_step_is_product(void) {
    for (uint32_t k = 0; k < 100; k++) {
        versors parent = fr_rotation_about(random_direction(2 * k), (float)k);
        versors local = fr_rotation_about(random_direction(2 * k + 1), 0.3f * (float)k);
        versors step = fr_frame_step(parent, local);
        versors product = glms_quat_mul(parent, local);
        for (int i = 0; i < 4; i++) {
            g_assert_cmpfloat_with_epsilon((double)step.raw[i], (double)product.raw[i], 1e-6);
        }
    }
}

static void test_step_stays_unit(void) {
    versors frame = {{0, 0, 0, 1}};
    versors local = fr_rotation_about(random_direction(3), 0.1f);
    for (int i = 0; i < 1000000; i++) {
        frame = fr_frame_step(frame, local);
    }
    g_assert_cmpfloat_with_epsilon((double)glms_quat_norm(frame), 1.0, 1e-6);
}

static void test_between(void) {
    for (uint32_t k = 0; k < 200; k++) {
        vec3s from = random_direction(k), to = random_direction(k + 1000);
        versors turn = fr_rotation_between(from, to);
        assert_near(glms_quat_rotatev(turn, from), to, 1e-5);
        // The smallest rotation is about an axis perpendicular to both.
        vec3s axis = {{turn.x, turn.y, turn.z}};
        g_assert_cmpfloat_with_epsilon((double)glms_vec3_dot(axis, from), 0, 1e-6);
    }
}

static void test_between_opposite(void) {
    for (uint32_t k = 0; k < 50; k++) {
        vec3s from = random_direction(k);
        versors turn = fr_rotation_between(from, glms_vec3_negate(from));
        g_assert_cmpfloat_with_epsilon((double)glms_quat_norm(turn), 1, 1e-6);
        assert_near(glms_quat_rotatev(turn, from), glms_vec3_negate(from), 1e-5);
        // And a hair beside opposite.
        for (float hair = 1e-2f; hair > 1e-9f; hair *= 0.1f) {
            vec3s beside = glms_vec3_sub(glms_vec3_scale(random_direction(k + 7), hair), from);
            beside = glms_vec3_normalize(beside);
            turn = fr_rotation_between(from, beside);
            assert_near(glms_quat_rotatev(turn, from), beside, 5e-6);
        }
    }
}

static void test_from_heading(void) {
    vec3s up = {{0, 0, 1}};
    for (uint32_t k = 0; k < 200; k++) {
        vec3s heading = random_direction(k);
        versors frame = fr_frame_from_heading(heading, up);
        assert_near(fr_frame_heading(frame), heading, 1e-5);
        // x is level and y leans towards up.
        g_assert_cmpfloat_with_epsilon((double)fr_frame_left(frame).z, 0, 1e-5);
        g_assert_cmpfloat((double)fr_frame_up(frame).z, >=, -1e-6);
    }
    versors straight_up = fr_frame_from_heading(up, up);
    assert_near(fr_frame_heading(straight_up), up, 1e-6);
    g_assert_cmpfloat_with_epsilon((double)glms_quat_norm(straight_up), 1, 1e-6);
    versors straight_down = fr_frame_from_heading(glms_vec3_negate(up), up);
    assert_near(fr_frame_heading(straight_down), glms_vec3_negate(up), 1e-6);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/rotation/left up and heading are the x y and z axes", test_axes);
    g_test_add_func("/math/rotation/a frame step is the quaternion product", test_step_is_product);
    g_test_add_func("/math/rotation/a million steps keep the frame a unit", test_step_stays_unit);
    g_test_add_func("/math/rotation/the smallest rotation takes one direction to the other",
                    test_between);
    g_test_add_func("/math/rotation/opposite directions have a half turn between them",
                    test_between_opposite);
    g_test_add_func("/math/rotation/a frame from a heading keeps x level", test_from_heading);
    return g_test_run();
}
