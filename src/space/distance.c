// Distances from a surface of triangles.
//
// The nearest point is found by branch and bound over a binary tree of boxes. The side it is on is
// told by the angle-weighted normal of the face, edge or corner that is nearest:
// Bærentzen, Aanæs. Signed Distance Computation Using the Angle Weighted Pseudonormal. IEEE
// Transactions on Visualization and Computer Graphics 11 (3), 2005.
// Nearest points of triangles after: Ericson. Real-Time Collision Detection, 5.1.5. 2005.
#include "frond/distance.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { LEAF = 4, DEEPEST = 64 };

// Which part of a triangle is nearest: a corner, an edge (from its corner on), or its inside.
enum { AT_CORNER, AT_EDGE = 3, AT_FACE = 6 };

typedef struct Triangle {
    double corner[3][3];
    double normal[7][3]; ///< of corners, edges, face
} Triangle;

typedef struct Box {
    double min[3], max[3];
} Box;

/// A leaf holds triangles first … first + count − 1; others have two children: the next node, and
/// `second`.
typedef struct Node {
    Box box;
    uint32_t first, count, second;
} Node;

struct FrDistance {
    Triangle *triangles;
    Node *nodes;
    uint32_t count, node_count;
    bool is_closed;
};

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void minus(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static bool normalize(double v[3]) {
    double size = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] = size > 0 ? v[k] / size : 0;
    }
    return size > 0;
}

// ---- normals ----------------------------------------------------------------------------------

// Corners at one place are one, however often the file has them.
typedef struct Weld {
    GHashTable *places; ///< vec3s → number + 1
    uint32_t *number;   ///< by vertex
} Weld;

static guint hash_place(gconstpointer key) {
    uint32_t bits[3];
    memcpy(bits, key, sizeof bits);
    return bits[0] * 73856093u ^ bits[1] * 19349663u ^ bits[2] * 83492791u;
}

static gboolean same_place(gconstpointer a, gconstpointer b) {
    return memcmp(a, b, sizeof(vec3s)) == 0;
}

static void weld(Weld *welded, vec3s *positions, uint32_t count) {
    welded->places = g_hash_table_new(hash_place, same_place);
    welded->number = g_new(uint32_t, MAX(count, 1));
    for (uint32_t k = 0; k < count; k++) {
        guint known = GPOINTER_TO_UINT(g_hash_table_lookup(welded->places, &positions[k]));
        welded->number[k] = known > 0 ? known - 1 : k;
        if (known == 0) {
            g_hash_table_insert(welded->places, &positions[k], GUINT_TO_POINTER(k + 1));
        }
    }
}

// An edge between two corners, and what is known of it.
typedef struct Edge {
    uint64_t key;
    uint32_t triangle, side;
} Edge;

static int compare_edges(const void *a, const void *b) {
    const Edge *p = a, *q = b;
    if (p->key != q->key) {
        return p->key < q->key ? -1 : 1;
    }
    uint32_t i = p->triangle * 3 + p->side, j = q->triangle * 3 + q->side;
    return i < j ? -1 : i > j;
}

static double corner_angle(const Triangle *triangle, int k) {
    double a[3], b[3];
    minus(triangle->corner[(k + 1) % 3], triangle->corner[k], a);
    minus(triangle->corner[(k + 2) % 3], triangle->corner[k], b);
    normalize(a);
    normalize(b);
    return acos(fmax(-1, fmin(dot(a, b), 1)));
}

// Sums the normals at welded corners.
static void sum_corners(FrDistance *distance, const uint32_t *corners, uint32_t vertices) {
    double(*sum)[3] = g_malloc0_n(MAX(vertices, 1), sizeof *sum);
    for (uint32_t t = 0; t < distance->count; t++) {
        const Triangle *triangle = &distance->triangles[t];
        for (int k = 0; k < 3; k++) {
            double angle = corner_angle(triangle, k);
            for (int r = 0; r < 3; r++) {
                sum[corners[3 * t + (uint32_t)k]][r] += angle * triangle->normal[AT_FACE][r];
            }
        }
    }
    for (uint32_t t = 0; t < distance->count; t++) {
        for (int k = 0; k < 3; k++) {
            memcpy(distance->triangles[t].normal[AT_CORNER + k], sum[corners[3 * t + (uint32_t)k]],
                   sizeof *sum);
        }
    }
    g_free(sum);
}

// Sums the normals at edges; tells whether each has two sides.
static void sum_edges(FrDistance *distance, const uint32_t *corners) {
    uint32_t count = 3 * distance->count;
    Edge *edges = g_new(Edge, count);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t a = corners[k], b = corners[k % 3 == 2 ? k - 2 : k + 1];
        edges[k] = (Edge){(uint64_t)MIN(a, b) << 32 | MAX(a, b), k / 3, k % 3};
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    distance->is_closed = true;
    for (uint32_t first = 0, end; first < count; first = end) {
        double sum[3] = {0, 0, 0};
        for (end = first; end < count && edges[end].key == edges[first].key; end++) {
            for (int r = 0; r < 3; r++) {
                sum[r] += distance->triangles[edges[end].triangle].normal[AT_FACE][r];
            }
        }
        distance->is_closed &= (end - first) % 2 == 0;
        for (uint32_t k = first; k < end; k++) {
            Triangle *triangle = &distance->triangles[edges[k].triangle];
            memcpy(triangle->normal[AT_EDGE + edges[k].side], sum, sizeof sum);
        }
    }
    g_free(edges);
}

// ---- the tree ---------------------------------------------------------------------------------

// A triangle on its way into the tree.
typedef struct Item {
    double middle[3];
    uint32_t triangle;
} Item;

static void widen(Box *box, const Triangle *triangle) {
    for (int k = 0; k < 3; k++) {
        for (int r = 0; r < 3; r++) {
            box->min[r] = fmin(box->min[r], triangle->corner[k][r]);
            box->max[r] = fmax(box->max[r], triangle->corner[k][r]);
        }
    }
}

static int compare_items(const void *a, const void *b, void *data) {
    const Item *p = a, *q = b;
    int axis = *(const int *)data;
    if (p->middle[axis] != q->middle[axis]) {
        return p->middle[axis] < q->middle[axis] ? -1 : 1;
    }
    return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

static uint32_t build(FrDistance *distance, Item *items, uint32_t first, uint32_t count) {
    uint32_t own = distance->node_count++;
    Node node = {.first = first, .count = count};
    node.box = (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t k = first; k < first + count; k++) {
        widen(&node.box, &distance->triangles[items[k].triangle]);
        for (int r = 0; r < 3; r++) {
            low[r] = fmin(low[r], items[k].middle[r]);
            high[r] = fmax(high[r], items[k].middle[r]);
        }
    }
    if (count > LEAF) {
        int axis = 0;
        for (int r = 1; r < 3; r++) {
            axis = high[r] - low[r] > high[axis] - low[axis] ? r : axis;
        }
        g_qsort_with_data(items + first, (gint)count, sizeof *items, compare_items, &axis);
        node.count = 0;
        build(distance, items, first, count / 2);
        node.second = build(distance, items, first + count / 2, count - count / 2);
    }
    distance->nodes[own] = node;
    return own;
}

static void make_tree(FrDistance *distance) {
    Item *items = g_new(Item, distance->count);
    for (uint32_t t = 0; t < distance->count; t++) {
        items[t].triangle = t;
        for (int r = 0; r < 3; r++) {
            const Triangle *triangle = &distance->triangles[t];
            items[t].middle[r] = triangle->corner[0][r] + triangle->corner[1][r];
            items[t].middle[r] += triangle->corner[2][r];
        }
    }
    distance->nodes = g_new(Node, 2 * (size_t)distance->count);
    build(distance, items, 0, distance->count);
    Triangle *ordered = g_new(Triangle, distance->count);
    for (uint32_t k = 0; k < distance->count; k++) {
        ordered[k] = distance->triangles[items[k].triangle];
    }
    g_free(distance->triangles);
    distance->triangles = ordered;
    g_free(items);
}

uint64_t fr_distance_bytes(uint64_t triangles) {
    uint64_t each = 2 * sizeof(Triangle) + 2 * sizeof(Node) + sizeof(Item) + 3 * sizeof(Edge);
    return triangles * (each + 3 * (sizeof(uint32_t) + 3 * sizeof(double)));
}

FrDistance *fr_distance_new(const vec3s *positions, uint32_t vertex_count, const uint32_t *indices,
                            uint32_t index_count) {
    FrDistance *distance = g_new0(FrDistance, 1);
    distance->triangles = g_new(Triangle, MAX(index_count / 3, 1));
    uint32_t *corners = g_new(uint32_t, MAX(index_count, 1));
    vec3s *places = g_new(vec3s, MAX(vertex_count, 1));
    for (uint32_t k = 0; k < vertex_count; k++) {
        for (int r = 0; r < 3; r++) {
            places[k].raw[r] = positions[k].raw[r] + 0.0f; // one zero
        }
    }
    Weld welded;
    weld(&welded, places, vertex_count);
    for (uint32_t i = 0; i + 3 <= index_count; i += 3) {
        Triangle *triangle = &distance->triangles[distance->count];
        double a[3], b[3];
        for (uint32_t k = 0; k < 3; k++) {
            for (int r = 0; r < 3; r++) {
                triangle->corner[k][r] = (double)positions[indices[i + k]].raw[r];
            }
            corners[3 * distance->count + k] = welded.number[indices[i + k]];
        }
        minus(triangle->corner[1], triangle->corner[0], a);
        minus(triangle->corner[2], triangle->corner[0], b);
        cross(a, b, triangle->normal[AT_FACE]);
        distance->count += normalize(triangle->normal[AT_FACE]);
    }
    if (distance->count > 0) {
        sum_corners(distance, corners, vertex_count);
        sum_edges(distance, corners);
        make_tree(distance);
    }
    g_hash_table_unref(welded.places);
    g_free(welded.number);
    g_free(places);
    g_free(corners);
    if (distance->count == 0) {
        fr_distance_free(distance);
        return NULL;
    }
    return distance;
}

void fr_distance_free(FrDistance *distance) {
    if (distance != NULL) {
        g_free(distance->triangles);
        g_free(distance->nodes);
        g_free(distance);
    }
}

bool fr_distance_is_closed(const FrDistance *distance) {
    return distance->is_closed;
}

// ---- asking -----------------------------------------------------------------------------------

typedef struct Nearest {
    double square; ///< of the distance
    double way[3]; ///< from there to the point asked about
    const double *normal;
} Nearest;

static double box_square(const Box *box, const double at[3]) {
    double square = 0;
    for (int r = 0; r < 3; r++) {
        double off = fmax(fmax(box->min[r] - at[r], at[r] - box->max[r]), 0);
        square += off * off;
    }
    return square;
}

// The part of a triangle that is nearest, and how far along its two edges from corner 0.
static int nearest_part(const Triangle *triangle, const double at[3], double *v, double *w) {
    double ab[3], ac[3], ap[3], bp[3], cp[3];
    minus(triangle->corner[1], triangle->corner[0], ab);
    minus(triangle->corner[2], triangle->corner[0], ac);
    minus(at, triangle->corner[0], ap);
    minus(at, triangle->corner[1], bp);
    minus(at, triangle->corner[2], cp);
    double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp);
    double d5 = dot(ab, cp), d6 = dot(ac, cp);
    *v = *w = 0;
    if (d1 <= 0 && d2 <= 0) {
        return AT_CORNER;
    }
    if (d3 >= 0 && d4 <= d3) {
        *v = 1;
        return AT_CORNER + 1;
    }
    if (d6 >= 0 && d5 <= d6) {
        *w = 1;
        return AT_CORNER + 2;
    }
    double c = d1 * d4 - d3 * d2, b = d5 * d2 - d1 * d6, a = d3 * d6 - d5 * d4;
    if (c <= 0 && d1 >= 0 && d3 <= 0) {
        *v = d1 / (d1 - d3);
        return AT_EDGE;
    }
    if (b <= 0 && d2 >= 0 && d6 <= 0) {
        *w = d2 / (d2 - d6);
        return AT_EDGE + 2;
    }
    if (a <= 0 && d4 >= d3 && d5 >= d6) {
        *w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        *v = 1 - *w;
        return AT_EDGE + 1;
    }
    double sum = a + b + c;
    *v = sum > 0 ? b / sum : 0;
    *w = sum > 0 ? c / sum : 0;
    return AT_FACE;
}

static void ask(const Triangle *triangle, const double at[3], Nearest *nearest) {
    double v, w, way[3];
    int part = nearest_part(triangle, at, &v, &w);
    for (int r = 0; r < 3; r++) {
        double a = triangle->corner[0][r], b = triangle->corner[1][r], c = triangle->corner[2][r];
        way[r] = at[r] - (a + v * (b - a) + w * (c - a));
    }
    double square = dot(way, way);
    if (square < nearest->square) {
        nearest->square = square;
        nearest->normal = triangle->normal[part];
        memcpy(nearest->way, way, sizeof way);
    }
}

/// Looks only nearer than `nearest` is already.
static void find_nearest(const FrDistance *distance, const double at[3], Nearest *nearest) {
    uint32_t stack[DEEPEST] = {0}, depth = 1;
    while (depth > 0) {
        uint32_t own = stack[--depth];
        const Node *node = &distance->nodes[own];
        if (box_square(&node->box, at) >= nearest->square) {
            continue;
        }
        for (uint32_t k = 0; k < node->count; k++) {
            ask(&distance->triangles[node->first + k], at, nearest);
        }
        if (node->count == 0) {
            const Box *low = &distance->nodes[own + 1].box;
            bool is_low_near =
                box_square(low, at) <= box_square(&distance->nodes[node->second].box, at);
            stack[depth++] = is_low_near ? node->second : own + 1;
            stack[depth++] = is_low_near ? own + 1 : node->second;
        }
    }
}

double fr_distance_within(const FrDistance *distance, const double at[3], double reach,
                          double outward[3]) {
    Nearest nearest = {.square = reach * reach};
    find_nearest(distance, at, &nearest);
    if (nearest.normal == NULL) {
        return INFINITY;
    }
    double size = sqrt(nearest.square);
    bool is_inside = distance->is_closed && dot(nearest.way, nearest.normal) < 0;
    for (int r = 0; r < 3; r++) {
        outward[r] = is_inside ? -nearest.way[r] : nearest.way[r];
    }
    if (size < 1e-9 || !normalize(outward)) {
        memcpy(outward, nearest.normal, 3 * sizeof *outward);
        if (!normalize(outward)) {
            outward[2] = 1;
        }
    }
    return is_inside ? -size : size;
}

double fr_distance_at(const FrDistance *distance, const double at[3], double outward[3]) {
    return fr_distance_within(distance, at, INFINITY, outward);
}
