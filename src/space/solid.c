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

static void cross_triangle(double corner[3][3], const FrCellGrid *grid, int64_t y, int64_t z,
                           const double normal[3], GArray *crossings) {
    double at[2] = {grid->origin[1] + ((double)y + 0.5) * grid->cell,
                    grid->origin[2] + ((double)z + 0.5) * grid->cell};
    bool is_hit = false;
    for (int k = 0; k < 3; k++) {
        is_hit ^= passes_edge(corner[k], corner[(k + 1) % 3], at[0], at[1]);
    }
    if (is_hit && normal[0] != 0) {
        double x =
            corner[0][0] -
            (normal[1] * (at[0] - corner[0][1]) + normal[2] * (at[1] - corner[0][2])) / normal[0];
        Crossing crossing = {z * grid->counts[1] + y, x, normal[0] > 0 ? 1 : -1};
        g_array_append_val(crossings, crossing);
    }
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
    double corner[3][3], min[3], max[3];
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) {
            corner[c][k] = (double)positions[index[c]].raw[k];
        }
        min[k] = fmin(corner[0][k], fmin(corner[1][k], corner[2][k]));
        max[k] = fmax(corner[0][k], fmax(corner[1][k], corner[2][k]));
    }
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = corner[1][k] - corner[0][k];
        b[k] = corner[2][k] - corner[0][k];
    }
    const double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
    int64_t first[3], last[3];
    for (int k = 1; k < 3; k++) {
        cells_between(grid, k, min[k], max[k], &first[k], &last[k]);
    }
    for (int64_t z = first[2]; z <= last[2]; z++) {
        for (int64_t y = first[1]; y <= last[1]; y++) {
            cross_triangle(corner, grid, y, z, normal, crossings);
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
