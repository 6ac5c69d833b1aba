// Solid voxelization: along each row of cells the winding number goes up or down by one where a
// triangle is crossed. An edge is judged the same way for both its triangles, so that no row slips
// between them. Nooruddin, Turk. Simplification and Repair of Polygonal Models Using Volumetric
// Techniques. IEEE Transactions on Visualization and Computer Graphics 9 (2), 2003 (ray stabbing).
#include "frond/solid.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

/// Where a row crosses the surface.
typedef struct Crossing {
    int64_t row; ///< z · rows along y + y
    double x;
    int sign;
} Crossing;

static bool is_before(const double a[3], const double b[3]) {
    for (int k = 2; k > 0; k--) {
        if (a[k] != b[k]) {
            return a[k] < b[k];
        }
    }
    return a[0] < b[0];
}

/// Whether the line at y, z has the edge on its side of greater y. The corners come in one order
/// for both triangles of an edge, so the answer has the same bits.
static bool passes_edge(const double a[3], const double b[3], double y, double z) {
    const double *low = is_before(a, b) ? a : b, *high = low == a ? b : a;
    if (!(low[2] <= z && z < high[2])) {
        return false;
    }
    return low[1] + (z - low[2]) / (high[2] - low[2]) * (high[1] - low[1]) > y;
}

/// A triangle with its box and normal.
typedef struct Facet {
    double corner[3][3], min[3], max[3], normal[3];
} Facet;

static Facet facet_of(const vec3s *positions, const uint32_t *index) {
    Facet facet;
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) {
            facet.corner[c][k] = (double)positions[index[c]].raw[k];
        }
        const double(*corner)[3] = (const double(*)[3])facet.corner;
        facet.min[k] = fmin(corner[0][k], fmin(corner[1][k], corner[2][k]));
        facet.max[k] = fmax(corner[0][k], fmax(corner[1][k], corner[2][k]));
        a[k] = corner[1][k] - corner[0][k];
        b[k] = corner[2][k] - corner[0][k];
    }
    for (int k = 0; k < 3; k++) {
        int m = (k + 1) % 3, n = (k + 2) % 3;
        facet.normal[k] = a[m] * b[n] - a[n] * b[m];
    }
    return facet;
}

/// Where the line at y, z along x crosses the triangle: +1 or −1 by its side, 0 if it does not.
static int cross(const Facet *facet, double y, double z, double *x) {
    const double *normal = facet->normal;
    bool is_hit = false;
    for (int k = 0; k < 3; k++) {
        is_hit ^= passes_edge(facet->corner[k], facet->corner[(k + 1) % 3], y, z);
    }
    if (!is_hit || normal[0] == 0) {
        return 0;
    }
    const double *corner = facet->corner[0];
    *x = corner[0] - (normal[1] * (y - corner[1]) + normal[2] * (z - corner[2])) / normal[0];
    return normal[0] > 0 ? 1 : -1;
}

/// The cells along an axis whose middles lie between two places: first > last if there are none.
static void cells_between(const FrCellGrid *grid, int axis, double from, double to, int64_t *first,
                          int64_t *last) {
    double low = ceil((from - grid->origin[axis]) / grid->cell - 0.5);
    double high = floor((to - grid->origin[axis]) / grid->cell - 0.5);
    double least = (double)grid->first[axis], most = (double)grid->counts[axis] - 1;
    *first = (int64_t)fmin(fmax(low, least), most + 1);
    *last = (int64_t)fmax(fmin(high, most), least - 1);
}

static void add_triangle(const vec3s *positions, const uint32_t *index, const FrCellGrid *grid,
                         GArray *crossings) {
    Facet facet = facet_of(positions, index);
    int64_t first[3], last[3];
    for (int k = 1; k < 3; k++) {
        cells_between(grid, k, facet.min[k], facet.max[k], &first[k], &last[k]);
    }
    for (int64_t z = first[2]; z <= last[2]; z++) {
        for (int64_t y = first[1]; y <= last[1]; y++) {
            Crossing crossing = {.row = z * grid->counts[1] + y};
            crossing.sign = cross(&facet, grid->origin[1] + ((double)y + 0.5) * grid->cell,
                                  grid->origin[2] + ((double)z + 0.5) * grid->cell, &crossing.x);
            if (crossing.sign != 0) {
                g_array_append_val(crossings, crossing);
            }
        }
    }
}

static int compare_crossings(const void *a, const void *b) {
    const Crossing *p = a, *q = b;
    if (p->row != q->row) {
        return p->row < q->row ? -1 : 1;
    }
    return p->x != q->x ? (p->x < q->x ? -1 : 1) : p->sign - q->sign;
}

/// The runs of one row, from the places where it is crossed.
static void fill_row(const Crossing *crossings, guint count, const FrCellGrid *grid,
                     FrCellRunFn run, void *data) {
    int winding = 0;
    for (guint i = 0; i < count; i++) {
        winding += crossings[i].sign;
    }
    if (winding != 0) {
        return;
    }
    for (guint i = 0; i + 1 < count; i++) {
        winding += crossings[i].sign;
        int64_t first, last;
        cells_between(grid, 0, crossings[i].x, crossings[i + 1].x, &first, &last);
        if (winding != 0 && first <= last) {
            run(data, first, last, crossings[0].row % grid->counts[1],
                crossings[0].row / grid->counts[1]);
        }
    }
}

void fr_solid_cells(const vec3s *positions, const uint32_t *indices, uint32_t index_count,
                    const FrCellGrid *grid, FrCellRunFn run, void *data) {
    GArray *crossings = g_array_new(FALSE, FALSE, sizeof(Crossing));
    for (uint32_t i = 0; i + 2 < index_count; i += 3) {
        add_triangle(positions, &indices[i], grid, crossings);
    }
    Crossing *all = (Crossing *)(void *)crossings->data;
    if (crossings->len > 0) {
        qsort(all, crossings->len, sizeof *all, compare_crossings);
    }
    for (guint first = 0, end; first < crossings->len; first = end) {
        for (end = first + 1; end < crossings->len && all[end].row == all[first].row; end++) {
        }
        fill_row(&all[first], end - first, grid, run, data);
    }
    g_array_unref(crossings);
}

// ---- points -----------------------------------------------------------------------------------

/// A point in the surface's box, and how often the surface winds around it.
typedef struct Wound {
    const double *at;
    uint32_t point;
    int winding; ///< of what is crossed beyond it …
    int all;     ///< … and on its whole row: 0 unless the surface is open there
} Wound;

static int compare_wound(const void *a, const void *b) {
    const Wound *p = a, *q = b;
    return p->at[1] < q->at[1] ? -1 : p->at[1] > q->at[1];
}

/// Those points that are in the box of the surface, by rising y.
static GArray *points_in_box(const vec3s *positions, const uint32_t *indices, uint32_t index_count,
                             const FrPoint3 *points, uint32_t count) {
    double min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < index_count; i++) {
        for (int k = 0; k < 3; k++) {
            min[k] = fmin(min[k], (double)positions[indices[i]].raw[k]);
            max[k] = fmax(max[k], (double)positions[indices[i]].raw[k]);
        }
    }
    GArray *within = g_array_new(FALSE, FALSE, sizeof(Wound));
    for (uint32_t i = 0; i < count; i++) {
        const double *at = points[i].at;
        if (at[0] >= min[0] && at[0] <= max[0] && at[1] >= min[1] && at[1] <= max[1] &&
            at[2] >= min[2] && at[2] <= max[2]) {
            Wound wound = {at, i, 0, 0};
            g_array_append_val(within, wound);
        }
    }
    g_array_sort(within, compare_wound);
    return within;
}

void fr_solid_holds(const vec3s *positions, const uint32_t *indices, uint32_t index_count,
                    const FrPoint3 *points, uint32_t count, bool *is_held) {
    GArray *within = points_in_box(positions, indices, index_count, points, count);
    Wound *wounds = (Wound *)(void *)within->data;
    for (uint32_t i = 0; i + 2 < index_count && within->len > 0; i += 3) {
        Facet facet = facet_of(positions, &indices[i]);
        guint low = 0, high = within->len;
        while (low < high) { // the first whose y is not below the triangle
            guint middle = low + (high - low) / 2;
            bool is_below = wounds[middle].at[1] < facet.min[1];
            low = is_below ? middle + 1 : low;
            high = is_below ? high : middle;
        }
        for (; low < within->len && wounds[low].at[1] <= facet.max[1]; low++) {
            const double *at = wounds[low].at;
            double x = 0;
            int sign = at[2] >= facet.min[2] && at[2] <= facet.max[2]
                           ? cross(&facet, at[1], at[2], &x)
                           : 0;
            wounds[low].winding += x > at[0] ? sign : 0;
            wounds[low].all += sign;
        }
    }
    for (guint i = 0; i < within->len; i++) {
        is_held[wounds[i].point] |= wounds[i].winding != 0 && wounds[i].all == 0;
    }
    g_array_unref(within);
}
