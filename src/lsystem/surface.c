// Surfaces: bicubic Bézier patches or triangles, brought into the turtle's axes.
#include "lsystem/companion.h"

#include <math.h>
#include <string.h>

#define MOST_PATCHES 10000

/// How a surface file lies in space.
typedef struct Basis {
    double contact[3], end[3], heading[3], up[3], left[3];
    double size;
    int s, t;
} Basis;

static void unit(double v[3]) {
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0; k++) {
        v[k] /= length;
    }
}

/// A point of the file in the turtle's axes, from the contact point, in units of the view. As in
/// cpfg the coordinates count along the basis, whose x is left, y heading and z up.
static void place(const Basis *basis, double scale, const double point[3], double out[3]) {
    double d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = (point[k] - basis->contact[k]) * scale;
    }
    for (int k = 0; k < 3; k++) {
        out[k] = d[0] * basis->left[k] + d[1] * basis->heading[k] + d[2] * basis->up[k];
    }
}

static bool read_keyword(Basis *basis, const char *line) {
    double n[3] = {0, 0, 0};
    int count = fr_lcompanion_numbers(line, n, 3);
    if (g_str_has_prefix(line, "PRECISION")) {
        basis->s = count > 0 ? (int)n[0] : basis->s;
        basis->t = count > 1 ? (int)n[1] : basis->t;
    } else if (g_str_has_prefix(line, "CONTACT POINT")) {
        memcpy(basis->contact, n, sizeof n);
    } else if (g_str_has_prefix(line, "END POINT")) {
        memcpy(basis->end, n, sizeof n);
    } else if (g_str_has_prefix(line, "HEADING")) {
        memcpy(basis->heading, n, sizeof n);
    } else if (g_str_has_prefix(line, "UP")) {
        memcpy(basis->up, n, sizeof n);
    } else if (g_str_has_prefix(line, "SIZE")) {
        basis->size = n[0] > 0 ? n[0] : 1;
    } else {
        return false;
    }
    return true;
}

static void bezier(const double points[16][3], double s, double t, double out[3]) {
    double u = 1 - s, v = 1 - t;
    double a[4] = {u * u * u, 3 * u * u * s, 3 * u * s * s, s * s * s};
    double b[4] = {v * v * v, 3 * v * v * t, 3 * v * t * t, t * t * t};
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            for (int k = 0; k < 3; k++) {
                out[k] += a[i] * b[j] * points[4 * i + j][k];
            }
        }
    }
}

static void add_corner(GArray *corners, const Basis *basis, double scale, const double at[3]) {
    double c[3];
    place(basis, scale, at, c);
    float corner[3] = {(float)c[0], (float)c[1], (float)c[2]};
    g_array_append_vals(corners, corner, 1);
}

static void add_patch(GArray *corners, GArray *hull, const Basis *basis, double scale,
                      const double points[16][3], int s, int t) {
    static const int order[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < 16; i++) {
        double at[3];
        place(basis, scale, points[i], at);
        g_array_append_vals(hull, at, 1);
    }
    for (int i = 0; i < s; i++) {
        for (int j = 0; j < t; j++) {
            for (int c = 0; c < 6; c++) {
                double at[3];
                bezier(points, (double)(i + order[c][0]) / s, (double)(j + order[c][1]) / t, at);
                add_corner(corners, basis, scale, at);
            }
        }
    }
}

/// `hull` is NULL for triangles, whose corners bound them.
static bool add_surface(GArray *surfaces, const Basis *basis, double scale, char symbol,
                        GArray *corners, GArray *hull) {
    FrLsurface surface = {.symbol = symbol, .count = corners->len, .is_mesh = hull == NULL};
    bool is_empty = corners->len == 0;
    place(basis, scale, basis->end, surface.end);
    surface.corners = (float(*)[3])(void *)g_array_free(corners, FALSE);
    if (hull != NULL) {
        surface.hull_count = hull->len;
        surface.hull = (double(*)[3])(void *)g_array_free(hull, FALSE);
    }
    if (is_empty) {
        g_free(surface.corners);
        g_free(surface.hull);
        return false;
    }
    g_array_append_val(surfaces, surface);
    return true;
}

static Basis basis_default(void) {
    return (Basis){.heading = {0, 1, 0}, .up = {0, 0, 1}, .size = 1, .s = 5, .t = 5};
}

static void settle(Basis *basis) {
    unit(basis->heading);
    unit(basis->up);
    basis->left[0] = basis->heading[1] * basis->up[2] - basis->heading[2] * basis->up[1];
    basis->left[1] = basis->heading[2] * basis->up[0] - basis->heading[0] * basis->up[2];
    basis->left[2] = basis->heading[0] * basis->up[1] - basis->heading[1] * basis->up[0];
    const double *left = basis->left, *heading = basis->heading;
    basis->up[0] = left[1] * heading[2] - left[2] * heading[1];
    basis->up[1] = left[2] * heading[0] - left[0] * heading[2];
    basis->up[2] = left[0] * heading[1] - left[1] * heading[0];
}

bool fr_lcompanion_patches(FrSource *source, GArray *surfaces, char symbol, double size, int s,
                           int t) {
    size_t bytes;
    char **lines = g_strsplit(fr_source_text(source, &bytes), "\n", -1);
    GArray *corners = g_array_new(FALSE, FALSE, 3 * sizeof(float));
    GArray *hull = g_array_new(FALSE, FALSE, 3 * sizeof(double));
    Basis basis = basis_default();
    double points[16][3];
    int rows = 0, patches = 0;
    for (char **line = lines; *line != NULL && patches < MOST_PATCHES; line++) {
        char *text = g_strstrip(*line);
        if (read_keyword(&basis, text)) {
            continue;
        }
        double n[12];
        if (g_ascii_isalpha(*text) || fr_lcompanion_numbers(text, n, 12) < 12) {
            continue;
        }
        memcpy(points[4 * rows], n, sizeof n);
        if (++rows == 4) {
            settle(&basis);
            add_patch(corners, hull, &basis, size / basis.size, (const double(*)[3])points,
                      CLAMP(s > 0 ? s : basis.s, 1, 40), CLAMP(t > 0 ? t : basis.t, 1, 40));
            rows = 0;
            patches++;
        }
    }
    g_strfreev(lines);
    settle(&basis);
    return add_surface(surfaces, &basis, size / basis.size, symbol, corners, hull);
}

double (*fr_lcompanion_section(const FrLsurface *surface, uint32_t *count))[2] {
    enum { STEPS = 8 };
    uint32_t patches = surface->hull_count / 16;
    double(*section)[2] = g_malloc_n(patches * STEPS + 1, sizeof *section);
    *count = 0;
    for (uint32_t p = 0; p < patches; p++) {
        const double(*points)[3] = (const double(*)[3])surface->hull + 16 * (size_t)p;
        // Rows go around and columns along, or the other way round.
        bool is_along = fabs(points[3][1] - points[0][1]) > fabs(points[12][1] - points[0][1]);
        for (int i = 0; i < STEPS; i++) {
            double at[3], part = (double)i / STEPS;
            bezier(points, is_along ? part : 0.5, is_along ? 0.5 : part, at);
            section[*count][0] = 2 * at[0];
            section[(*count)++][1] = -2 * at[2];
        }
    }
    if (*count < 3) {
        g_free(section);
        return NULL;
    }
    return section;
}

bool fr_lcompanion_triangles(FrSource *source, GArray *surfaces, char symbol, double size) {
    size_t bytes;
    char **lines = g_strsplit(fr_source_text(source, &bytes), "\n", -1);
    GArray *corners = g_array_new(FALSE, FALSE, 3 * sizeof(float));
    Basis basis = basis_default();
    settle(&basis);
    for (char **line = lines; *line != NULL && corners->len < 3000000; line++) {
        char *text = g_strstrip(*line);
        double n[8];
        if (read_keyword(&basis, text)) {
            settle(&basis);
        } else if (!g_ascii_isalpha(*text) && fr_lcompanion_numbers(text, n, 8) >= 6) {
            add_corner(corners, &basis, size / basis.size, n);
        }
    }
    g_array_set_size(corners, corners->len - corners->len % 3);
    g_strfreev(lines);
    return add_surface(surfaces, &basis, size / basis.size, symbol, corners, NULL);
}
