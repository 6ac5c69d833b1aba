// Rotation-minimizing frames against what is known of helices and plane curves.
#include "frond/curve.h"

#include <cglm/struct.h>

#include <glib.h>
#include <math.h>

// A helix of radius a and pitch 2πb, at angle u.
static vec3s helix(double a, double b, double u) {
    return (vec3s){{(float)(a * cos(u)), (float)(a * sin(u)), (float)(b * u)}};
}

static vec3s helix_tangent(double a, double b, double u) {
    double c = hypot(a, b);
    return (vec3s){
        {(float)(-a / c * sin(u)), (float)(a / c * cos(u)), (float)(b / c)},
    };
}

// Angle from the helix' principal normal (towards its axis) to the frame's x axis about the
// tangent.
static double angle_to_normal(versors frame, double u) {
    vec3s normal = {{(float)-cos(u), (float)-sin(u), 0}};
    vec3s binormal = glms_vec3_cross(fr_frame_heading(frame), normal);
    vec3s left = fr_frame_left(frame);
    return atan2((double)glms_vec3_dot(left, binormal), (double)glms_vec3_dot(left, normal));
}

// The Frenet frame turns about the tangent by the torsion, b/(a² + b²) per metre; one that does
// not turn falls back behind it by that.
static void test_helix(void) {
    const double a = 1, b = 0.5, turns = 2 * G_PI;
    const int steps = 200;
    versors frame = fr_frame_from_heading(helix_tangent(a, b, 0), (vec3s){{0, 0, 1}});
    double before = angle_to_normal(frame, 0);
    for (int i = 1; i <= steps; i++) {
        double u0 = turns * (i - 1) / steps, u1 = turns * i / steps;
        frame =
            fr_frame_transport(frame, helix(a, b, u0), helix(a, b, u1), helix_tangent(a, b, u1));
    }
    double length = turns * hypot(a, b);
    double expected = before - length * b / (a * a + b * b);
    double error = remainder(angle_to_normal(frame, turns) - expected, 2 * G_PI);
    g_assert_cmpfloat(fabs(error), <, 1e-4);
}

static void test_plane(void) {
    versors frame = fr_frame_from_heading((vec3s){{0, 1, 0}}, (vec3s){{0, 0, 1}});
    vec3s up = fr_frame_up(frame);
    for (int i = 0; i < 64; i++) {
        double u0 = 2 * G_PI * i / 64, u1 = 2 * G_PI * (i + 1) / 64;
        frame =
            fr_frame_transport(frame, helix(1, 0, u0), helix(1, 0, u1), helix_tangent(1, 0, u1));
        g_assert_cmpfloat((double)glms_vec3_distance(fr_frame_up(frame), up), <, 1e-4);
        g_assert_cmpfloat(
            (double)glms_vec3_distance(fr_frame_heading(frame), helix_tangent(1, 0, u1)), <, 1e-4);
    }
}

static void test_straight(void) {
    versors frame = fr_rotation_about((vec3s){{0, 0, 1}}, 0.7f);
    versors after =
        fr_frame_transport(frame, (vec3s){{0, 0, 0}}, (vec3s){{0, 0, 3}}, (vec3s){{0, 0, 1}});
    g_assert_cmpfloat((double)glms_vec3_distance(fr_frame_left(frame), fr_frame_left(after)), <,
                      1e-6);
}

static void test_degenerate(void) {
    versors frame = {{0, 0, 0, 1}};
    vec3s here = {{1, 2, 3}}, side = {{2, 2, 3}};
    // The points coincide: only the direction changes.
    versors turned = fr_frame_transport(frame, here, here, (vec3s){{1, 0, 0}});
    g_assert_cmpfloat((double)glms_vec3_distance(fr_frame_heading(turned), (vec3s){{1, 0, 0}}), <,
                      1e-6);
    // Sideways, perpendicular to the tangent: nothing turns.
    versors moved = fr_frame_transport(frame, here, side, (vec3s){{0, 0, 1}});
    g_assert_cmpfloat((double)glms_vec3_distance(fr_frame_left(moved), (vec3s){{1, 0, 0}}), <,
                      1e-6);
    g_assert_cmpfloat((double)glms_vec3_distance(fr_frame_heading(moved), (vec3s){{0, 0, 1}}), <,
                      1e-6);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/math/frames/along a helix the frame falls behind by the torsion", test_helix);
    g_test_add_func("/math/frames/around a circle the axis normal to its plane stays", test_plane);
    g_test_add_func("/math/frames/along a line the frame does not turn", test_straight);
    g_test_add_func("/math/frames/coinciding points and sideways steps are defined",
                    test_degenerate);
    return g_test_run();
}
