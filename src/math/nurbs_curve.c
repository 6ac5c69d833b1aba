// Making rational B-spline curves: circles, polygons, common knots, interpolation.
// Piegl, Tiller. The NURBS Book. 2nd edition, Springer 1997: section 7.5 (circles), equation 9.8
// (averaged knots), section 9.2.1 (interpolation). Boehm. Inserting new knots into B-spline
// curves. Computer-Aided Design 12, 1980.
#include "frond/nurbs.h"

#include <glib.h>

#include <math.h>
#include <string.h>

#define ROOT3 1.7320508075688772
#define HALF_ROOT2 0.70710678118654752

/// A circle as it is published.
typedef struct FrCircleTable {
    uint32_t degree, count;
    double points[9][3]; ///< x, y, weight
    double knots[13];
} FrCircleTable;

static const FrCircleTable circles[] = {
    [FR_CIRCLE_TRIANGLE] = {2,
                            7,
                            {{0, -1, 1},
                             {ROOT3, -1, 0.5},
                             {ROOT3 / 2, 0.5, 1},
                             {0, 2, 0.5},
                             {-ROOT3 / 2, 0.5, 1},
                             {-ROOT3, -1, 0.5},
                             {0, -1, 1}},
                            {0, 0, 0, 1.0 / 3, 1.0 / 3, 2.0 / 3, 2.0 / 3, 1, 1, 1}},
    [FR_CIRCLE_SQUARE] =
        {2,
         7,
         {{1, 0, 1}, {1, 1, 0.5}, {-1, 1, 0.5}, {-1, 0, 1}, {-1, -1, 0.5}, {1, -1, 0.5}, {1, 0, 1}},
         {0, 0, 0, 0.25, 0.5, 0.5, 0.75, 1, 1, 1}},
    [FR_CIRCLE_NINE] = {2,
                        9,
                        {{1, 0, 1},
                         {1, 1, HALF_ROOT2},
                         {0, 1, 1},
                         {-1, 1, HALF_ROOT2},
                         {-1, 0, 1},
                         {-1, -1, HALF_ROOT2},
                         {0, -1, 1},
                         {1, -1, HALF_ROOT2},
                         {1, 0, 1}},
                        {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}},
    [FR_CIRCLE_CUBIC] = {3,
                         7,
                         {{1, 0, 1},
                          {1, 2, 1.0 / 3},
                          {-1, 2, 1.0 / 3},
                          {-1, 0, 1},
                          {-1, -2, 1.0 / 3},
                          {1, -2, 1.0 / 3},
                          {1, 0, 1}},
                         {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}},
};

static FrNurbsCurve allocate(uint32_t degree, uint32_t count) {
    FrNurbsCurve curve = {.degree = degree, .count = count};
    curve.knots = g_new(double, (size_t)count + degree + 1);
    curve.points = g_malloc_n(count, sizeof *curve.points);
    return curve;
}

void fr_nurbs_curve_clear(FrNurbsCurve *curve) {
    g_clear_pointer(&curve->knots, g_free);
    g_clear_pointer(&curve->points, g_free);
    curve->count = 0;
}

FrNurbsCurve fr_nurbs_curve_copy(const FrNurbsCurve *curve) {
    FrNurbsCurve copy = allocate(curve->degree, curve->count);
    memcpy(copy.knots, curve->knots, sizeof(double) * ((size_t)curve->count + curve->degree + 1));
    memcpy(copy.points, curve->points, sizeof *copy.points * curve->count);
    return copy;
}

FrNurbsCurve fr_nurbs_circle(FrNurbsCircle form) {
    const FrCircleTable *table = &circles[form];
    FrNurbsCurve circle = allocate(table->degree, table->count);
    memcpy(circle.knots, table->knots, sizeof(double) * (table->count + table->degree + 1));
    for (uint32_t i = 0; i < table->count; i++) {
        const double *point = table->points[i];
        double control[4] = {point[0], point[1], 0.0, point[2]};
        memcpy(circle.points[i], control, sizeof control);
    }
    return circle;
}

/// Inserts a knot as often as it takes to be there `degree` times.
static void saturate(FrNurbsCurve *curve, double knot) {
    uint32_t times = 0;
    for (uint32_t i = 0; i < curve->count + curve->degree + 1; i++) {
        times += fabs(curve->knots[i] - knot) < 1e-12;
    }
    for (; times < curve->degree; times++) {
        fr_nurbs_curve_insert(curve, knot);
    }
}

// A closed uniform spline repeats its first points at its end. Clamping makes its ends points.
static FrNurbsCurve closed_spline(const double (*points)[2], uint32_t count, uint32_t degree) {
    FrNurbsCurve loop = allocate(degree, count + degree);
    for (uint32_t i = 0; i < loop.count; i++) {
        const double *point = points[i % count];
        double control[4] = {point[0], point[1], 0.0, 1.0};
        memcpy(loop.points[i], control, sizeof control);
    }
    for (uint32_t i = 0; i < loop.count + degree + 1; i++) {
        loop.knots[i] = ((double)i - degree) / count;
    }
    saturate(&loop, 0.0);
    saturate(&loop, 1.0);
    uint32_t first = 0; // of the knots that are 0
    while (fabs(loop.knots[first]) > 1e-12) {
        first++;
    }
    FrNurbsCurve curve = allocate(degree, count + degree);
    memcpy(curve.points, loop.points + (first > 0 ? first - 1 : 0),
           sizeof *curve.points * curve.count);
    for (uint32_t i = 0; i < curve.count + degree + 1; i++) {
        bool is_start = i <= degree, is_end = i >= curve.count;
        curve.knots[i] = is_start ? 0.0 : is_end ? 1.0 : (double)(i - degree) / count;
    }
    memcpy(curve.points[curve.count - 1], curve.points[0], sizeof *curve.points);
    fr_nurbs_curve_clear(&loop);
    return curve;
}

FrNurbsCurve fr_nurbs_from_polygon(const double (*points)[2], uint32_t count, bool is_closed,
                                   uint32_t degree) {
    if (is_closed) {
        return closed_spline(points, count, degree);
    }
    degree = MIN(degree, count - 1);
    FrNurbsCurve curve = allocate(degree, count);
    uint32_t pieces = count - degree;
    for (uint32_t i = 0; i < count; i++) {
        double control[4] = {points[i][0], points[i][1], 0.0, 1.0};
        memcpy(curve.points[i], control, sizeof control);
    }
    for (uint32_t i = 0; i < count + degree + 1; i++) {
        uint32_t step = i > degree ? MIN(i - degree, pieces) : 0;
        curve.knots[i] = (double)step / pieces;
    }
    return curve;
}

void fr_nurbs_curve_insert(FrNurbsCurve *curve, double knot) {
    uint32_t p = curve->degree, span = fr_nurbs_span(curve->knots, p, curve->count, knot);
    FrNurbsCurve finer = allocate(p, curve->count + 1);
    for (uint32_t i = 0; i < finer.count; i++) {
        uint32_t before = i > 0 ? i - 1 : 0, after = MIN(i, curve->count - 1);
        double part = i + p <= span ? 1.0 : i > span ? 0.0 : -1.0;
        if (part < 0.0) {
            double width = curve->knots[i + p] - curve->knots[i];
            part = width > 0.0 ? (knot - curve->knots[i]) / width : 0.0;
        }
        const double *a = curve->points[before], *b = curve->points[after];
        double weight = (1.0 - part) * a[3] + part * b[3];
        for (int k = 0; k < 3; k++) {
            finer.points[i][k] = ((1.0 - part) * a[3] * a[k] + part * b[3] * b[k]) / weight;
        }
        finer.points[i][3] = weight;
    }
    for (uint32_t i = 0; i < finer.count + p + 1; i++) {
        finer.knots[i] = i <= span ? curve->knots[i] : i == span + 1 ? knot : curve->knots[i - 1];
    }
    fr_nurbs_curve_clear(curve);
    *curve = finer;
}

// Inserts into `curve` what inner knots of `other` it lacks.
static void adopt_knots(FrNurbsCurve *curve, const FrNurbsCurve *other) {
    uint32_t p = curve->degree, own = p + 1;
    for (uint32_t i = p + 1; i < other->count; i++) {
        double knot = other->knots[i];
        while (own < curve->count && curve->knots[own] < knot - 1e-12) {
            own++;
        }
        if (own >= curve->count || curve->knots[own] > knot + 1e-12) {
            fr_nurbs_curve_insert(curve, knot);
        }
        own++;
    }
}

void fr_nurbs_curves_merge(FrNurbsCurve *a, FrNurbsCurve *b) {
    adopt_knots(a, b);
    adopt_knots(b, a);
}

void fr_nurbs_average_knots(const double *at, uint32_t count, uint32_t degree, double *knots) {
    for (uint32_t i = 0; i <= degree; i++) {
        knots[i] = at[0];
        knots[count + i] = at[count - 1];
    }
    for (uint32_t j = 1; j + degree < count; j++) {
        double sum = 0.0;
        for (uint32_t i = j; i < j + degree; i++) {
            sum += at[i];
        }
        knots[j + degree] = sum / degree;
    }
}

// The matrix of basis functions is totally positive, so elimination needs no pivots (de Boor, A
// Practical Guide to Splines, chapter XIII), and banded, so it takes linear time.
void fr_nurbs_interpolate(const double *knots, uint32_t degree, const double *at, uint32_t count,
                          double *values, uint32_t dimensions, uint32_t stride) {
    uint32_t band = 2 * degree + 1;
    double *matrix = g_new0(double, (size_t)count *band); // column k of row i at k − i + degree
    for (uint32_t i = 0; i < count; i++) {
        double basis[FR_NURBS_DEGREE_MOST + 1];
        uint32_t span = fr_nurbs_span(knots, degree, count, at[i]);
        fr_nurbs_basis(knots, degree, span, at[i], basis, NULL);
        for (uint32_t r = 0; r <= degree; r++) {
            uint32_t place = span + r - i; // (span − degree + r) − i + degree
            if (place < band) {
                matrix[(size_t)i * band + place] = basis[r];
            }
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        const double *pivot = matrix + (size_t)i * band;
        for (uint32_t k = i + 1; k < count && k <= i + degree; k++) {
            double *row = matrix + (size_t)k * band;
            double factor = row[i + degree - k] / pivot[degree];
            for (uint32_t c = i; factor != 0.0 && c < count && c <= i + degree; c++) {
                row[c + degree - k] -= factor * pivot[c + degree - i];
            }
            for (uint32_t d = 0; d < dimensions; d++) {
                values[(size_t)k * stride + d] -= factor * values[(size_t)i * stride + d];
            }
        }
    }
    for (uint32_t i = count; i-- > 0;) {
        const double *row = matrix + (size_t)i * band;
        for (uint32_t d = 0; d < dimensions; d++) {
            double sum = values[(size_t)i * stride + d];
            for (uint32_t c = i + 1; c < count && c <= i + degree; c++) {
                sum -= row[c + degree - i] * values[(size_t)c * stride + d];
            }
            values[(size_t)i * stride + d] = sum / row[degree];
        }
    }
    g_free(matrix);
}
