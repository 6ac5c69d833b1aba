// Triangles between two rings of points, one within the other, by the cheapest way around.
// Fuchs, Kedem, Uselton. Optimal surface reconstruction from planar contours. CACM 20(10), 1977.
//
// A strip is a path through a table: a step right takes the next point of the outer ring, a step
// down that of the inner one, and each step is a triangle. It costs the square of its new edge, and
// is forbidden if the triangle is turned over where the surface is unrolled.
#include "skin/weld.h"

#include <cglm/struct.h>

#include <math.h>

// Twice the smallest area of a triangle, in quads.
#define LEAST_AREA 1e-4F

typedef struct FrStrip {
    const FrWeldPoint *outer, *inner;
    uint32_t outer_count, inner_count;
    uint32_t begin; ///< of the outer ring: opposite the first of the inner one
    float *costs;   ///< (outer_count + 1) columns, (inner_count + 1) rows
    bool *is_inner; ///< the step that came there
} FrStrip;

static const FrWeldPoint *outer_at(const FrStrip *strip, uint32_t i) {
    return &strip->outer[(strip->begin + i) % strip->outer_count];
}

static const FrWeldPoint *inner_at(const FrStrip *strip, uint32_t j) {
    return &strip->inner[j % strip->inner_count];
}

static bool is_upright(const FrWeldPoint *a, const FrWeldPoint *b, const FrWeldPoint *c) {
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x) > LEAST_AREA;
}

static void fill_cell(FrStrip *strip, uint32_t i, uint32_t j) {
    uint32_t columns = strip->outer_count + 1, at = j * columns + i;
    const FrWeldPoint *outer = outer_at(strip, i), *inner = inner_at(strip, j);
    float edge = glms_vec3_distance2(outer->at, inner->at);
    float best = i == 0 && j == 0 ? 0.0F : INFINITY;
    if (i > 0 && is_upright(outer_at(strip, i - 1), outer, inner)) {
        best = strip->costs[at - 1] + edge;
        strip->is_inner[at] = false;
    }
    if (j > 0 && is_upright(inner, inner_at(strip, j - 1), outer) &&
        strip->costs[at - columns] + edge < best) {
        best = strip->costs[at - columns] + edge;
        strip->is_inner[at] = true;
    }
    strip->costs[at] = best;
}

static bool fill_table(FrStrip *strip) {
    for (uint32_t j = 0; j <= strip->inner_count; j++) {
        for (uint32_t i = 0; i <= strip->outer_count; i++) {
            fill_cell(strip, i, j);
        }
    }
    uint32_t cells = (strip->outer_count + 1) * (strip->inner_count + 1);
    return isfinite(strip->costs[cells - 1]);
}

static void walk_back(const FrStrip *strip, uint32_t (*triangles)[3]) {
    uint32_t i = strip->outer_count, j = strip->inner_count;
    for (uint32_t k = i + j; k-- > 0;) {
        bool is_inner = strip->is_inner[j * (strip->outer_count + 1) + i];
        uint32_t outer = (strip->begin + i) % strip->outer_count;
        uint32_t inner = strip->outer_count + j % strip->inner_count;
        if (is_inner) {
            j--;
            triangles[k][0] = inner;
            triangles[k][1] = strip->outer_count + j % strip->inner_count;
            triangles[k][2] = outer;
        } else {
            i--;
            triangles[k][0] = (strip->begin + i) % strip->outer_count;
            triangles[k][1] = outer;
            triangles[k][2] = inner;
        }
    }
}

static uint32_t nearest_to(const FrWeldPoint *inner, const FrWeldPoint *outer, uint32_t count) {
    uint32_t nearest = 0;
    for (uint32_t i = 1; i < count; i++) {
        float apart = glms_vec3_distance2(outer[i].at, inner->at);
        nearest = apart < glms_vec3_distance2(outer[nearest].at, inner->at) ? i : nearest;
    }
    return nearest;
}

uint32_t fr_weld_strip(const FrWeldPoint *outer, uint32_t outer_count, const FrWeldPoint *inner,
                       uint32_t inner_count, uint32_t (*triangles)[3]) {
    FR_ASSERT(outer_count >= 3 && inner_count >= 3 && outer_count + inner_count <= FR_WELD_MOST);
    size_t cells = (size_t)(outer_count + 1) * (inner_count + 1);
    FrStrip strip = {
        .outer = outer,
        .inner = inner,
        .outer_count = outer_count,
        .inner_count = inner_count,
        .costs = g_new(float, cells),
        .is_inner = g_new0(bool, cells),
    };
    uint32_t first = nearest_to(inner, outer, outer_count);
    bool is_found = false;
    for (uint32_t k = 0; k < outer_count && !is_found; k++) {
        strip.begin = (first + k) % outer_count;
        is_found = fill_table(&strip);
    }
    if (is_found) {
        walk_back(&strip, triangles);
    }
    g_free(strip.costs);
    g_free(strip.is_inner);
    return is_found ? outer_count + inner_count : 0;
}
