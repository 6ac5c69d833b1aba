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

/// Turns `up` as the least rotation turns one heading into another. False where they hardly differ.
static bool carry(const double from[3], const double to[3], double up[3]) {
    double axis[3];
    fr_lvector_cross(from, to, axis);
    double sine = sqrt(fr_lvector_dot(axis, axis)), cosine = fr_lvector_dot(from, to);
    if (sine <= 1e-6) {
        return false;
    }
    fr_lvector_unit(axis);
    sine = MIN(sine, 1);
    double other = sqrt(1 - sine * sine);
    fr_lvector_rotate(up, axis, sine, cosine < 0 ? -other : other);
    return true;
}

// A heading that has not changed keeps up as it is, rolls included.
void fr_lturtle_untwist(FrLpose *pose) {
    double up[3] = {pose->last_up[0], pose->last_up[1], pose->last_up[2]};
    if (carry(pose->last_heading, pose->heading, up)) {
        memcpy(pose->up, up, sizeof up);
    }
    // Left = H × U in the turtle's left-handed axes.
    fr_lvector_cross(pose->heading, pose->up, pose->left);
}

void fr_lpoint_untwist(FrLpoint *point, const FrLpoint *before, double roll) {
    double up[3] = {before->up[0], before->up[1], before->up[2]};
    carry(before->heading, point->heading, up);
    if (roll != 0) {
        fr_lvector_rotate(up, point->heading, -sin(roll), cos(roll));
    }
    memcpy(point->up, up, sizeof up);
    fr_lvector_cross(point->heading, point->up, point->left);
}

/// Adds the pull of one tropism to `sum`.
static void pull(const FrLpose *pose, const FrLtropism *tropism, double elasticity, double sum[3]) {
    double right[3], other[3];
    fr_lvector_cross(pose->heading, tropism->direction, right);
    double length = sqrt(fr_lvector_dot(right, right));
    const double *r = length >= 1e-7 ? right : pose->left;
    fr_lvector_cross(tropism->direction, r, other);
    double cosine = cos(tropism->angle), sine = sin(tropism->angle) / (length >= 1e-7 ? length : 1);
    for (int k = 0; k < 3; k++) {
        sum[k] += elasticity * (cosine * tropism->direction[k] + sine * other[k]);
    }
}

/// The angle that cpfg turns by about an axis of that length. It does not scale lengths above 1, so
/// that its quaternion is not of unit length there; hence the arc tangent.
static double angle_of(double length) {
    return length <= 1 ? length : 2 * atan2(sin(0.5) * length, cos(0.5));
}

// cpfg's quaternion turns up by the angle to the target, but away from it: both its quaternions are
// applied from the right, and only that of headings has the sign for it.
static void twist(FrLpose *pose, const double target[3]) {
    double unit[3] = {target[0], target[1], target[2]}, side[3], flat[3], axis[3];
    fr_lvector_unit(unit);
    fr_lvector_cross(pose->heading, unit, side);
    if (!(fr_lvector_dot(side, side) > 1e-8)) {
        return;
    }
    double length = sqrt(fr_lvector_dot(target, target));
    fr_lvector_cross(side, pose->heading, flat);
    for (int k = 0; k < 3; k++) {
        flat[k] *= length;
    }
    fr_lvector_cross(pose->up, flat, axis);
    double angle = angle_of(sqrt(fr_lvector_dot(axis, axis)));
    if (angle >= 1e-7 && isfinite(angle)) {
        fr_lvector_unit(axis);
        fr_lvector_rotate(pose->up, axis, -sin(angle), cos(angle));
        fr_lvector_cross(pose->heading, pose->up, pose->left);
    }
    memcpy(pose->last_heading, pose->heading, sizeof pose->last_heading);
    memcpy(pose->last_up, pose->up, sizeof pose->last_up);
}

/// Turns the heading about `axis` by its length.
static void bend(FrLpose *pose, double axis[3]) {
    double length = sqrt(fr_lvector_dot(axis, axis));
    if (!(length >= 1e-6) || !isfinite(length)) {
        return;
    }
    double angle = angle_of(length);
    fr_lvector_unit(axis);
    fr_lvector_rotate(pose->heading, axis, sin(angle), cos(angle));
    fr_lturtle_untwist(pose);
}

void fr_lturtle_bend(FrLturtle *turtle) {
    const GArray *tropisms = turtle->view->tropisms;
    FrLpose *pose = &turtle->pose;
    double sum[3] = {0, 0, 0}, torque[3] = {0, 0, 0}, axis[3];
    for (guint i = 0; i < MIN(tropisms->len, FR_LTROPISMS); i++) {
        const FrLtropism *tropism = &g_array_index(tropisms, FrLtropism, i);
        double e = pose->elasticities[i];
        if (tropism->is_torque) {
            for (int k = 0; k < 3; k++) {
                torque[k] += e * tropism->direction[k];
            }
        } else if (e != 0) {
            pull(pose, tropism, e, sum);
        }
    }
    fr_lvector_cross(pose->heading, sum, axis);
    bend(pose, axis);
    if (torque[0] != 0 || torque[1] != 0 || torque[2] != 0) {
        twist(pose, torque);
    }
}

void fr_lturtle_bend_old(FrLturtle *turtle) {
    FrLpose *pose = &turtle->pose;
    const double *direction = turtle->view->old_direction;
    double e = pose->elasticity;
    double sine = CLAMP(e * fr_lvector_dot(direction, pose->up), -1, 1);
    fr_lturtle_turn(pose->heading, pose->up, sine, sqrt(1 - sine * sine));
    sine = CLAMP(e * fr_lvector_dot(direction, pose->left), -1, 1);
    fr_lturtle_turn(pose->heading, pose->left, sine, sqrt(1 - sine * sine));
}
