// What is wrong with a profile: edges are held against each other, sorted along x.
#include "skin/section.h"

#include <math.h>
#include <stdlib.h>

/// Nearer than this is touching.
#define NEAR 1e-7

typedef struct FrMarginEdge {
    double a[2], b[2];
    double left, right; ///< range of x
    uint32_t number;    ///< around the section
} FrMarginEdge;

static int compare_edges(const void *p, const void *q) {
    const FrMarginEdge *a = p, *b = q;
    return a->left != b->left ? (a->left < b->left ? -1 : 1)
                              : (a->number > b->number) - (a->number < b->number);
}

/// On which side of an edge's line a point is: -1, 0, 1.
static int side_of(const FrMarginEdge *edge, const double point[2]) {
    double x = edge->b[0] - edge->a[0], y = edge->b[1] - edge->a[1];
    double away =
        (x * (point[1] - edge->a[1]) - y * (point[0] - edge->a[0])) / fmax(hypot(x, y), NEAR);
    return away > NEAR ? 1 : away < -NEAR ? -1 : 0;
}

static bool overlap_upright(const FrMarginEdge *p, const FrMarginEdge *q) {
    return fmax(p->a[1], p->b[1]) + NEAR >= fmin(q->a[1], q->b[1]) &&
           fmax(q->a[1], q->b[1]) + NEAR >= fmin(p->a[1], p->b[1]);
}

/// Edges with no common end whose ranges of x overlap.
static bool touch(const FrMarginEdge *p, const FrMarginEdge *q) {
    return overlap_upright(p, q) && side_of(p, q->a) * side_of(p, q->b) <= 0 &&
           side_of(q, p->a) * side_of(q, p->b) <= 0;
}

/// True if the edge after another lies on it.
static bool runs_back(const FrMarginEdge *edge, const FrMarginEdge *after) {
    double along = (edge->b[0] - edge->a[0]) * (after->b[0] - after->a[0]) +
                   (edge->b[1] - edge->a[1]) * (after->b[1] - after->a[1]);
    return along < 0.0 && (side_of(edge, after->b) == 0 || side_of(after, edge->a) == 0);
}

static bool touches_itself(double (*points)[2], uint32_t count) {
    FrMarginEdge *edges = g_new(FrMarginEdge, count);
    for (uint32_t i = 0; i < count; i++) {
        const double *a = points[i], *b = points[(i + 1) % count];
        edges[i] = (FrMarginEdge){
            {a[0], a[1]}, {b[0], b[1]}, fmin(a[0], b[0]), fmax(a[0], b[0]) + NEAR, i};
    }
    bool is_found = false;
    for (uint32_t i = 0; i < count && !is_found; i++) {
        is_found = runs_back(&edges[i], &edges[(i + 1) % count]);
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (uint32_t i = 0; i < count && !is_found; i++) {
        for (uint32_t j = i + 1; j < count && edges[j].left <= edges[i].right && !is_found; j++) {
            uint32_t apart = edges[i].number > edges[j].number ? edges[i].number - edges[j].number
                                                               : edges[j].number - edges[i].number;
            is_found = apart > 1 && apart + 1 < count && touch(&edges[i], &edges[j]);
        }
    }
    g_free(edges);
    return is_found;
}

FrSectionFault fr_section_fault(const FrProfile *profile) {
    double(*points)[2] = g_malloc_n(MAX(profile->count, 1), sizeof *points);
    uint32_t count = fr_section_points(profile, points);
    FrSectionFault fault = FR_SECTION_SOUND;
    if (count < (profile->is_closed ? 3U : 2U)) {
        fault = FR_SECTION_FEW;
    }
    for (uint32_t i = 0; i < profile->count && fault == FR_SECTION_SOUND; i++) {
        fault = fr_section_is_near(profile->points[i]) ? fault : FR_SECTION_FAR;
    }
    if (fault == FR_SECTION_SOUND && profile->is_closed && count <= FR_SECTION_LOOKED_MOST &&
        touches_itself(points, count)) {
        fault = FR_SECTION_TOUCHES;
    }
    g_free(points);
    return fault;
}
