// Boundary representation of rational B-spline surfaces. ISO 10303-42: a face is a surface and a
// loop of edges around it; an edge is a curve between two vertices. Neighbours share their edges.
//
// A surface has four sides. One that is shrunk to a point has no edge; on a surface closed in u the
// two sides of the seam are one edge, passed up and down.
#include "io/step_faces.h"

#include <math.h>
#include <string.h>

uint64_t fr_step_begin(FrStep *step) {
    step->last++;
    fr_step_reference(step, step->last);
    fr_output_bytes(&step->output, "=", 1);
    return step->last;
}

void fr_step_text(FrStep *step, const char *text) {
    fr_output_text(&step->output, text);
}

void fr_step_reference(FrStep *step, uint64_t entity) {
    fr_output_bytes(&step->output, "#", 1);
    fr_output_integer(&step->output, entity);
}

void fr_step_references(FrStep *step, const uint64_t *entities, size_t count) {
    for (size_t i = 0; i < count; i++) {
        fr_output_bytes(&step->output, i > 0 ? "," : "(", 1);
        fr_step_reference(step, entities[i]);
    }
    fr_output_bytes(&step->output, ")", 1);
}

void fr_step_real(FrStep *step, double value, int digits) {
    char text[FR_REAL_ROOM];
    int length = fr_real_text(text, value, digits);
    fr_output_bytes(&step->output, text, (size_t)length);
}

/// A length in metres, to a tenth of what the file says two points are apart at least.
static void put_length(FrStep *step, double value) {
    double rounded = nearbyint(value * 1e8) * 1e-8;
    fr_step_real(step, rounded + 0.0, fabs(rounded) < 10.0 ? 9 : 15);
}

uint64_t fr_step_direction(FrStep *step, const double v[3]) {
    uint64_t entity = fr_step_begin(step);
    for (int k = 0; k < 3; k++) {
        fr_step_text(step, k > 0 ? "," : "DIRECTION('',(");
        fr_step_real(step, fabs(v[k]) < 1e-12 ? 0.0 : v[k], 10);
    }
    fr_step_text(step, "));\n");
    return entity;
}

uint64_t fr_step_point(FrStep *step, const double at[3]) {
    uint64_t entity = fr_step_begin(step);
    for (int k = 0; k < 3; k++) {
        fr_step_text(step, k > 0 ? "," : "CARTESIAN_POINT('',(");
        put_length(step, at[k]);
    }
    fr_step_text(step, "));\n");
    return entity;
}

static uint64_t put_point(FrStep *step, const double point[4]) {
    double at[4];
    fr_io_nurbs_posed(step->pose, point, at);
    return fr_step_point(step, at);
}

static uint64_t put_vertex(FrStep *step, uint64_t at) {
    uint64_t entity = fr_step_begin(step);
    fr_step_text(step, "VERTEX_POINT('',");
    fr_step_reference(step, at);
    fr_step_text(step, ");\n");
    return entity;
}

/// Multiplicities, or the distinct knots themselves, in brackets.
static void put_knots(FrStep *step, const double *knots, uint32_t count, bool is_multiplicity) {
    fr_step_text(step, "(");
    for (uint32_t i = 0; i < count;) {
        uint32_t next = i + 1;
        while (next < count && !(knots[next] > knots[i])) {
            next++;
        }
        fr_step_text(step, i > 0 ? "," : "");
        if (is_multiplicity) {
            fr_output_integer(&step->output, next - i);
        } else {
            fr_step_real(step, knots[i], 12);
        }
        i = next;
    }
    fr_step_text(step, ")");
}

/// A side of a surface: its points are `stride` apart.
typedef struct FrSide {
    const double (*points)[4];
    const uint64_t *entities; ///< of the points
    size_t stride;
    uint32_t count, degree;
    const double *knots;
} FrSide;

static uint64_t put_curve(FrStep *step, const FrSide *side) {
    uint64_t entity = fr_step_begin(step);
    uint32_t knots = side->count + side->degree + 1;
    fr_step_text(step, "(BOUNDED_CURVE()B_SPLINE_CURVE(");
    fr_output_integer(&step->output, side->degree);
    for (uint32_t i = 0; i < side->count; i++) {
        fr_step_text(step, i > 0 ? "," : ",(");
        fr_step_reference(step, side->entities[i * side->stride]);
    }
    fr_step_text(step, "),.UNSPECIFIED.,.F.,.F.)B_SPLINE_CURVE_WITH_KNOTS(");
    put_knots(step, side->knots, knots, true);
    fr_step_text(step, ",");
    put_knots(step, side->knots, knots, false);
    fr_step_text(step, ",.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()"
                       "RATIONAL_B_SPLINE_CURVE(");
    for (uint32_t i = 0; i < side->count; i++) {
        fr_step_text(step, i > 0 ? "," : "(");
        fr_step_real(step, side->points[i * side->stride][3], 12);
    }
    fr_step_text(step, "))REPRESENTATION_ITEM(''));\n");
    return entity;
}

static uint64_t put_edge(FrStep *step, const FrSide *side, uint64_t from, uint64_t to) {
    uint64_t curve = put_curve(step, side), entity = fr_step_begin(step);
    const uint64_t parts[] = {from, to, curve};
    fr_step_text(step, "EDGE_CURVE(''");
    for (int i = 0; i < 3; i++) {
        fr_step_text(step, ",");
        fr_step_reference(step, parts[i]);
    }
    fr_step_text(step, ",.T.);\n");
    return entity;
}

/// Writes the control points of a surface into step->scratch; those that repeat one another are
/// one.
static const uint64_t *put_points(FrStep *step, const FrNurbsSurface *s) {
    size_t count = (size_t)s->count_u * s->count_v;
    g_array_set_size(step->scratch, 0);
    for (size_t i = 0; i < count; i++) {
        size_t first = i - i % s->count_u; // of its row: closed and shrunk ones come back to it
        bool repeats = i > first && memcmp(s->points[i], s->points[first], 3 * sizeof(double)) == 0;
        uint64_t point =
            repeats ? g_array_index(step->scratch, uint64_t, first) : put_point(step, s->points[i]);
        g_array_append_val(step->scratch, point);
    }
    return (const uint64_t *)(void *)step->scratch->data;
}

static uint64_t put_surface(FrStep *step, const FrNurbsSurface *s, const uint64_t *points) {
    uint64_t entity = fr_step_begin(step);
    fr_step_text(step, "(BOUNDED_SURFACE()B_SPLINE_SURFACE(");
    fr_output_integer(&step->output, s->degree_u);
    fr_step_text(step, ",");
    fr_output_integer(&step->output, s->degree_v);
    for (size_t i = 0; i < s->count_u; i++) {
        for (size_t j = 0; j < s->count_v; j++) {
            fr_step_text(step, j > 0 ? "," : i > 0 ? "),(" : ",((");
            fr_step_reference(step, points[j * s->count_u + i]);
        }
    }
    fr_step_text(step, ")),.UNSPECIFIED.,.F.,.F.,.F.)B_SPLINE_SURFACE_WITH_KNOTS(");
    put_knots(step, s->knots_u, s->count_u + s->degree_u + 1, true);
    fr_step_text(step, ",");
    put_knots(step, s->knots_v, s->count_v + s->degree_v + 1, true);
    fr_step_text(step, ",");
    put_knots(step, s->knots_u, s->count_u + s->degree_u + 1, false);
    fr_step_text(step, ",");
    put_knots(step, s->knots_v, s->count_v + s->degree_v + 1, false);
    fr_step_text(step, ",.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE(");
    for (size_t i = 0; i < s->count_u; i++) {
        for (size_t j = 0; j < s->count_v; j++) {
            fr_step_text(step, j > 0 ? "," : i > 0 ? "),(" : "((");
            fr_step_real(step, s->points[j * s->count_u + i][3], 12);
        }
    }
    fr_step_text(step, ")))REPRESENTATION_ITEM('')SURFACE());\n");
    return entity;
}

// ---- faces -------------------------------------------------------------------------------------

enum { BOTTOM, RIGHT, TOP, LEFT, SIDES }; ///< v = 0, u = 1, v = 1, u = 0

/// Bounds of a face: 0 where a side has no edge. Corners: (0,0) (1,0) (1,1) (0,1).
typedef struct FrBounds {
    uint64_t edge[SIDES], corner[4];
} FrBounds;

static FrSide side_of(const FrNurbsSurface *s, const uint64_t *entities, int which) {
    size_t last_row = (size_t)(s->count_v - 1) * s->count_u;
    size_t first = which == TOP ? last_row : which == RIGHT ? s->count_u - 1 : 0;
    bool is_row = which == BOTTOM || which == TOP;
    return (FrSide){
        .points = s->points + first,
        .entities = entities + first,
        .stride = is_row ? 1 : s->count_u,
        .count = is_row ? s->count_u : s->count_v,
        .degree = is_row ? s->degree_u : s->degree_v,
        .knots = is_row ? s->knots_u : s->knots_v,
    };
}

static double apart(const double a[4], const double b[4]) {
    return fmax(fabs(a[0] - b[0]), fmax(fabs(a[1] - b[1]), fabs(a[2] - b[2])));
}

static bool is_point(const FrSide *side) {
    double most = 0.0;
    for (uint32_t i = 1; i < side->count; i++) {
        most = fmax(most, apart(side->points[0], side->points[i * side->stride]));
    }
    return most < 1e-9;
}

static bool is_same(const FrSide *a, const FrSide *b) {
    double most = 0.0;
    for (uint32_t i = 0; i < a->count; i++) {
        most = fmax(most, apart(a->points[i * a->stride], b->points[i * b->stride]));
    }
    return most < 1e-9;
}

/// Corners that one side or another joins are one vertex.
static void find_corners(FrStep *step, const FrNurbsSurface *s, const uint64_t *entities,
                         FrBounds *bounds, const bool shrunk[SIDES], bool closed_u, bool closed_v) {
    size_t last_row = (size_t)(s->count_v - 1) * s->count_u;
    const size_t at[4] = {0, s->count_u - 1, last_row + s->count_u - 1, last_row};
    int same[4] = {0, 1, 2, 3};
    const bool joined[SIDES] = {shrunk[BOTTOM] || closed_u, shrunk[RIGHT] || closed_v,
                                shrunk[TOP] || closed_u, shrunk[LEFT] || closed_v};
    for (int i = 0; i < SIDES; i++) {
        int a = same[i], b = same[(i + 1) % 4];
        for (int c = 0; c < 4 && joined[i]; c++) {
            same[c] = same[c] == b ? a : same[c];
        }
    }
    for (int c = 0; c < 4; c++) {
        for (int d = 0; d < 4 && bounds->corner[c] == 0; d++) {
            bounds->corner[c] = same[d] == same[c] ? bounds->corner[d] : 0;
        }
        if (bounds->corner[c] == 0) {
            bounds->corner[c] = put_vertex(step, entities[at[c]]);
        }
    }
}

/// Writes the bounds that are not given yet.
static void find_bounds(FrStep *step, const FrNurbsSurface *s, const uint64_t *entities,
                        FrBounds *bounds) {
    FrSide sides[SIDES];
    bool shrunk[SIDES];
    for (int i = 0; i < SIDES; i++) {
        sides[i] = side_of(s, entities, i);
        shrunk[i] = is_point(&sides[i]);
    }
    bool closed_u = is_same(&sides[LEFT], &sides[RIGHT]);
    bool closed_v = is_same(&sides[BOTTOM], &sides[TOP]);
    find_corners(step, s, entities, bounds, shrunk, closed_u, closed_v);
    // Edges go the way of the parameter.
    static const int begin[SIDES] = {0, 1, 3, 0}, end[SIDES] = {1, 2, 2, 3};
    static const int twin[SIDES] = {TOP, LEFT, BOTTOM, RIGHT};
    for (int i = 0; i < SIDES; i++) {
        bool is_seam = i == BOTTOM || i == TOP ? closed_v : closed_u;
        if (is_seam && bounds->edge[i] == 0) {
            bounds->edge[i] = bounds->edge[twin[i]];
        }
        if (bounds->edge[i] == 0 && !shrunk[i]) {
            bounds->edge[i] =
                put_edge(step, &sides[i], bounds->corner[begin[i]], bounds->corner[end[i]]);
        }
    }
}

static uint64_t put_oriented(FrStep *step, uint64_t edge, bool is_forward) {
    uint64_t entity = fr_step_begin(step);
    fr_step_text(step, "ORIENTED_EDGE('',*,*,");
    fr_step_reference(step, edge);
    fr_step_text(step, is_forward ? ",.T.);\n" : ",.F.);\n");
    return entity;
}

static uint64_t put_face(FrStep *step, uint64_t surface, const uint64_t *edges,
                         const bool *is_forward, uint32_t count) {
    uint64_t oriented[SIDES];
    for (uint32_t i = 0; i < count; i++) {
        oriented[i] = put_oriented(step, edges[i], is_forward[i]);
    }
    uint64_t loop = fr_step_begin(step);
    fr_step_text(step, "EDGE_LOOP('',");
    fr_step_references(step, oriented, count);
    fr_step_text(step, ");\n");
    uint64_t bound = fr_step_begin(step);
    fr_step_text(step, "FACE_OUTER_BOUND('',");
    fr_step_reference(step, loop);
    fr_step_text(step, ",.T.);\n");
    uint64_t face = fr_step_begin(step);
    fr_step_text(step, "ADVANCED_FACE('',(");
    fr_step_reference(step, bound);
    fr_step_text(step, "),");
    fr_step_reference(step, surface);
    fr_step_text(step, ",.T.);\n");
    return face;
}

static uint64_t put_patch(FrStep *step, const FrNurbsSurface *s, FrBounds *bounds) {
    const uint64_t *points = put_points(step, s);
    find_bounds(step, s, points, bounds);
    uint64_t surface = put_surface(step, s, points), edges[SIDES];
    bool is_forward[SIDES];
    uint32_t count = 0;
    for (int i = 0; i < SIDES; i++) {
        if (bounds->edge[i] != 0) {
            edges[count] = bounds->edge[i];
            is_forward[count++] = i == BOTTOM || i == RIGHT;
        }
    }
    return put_face(step, surface, edges, is_forward, count);
}

/// The unit normal of a flat cap; false if it is not flat.
static bool cap_plane(const FrNurbsSurface *s, const double (*rim)[4], const double centre[4],
                      double normal[3]) {
    double sum[3] = {0}, reach = 0.0;
    for (uint32_t i = 0; i + 1 < s->count_u; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = rim[i][k] - centre[k];
            b[k] = rim[i + 1][k] - centre[k];
            reach = fmax(reach, fabs(a[k]));
        }
        sum[0] += a[1] * b[2] - a[2] * b[1];
        sum[1] += a[2] * b[0] - a[0] * b[2];
        sum[2] += a[0] * b[1] - a[1] * b[0];
    }
    double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    double most = 0.0;
    for (int k = 0; k < 3; k++) {
        normal[k] = length > 0.0 ? sum[k] / length : 0.0;
    }
    for (uint32_t i = 0; i < s->count_u; i++) {
        double off = 0.0;
        for (int k = 0; k < 3; k++) {
            off += (rim[i][k] - centre[k]) * normal[k];
        }
        most = fmax(most, fabs(off));
    }
    return length > 0.0 && most < 1e-9 * fmax(reach, 1.0);
}

uint64_t fr_step_placement(FrStep *step, const double at[3], const double axis[3],
                           const double across[3]) {
    uint64_t point = fr_step_point(step, at), along = fr_step_direction(step, axis);
    uint64_t reference = fr_step_direction(step, across), place = fr_step_begin(step);
    const uint64_t parts[] = {point, along, reference};
    fr_step_text(step, "AXIS2_PLACEMENT_3D(''");
    for (int i = 0; i < 3; i++) {
        fr_step_text(step, ",");
        fr_step_reference(step, parts[i]);
    }
    fr_step_text(step, ");\n");
    return place;
}

static uint64_t put_plane(FrStep *step, const double centre[4], const double normal[3]) {
    const FrPose *pose = step->pose;
    double turned[3] = {pose->cosine * normal[0] - pose->sine * normal[1],
                        pose->sine * normal[0] + pose->cosine * normal[1], normal[2]};
    int least = fabs(turned[0]) < 0.6 ? 0 : 1;
    double across[3] = {least == 0, least == 1, 0}, at[4];
    double along = turned[least], length = sqrt(1.0 - along * along);
    for (int k = 0; k < 3; k++) {
        across[k] = (across[k] - along * turned[k]) / length;
    }
    fr_io_nurbs_posed(pose, centre, at);
    uint64_t place = fr_step_placement(step, at, turned, across), plane = fr_step_begin(step);
    fr_step_text(step, "PLANE('',");
    fr_step_reference(step, place);
    fr_step_text(step, ");\n");
    return plane;
}

// A cap shares its rim with the tube. A flat one is a plane, whatever its outline.
static uint64_t put_cap(FrStep *step, const FrNurbsPiece *cap, const FrBounds *tube) {
    const FrNurbsSurface *s = &cap->surface;
    bool is_tip = cap->kind == FR_NURBS_CAP;
    uint64_t rim_edge = tube->edge[is_tip ? TOP : BOTTOM];
    const double(*rim)[4] = s->points + (is_tip ? 0 : s->count_u);
    const double *centre = s->points[is_tip ? s->count_u : 0];
    double normal[3];
    if (cap_plane(s, rim, centre, normal)) {
        for (int k = 0; k < 3 && !is_tip; k++) {
            normal[k] = -normal[k];
        }
        uint64_t plane = put_plane(step, centre, normal);
        return put_face(step, plane, &rim_edge, &is_tip, 1);
    }
    FrBounds bounds = {0};
    bounds.edge[is_tip ? BOTTOM : TOP] = rim_edge;
    int from = is_tip ? 0 : 3, to = is_tip ? 1 : 2;
    bounds.corner[from] = bounds.corner[to] = tube->corner[is_tip ? 3 : 0];
    return put_patch(step, s, &bounds);
}

uint32_t fr_step_shell(FrStep *step, const FrNurbsPiece *pieces, uint64_t count, uint64_t faces[3],
                       bool *is_closed) {
    FrBounds bounds = {0};
    faces[0] = put_patch(step, &pieces[0].surface, &bounds);
    *is_closed = false;
    uint32_t used = 1;
    if (pieces[0].kind == FR_NURBS_TUBE) {
        uint32_t ends = (bounds.edge[BOTTOM] == 0 ? 1U : 0U) + (bounds.edge[TOP] == 0 ? 1U : 0U);
        for (; used < count && used < 3 &&
               (pieces[used].kind == FR_NURBS_FOOT || pieces[used].kind == FR_NURBS_CAP);
             used++) {
            faces[used] = put_cap(step, &pieces[used], &bounds);
            ends++;
        }
        *is_closed = ends == 2 && bounds.edge[LEFT] == bounds.edge[RIGHT];
    } else if (pieces[0].kind == FR_NURBS_RIGHT && count > 1 && pieces[1].kind == FR_NURBS_LEFT) {
        FrBounds other = {0};
        other.edge[BOTTOM] = bounds.edge[TOP];
        other.corner[0] = bounds.corner[3];
        other.corner[1] = bounds.corner[2];
        faces[used++] = put_patch(step, &pieces[1].surface, &other);
    }
    return used;
}
