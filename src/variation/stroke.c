// Strokes: lines drawn in space, and their cutting by arc length.
#include "frond/variation.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

#define FARTHEST 1e9f

struct FrStroke {
    gint references;
    size_t count;
    FrStrokePoint *points;
    double *distance; ///< of every point from the first, along the stroke
};

static bool is_near(vec3s v) {
    return fabsf(v.x) <= FARTHEST && fabsf(v.y) <= FARTHEST && fabsf(v.z) <= FARTHEST;
}

static double gap(vec3s a, vec3s b) {
    double x = (double)b.x - (double)a.x, y = (double)b.y - (double)a.y,
           z = (double)b.z - (double)a.z;
    return sqrt(x * x + y * y + z * z);
}

FrStroke *fr_stroke_new(const FrStrokePoint *points, size_t count) {
    double length = 0;
    for (size_t i = 0; i < count; i++) {
        if (!is_near(points[i].at) || !isfinite(points[i].pressure) || !isfinite(points[i].time)) {
            return NULL;
        }
        length += i > 0 ? gap(points[i - 1].at, points[i].at) : 0;
    }
    if (!(length > 0)) {
        return NULL;
    }
    FrStroke *stroke = g_new0(FrStroke, 1);
    *stroke = (FrStroke){.references = 1,
                         .count = count,
                         .points = g_memdup2(points, count * sizeof *points),
                         .distance = g_new0(double, count)};
    for (size_t i = 1; i < count; i++) {
        stroke->distance[i] = stroke->distance[i - 1] + gap(points[i - 1].at, points[i].at);
    }
    return stroke;
}

FrStroke *fr_stroke_ref(FrStroke *stroke) {
    g_atomic_int_inc(&stroke->references);
    return stroke;
}

void fr_stroke_unref(FrStroke *stroke) {
    if (stroke != NULL && g_atomic_int_dec_and_test(&stroke->references)) {
        g_free(stroke->points);
        g_free(stroke->distance);
        g_free(stroke);
    }
}

const FrStrokePoint *fr_stroke_points(const FrStroke *stroke, size_t *count) {
    *count = stroke->count;
    return stroke->points;
}

double fr_stroke_length(const FrStroke *stroke) {
    return stroke->distance[stroke->count - 1];
}

/// A walk along the stroke, never back.
typedef struct Walk {
    const FrStroke *stroke;
    size_t at; ///< the point reached last
} Walk;

static void walk_to(Walk *walk, double distance, double point[3]) {
    const FrStroke *stroke = walk->stroke;
    while (walk->at + 2 < stroke->count && stroke->distance[walk->at + 1] < distance) {
        walk->at++;
    }
    double from = stroke->distance[walk->at], to = stroke->distance[walk->at + 1];
    double part = to > from ? fmin(fmax((distance - from) / (to - from), 0), 1) : 0;
    for (int k = 0; k < 3; k++) {
        double a = (double)stroke->points[walk->at].at.raw[k];
        double b = (double)stroke->points[walk->at + 1].at.raw[k];
        point[k] = a + part * (b - a);
    }
}

void fr_stroke_at(const FrStroke *stroke, double distance, double point[3], double direction[3]) {
    // The last point that is not beyond the distance, with one after it that is elsewhere.
    size_t low = 0, high = stroke->count - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        bool is_before = stroke->distance[middle] <= distance &&
                         stroke->distance[middle] < fr_stroke_length(stroke);
        *(is_before ? &low : &high) = middle;
    }
    Walk walk = {stroke, low};
    walk_to(&walk, distance, point);
    double length = stroke->distance[walk.at + 1] - stroke->distance[walk.at];
    for (int k = 0; k < 3 && direction != NULL; k++) {
        double from = (double)stroke->points[walk.at].at.raw[k];
        double to = (double)stroke->points[walk.at + 1].at.raw[k];
        direction[k] = length > 0 ? (to - from) / length : (double)(k == 0);
    }
}

void fr_stroke_resample(const FrStroke *stroke, const float *lengths, size_t count,
                        vec3s *headings) {
    double total = 0;
    for (size_t n = 0; n < count; n++) {
        total += (double)lengths[n];
    }
    double whole = fr_stroke_length(stroke), reached = 0;
    Walk walk = {stroke, 0};
    double from[3], to[3];
    walk_to(&walk, 0, from);
    vec3s heading = {{0, 0, 1}};
    size_t waiting = 0; // joints at the base that have no direction yet
    for (size_t n = 0; n < count; n++) {
        reached += total > 0 ? (double)lengths[n] / total : 1.0 / (double)count;
        walk_to(&walk, reached * whole, to);
        double chord[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        double norm = sqrt(chord[0] * chord[0] + chord[1] * chord[1] + chord[2] * chord[2]);
        if (norm > 1e-9 * whole) {
            for (int k = 0; k < 3; k++) {
                heading.raw[k] = (float)(chord[k] / norm);
            }
            for (; waiting > 0; waiting--) {
                headings[n - waiting] = heading;
            }
            memcpy(from, to, sizeof from);
        } else if (n == 0 || waiting > 0) {
            waiting++;
        }
        headings[n] = heading;
    }
}

// ---- text -------------------------------------------------------------------------------------

enum { NUMBERS = 5 };

/// Reads one point; false if it is wrong. *text stops behind it.
static bool read_point(const char **text, FrStrokePoint *point) {
    double numbers[NUMBERS] = {0, 0, 0, 1, 0};
    int count = 0;
    const char *at = *text;
    for (; count < NUMBERS; count++) {
        if (g_ascii_isspace(*at) || *at == '\0') {
            break;
        }
        char *end;
        numbers[count] = g_ascii_strtod(at, &end);
        if (end == at || !isfinite(numbers[count])) {
            return false;
        }
        at = end;
        if (*at != ',') {
            count++;
            break;
        }
        at++;
    }
    *text = at;
    for (int k = 0; k < 3; k++) {
        point->at.raw[k] = (float)numbers[k];
    }
    point->pressure = (float)numbers[3];
    point->time = numbers[4];
    return count >= 3 && (*at == '\0' || g_ascii_isspace(*at)) && at[-1] != ',';
}

FrStroke *fr_stroke_parse(const char *text, FrSpan span, FrDiags *diags) {
    GArray *points = g_array_new(FALSE, FALSE, sizeof(FrStrokePoint));
    const char *at = text;
    FrStroke *stroke = NULL;
    for (;;) {
        while (g_ascii_isspace(*at)) {
            at++;
        }
        if (*at == '\0') {
            stroke = fr_stroke_new((const FrStrokePoint *)(const void *)points->data, points->len);
            if (stroke == NULL) {
                fr_diags_add(diags, FR_ERROR, "bad-stroke", span,
                             "two different points are needed at least, none farther than 1e9 m");
            }
            break;
        }
        const char *begin = at;
        FrStrokePoint point;
        if (!read_point(&at, &point)) {
            int shown = (int)MIN(strcspn(begin, " \t\r\n"), 40);
            fr_diags_add(diags, FR_ERROR, "bad-stroke", span,
                         "point %u is '%.*s'; points are x,y,z with a pressure and a "
                         "time if need be",
                         points->len + 1, shown, begin);
            break;
        }
        g_array_append_val(points, point);
    }
    g_array_unref(points);
    return stroke;
}

char *fr_stroke_text(const FrStroke *stroke) {
    GString *text = g_string_new(NULL);
    char number[G_ASCII_DTOSTR_BUF_SIZE];
    for (size_t i = 0; i < stroke->count; i++) {
        const FrStrokePoint *point = &stroke->points[i];
        for (int k = 0; k < 3; k++) {
            g_ascii_formatd(number, sizeof number, "%.9g", (double)point->at.raw[k]);
            g_string_append_printf(text, "%s%s", k > 0 ? "," : (i > 0 ? " " : ""), number);
        }
        if (point->pressure != 1 || point->time != 0) {
            g_ascii_formatd(number, sizeof number, "%.9g", (double)point->pressure);
            g_string_append_printf(text, ",%s", number);
            g_string_append_printf(text, ",%s", g_ascii_dtostr(number, sizeof number, point->time));
        }
    }
    return g_string_free(text, FALSE);
}
