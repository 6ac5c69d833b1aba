// Tropisms as cpfg computes them: those of `tropism:` lines turn the heading by |H × V| radians
// before a move, the old one turns it by the sine of e·T·U after it.
#include "lsystem/turtle.h"

#include <math.h>

double fr_lvector_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void fr_lvector_cross(const double a[3], const double b[3], double out[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
}

void fr_lvector_unit(double v[3]) {
    double length = sqrt(fr_lvector_dot(v, v));
    if (length > 0) {
        for (int k = 0; k < 3; k++) {
            v[k] /= length;
        }
    }
}

void fr_lvector_rotate(double v[3], const double axis[3], double sine, double cosine) {
    double cross[3], dot = fr_lvector_dot(axis, v);
    fr_lvector_cross(axis, v, cross);
    for (int k = 0; k < 3; k++) {
        v[k] = v[k] * cosine + cross[k] * sine + axis[k] * dot * (1 - cosine);
    }
}

void fr_lturtle_untwist(FrLpose *pose) {
    double axis[3], up[3] = {pose->last_up[0], pose->last_up[1], pose->last_up[2]};
    fr_lvector_cross(pose->last_heading, pose->heading, axis);
    double sine = sqrt(fr_lvector_dot(axis, axis));
    double cosine = fr_lvector_dot(pose->last_heading, pose->heading);
    if (sine > 1e-12) {
        fr_lvector_unit(axis);
        fr_lvector_rotate(up, axis, sine, cosine);
    } else if (cosine < 0) {
        return; // turned round: any twist is as small as another
    }
    // Left = H × U in the turtle's left-handed axes.
    double along = fr_lvector_dot(up, pose->heading);
    for (int k = 0; k < 3; k++) {
        pose->up[k] = up[k] - along * pose->heading[k];
    }
    fr_lvector_unit(pose->up);
    fr_lvector_cross(pose->heading, pose->up, pose->left);
}

/// Adds the pull of one tropism to `sum`.
static void pull(const FrLpose *pose, const FrLtropism *tropism, double elasticity, double sum[3]) {
    double right[3], other[3];
    fr_lvector_cross(pose->heading, tropism->direction, right);
    double length = sqrt(fr_lvector_dot(right, right));
    const double *r = length > 1e-12 ? right : pose->left;
    fr_lvector_cross(tropism->direction, r, other);
    double cosine = cos(tropism->angle), sine = sin(tropism->angle) / (length > 1e-12 ? length : 1);
    for (int k = 0; k < 3; k++) {
        sum[k] += elasticity * (cosine * tropism->direction[k] + sine * other[k]);
    }
}

static void twist(FrLpose *pose, const double target[3]) {
    double along = fr_lvector_dot(target, pose->heading), flat[3], axis[3];
    for (int k = 0; k < 3; k++) {
        flat[k] = target[k] - along * pose->heading[k];
    }
    double length = sqrt(fr_lvector_dot(flat, flat));
    if (length < 1e-12) {
        return;
    }
    fr_lvector_cross(pose->up, flat, axis);
    double side = fr_lvector_dot(axis, pose->heading); // length · sin of the angle, with its sign
    double angle = CLAMP(side, -1, 1);
    fr_lvector_rotate(pose->up, pose->heading, sin(angle), cos(angle));
    fr_lvector_cross(pose->heading, pose->up, pose->left);
}

void fr_lturtle_bend(FrLturtle *turtle) {
    const GArray *tropisms = turtle->view->tropisms;
    FrLpose *pose = &turtle->pose;
    double sum[3] = {0, 0, 0}, torque[3] = {0, 0, 0};
    bool bends = false, twists = false;
    for (guint i = 0; i < MIN(tropisms->len, FR_LTROPISMS); i++) {
        const FrLtropism *tropism = &g_array_index(tropisms, FrLtropism, i);
        double e = pose->elasticities[i];
        if (tropism->is_torque) {
            for (int k = 0; k < 3; k++) {
                torque[k] += e * tropism->direction[k];
            }
            twists |= e != 0;
        } else if (e != 0) {
            pull(pose, tropism, e, sum);
            bends = true;
        }
    }
    if (bends) {
        double axis[3];
        fr_lvector_cross(pose->heading, sum, axis);
        double angle = sqrt(fr_lvector_dot(axis, axis));
        if (angle > 1e-12 && isfinite(angle)) {
            fr_lvector_unit(axis);
            angle = MIN(angle, 1);
            fr_lvector_rotate(pose->heading, axis, sin(angle), cos(angle));
            fr_lvector_unit(pose->heading);
        }
        fr_lturtle_untwist(pose);
    }
    if (twists) {
        twist(pose, torque);
    }
}

void fr_lturtle_bend_old(FrLturtle *turtle) {
    FrLpose *pose = &turtle->pose;
    if (pose->elasticity == 0) {
        return;
    }
    const double *direction = turtle->view->old_direction;
    double sine = CLAMP(pose->elasticity * fr_lvector_dot(direction, pose->up), -1, 1);
    fr_lturtle_turn(pose->heading, pose->up, sine, sqrt(1 - sine * sine));
    sine = CLAMP(pose->elasticity * fr_lvector_dot(direction, pose->left), -1, 1);
    fr_lturtle_turn(pose->heading, pose->left, sine, sqrt(1 - sine * sine));
}
