// A part of a spline as a spline of its own, with clamped ends.
// Ramshaw. Blossoms are polar forms. Computer Aided Geometric Design 6(4), 1989: a control point is
// the blossom of a polynomial piece at the degree knots after its own; de Boor's algorithm with a
// parameter of its own in each round evaluates it. That is the same as inserting the ends of the
// range until they stand degree + 1 times (Boehm 1980), without what is cut off.
#include "frond/nurbs.h"

#include <string.h>

/// Knots nearer than this part of the range are one.
#define NEAR 1e-9

bool fr_nurbs_is_cut(const double *knots, uint32_t degree, uint32_t count, double range[2]) {
    double whole[2];
    fr_nurbs_range(knots, degree, count, whole);
    double near = NEAR * (whole[1] - whole[0]);
    range[0] = range[0] < whole[0] + near ? whole[0] : range[0];
    range[1] = range[1] > whole[1] - near ? whole[1] : range[1];
    bool is_clamped = !(knots[0] < whole[0]) && !(knots[count + degree] > whole[1]);
    return !is_clamped || range[0] > whole[0] || range[1] < whole[1];
}

uint32_t fr_nurbs_cut_knots(const double *knots, uint32_t degree, uint32_t count,
                            const double range[2], double *cut) {
    double near = NEAR * (knots[count] - knots[degree]);
    uint32_t made = 0;
    for (uint32_t i = 0; i <= degree; i++) {
        cut[made++] = range[0];
    }
    for (uint32_t i = 0; i < count + degree + 1; i++) {
        if (knots[i] > range[0] + near && knots[i] < range[1] - near) {
            cut[made++] = knots[i];
        }
    }
    for (uint32_t i = 0; i <= degree; i++) {
        cut[made++] = range[1];
    }
    return made - degree - 1;
}

/// The polynomial piece `span` of a spline, as its blossom at `degree` arguments.
static void blossom(const double *knots, uint32_t degree, uint32_t span, const double *arguments,
                    const double (*points)[4], size_t stride, double out[4]) {
    double work[FR_NURBS_DEGREE_MOST + 1][4];
    for (uint32_t r = 0; r <= degree; r++) {
        const double *point = points[(span - degree + r) * stride];
        for (int k = 0; k < 4; k++) {
            work[r][k] = k < 3 ? point[3] * point[k] : point[3];
        }
    }
    for (uint32_t round = 1; round <= degree; round++) {
        for (uint32_t r = degree; r >= round; r--) {
            double low = knots[span - degree + r], high = knots[span + 1 + r - round];
            double part = (arguments[round - 1] - low) / (high - low);
            for (int k = 0; k < 4; k++) {
                work[r][k] = (1.0 - part) * work[r - 1][k] + part * work[r][k];
            }
        }
    }
    for (int k = 0; k < 4; k++) {
        out[k] = k < 3 ? work[degree][k] / work[degree][3] : work[degree][3];
    }
}

void fr_nurbs_cut(const double *knots, uint32_t degree, uint32_t count, const double (*points)[4],
                  size_t stride, const double *cut, uint32_t cut_count, double (*cut_points)[4],
                  size_t cut_stride) {
    for (uint32_t i = 0; i < cut_count; i++) {
        uint32_t piece = i; // any that the control point acts on and that has a length
        while (piece < i + degree && !(cut[piece] < cut[piece + 1])) {
            piece++;
        }
        double middle = 0.5 * (cut[piece] + cut[piece + 1]);
        uint32_t span = fr_nurbs_span(knots, degree, count, middle);
        blossom(knots, degree, span, cut + i + 1, points, stride, cut_points[i * cut_stride]);
    }
}
