// Distances from stems: branch and bound over a binary tree of boxes around middle lines, each with
// the thickest radius in it.
#include "space/stems.h"

#include <glib.h>
#include <math.h>

enum { LEAF = 4, DEEPEST = 64 };

/// A leaf holds stems first … first + count − 1; others have two children: the next node, and
/// `second`.
typedef struct Node {
    double min[3], max[3]; ///< of the middle lines
    double thickest;
    uint32_t first, count, second;
} Node;

struct FrStems {
    FrStem *stems;
    Node *nodes;
    uint32_t count, node_count;
};

// ---- the tree ---------------------------------------------------------------------------------

static int compare_numbers(const double *a, const double *b, int count) {
    for (int k = 0; k < count; k++) {
        if (a[k] != b[k]) {
            return a[k] < b[k] ? -1 : 1;
        }
    }
    return 0;
}

/// By the middle along an axis, and then by all that a stem is: equal ones may stand either way.
static int compare_stems(const void *a, const void *b, void *data) {
    const FrStem *p = a, *q = b;
    int axis = *(const int *)data;
    double left = p->from[axis] + p->to[axis], right = q->from[axis] + q->to[axis];
    int order = compare_numbers(&left, &right, 1);
    order = order != 0 ? order : compare_numbers(p->from, q->from, 3);
    order = order != 0 ? order : compare_numbers(p->to, q->to, 3);
    return order != 0 ? order : compare_numbers(p->radius, q->radius, 2);
}

static Node enclose(const FrStem *stems, uint32_t first, uint32_t count) {
    Node node = {.first = first, .count = count};
    for (int r = 0; r < 3; r++) {
        node.min[r] = INFINITY;
        node.max[r] = -INFINITY;
        for (uint32_t k = first; k < first + count; k++) {
            node.min[r] = fmin(node.min[r], fmin(stems[k].from[r], stems[k].to[r]));
            node.max[r] = fmax(node.max[r], fmax(stems[k].from[r], stems[k].to[r]));
        }
    }
    for (uint32_t k = first; k < first + count; k++) {
        node.thickest = fmax(node.thickest, fmax(stems[k].radius[0], stems[k].radius[1]));
    }
    return node;
}

static uint32_t build(FrStems *stems, uint32_t first, uint32_t count) {
    uint32_t own = stems->node_count++;
    Node node = enclose(stems->stems, first, count);
    if (count > LEAF) {
        int axis = 0;
        for (int r = 1; r < 3; r++) {
            axis = node.max[r] - node.min[r] > node.max[axis] - node.min[axis] ? r : axis;
        }
        g_qsort_with_data(stems->stems + first, (gint)count, sizeof(FrStem), compare_stems, &axis);
        node.count = 0;
        build(stems, first, count / 2);
        node.second = build(stems, first + count / 2, count - count / 2);
    }
    stems->nodes[own] = node;
    return own;
}

FrStems *fr_stems_new(const FrStem *stems, uint32_t count) {
    if (count == 0) {
        return NULL;
    }
    FrStems *made = g_new0(FrStems, 1);
    made->stems = g_memdup2(stems, count * sizeof *stems);
    made->nodes = g_new(Node, count);
    made->count = count;
    build(made, 0, count);
    return made;
}

void fr_stems_free(FrStems *stems) {
    if (stems != NULL) {
        g_free(stems->stems);
        g_free(stems->nodes);
        g_free(stems);
    }
}

uint64_t fr_stems_bytes(uint64_t count) {
    return count * (sizeof(FrStem) + sizeof(Node));
}

uint32_t fr_stems_count(const FrStems *stems) {
    return stems == NULL ? 0 : stems->count;
}

// ---- asking -----------------------------------------------------------------------------------

/// Square of the distance of a point from a box.
static inline double box_square(const Node *node, const double at[3]) {
    double square = 0;
    for (int r = 0; r < 3; r++) {
        double below = node->min[r] - at[r], above = at[r] - node->max[r];
        double off = below > above ? below : above;
        square += off > 0 ? off * off : 0;
    }
    return square;
}

/// True if a stem in a box may be nearer than that.
static inline bool may_be_nearer(const Node *node, double square, double distance) {
    double far = distance + node->thickest;
    return far > 0 && square < far * far;
}

/// A unit vector across the middle line, for a point on it.
static void across(const FrStem *stem, double out[3]) {
    double along[3], size = 0;
    int least = 0;
    for (int r = 0; r < 3; r++) {
        along[r] = stem->to[r] - stem->from[r];
        least = fabs(along[r]) < fabs(along[least]) ? r : least;
    }
    int next = (least + 1) % 3, last = (least + 2) % 3;
    out[least] = 0;
    out[next] = -along[last];
    out[last] = along[next];
    size = hypot(out[next], out[last]);
    out[least] = size > 0 ? 0 : 1;
    out[next] = size > 0 ? out[next] / size : 0;
    out[last] = size > 0 ? out[last] / size : 0;
}

static void ask(const FrStem *stem, const double at[3], double thinnest, FrBark *bark) {
    double along = 0, square = 0, way[3], off = 0;
    for (int r = 0; r < 3; r++) {
        double d = stem->to[r] - stem->from[r];
        along += (at[r] - stem->from[r]) * d;
        square += d * d;
    }
    double t = along <= 0 ? 0 : along >= square ? 1 : along / square;
    for (int r = 0; r < 3; r++) {
        double on = t < 1 ? stem->from[r] + t * (stem->to[r] - stem->from[r]) : stem->to[r];
        way[r] = at[r] - on;
        off += way[r] * way[r];
    }
    double radius = stem->radius[0] + t * (stem->radius[1] - stem->radius[0]);
    double far = bark->distance + radius;
    if (radius < thinnest || far <= 0 || off >= far * far) {
        return;
    }
    bark->distance = sqrt(off) - radius;
    bark->radius = radius;
    if (off > 1e-20) {
        for (int r = 0; r < 3; r++) {
            bark->outward[r] = way[r] / sqrt(off);
        }
    } else {
        across(stem, bark->outward);
    }
}

FrBark fr_stems_near(const FrStems *stems, const double at[3], double reach, double thinnest) {
    FrBark bark = {.distance = reach};
    uint32_t stack[DEEPEST] = {0}, depth = stems != NULL;
    while (depth > 0) {
        uint32_t own = stack[--depth];
        const Node *node = &stems->nodes[own];
        if (node->thickest < thinnest ||
            !may_be_nearer(node, box_square(node, at), bark.distance)) {
            continue;
        }
        for (uint32_t k = 0; k < node->count; k++) {
            ask(&stems->stems[node->first + k], at, thinnest, &bark);
        }
        if (node->count == 0) {
            bool is_low_near = box_square(&stems->nodes[own + 1], at) <=
                               box_square(&stems->nodes[node->second], at);
            stack[depth++] = is_low_near ? node->second : own + 1;
            stack[depth++] = is_low_near ? own + 1 : node->second;
        }
    }
    bark.distance = bark.distance < reach ? bark.distance : INFINITY;
    return bark;
}
