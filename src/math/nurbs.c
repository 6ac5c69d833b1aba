// Rational B-splines: basis functions and evaluation.
// Piegl, Tiller. The NURBS Book. 2nd edition, Springer 1997: algorithms A2.2, A2.3, A3.5, A4.3.
#include "frond/nurbs.h"

#include <math.h>
#include <string.h>

enum { ORDER_MOST = FR_NURBS_DEGREE_MOST + 1 };

uint32_t fr_nurbs_span(const double *knots, uint32_t degree, uint32_t count, double u) {
    uint32_t low = degree, high = count;
    if (!(u < knots[count])) {
        // The end belongs to the last piece that has a length.
        for (low = count - 1; low > degree && !(knots[low] < knots[count]); low--) {
        }
        return low;
    }
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (u < knots[middle]) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return low;
}

void fr_nurbs_basis(const double *knots, uint32_t degree, uint32_t span, double u, double *basis,
                    double *slope) {
    double left[ORDER_MOST], right[ORDER_MOST], lower[ORDER_MOST] = {0};
    basis[0] = 1.0;
    for (uint32_t j = 1; j <= degree; j++) {
        if (j == degree) {
            memcpy(lower, basis, degree * sizeof *lower);
        }
        left[j] = u - knots[span + 1 - j];
        right[j] = knots[span + j] - u;
        double carried = 0.0;
        for (uint32_t r = 0; r < j; r++) {
            double width = right[r + 1] + left[j - r];
            double part = width > 0.0 ? basis[r] / width : 0.0;
            basis[r] = carried + right[r + 1] * part;
            carried = left[j - r] * part;
        }
        basis[j] = carried;
    }
    for (uint32_t r = 0; slope != NULL && r <= degree; r++) {
        uint32_t i = span - degree + r; // index of the function
        double a = r > 0 ? knots[i + degree] - knots[i] : 0.0;
        double b = r < degree ? knots[i + degree + 1] - knots[i + 1] : 0.0;
        slope[r] = degree * ((a > 0.0 ? lower[r - 1] / a : 0.0) - (b > 0.0 ? lower[r] / b : 0.0));
    }
}

void fr_nurbs_range(const double *knots, uint32_t degree, uint32_t count, double range[2]) {
    range[0] = knots[degree];
    range[1] = knots[count];
}

static double clamped(const double *knots, uint32_t degree, uint32_t count, double u) {
    return u > knots[degree] ? fmin(u, knots[count]) : knots[degree];
}

static void add_point(double sum[4], const double point[4], double factor) {
    double weighted = factor * point[3];
    sum[0] += weighted * point[0];
    sum[1] += weighted * point[1];
    sum[2] += weighted * point[2];
    sum[3] += weighted;
}

static void divide(const double sum[4], double point[3]) {
    for (int k = 0; k < 3; k++) {
        point[k] = sum[k] / sum[3];
    }
}

// The quotient rule: (A / w)′ = (A′ − w′ A/w) / w.
static void divide_slope(const double slope[4], const double sum[4], double derivative[3]) {
    for (int k = 0; k < 3; k++) {
        derivative[k] = (slope[k] - slope[3] * sum[k] / sum[3]) / sum[3];
    }
}

void fr_nurbs_curve_at(const FrNurbsCurve *curve, double u, double point[3], double derivative[3]) {
    double basis[ORDER_MOST], slope[ORDER_MOST], sum[4] = {0}, change[4] = {0};
    u = clamped(curve->knots, curve->degree, curve->count, u);
    uint32_t span = fr_nurbs_span(curve->knots, curve->degree, curve->count, u);
    fr_nurbs_basis(curve->knots, curve->degree, span, u, basis, slope);
    for (uint32_t r = 0; r <= curve->degree; r++) {
        const double *control = curve->points[span - curve->degree + r];
        add_point(sum, control, basis[r]);
        add_point(change, control, slope[r]);
    }
    if (point != NULL) {
        divide(sum, point);
    }
    if (derivative != NULL) {
        divide_slope(change, sum, derivative);
    }
}

void fr_nurbs_surface_at(const FrNurbsSurface *surface, double u, double v, double point[3],
                         double along_u[3], double along_v[3]) {
    uint32_t p = surface->degree_u, q = surface->degree_v;
    double a[ORDER_MOST], da[ORDER_MOST], b[ORDER_MOST], db[ORDER_MOST];
    u = clamped(surface->knots_u, p, surface->count_u, u);
    v = clamped(surface->knots_v, q, surface->count_v, v);
    uint32_t span_u = fr_nurbs_span(surface->knots_u, p, surface->count_u, u);
    uint32_t span_v = fr_nurbs_span(surface->knots_v, q, surface->count_v, v);
    bool has_slopes = along_u != NULL || along_v != NULL;
    fr_nurbs_basis(surface->knots_u, p, span_u, u, a, has_slopes ? da : NULL);
    fr_nurbs_basis(surface->knots_v, q, span_v, v, b, has_slopes ? db : NULL);
    double sum[4] = {0}, change_u[4] = {0}, change_v[4] = {0};
    for (uint32_t s = 0; s <= q; s++) {
        size_t row = (size_t)(span_v - q + s) * surface->count_u + span_u - p;
        for (uint32_t r = 0; r <= p; r++) {
            const double *control = surface->points[row + r];
            add_point(sum, control, a[r] * b[s]);
            if (has_slopes) {
                add_point(change_u, control, da[r] * b[s]);
                add_point(change_v, control, a[r] * db[s]);
            }
        }
    }
    if (point != NULL) {
        divide(sum, point);
    }
    if (along_u != NULL) {
        divide_slope(change_u, sum, along_u);
    }
    if (along_v != NULL) {
        divide_slope(change_v, sum, along_v);
    }
}

static bool knots_are_valid(const double *knots, uint32_t degree, uint32_t count) {
    if (degree < 1 || degree > FR_NURBS_DEGREE_MOST || count <= degree) {
        return false;
    }
    uint32_t equal = 1;
    for (size_t i = 0; i < (size_t)count + degree + 1; i++) {
        if (!isfinite(knots[i]) || fabs(knots[i]) > 1e12 || (i > 0 && knots[i] < knots[i - 1])) {
            return false;
        }
        equal = i > 0 && !(knots[i] > knots[i - 1]) ? equal + 1 : 1;
        if (equal > degree + 1) {
            return false;
        }
    }
    return knots[degree] < knots[count];
}

bool fr_nurbs_surface_is_valid(const FrNurbsSurface *surface) {
    if (!knots_are_valid(surface->knots_u, surface->degree_u, surface->count_u) ||
        !knots_are_valid(surface->knots_v, surface->degree_v, surface->count_v)) {
        return false;
    }
    for (size_t i = 0; i < (size_t)surface->count_u * surface->count_v; i++) {
        const double *point = surface->points[i];
        for (int k = 0; k < 4; k++) {
            if (!isfinite(point[k]) || fabs(point[k]) > 1e12) {
                return false;
            }
        }
        if (!(point[3] > 1e-12)) {
            return false;
        }
    }
    return true;
}

void fr_nurbs_project(const double map[4][4], const double point[4], double image[4]) {
    double out[4];
    for (int i = 0; i < 4; i++) {
        double sum = map[i][3];
        for (int k = 0; k < 3; k++) {
            sum += map[i][k] * point[k];
        }
        out[i] = sum * point[3];
    }
    for (int k = 0; k < 3; k++) {
        image[k] = out[k] / out[3];
    }
    image[3] = out[3];
}
