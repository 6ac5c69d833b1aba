// Blue noise over triangles: the best of several candidates, each drawn evenly by area.
// Mitchell. Spectrally Optimal Sampling for Distribution Ray Tracing. SIGGRAPH 1991.
#include "pgraph/strewn.h"

#include "pgraph/near.h"

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
}

void fr_strewn_free(FrStrewnSurface *surface) {
    if (surface != NULL) {
        g_free(surface->below);
        fr_image_unref(surface->map);
        g_free(surface);
    }
}

// The first triangle up to which there is more area than `area`.
static uint32_t triangle_at(const FrStrewnSurface *surface, double area) {
    uint32_t low = 0, high = surface->file->index_count / 3 - 1;
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

// Draws a point evenly by area; false if it is too low, too high or where the map is dark.
static bool draw_once(const FrStrewnSurface *surface, FrKey key, uint32_t k, FrStrewnPoint *point) {
    const FrMeshFile *file = surface->file;
    uint32_t t = triangle_at(surface, surface->area * fr_random(key, 0, k));
    double root = sqrt(fr_random(key, 1, k)), part = fr_random(key, 2, k);
    double weight[3] = {1 - root, root * (1 - part), root * part}, uv[2] = {0, 0};
    *point = (FrStrewnPoint){0};
    for (int c = 0; c < 3; c++) {
        double at[3];
        corner(file, t, c, at);
        const float *own = file->uvs[file->indices[3 * t + (uint32_t)c]];
        for (int r = 0; r < 3; r++) {
            point->at[r] += weight[c] * at[r];
        }
        uv[0] += weight[c] * (double)own[0];
        uv[1] += weight[c] * (double)own[1];
    }
    area_normal(file, t, point->normal);
    double size = length_of(point->normal);
    for (int r = 0; r < 3; r++) {
        point->normal[r] = size > 0 ? point->normal[r] / size : r == 2;
    }
    return point->at[2] >= surface->least_height && point->at[2] <= surface->most_height &&
           (surface->map == NULL || fr_random(key, 3, k) < brightness(surface->map, uv[0], uv[1]));
}

static void draw(const FrStrewnSurface *surface, FrKey key, FrStrewnPoint *point) {
    bool is_drawn = false;
    for (uint32_t k = 0; k < MOST_TRIES && !is_drawn; k++) {
        is_drawn = draw_once(surface, key, k, point);
    }
}

void fr_strew(const FrStrewnSurface *surface, FrStrewnPoint *points, uint32_t count,
              uint32_t candidates, FrKey key, const FrProgress *progress) {
    FrNear *near = fr_near_new(surface->area, count);
    for (uint32_t i = 0; i < count; i++) {
        candidates = i % 256 == 0 && fr_progress_is_cancelled(progress) ? 1 : candidates;
        double best = -1;
        for (uint32_t c = 0; c < candidates; c++) {
            FrStrewnPoint point;
            draw(surface, fr_key_child(fr_key_child(key, i), c), &point);
            double distance = candidates > 1 ? fr_near_distance(near, point.at, best) : 0;
            if (distance > best) {
                best = distance;
                points[i] = point;
            }
        }
        fr_near_add(near, points[i].at);
    }
    fr_near_free(near);
}
