/// Douglas, Peucker 1973.
#include "studio/model/drawn_line.h"

#include <math.h>

static const double *at(const GArray *points, guint index) {
    return &g_array_index(points, double, 3 * index);
}

// How far a point is from the segment from a to b.
static double distance(const double *point, const double *a, const double *b) {
    double along = 0, length = 0, squared = 0;
    for (int k = 0; k < 3; k++) {
        along += (point[k] - a[k]) * (b[k] - a[k]);
        length += (b[k] - a[k]) * (b[k] - a[k]);
    }
    double t = length > 0 ? CLAMP(along / length, 0, 1) : 0;
    for (int k = 0; k < 3; k++) {
        double gap = point[k] - a[k] - t * (b[k] - a[k]);
        squared += gap * gap;
    }
    return sqrt(squared);
}

GArray *studio_line_simplify(const GArray *points, double tolerance) {
    GArray *kept = g_array_new(FALSE, FALSE, 3 * sizeof(double));
    if (points->len == 0) {
        return kept;
    }
    gboolean *keeps = g_new0(gboolean, points->len);
    keeps[0] = keeps[points->len - 1] = TRUE;
    GArray *spans = g_array_new(FALSE, FALSE, 2 * sizeof(guint)); // still to be looked at
    guint whole[2] = {0, points->len - 1};
    g_array_append_val(spans, whole);
    while (spans->len > 0) {
        guint first = g_array_index(spans, guint, 2 * (spans->len - 1));
        guint last = g_array_index(spans, guint, 2 * (spans->len - 1) + 1);
        g_array_set_size(spans, spans->len - 1);
        guint farthest = first;
        double most = tolerance;
        for (guint i = first + 1; i < last; i++) {
            double away = distance(at(points, i), at(points, first), at(points, last));
            farthest = away > most ? i : farthest;
            most = fmax(most, away);
        }
        if (farthest != first) {
            keeps[farthest] = TRUE;
            guint parts[2][2] = {{first, farthest}, {farthest, last}};
            g_array_append_vals(spans, parts, 2);
        }
    }
    for (guint i = 0; i < points->len; i++) {
        if (keeps[i]) {
            g_array_append_vals(kept, at(points, i), 1);
        }
    }
    g_array_unref(spans);
    g_free(keeps);
    return kept;
}

GArray *studio_line_to_outline(const GArray *points, double tolerance) {
    GArray *flat = g_array_new(FALSE, FALSE, 3 * sizeof(double));
    for (guint i = 0; i < points->len; i++) {
        const double *from = &g_array_index(points, double, 2 * i);
        double point[3] = {fabs(from[0]), fmax(from[1], 0), 0};
        g_array_append_val(flat, point);
    }
    GArray *few = studio_line_simplify(flat, tolerance);
    GArray *outline = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    gboolean is_down = few->len > 1 && at(few, 0)[1] > at(few, few->len - 1)[1];
    for (guint i = 0; i < few->len; i++) {
        g_array_append_vals(outline, at(few, is_down ? few->len - 1 - i : i), 1);
    }
    g_array_unref(few);
    g_array_unref(flat);
    return outline;
}
