// Curves y(x) through given points.
// Smooth ones are monotone piecewise cubics. After: Fritsch, Carlson. Monotone piecewise cubic
// interpolation. SIAM Journal on Numerical Analysis 17 (2), 1980.
#include "math/curve.h"

#include <math.h>

// ---- making -----------------------------------------------------------------------------------

static double secant(const FrCurveKnot *a) {
    return (a[1].y - a[0].y) / (a[1].x - a[0].x);
}

// One-sided three-point slope at an end; `near` and `far` are the widths and secants of the two
// segments next to it. Kept on the side of its own secant and within three times it.
static double end_slope(double near_width, double far_width, double near, double far) {
    double slope = near + (near - far) * near_width / (near_width + far_width);
    if (slope * near <= 0) {
        return 0;
    }
    return fabs(slope) > 3 * fabs(near) ? 3 * near : slope;
}

// Slopes of the parabola through three neighbours, 0 where the data turn.
static void first_slopes(FrCurve *curve) {
    FrCurveKnot *knot = curve->knots;
    size_t last = curve->count - 1;
    if (last == 1) {
        knot[0].slope = knot[1].slope = secant(knot);
        return;
    }
    for (size_t i = 1; i < last; i++) {
        double before = secant(knot + i - 1), after = secant(knot + i);
        double width = knot[i + 1].x - knot[i - 1].x;
        double share = (knot[i].x - knot[i - 1].x) / width;
        bool turns = before == 0 || after == 0 || (before > 0) != (after > 0);
        knot[i].slope = turns ? 0 : before + share * (after - before);
    }
    knot[0].slope =
        end_slope(knot[1].x - knot[0].x, knot[2].x - knot[1].x, secant(knot), secant(knot + 1));
    knot[last].slope =
        end_slope(knot[last].x - knot[last - 1].x, knot[last - 1].x - knot[last - 2].x,
                  secant(knot + last - 1), secant(knot + last - 2));
}

// Shrinks the slopes of every segment into the circle of radius 3 in which a cubic is monotone.
static void limit_slopes(FrCurve *curve) {
    for (size_t i = 0; i + 1 < curve->count; i++) {
        FrCurveKnot *knot = curve->knots + i;
        double rise = secant(knot);
        if (rise == 0) {
            knot[0].slope = knot[1].slope = 0;
            continue;
        }
        double size = hypot(knot[0].slope / rise, knot[1].slope / rise);
        if (size > 3) {
            knot[0].slope *= 3 / size;
            knot[1].slope *= 3 / size;
        }
    }
}

// The area from the left knot of a segment to `along` of its width.
static double segment_area(const FrCurve *curve, const FrCurveKnot *knot, double along) {
    double width = knot[1].x - knot[0].x;
    double u = along;
    double h10, h11, h01;
    switch (curve->kind) {
    case FR_CURVE_STEP:
        return width * u * knot[0].y;
    case FR_CURVE_LINEAR:
        return width * u * (knot[0].y + 0.5 * u * (knot[1].y - knot[0].y));
    case FR_CURVE_SMOOTH:
        break;
    }
    // Integrals of the Hermite basis.
    h01 = u * u * u * (1 - 0.5 * u);
    h10 = u * u * (0.5 - u * (2.0 / 3 - 0.25 * u));
    h11 = u * u * u * (0.25 * u - 1.0 / 3);
    return width * (u * knot[0].y + h01 * (knot[1].y - knot[0].y) +
                    width * (h10 * knot[0].slope + h11 * knot[1].slope));
}

FrCurve *fr_curve_new(FrCurveKind kind, const double (*points)[2], size_t count) {
    if (count < 1) {
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        bool rises = i == 0 || points[i][0] > points[i - 1][0];
        if (!isfinite(points[i][0]) || !isfinite(points[i][1]) || !rises) {
            return NULL;
        }
    }
    FrCurve *curve = g_malloc0(sizeof *curve + count * sizeof curve->knots[0]);
    curve->references = 1;
    curve->kind = kind;
    curve->count = count;
    for (size_t i = 0; i < count; i++) {
        curve->knots[i].x = points[i][0];
        curve->knots[i].y = points[i][1];
    }
    if (kind == FR_CURVE_SMOOTH && count > 1) {
        first_slopes(curve);
        limit_slopes(curve);
    }
    for (size_t i = 0; i + 1 < count; i++) {
        FrCurveKnot *knot = curve->knots + i;
        knot[1].area = knot[0].area + segment_area(curve, knot, 1);
        if (!isfinite(secant(knot)) || !isfinite(knot[1].slope) || !isfinite(knot[1].area)) {
            g_free(curve);
            return NULL;
        }
    }
    return curve;
}

FrCurve *fr_curve_ref(FrCurve *curve) {
    g_atomic_int_inc(&curve->references);
    return curve;
}

void fr_curve_unref(FrCurve *curve) {
    if (curve != NULL && g_atomic_int_dec_and_test(&curve->references)) {
        g_free(curve);
    }
}

// ---- reading ----------------------------------------------------------------------------------

// The left knot of the segment that holds x; x is inside the curve.
static const FrCurveKnot *find_segment(const FrCurve *curve, double x) {
    const FrCurveKnot *base = curve->knots;
    size_t length = curve->count - 1;
    while (length > 1) {
        size_t half = length / 2;
        base = x >= base[half].x ? base + half : base;
        length -= half;
    }
    return base;
}

double fr_curve_eval(const FrCurve *curve, double x) {
    const FrCurveKnot *knot = curve->knots, *last = knot + curve->count - 1;
    if (!(x > knot->x)) {
        return knot->y;
    }
    if (x >= last->x) {
        return last->y;
    }
    knot = find_segment(curve, x);
    double width = knot[1].x - knot[0].x;
    double u = (x - knot[0].x) / width;
    double rise = knot[1].y - knot[0].y;
    if (curve->kind == FR_CURVE_STEP) {
        return knot[0].y;
    }
    if (curve->kind == FR_CURVE_LINEAR) {
        return knot[0].y + u * rise;
    }
    double linear = width * knot[0].slope;
    double cubic = linear + width * knot[1].slope - 2 * rise;
    double y = knot[0].y + u * (linear + u * ((rise - linear - cubic) + u * cubic));
    // Monotone in exact arithmetic; rounding must not carry it past its points either.
    double low = fmin(knot[0].y, knot[1].y), high = fmax(knot[0].y, knot[1].y);
    return y < low ? low : y > high ? high : y;
}

double fr_curve_integral(const FrCurve *curve, double x) {
    const FrCurveKnot *knot = curve->knots, *last = knot + curve->count - 1;
    if (!(x > knot->x)) {
        return isnan(x) ? 0 : (x - knot->x) * knot->y;
    }
    if (x >= last->x) {
        return last->area + (x - last->x) * last->y;
    }
    knot = find_segment(curve, x);
    return knot->area + segment_area(curve, knot, (x - knot[0].x) / (knot[1].x - knot[0].x));
}

size_t fr_curve_point_count(const FrCurve *curve) {
    return curve->count;
}

FrCurveKind fr_curve_kind(const FrCurve *curve) {
    return curve->kind;
}

void fr_curve_point(const FrCurve *curve, size_t index, double point[2]) {
    FR_ASSERT(index < curve->count);
    point[0] = curve->knots[index].x;
    point[1] = curve->knots[index].y;
}

FrDigest fr_curve_digest(FrDigest seed, const FrCurve *curve) {
    uint64_t head[2] = {curve->kind, curve->count};
    FrDigest digest = fr_digest(seed, head, sizeof head);
    return fr_digest(digest, curve->knots, curve->count * sizeof *curve->knots);
}
