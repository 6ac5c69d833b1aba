// Functions, contours and surfaces in the formats of the field's editors.
#include "lsystem/companion.h"

#include <math.h>
#include <string.h>

#define SAMPLES 1025
#define MOST_POINTS 10000

int fr_lcompanion_numbers(const char *line, double *numbers, int most) {
    int count = 0;
    while (*line != '\0' && *line != '\n' && count < most) {
        bool is_start = g_ascii_isdigit(*line) || (strchr("+-.", *line) != NULL &&
                                                   (g_ascii_isdigit(line[1]) || line[1] == '.'));
        if (!is_start) {
            line++;
            continue;
        }
        char *end;
        double value = g_ascii_strtod(line, &end);
        if (end == line) {
            line++;
            continue;
        }
        numbers[count++] = isfinite(value) ? CLAMP(value, -1e9, 1e9) : 0;
        line = end;
    }
    return count;
}

/// A point of a cubic B-spline with clamped, uniform knots (de Boor 1972), at u in [0, 1].
static void clamped_spline(const double (*points)[3], uint32_t count, double u, double out[3]) {
    uint32_t degree = MIN(3, count - 1), spans = count - degree;
    double at = u * spans;
    uint32_t span = MIN((uint32_t)at, spans - 1);
    double d[4][3];
    for (uint32_t i = 0; i <= degree; i++) {
        memcpy(d[i], points[span + i], sizeof d[i]);
    }
    for (uint32_t r = 1; r <= degree; r++) {
        for (uint32_t i = degree; i >= r; i--) {
            // Knot k is clamp(k − degree, 0, spans).
            double low = CLAMP((double)(span + i) - degree, 0, spans);
            double high = CLAMP((double)(span + i) + 1 - r, 0, spans);
            double part = high > low ? (at - low) / (high - low) : 0;
            for (int k = 0; k < 3; k++) {
                d[i][k] = d[i - 1][k] * (1 - part) + d[i][k] * part;
            }
        }
    }
    memcpy(out, d[degree], 3 * sizeof *out);
}

// y at x: the curve is followed until it passes x.
static double spline_at(const double (*points)[3], uint32_t count, double x) {
    double low = 0, high = 1, point[3];
    for (int i = 0; i < 40; i++) {
        double middle = (low + high) / 2;
        clamped_spline(points, count, middle, point);
        if (point[0] < x) {
            low = middle;
        } else {
            high = middle;
        }
    }
    clamped_spline(points, count, (low + high) / 2, point);
    return point[1];
}

static void add_function(GArray *functions, const char *name, const double (*points)[3],
                         uint32_t count) {
    FrLspline spline = {g_strdup(name), g_new(double, SAMPLES), SAMPLES};
    for (uint32_t i = 0; i < SAMPLES; i++) {
        spline.samples[i] = spline_at(points, count, (double)i / (SAMPLES - 1));
    }
    g_array_append_val(functions, spline);
}

bool fr_lcompanion_functions(FrSource *source, GArray *functions) {
    size_t size;
    char **lines = g_strsplit(fr_source_text(source, &size), "\n", -1);
    double(*points)[3] = g_malloc_n(MOST_POINTS, sizeof *points);
    char *name = NULL;
    guint before = functions->len;
    uint32_t wanted = 0, count = 0;
    for (char **line = lines; *line != NULL && functions->len < before + 1000; line++) {
        char *text = g_strstrip(*line);
        double n[3] = {0, 0, 1};
        if (g_str_has_prefix(text, "name:")) {
            g_free(name);
            name = g_strstrip(g_strdup(text + 5));
        } else if (g_str_has_prefix(text, "points:")) {
            fr_lcompanion_numbers(text + 7, n, 1);
            wanted = (uint32_t)CLAMP(n[0], 0, MOST_POINTS);
            count = 0;
        } else if (count < wanted && fr_lcompanion_numbers(text, n, 3) >= 2) {
            uint32_t times = (uint32_t)CLAMP(n[2], 1, 3);
            for (uint32_t i = 0; i < times && count < MOST_POINTS; i++) {
                memcpy(points[count++], (double[3]){n[0], n[1], 0}, sizeof points[0]);
            }
            wanted += times - 1;
            if (count >= wanted && count >= 2) {
                add_function(functions, name, (const double(*)[3])points, count);
                wanted = 0;
            }
        }
    }
    g_free(name);
    g_free(points);
    g_strfreev(lines);
    return functions->len > before;
}

// ---- contours ---------------------------------------------------------------------------------

/// A point of a uniform cubic B-spline.
static void uniform_spline(const double (*points)[3], uint32_t count, uint32_t span, double t,
                           double out[3]) {
    double u = 1 - t, t2 = t * t, t3 = t2 * t;
    double weight[4] = {u * u * u / 6, (3 * t3 - 6 * t2 + 4) / 6,
                        (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6};
    out[0] = out[1] = out[2] = 0;
    for (uint32_t i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            out[k] += weight[i] * points[(span + i) % count][k];
        }
    }
}

static void add_contour(GArray *contours, int id, const double (*points)[3], uint32_t count,
                        bool is_closed) {
    uint32_t spans = is_closed ? count : count - 3, steps = 8;
    FrLcontour contour = {.id = id, .is_closed = is_closed};
    contour.count = spans * steps + !is_closed;
    contour.points = g_malloc_n(contour.count, sizeof *contour.points);
    for (uint32_t i = 0; i < contour.count; i++) {
        uint32_t span = MIN(i / steps, spans - 1);
        uniform_spline(points, count, span, (double)(i - span * steps) / steps, contour.points[i]);
    }
    for (uint32_t i = 1; i < contour.count; i++) {
        const double *a = contour.points[i - 1], *b = contour.points[i];
        contour.length += sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                               (a[2] - b[2]) * (a[2] - b[2]));
    }
    g_array_append_val(contours, contour);
}

bool fr_lcompanion_contour(FrSource *source, GArray *contours, int id) {
    size_t size;
    char **lines = g_strsplit(fr_source_text(source, &size), "\n", -1);
    double(*points)[3] = g_malloc_n(MOST_POINTS, sizeof *points);
    uint32_t count = 0;
    bool is_closed = false;
    for (char **line = lines; *line != NULL; line++) {
        char *text = g_strstrip(*line);
        double n[4] = {0, 0, 0, 1};
        if (g_str_has_prefix(text, "type:")) {
            is_closed = strchr(text + 5, 'c') != NULL;
        } else if (!g_ascii_isalpha(*text) && fr_lcompanion_numbers(text, n, 4) >= 2) {
            for (uint32_t i = 0; i < (uint32_t)CLAMP(n[3], 1, 3) && count < MOST_POINTS; i++) {
                memcpy(points[count++], n, sizeof points[0]);
            }
        }
    }
    bool is_enough = count >= 4;
    if (is_enough) {
        add_contour(contours, id, (const double(*)[3])points, count, is_closed);
    }
    g_free(points);
    g_strfreev(lines);
    return is_enough;
}
