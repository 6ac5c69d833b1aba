// Functions, contours and surfaces in the formats of the field's editors.
#include "lsystem/companion.h"

#include <math.h>
#include <string.h>

#define MOST_SAMPLES 100000
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

// y at x by bisection, which stops where x is met to a thousandth: values are those of cpfg to
// the last bit, not those of the curve.
double fr_lspline_value(const double (*points)[3], uint32_t count, double x) {
    double low = 0, high = 1, point[3] = {0, 0, 0};
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        clamped_spline(points, count, middle, point);
        if (point[0] > x) {
            high = middle;
        } else {
            low = middle;
        }
        if (fabs(point[0] - x) <= 0.001) {
            break;
        }
    }
    return point[1];
}

static void add_function(GArray *functions, const char *name, const double (*points)[3],
                         uint32_t count, uint32_t samples) {
    FrLspline spline = {.name = g_strdup(name),
                        .points = g_memdup2(points, count * sizeof *points),
                        .point_count = count};
    if (samples > 2) {
        spline.samples = g_new(double, samples);
        spline.count = samples;
        for (uint32_t i = 0; i < samples; i++) {
            spline.samples[i] = fr_lspline_value(points, count, (double)i / (samples - 1));
        }
    }
    g_array_append_val(functions, spline);
}

/// A function that is being read.
typedef struct Function {
    char *name;
    bool is_old; ///< begins with `range:`; a third number means nothing
    uint32_t samples, wanted, seen, count;
    double (*points)[3];
} Function;

static void read_head(Function *function, const char *text, int samples) {
    double n[2] = {0, 0};
    if (g_str_has_prefix(text, "name:")) {
        g_free(function->name);
        function->name = g_strstrip(g_strdup(text + 5));
    } else if (g_str_has_prefix(text, "range:") || g_str_has_prefix(text, "fver")) {
        function->is_old = *text == 'r';
        function->samples = function->is_old && samples > 0 ? (uint32_t)samples : 0;
    } else if (g_str_has_prefix(text, "samples:")) {
        fr_lcompanion_numbers(text + 8, n, 1);
        function->samples = (uint32_t)CLAMP(n[0], 0, MOST_SAMPLES);
    } else if (g_str_has_prefix(text, "points:")) {
        fr_lcompanion_numbers(text + 7, n, 1);
        function->wanted = (uint32_t)CLAMP(n[0], 0, MOST_POINTS);
        function->seen = function->count = 0;
    }
}

/// Takes a control point, in single precision; true with the last.
static bool read_point(Function *function, const double n[3]) {
    uint32_t times = function->is_old ? 1 : (uint32_t)CLAMP(n[2], 0, MOST_POINTS);
    for (uint32_t i = 0; i < times && function->count < MOST_POINTS; i++) {
        double point[3] = {(double)(float)n[0], (double)(float)n[1], 0};
        memcpy(function->points[function->count++], point, sizeof point);
    }
    return ++function->seen == function->wanted && function->count >= 2;
}

bool fr_lcompanion_functions(FrSource *source, GArray *functions, int samples) {
    size_t size;
    char **lines = g_strsplit(fr_source_text(source, &size), "\n", -1);
    Function function = {.points = g_malloc_n(MOST_POINTS, sizeof(double[3]))};
    guint before = functions->len;
    for (char **line = lines; *line != NULL && functions->len < before + 1000; line++) {
        char *text = g_strstrip(*line);
        double n[3] = {0, 0, 1};
        bool is_head = g_ascii_isalpha(*text);
        if (is_head) {
            read_head(&function, text, MIN(samples, MOST_SAMPLES));
        } else if (function.seen < function.wanted && fr_lcompanion_numbers(text, n, 3) >= 2 &&
                   read_point(&function, n)) {
            add_function(functions, function.name, (const double(*)[3])function.points,
                         function.count, function.samples);
        }
    }
    g_free(function.name);
    g_free(function.points);
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

void fr_lcurve_point(const FrLcontour *curve, double t, double out[3]) {
    const double(*points)[3] = (const double(*)[3])curve->controls;
    uint32_t count = curve->control_count;
    double spans = (double)count - 3.000001, at = t * spans;
    if (curve->is_clamped) {
        clamped_spline(points, count, at / (count - 3), out);
    } else {
        uint32_t span = MIN((uint32_t)at, count - 4);
        uniform_spline(points, count, span, at - span, out);
    }
}

/// A curve of so many samples, whose lengths tell where a part of it is.
static void add_curve(GArray *curves, int id, const double (*points)[3], uint32_t count,
                      bool is_closed, bool is_clamped, uint32_t samples) {
    FrLcontour curve = {.id = id, .is_closed = is_closed, .is_clamped = is_clamped};
    curve.control_count = count + (is_closed ? 3 : 0);
    curve.controls = g_malloc_n(curve.control_count, sizeof *curve.controls);
    for (uint32_t i = 0; i < curve.control_count; i++) {
        memcpy(curve.controls[i], points[i % count], sizeof *curve.controls);
    }
    curve.count = samples;
    curve.points = g_malloc_n(samples, sizeof *curve.points);
    curve.lengths = g_new(double, samples);
    for (uint32_t i = 0; i < samples; i++) {
        fr_lcurve_point(&curve, (double)i / (samples - 1), curve.points[i]);
        const double *a = curve.points[i > 0 ? i - 1 : 0], *b = curve.points[i];
        curve.length += sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                             (b[2] - a[2]) * (b[2] - a[2]));
        curve.lengths[i] = curve.length;
    }
    for (uint32_t i = 0; i < samples && curve.length > 0; i++) {
        curve.lengths[i] /= curve.length;
    }
    g_array_append_val(curves, curve);
}

bool fr_lcompanion_contour(FrSource *source, GArray *contours, int id, int samples) {
    size_t size;
    char **lines = g_strsplit(fr_source_text(source, &size), "\n", -1);
    double(*points)[3] = g_malloc_n(MOST_POINTS, sizeof *points);
    uint32_t count = 0;
    bool is_closed = false, is_clamped = false;
    for (char **line = lines; *line != NULL; line++) {
        char *text = g_strstrip(*line);
        double n[4] = {0, 0, 0, 1};
        if (g_str_has_prefix(text, "type:")) {
            const char *type = text + 5 + strspn(text + 5, " \t");
            is_closed = *type == 'c';
            is_clamped = *type == 'o' && type[1] == 'e';
        } else if (!g_ascii_isalpha(*text) && fr_lcompanion_numbers(text, n, 4) >= 2) {
            for (uint32_t i = 0; i < (uint32_t)CLAMP(n[3], 0, 100) && count < MOST_POINTS; i++) {
                memcpy(points[count++], n, sizeof points[0]);
            }
        }
    }
    bool is_enough = count >= 4;
    if (is_enough && samples > 0) {
        add_curve(contours, id, (const double(*)[3])points, count, is_closed, is_clamped,
                  (uint32_t)CLAMP(samples, 2, MOST_SAMPLES));
    } else if (is_enough) {
        add_contour(contours, id, (const double(*)[3])points, count, is_closed);
    }
    g_free(points);
    g_strfreev(lines);
    return is_enough;
}
