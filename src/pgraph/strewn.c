// Blue noise over triangles: the best of several candidates, each drawn evenly by area.
// Mitchell. Spectrally Optimal Sampling for Distribution Ray Tracing. SIGGRAPH 1991.
#include "pgraph/strewn.h"

#include "pgraph/farthest.h"

#include <glib.h>
#include <math.h>

enum { MOST_TRIES = 256 }; // for a candidate

static void corner(const FrMeshFile *file, uint32_t triangle, int k, double at[3]) {
    vec3s from = file->positions[file->indices[3 * triangle + (uint32_t)k]];
    for (int r = 0; r < 3; r++) {
        at[r] = (double)from.raw[r];
    }
}

// The normal of a triangle, as long as its area twice over.
static void area_normal(const FrMeshFile *file, uint32_t triangle, double normal[3]) {
    double a[3], b[3], c[3];
    corner(file, triangle, 0, a);
    corner(file, triangle, 1, b);
    corner(file, triangle, 2, c);
    for (int r = 0; r < 3; r++) {
        b[r] -= a[r];
        c[r] -= a[r];
    }
    normal[0] = b[1] * c[2] - b[2] * c[1];
    normal[1] = b[2] * c[0] - b[0] * c[2];
    normal[2] = b[0] * c[1] - b[1] * c[0];
}

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static bool reaches_heights(const FrStrewnSurface *surface, uint32_t triangle) {
    double low = INFINITY, high = -INFINITY, at[3];
    for (int k = 0; k < 3; k++) {
        corner(surface->file, triangle, k, at);
        low = fmin(low, at[2]);
        high = fmax(high, at[2]);
    }
    return high >= surface->least_height && low <= surface->most_height;
}

// Where to look for a part of the area: the first triangles of as many equal parts as there are
// triangles.
static void make_guide(FrStrewnSurface *surface, uint32_t count) {
    surface->guide = g_new(uint32_t, (size_t)count + 1);
    uint32_t t = 0;
    for (uint32_t part = 0; part <= count; part++) {
        double area = surface->area * ((double)part / count);
        while (t + 1 < count && surface->below[t] <= area) {
            t++;
        }
        surface->guide[part] = t;
    }
}

void fr_strewn_init(FrStrewnSurface *surface) {
    uint32_t count = surface->file->index_count / 3;
    surface->below = g_new(double, count);
    surface->area = 0;
    for (uint32_t t = 0; t < count; t++) {
        double normal[3];
        area_normal(surface->file, t, normal);
        double size = length_of(normal);
        double slope = size > 0 ? acos(fmax(-1, fmin(normal[2] / size, 1))) : 0;
        bool is_fine = slope >= surface->least_slope && slope <= surface->most_slope &&
                       reaches_heights(surface, t);
        surface->area += is_fine ? 0.5 * size : 0;
        surface->below[t] = surface->area;
    }
    make_guide(surface, count);
}

void fr_strewn_free(FrStrewnSurface *surface) {
    if (surface != NULL) {
        g_free(surface->below);
        g_free(surface->guide);
        fr_image_unref(surface->map);
        g_free(surface);
    }
}

// The first triangle up to which there is more than a part of the area.
static uint32_t triangle_at(const FrStrewnSurface *surface, double part) {
    uint32_t count = surface->file->index_count / 3;
    uint32_t guess = MIN((uint32_t)(part * count), count - 1);
    // A part that was rounded up or down may lie just outside.
    uint32_t low = surface->guide[guess - (guess > 0)];
    uint32_t high = surface->guide[MIN(guess + 2, count)];
    double area = surface->area * part;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (surface->below[middle] > area) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static double brightness(const FrImage *map, double u, double v) {
    double x = floor((u - floor(u)) * map->width), y = floor((v - floor(v)) * map->height);
    size_t column = (size_t)fmin(x, map->width - 1), row = (size_t)fmin(y, map->height - 1);
    const uint8_t *pixel = map->pixels + (row * map->width + column) * map->channels;
    return (map->channels == 1 ? pixel[0] : (pixel[0] + pixel[1] + pixel[2]) / 3.0) / 255;
}

// Draws a place evenly by area; false if it is too low, too high or where the map is dark.
static bool draw_once(const FrStrewnSurface *surface, FrKey key, uint32_t k, double place[3],
                      uint32_t *triangle) {
    const FrMeshFile *file = surface->file;
    uint32_t t = *triangle = triangle_at(surface, fr_random(key, 0, k));
    double root = sqrt(fr_random(key, 1, k)), part = fr_random(key, 2, k);
    double weight[3] = {1 - root, root * (1 - part), root * part}, uv[2] = {0, 0};
    place[0] = place[1] = place[2] = 0;
    for (int c = 0; c < 3; c++) {
        double at[3];
        corner(file, t, c, at);
        for (int r = 0; r < 3; r++) {
            place[r] += weight[c] * at[r];
        }
        if (surface->map != NULL) {
            const float *own = file->uvs[file->indices[3 * t + (uint32_t)c]];
            uv[0] += weight[c] * (double)own[0];
            uv[1] += weight[c] * (double)own[1];
        }
    }
    return place[2] >= surface->least_height && place[2] <= surface->most_height &&
           (surface->map == NULL || fr_random(key, 3, k) < brightness(surface->map, uv[0], uv[1]));
}

/// Draws a candidate; its triangle.
static uint32_t draw(const FrStrewnSurface *surface, FrKey key, double place[3]) {
    bool is_drawn = false;
    uint32_t triangle = 0;
    for (uint32_t k = 0; k < MOST_TRIES && !is_drawn; k++) {
        is_drawn = draw_once(surface, key, k, place, &triangle);
    }
    return triangle;
}

static void draw_candidate(const void *surface, FrKey key, uint32_t candidate, double at[3]) {
    draw(surface, fr_key_child(key, candidate), at);
}

/// Puts a point where a candidate is.
static void take(const FrStrewnSurface *surface, FrKey key, FrStrewnPoint *point) {
    uint32_t triangle = draw(surface, key, point->at);
    area_normal(surface->file, triangle, point->normal);
    double size = length_of(point->normal);
    for (int r = 0; r < 3; r++) {
        point->normal[r] = size > 0 ? point->normal[r] / size : r == 2;
    }
}

void fr_strew(const FrStrewnSurface *surface, FrStrewnPoint *points, uint32_t count,
              uint32_t candidates, FrKey key, const FrProgress *progress) {
    const FrCandidates drawn = {draw_candidate, surface, key, candidates, surface->area};
    uint32_t *chosen = fr_choose_farthest(&drawn, count, progress);
    for (uint32_t i = 0; i < count; i++) {
        take(surface, fr_key_child(fr_key_child(key, i), chosen[i]), &points[i]);
    }
    g_free(chosen);
}
