// Rational surfaces as grids of points, as fine as their curvature and size ask for.
//
// A chord of an arc of length l that turns by t is at most l·t/8 away from it; of n equal parts
// each is l·t/(8n²) away. So a piece between knots wants √(l·t / (8·tolerance)) steps, and so many
// that none turns by more than is wanted. Lengths and turns are those of the control polygons, each
// spread over the knots its points depend on: no curve turns more than its control polygon (Piegl,
// Tiller, The NURBS Book, section 3.2). Pieces that want less than a step together are cut once.
// Four corners that are not in a plane leave a quarter of their twist.
#include "frond/nurbs.h"

#include <glib.h>

#include <math.h>
#include <string.h>

enum { STEPS_MOST = FR_NURBS_STEPS_MOST, ROOM = 48 };
/// No step turns more, however small it is: a ring keeps three sides.
#define TURN_MOST 2.2
/// Part of the tolerance for the bends of either way; the rest is for the twist.
#define BEND_SHARE 0.4
#define TWIST_SHARE 0.2

uint32_t fr_nurbs_pieces(const double *knots, uint32_t degree, uint32_t count) {
    uint32_t pieces = 0;
    for (uint32_t i = degree; i < count; i++) {
        pieces += knots[i + 1] > knots[i];
    }
    return pieces;
}

/// One way of a surface: its knots, and its control polygons.
typedef struct FrWay {
    const double *knots;
    uint32_t degree, count, lines;
    const double (*points)[4];
    size_t stride, line_stride;
} FrWay;

/// What the pieces of a way want. `lines` are the parameters between them, one more.
typedef struct FrWants {
    double *length, *turn, *steps, *lines;
    uint32_t pieces;
} FrWants;

/// Adds an amount to the pieces from `a` to `b`, by their widths.
static void spread(const FrWants *wants, double a, double b, double amount, double *to) {
    uint32_t i = 0;
    while (i + 1 < wants->pieces && wants->lines[i + 1] <= a) {
        i++;
    }
    for (; i < wants->pieces && wants->lines[i] < b; i++) {
        double low = fmax(a, wants->lines[i]), high = fmin(b, wants->lines[i + 1]);
        to[i] += amount * fmax(high - low, 0.0) / (b - a);
    }
}

/// The angle whose chord of the unit circle is that long, a little rounded.
static double angle_of(double chord) {
    double square = chord * chord;
    return chord * (1.0 + square / 24.0 + 3.0 * square * square / 640.0) *
           (square > 2.0 ? 1.2 : 1.0);
}

static void follow_line(const FrWay *way, const FrWants *wants, const double (*points)[4]) {
    double before[3] = {0}, range[2];
    bool has_before = false;
    fr_nurbs_range(way->knots, way->degree, way->count, range);
    for (uint32_t k = 0; k + 1 < way->count; k++) {
        const double *p = points[k * way->stride], *q = points[(k + 1) * way->stride];
        double leg[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
        double length = sqrt(leg[0] * leg[0] + leg[1] * leg[1] + leg[2] * leg[2]);
        if (!(length > 0.0)) {
            continue;
        }
        double first = fmax(way->knots[k + 1], range[0]);
        double last = fmin(way->knots[k + way->degree + 1], range[1]);
        if (last > first) {
            spread(wants, first, last, length, wants->length);
        }
        double chord = 0.0;
        for (int d = 0; d < 3; d++) {
            leg[d] /= length;
            chord += (leg[d] - before[d]) * (leg[d] - before[d]);
        }
        last = fmin(way->knots[k + way->degree], range[1]); // of the corner between the legs
        if (has_before && last > first) {
            spread(wants, first, last, angle_of(sqrt(chord)), wants->turn);
        }
        memcpy(before, leg, sizeof before);
        has_before = true;
    }
}

static void want_steps(const FrWay *way, FrWants *wants, const FrNurbsFineness *fineness) {
    for (uint32_t line = 0; line < way->lines; line++) {
        for (uint32_t i = 0; i < wants->pieces; i++) {
            wants->length[i] = wants->turn[i] = 0.0;
        }
        follow_line(way, wants, way->points + line * way->line_stride);
        for (uint32_t i = 0; i < wants->pieces; i++) {
            double turn = wants->turn[i];
            double by_size =
                sqrt(1.2 * wants->length[i] * turn / (8.0 * BEND_SHARE * fineness->tolerance));
            double by_turn = fmin(turn / fineness->turn, 1.5 * by_size);
            double most = fmax(turn / TURN_MOST, fmax(by_size, by_turn));
            wants->steps[i] = fmax(wants->steps[i], most);
        }
    }
}

static bool is_corner(const FrWay *way, double knot) {
    uint32_t times = 0;
    for (uint32_t i = 0; i < way->count + way->degree + 1; i++) {
        times += way->knots[i] >= knot && way->knots[i] <= knot;
    }
    return times >= way->degree;
}

/// Joins pieces that together want less than a step, but not over corners. A joined piece has no
/// steps of its own; its lines are taken out.
static uint32_t join_pieces(const FrWay *way, FrWants *wants, uint8_t *steps) {
    uint32_t groups = 0;
    double left = 0.0; // of the last step, not wanted yet
    for (uint32_t i = 0; i < wants->pieces; i++) {
        double wanted = wants->steps[i], begin = wants->lines[i];
        if (i > 0 && wanted <= left && !is_corner(way, begin)) {
            steps[i] = 0;
            left -= wanted;
        } else {
            steps[i] = (uint8_t)CLAMP(ceil(wanted), 1.0, STEPS_MOST);
            left = steps[i] == 1 ? 1.0 - wanted : 0.0;
            wants->lines[groups++] = begin;
        }
    }
    wants->lines[groups] = wants->lines[wants->pieces];
    return groups;
}

static uint32_t find_lines(const FrWay *way, double *lines) {
    uint32_t length = 0;
    lines[length++] = way->knots[way->degree];
    for (uint32_t i = way->degree; i < way->count; i++) {
        if (way->knots[i + 1] > way->knots[i]) {
            lines[length++] = way->knots[i + 1];
        }
    }
    return length - 1;
}

/// How far the corners of a cell are from a plane: the part of their twist across it.
static double twist_of(const FrNurbsSurface *s, double u0, double u1, double v0, double v1) {
    double a[3], b[3], c[3], d[3], sum = 0.0;
    fr_nurbs_surface_at(s, u0, v0, a, NULL, NULL);
    fr_nurbs_surface_at(s, u1, v0, b, NULL, NULL);
    fr_nurbs_surface_at(s, u0, v1, c, NULL, NULL);
    fr_nurbs_surface_at(s, u1, v1, d, NULL, NULL);
    double one[3], other[3], length = 0.0;
    for (int k = 0; k < 3; k++) {
        one[k] = d[k] - a[k];
        other[k] = c[k] - b[k];
    }
    for (int k = 0; k < 3; k++) { // across both diagonals
        int m = (k + 1) % 3, n = (k + 2) % 3;
        double across = one[m] * other[n] - one[n] * other[m];
        sum += across * (d[k] - c[k] - b[k] + a[k]);
        length += across * across;
    }
    return length > 0.0 ? fabs(sum) / sqrt(length) : 0.0;
}

/// The n-th piece that has steps.
static uint32_t with_steps(const uint8_t *steps, uint32_t n) {
    uint32_t i = 0;
    for (n++; (n -= steps[i] > 0) > 0; i++) {
    }
    return i;
}

/// More steps both ways where the corners of a cell are not in a plane.
static void untwist(const FrNurbsSurface *s, const FrWants *u, uint32_t groups_u, uint8_t *steps_u,
                    const FrWants *v, uint32_t groups_v, uint8_t *steps_v, double tolerance) {
    for (uint32_t n = 0; n < groups_u * groups_v; n++) {
        uint32_t i = n % groups_u, j = n / groups_u;
        double twist = twist_of(s, u->lines[i], u->lines[i + 1], v->lines[j], v->lines[j + 1]);
        uint8_t *a = &steps_u[with_steps(steps_u, i)], *b = &steps_v[with_steps(steps_v, j)];
        double more = sqrt(twist / (4.0 * TWIST_SHARE * tolerance * *a * *b));
        if (more > 1.0) {
            *a = (uint8_t)fmin(ceil(more * *a), STEPS_MOST);
            *b = (uint8_t)fmin(ceil(more * *b), STEPS_MOST);
        }
    }
}

static void take_room(FrWants *wants, double *room, uint32_t width) {
    wants->length = room;
    wants->turn = room + width;
    wants->steps = room + 2 * (size_t)width;
    wants->lines = room + 3 * (size_t)width;
}

void fr_nurbs_steps(const FrNurbsSurface *surface, const FrNurbsFineness *fineness,
                    uint8_t *steps_u, uint8_t *steps_v) {
    const FrNurbsSurface *s = surface;
    const FrWay ways[2] = {
        {s->knots_u, s->degree_u, s->count_u, s->count_v, s->points, 1, s->count_u},
        {s->knots_v, s->degree_v, s->count_v, s->count_u, s->points, s->count_u, 1}};
    double few[8 * ROOM] = {0}, *room = few;
    uint32_t width = MAX(s->count_u, s->count_v) + 2;
    if (width > ROOM) {
        room = g_new0(double, 8 * (size_t)width);
    }
    FrWants wants[2];
    uint8_t *steps[2] = {steps_u, steps_v};
    uint32_t groups[2];
    for (int w = 0; w < 2; w++) {
        take_room(&wants[w], room + 4 * (size_t)width * (size_t)w, width);
        wants[w].pieces = find_lines(&ways[w], wants[w].lines);
        if (ways[w].degree > 1) {
            want_steps(&ways[w], &wants[w], fineness);
        }
        groups[w] = join_pieces(&ways[w], &wants[w], steps[w]);
    }
    untwist(s, &wants[0], groups[0], steps_u, &wants[1], groups[1], steps_v, fineness->tolerance);
    if (room != few) {
        g_free(room);
    }
}

uint32_t fr_nurbs_parameters(const double *knots, uint32_t degree, uint32_t count,
                             const uint8_t *steps, double *at) {
    uint32_t length = 0, piece = 0, cells = 0;
    double begin = knots[degree];
    for (uint32_t i = degree; i <= count; i++) {
        bool is_end = i == count;
        if (!is_end && !(knots[i + 1] > knots[i])) {
            continue;
        }
        if (is_end || steps[piece] > 0) {
            for (uint32_t k = 0; k < cells; k++) {
                at[length++] = begin + (knots[i] - begin) * k / cells;
            }
            begin = knots[i];
            cells = is_end ? 0 : steps[piece];
        }
        piece++;
    }
    at[length++] = knots[count];
    return length;
}
