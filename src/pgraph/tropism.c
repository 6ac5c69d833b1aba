#include "pgraph/tropism.h"

#include <cglm/struct.h>
#include <math.h>

#define PI 3.14159265358979323846

// Weaker than this in sum, the exponential and its limit cannot be told apart.
#define WEAK 1e-9
// A stem nearer to the vertical than this has no plane to turn in.
#define VERTICAL 1e-7

double fr_tropism_angle(FrTropism tropism, double angle, double step) {
    double sum = tropism.up + tropism.down + tropism.flat;
    double pull = tropism.down * PI + tropism.flat * (0.5 * PI);
    double turned;
    if (fabs(sum) < WEAK) {
        turned = angle + pull * step;
    } else {
        double rest = pull / sum;
        turned = rest + (angle - rest) * exp(-sum * step);
    }
    return turned < 0 ? 0 : turned > PI ? PI : turned;
}

versors fr_tropism_turn(FrTropism tropism, versors frame, double step) {
    vec3s heading = fr_frame_heading(frame);
    double x = (double)heading.x, y = (double)heading.y;
    double level = sqrt(x * x + y * y);
    double angle = atan2(level, (double)heading.z);
    float turn = (float)(fr_tropism_angle(tropism, angle, step) - angle);
    // About this axis the stem turns away from the vertical.
    vec3s axis = level > VERTICAL ? (vec3s){{(float)(-y / level), (float)(x / level), 0}}
                                  : fr_frame_left(frame);
    return fr_rotation_about(axis, turn);
}

versors fr_align_turn(double strength, vec3s to, versors frame) {
    vec3s heading = fr_frame_heading(frame);
    vec3s axis = glms_vec3_cross(heading, to);
    double sine = (double)glms_vec3_norm(axis);
    double angle = atan2(sine, (double)glms_vec3_dot(heading, to));
    double rest = fmin(angle * exp(-strength), PI);
    axis = sine > VERTICAL ? glms_vec3_divs(axis, (float)sine) : fr_frame_left(frame);
    return fr_rotation_about(axis, (float)(angle - rest));
}

versors fr_sag_turn(double strength, versors frame) {
    vec3s heading = fr_frame_heading(frame);
    double x = (double)heading.x, y = (double)heading.y;
    double level = sqrt(x * x + y * y);
    if (level < VERTICAL) {
        return (versors){{0, 0, 0, 1}};
    }
    double angle = atan2(level, (double)heading.z);
    double sagged = 2 * atan(tan(0.5 * angle) * exp(strength));
    vec3s axis = {{(float)(-y / level), (float)(x / level), 0}};
    return fr_rotation_about(axis, (float)(sagged - angle));
}
