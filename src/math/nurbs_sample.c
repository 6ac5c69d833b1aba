// Many points of a surface at once: each row of the grid is first a curve, whose control points
// serve all points of the row. Piegl, Tiller. The NURBS Book, algorithm A4.3, with its loops apart.
#include "frond/nurbs.h"

#include <glib.h>

#include <math.h>
#include <string.h>

enum { ORDER_MOST = FR_NURBS_DEGREE_MOST + 1, WIDE = 6 };

/// Basis functions at one parameter.
typedef struct FrBases {
    uint32_t first; ///< control point
    double value[ORDER_MOST], slope[ORDER_MOST];
} FrBases;

/// A control point of a row: weighted x, y, z, two coordinates and the weight; then the first three
/// and the weight of the derivative across rows.
typedef struct FrRowPoint {
    double at[WIDE], across[4];
} FrRowPoint;

static FrBases bases_at(const double *knots, uint32_t degree, uint32_t count, double at) {
    FrBases bases;
    uint32_t span = fr_nurbs_span(knots, degree, count, at);
    fr_nurbs_basis(knots, degree, span, at, bases.value, bases.slope);
    bases.first = span - degree;
    return bases;
}

static void make_row(const FrNurbsSurface *s, const FrBases *v, const double (*coordinates)[2],
                     FrRowPoint *row) {
    memset(row, 0, s->count_u * sizeof *row);
    for (uint32_t j = 0; j <= s->degree_v; j++) {
        size_t first = (size_t)(v->first + j) * s->count_u;
        for (uint32_t i = 0; i < s->count_u; i++) {
            const double *control = s->points[first + i];
            double part = v->value[j] * control[3], slope = v->slope[j] * control[3];
            for (int k = 0; k < 3; k++) {
                row[i].at[k] += part * control[k];
                row[i].across[k] += slope * control[k];
            }
            for (int k = 0; k < 2 && coordinates != NULL; k++) {
                row[i].at[3 + k] += part * coordinates[first + i][k];
            }
            row[i].at[5] += part;
            row[i].across[3] += slope;
        }
    }
}

/// False where the two are parallel, or one of them is nothing but rounding, as at a pole.
static bool unit_cross(const double a[3], const double b[3], double normal[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    double z = a[0] * b[1] - a[1] * b[0], length = sqrt(x * x + y * y + z * z);
    double size_a = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    double size_b = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    bool has_both = fmin(size_a, size_b) > 1e-9 * fmax(size_a, size_b);
    bool is_plain = has_both && length > 1e-7 * size_a * size_b;
    normal[0] = is_plain ? x / length : 0.0;
    normal[1] = is_plain ? y / length : 0.0;
    normal[2] = is_plain ? z / length : 1.0;
    return is_plain;
}

/// The normal a little inside, where a point has none.
static void normal_beside(const FrNurbsSurface *s, double u, double v, double normal[3]) {
    double u_range[2], v_range[2];
    fr_nurbs_range(s->knots_u, s->degree_u, s->count_u, u_range);
    fr_nurbs_range(s->knots_v, s->degree_v, s->count_v, v_range);
    for (double part = 1e-3; part < 0.2; part *= 8.0) {
        double inside_u = u + part * (0.5 * (u_range[0] + u_range[1]) - u), along_u[3];
        double inside_v = v + part * (0.5 * (v_range[0] + v_range[1]) - v), along_v[3];
        fr_nurbs_surface_at(s, inside_u, inside_v, NULL, along_u, along_v);
        if (unit_cross(along_u, along_v, normal)) {
            return;
        }
    }
}

static void put_point(const FrNurbsSurface *s, const FrRowPoint *row, const FrBases *u,
                      const double at[2], double point[3], double normal[3], double *blended) {
    double sum[WIDE] = {0}, slope[4] = {0}, across[4] = {0};
    for (uint32_t r = 0; r <= s->degree_u; r++) {
        const FrRowPoint *control = &row[u->first + r];
        for (int k = 0; k < WIDE; k++) {
            sum[k] += u->value[r] * control->at[k];
        }
        for (int k = 0; k < 4; k++) {
            slope[k] += u->slope[r] * control->at[k < 3 ? k : 5];
            across[k] += u->value[r] * control->across[k];
        }
    }
    double along_u[3], along_v[3];
    for (int k = 0; k < 3; k++) {
        point[k] = sum[k] / sum[5];
        along_u[k] = (slope[k] - slope[3] * point[k]) / sum[5];
        along_v[k] = (across[k] - across[3] * point[k]) / sum[5];
    }
    if (!unit_cross(along_u, along_v, normal)) {
        normal_beside(s, at[0], at[1], normal);
    }
    if (blended != NULL) {
        blended[0] = sum[3] / sum[5];
        blended[1] = sum[4] / sum[5];
    }
}

void fr_nurbs_grid(const FrNurbsSurface *surface, const double *u, uint32_t count_u,
                   const double *v, uint32_t count_v, double (*points)[3], double (*normals)[3],
                   const double (*coordinates)[2], double (*blended)[2]) {
    const FrNurbsSurface *s = surface;
    FrBases *bases = g_new(FrBases, count_u);
    FrRowPoint *row = g_new(FrRowPoint, s->count_u);
    for (uint32_t i = 0; i < count_u; i++) {
        bases[i] = bases_at(s->knots_u, s->degree_u, s->count_u, u[i]);
    }
    for (uint32_t j = 0; j < count_v; j++) {
        FrBases across = bases_at(s->knots_v, s->degree_v, s->count_v, v[j]);
        make_row(s, &across, coordinates, row);
        for (uint32_t i = 0; i < count_u; i++) {
            size_t n = (size_t)j * count_u + i;
            const double at[2] = {u[i], v[j]};
            put_point(s, row, &bases[i], at, points[n], normals[n],
                      coordinates != NULL ? blended[n] : NULL);
        }
    }
    g_free(bases);
    g_free(row);
}
