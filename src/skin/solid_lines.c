// Lines of a lattice through closed surfaces. A line goes into the solid where the number of
// surfaces around it becomes more than none, and out of it where it becomes none again.
//
// Diagonals are lines along x of a sheared lattice, so one way of finding crossings serves all. A
// line through an edge passes one of its two triangles: the side of an edge is decided the same for
// both, by its ends in a fixed order.
#include "skin/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const int fr_solid_steps[FR_SOLID_WAYS][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                                              {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};

/// x′, y′ and z′ of each way as sums of x, y and z. All keep the handedness.
static const int shears[FR_SOLID_WAYS][3][3] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},   {{1, 0, 0}, {-1, 1, 0}, {0, 0, 1}},
    {{0, 1, 0}, {0, -1, 1}, {1, 0, 0}},  {{1, 0, 0}, {0, 1, 0}, {-1, 0, 1}},
    {{1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}},
};

void fr_solid_line(int way, const int32_t point[3], int32_t line[2], int32_t *at) {
    int32_t sheared[3];
    for (int r = 0; r < 3; r++) {
        const int *row = shears[way][r];
        sheared[r] = row[0] * point[0] + row[1] * point[1] + row[2] * point[2];
    }
    *at = sheared[0];
    line[0] = sheared[1];
    line[1] = sheared[2];
}

static void shear(int way, const double point[3], double out[3]) {
    for (int r = 0; r < 3; r++) {
        const int *row = shears[way][r];
        out[r] = row[0] * point[0] + row[1] * point[1] + row[2] * point[2];
    }
}

/// Twice the area that an edge and a point span, seen along x: its sign is the point's side.
static double side_of(const double a[3], const double b[3], double y, double z) {
    bool is_turned = a[1] > b[1] || (a[1] == b[1] && a[2] > b[2]);
    const double *p = is_turned ? b : a, *q = is_turned ? a : b;
    double area = (q[1] - p[1]) * (z - p[2]) - (q[2] - p[2]) * (y - p[1]);
    double side = area >= 0.0 ? fmax(area, 1e-300) : area; // on the edge is left of it
    return is_turned ? -side : side;
}

static void cross_triangle(double t[3][3], GArray *crossings) {
    double low[2], high[2];
    for (int k = 0; k < 2; k++) {
        low[k] = ceil(fmin(t[0][k + 1], fmin(t[1][k + 1], t[2][k + 1])));
        high[k] = floor(fmax(t[0][k + 1], fmax(t[1][k + 1], t[2][k + 1])));
    }
    for (double z = low[1]; z <= high[1]; z += 1.0) {
        for (double y = low[0]; y <= high[0]; y += 1.0) {
            double a = side_of(t[1], t[2], y, z), b = side_of(t[2], t[0], y, z);
            double c = side_of(t[0], t[1], y, z), sum = a + b + c;
            bool is_left = a > 0.0 && b > 0.0 && c > 0.0;
            if (!is_left && !(a < 0.0 && b < 0.0 && c < 0.0)) {
                continue;
            }
            double at = (a * t[0][0] + b * t[1][0] + c * t[2][0]) / sum;
            FrCrossing crossing = {{(int32_t)y, (int32_t)z}, at, !is_left};
            g_array_append_val(crossings, crossing);
        }
    }
}

static int compare_lines(const int32_t a[2], const int32_t b[2]) {
    int first = (a[1] > b[1]) - (a[1] < b[1]);
    return first != 0 ? first : (a[0] > b[0]) - (a[0] < b[0]);
}

static int compare(const void *a, const void *b) {
    const FrCrossing *p = a, *q = b;
    int lines = compare_lines(p->line, q->line);
    int along = (p->at > q->at) - (p->at < q->at);
    // Surfaces that touch have no gap between them.
    return lines != 0 ? lines : along != 0 ? along : q->goes_in - p->goes_in;
}

/// Keeps the crossings where the solid begins and ends.
static size_t keep_outer(FrCrossing *crossings, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count;) {
        size_t first = kept;
        int inside = 0;
        int32_t line[2];
        memcpy(line, crossings[i].line, sizeof line);
        for (; i < count && compare_lines(crossings[i].line, line) == 0; i++) {
            FrCrossing crossing = crossings[i];
            int before = inside;
            inside += crossing.goes_in ? 1 : -1;
            if ((before == 0 && inside == 1) || (before == 1 && inside == 0)) {
                crossings[kept++] = crossing;
            }
        }
        kept = inside == 0 ? kept : first; // nothing to be sure of
    }
    return kept;
}

FrSolidLines fr_solid_lines(int way, const double (*corners)[3], size_t triangles) {
    GArray *crossings = g_array_new(FALSE, FALSE, sizeof(FrCrossing));
    for (size_t i = 0; i < triangles; i++) {
        double sheared[3][3];
        for (int k = 0; k < 3; k++) {
            shear(way, corners[3 * i + (size_t)k], sheared[k]);
        }
        cross_triangle(sheared, crossings);
    }
    if (crossings->len > 0) {
        qsort(crossings->data, crossings->len, sizeof(FrCrossing), compare);
    }
    FrSolidLines lines = {.count = crossings->len};
    lines.crossings = (FrCrossing *)(void *)g_array_free(crossings, FALSE);
    lines.count = keep_outer(lines.crossings, lines.count);
    return lines;
}

const FrCrossing *fr_solid_find(const FrSolidLines *lines, const int32_t line[2], size_t *count) {
    size_t low = 0, high = lines->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (compare_lines(lines->crossings[middle].line, line) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    size_t end = low;
    while (end < lines->count && compare_lines(lines->crossings[end].line, line) == 0) {
        end++;
    }
    *count = end - low;
    return lines->crossings + low;
}
