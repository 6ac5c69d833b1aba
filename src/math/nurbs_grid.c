// Rational surfaces as grids of points, as fine as their curvature and size ask for.
//
// A chord of an arc of length l that turns by t is at most l·t/8 away from it; of n equal parts each
// is l·t/(8n²) away. So a piece between knots is cut into n ≥ √(l·t / (8·tolerance)) steps, and so
// many that none turns by more than wanted. Four corners that are not in a plane leave a quarter of
// their twist. Farin. Curves and Surfaces for CAGD. 5th edition, sections 4.3 and 14.
#include "frond/nurbs.h"

#include <glib.h>

#include <math.h>
#include <string.h>

enum { SAMPLES = 5, LINES_MOST = 9, STEPS_MOST = FR_NURBS_STEPS_MOST, ROOM = 32 };
/// No step turns more, however small it is: a ring keeps three sides.
#define TURN_MOST 2.2

uint32_t fr_nurbs_pieces(const double *knots, uint32_t degree, uint32_t count) {
    uint32_t pieces = 0;
    for (uint32_t i = degree; i < count; i++) {
        pieces += knots[i + 1] > knots[i];
    }
    return pieces;
}

static void point_at(const FrNurbsSurface *s, bool is_u, double at, double other, double point[3],
                     double slope[3]) {
    if (is_u) {
        fr_nurbs_surface_at(s, at, other, point, slope, NULL);
    } else {
        fr_nurbs_surface_at(s, other, at, point, NULL, slope);
    }
}

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double angle_between(const double a[3], const double b[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    double z = a[0] * b[1] - a[1] * b[0], dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return atan2(sqrt(x * x + y * y + z * z), dot);
}

/// Steps that one line needs from `a` to `b`.
static double line_steps(const FrNurbsSurface *s, bool is_u, double a, double b, double other,
                         const FrNurbsFineness *fineness) {
    double before[3], before_slope[3], length = 0.0, turn = 0.0, fastest = 0.0, mean = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        double point[3], slope[3];
        double at = i == SAMPLES - 1 ? b - 1e-9 * (b - a) : a + (b - a) * i / (SAMPLES - 1);
        point_at(s, is_u, at, other, point, slope);
        double speed = length_of(slope);
        fastest = fmax(fastest, speed);
        mean += speed / SAMPLES;
        if (i > 0) {
            double step[3] = {point[0] - before[0], point[1] - before[1], point[2] - before[2]};
            length += length_of(step);
            turn += angle_between(before_slope, slope);
        }
        memcpy(before, point, sizeof before);
        memcpy(before_slope, slope, sizeof before_slope);
    }
    double uneven = mean > 0.0 ? fastest / mean : 1.0;
    // A curve that bends little in its samples may bend more between them.
    double by_size = sqrt(1.1 * length * turn / (8.0 * 0.4 * fineness->tolerance));
    double by_turn = fmin(turn / fineness->turn, 2.0 * by_size);
    return fmax(turn / TURN_MOST, uneven * fmax(by_size, by_turn));
}

static uint32_t distinct_knots(const double *knots, uint32_t degree, uint32_t count, double *at) {
    uint32_t length = 0;
    at[length++] = knots[degree];
    for (uint32_t i = degree; i < count; i++) {
        if (knots[i + 1] > knots[i]) {
            at[length++] = knots[i + 1];
        }
    }
    return length;
}

static void bend_steps(const FrNurbsSurface *s, bool is_u, const double *at, uint32_t pieces,
                       const double *other, uint32_t lines, const FrNurbsFineness *fineness,
                       uint8_t *steps) {
    uint32_t degree = is_u ? s->degree_u : s->degree_v;
    uint32_t stride = (lines + LINES_MOST - 1) / LINES_MOST;
    for (uint32_t i = 0; i < pieces; i++) {
        double most = 1.0;
        for (uint32_t k = 0; k < lines && degree > 1; k += stride) {
            most = fmax(most, line_steps(s, is_u, at[i], at[i + 1], other[k], fineness));
        }
        steps[i] = (uint8_t)fmin(ceil(most), STEPS_MOST);
    }
}

/// More steps both ways where the corners of a cell are not in a plane.
static void twist_steps(const FrNurbsSurface *s, const double *u, uint32_t pieces_u,
                        const double *v, uint32_t pieces_v, double tolerance, uint8_t *steps_u,
                        uint8_t *steps_v) {
    for (uint32_t j = 0; j < pieces_v; j++) {
        double left[2][3], right[2][3];
        fr_nurbs_surface_at(s, u[0], v[j], left[0], NULL, NULL);
        fr_nurbs_surface_at(s, u[0], v[j + 1], left[1], NULL, NULL);
        for (uint32_t i = 0; i < pieces_u; i++) {
            fr_nurbs_surface_at(s, u[i + 1], v[j], right[0], NULL, NULL);
            fr_nurbs_surface_at(s, u[i + 1], v[j + 1], right[1], NULL, NULL);
            double twist[3];
            for (int k = 0; k < 3; k++) {
                twist[k] = right[1][k] - right[0][k] - left[1][k] + left[0][k];
            }
            double cells = (double)steps_u[i] * steps_v[j];
            double more = sqrt(length_of(twist) / (4.0 * 0.2 * tolerance * cells));
            if (more > 1.0) {
                steps_u[i] = (uint8_t)fmin(ceil(more * steps_u[i]), STEPS_MOST);
                steps_v[j] = (uint8_t)fmin(ceil(more * steps_v[j]), STEPS_MOST);
            }
            memcpy(left, right, sizeof left);
        }
    }
}

void fr_nurbs_steps(const FrNurbsSurface *surface, const FrNurbsFineness *fineness,
                    uint8_t *steps_u, uint8_t *steps_v) {
    const FrNurbsSurface *s = surface;
    double few[2][ROOM], *u = few[0], *v = few[1], *many = NULL;
    if (s->count_u + 2 > ROOM || s->count_v + 2 > ROOM) {
        many = g_new(double, (size_t)s->count_u + s->count_v + 4);
        u = many;
        v = many + s->count_u + 2;
    }
    uint32_t lines_u = distinct_knots(s->knots_u, s->degree_u, s->count_u, u);
    uint32_t lines_v = distinct_knots(s->knots_v, s->degree_v, s->count_v, v);
    bend_steps(surface, true, u, lines_u - 1, v, lines_v, fineness, steps_u);
    bend_steps(surface, false, v, lines_v - 1, u, lines_u, fineness, steps_v);
    twist_steps(surface, u, lines_u - 1, v, lines_v - 1, fineness->tolerance, steps_u, steps_v);
    g_free(many);
}

uint32_t fr_nurbs_parameters(const double *knots, uint32_t degree, uint32_t count,
                             const uint8_t *steps, double *at) {
    uint32_t length = 0, piece = 0;
    for (uint32_t i = degree; i < count; i++) {
        double width = knots[i + 1] - knots[i];
        for (uint32_t k = 0; width > 0.0 && k < steps[piece]; k++) {
            at[length++] = knots[i] + width * k / steps[piece];
        }
        piece += width > 0.0;
    }
    at[length++] = knots[count];
    return length;
}
