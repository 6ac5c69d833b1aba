#include "pgraph/revolved.h"

#include <glib.h>
#include <math.h>

#define PI 3.14159265358979323846

enum { PIECES = 2048, PIECES_PER_SPAN = 16, MOST_PIECES = 65536 };

// One straight piece of the outline, from a point to the next.
typedef struct Piece {
    double from[2], to[2]; // radius, height
    double length;
    double below;    // area of the pieces before, over 2π
    double polar[2]; // of the outer side at both ends
} Piece;

struct FrRevolved {
    GArray *pieces;   // Piece, none without length
    double low, high; // area before start and before end
};

static GArray *form_points(int form) {
    static const FrOutlinePoint straight[][2] = {
        [FR_FORM_CONE] = {{0, 1}, {1, 0}},
        [FR_FORM_CYLINDER] = {{1, 1}, {1, 0}},
        [FR_FORM_DISC] = {{0, 0}, {1, 0}},
    };
    GArray *points = g_array_new(FALSE, FALSE, sizeof(FrOutlinePoint));
    if (form != FR_FORM_SPHERE) {
        g_array_append_vals(points, straight[form], 2);
        return points;
    }
    for (int k = 0; k <= PIECES; k++) {
        double polar = PI * k / PIECES;
        FrOutlinePoint point = {k == 0 || k == PIECES ? 0 : sin(polar), cos(polar)};
        g_array_append_val(points, point);
    }
    return points;
}

GArray *fr_outline_points(const double (*points)[2], size_t count, bool is_smooth) {
    FR_ASSERT(count >= 2);
    GArray *made = g_array_new(FALSE, FALSE, sizeof(FrOutlinePoint));
    vec3s *knots = g_new(vec3s, count);
    for (size_t k = 0; k < count; k++) {
        FrOutlinePoint point = {fmin(fmax(0, points[k][0]), 1e6),
                                fmax(-1e6, fmin(points[k][1], 1e6))};
        g_array_append_val(made, point);
        knots[k] = (vec3s){{(float)point.radius, 0, (float)point.height}};
    }
    FrPath *path = is_smooth ? fr_path_new(knots, count) : NULL;
    double length = path != NULL ? fr_path_length(path) : 0;
    if (length > 0) {
        size_t pieces = MIN((count - 1) * PIECES_PER_SPAN, MOST_PIECES);
        g_array_set_size(made, 0);
        for (size_t k = 0; k <= pieces; k++) {
            vec3s at, tangent;
            fr_path_at(path, length * (double)k / (double)pieces, &at, &tangent);
            FrOutlinePoint point = {fmax(0, (double)at.x), (double)at.z};
            g_array_append_val(made, point);
        }
    }
    fr_path_unref(path);
    g_free(knots);
    return made;
}

static double mean_radius(const Piece *piece) {
    return 0.5 * (piece->from[0] + piece->to[0]);
}

// The pieces with the direction of their normal to the left of the way they run.
static GArray *cut(const GArray *points, double stretch) {
    GArray *pieces = g_array_new(FALSE, FALSE, sizeof(Piece));
    double below = 0;
    for (guint k = 0; k + 1 < points->len; k++) {
        const FrOutlinePoint *at = &g_array_index(points, FrOutlinePoint, k);
        Piece piece = {.from = {at[0].radius, stretch * at[0].height},
                       .to = {at[1].radius, stretch * at[1].height},
                       .below = below};
        double out = piece.to[0] - piece.from[0], up = piece.to[1] - piece.from[1];
        piece.length = hypot(out, up);
        if (piece.length > 0) {
            piece.polar[0] = piece.polar[1] = atan2(-up, out);
            below += piece.length * mean_radius(&piece);
            g_array_append_val(pieces, piece);
        }
    }
    return pieces;
}

static double wrapped(double angle) {
    return angle - 2 * PI * floor(angle / (2 * PI) + 0.5);
}

// Turns all normals round if on the whole they look to the axis, or down from a level surface.
static void face_outwards(GArray *pieces) {
    double outwards = 0, upwards = 0;
    for (guint k = 0; k < pieces->len; k++) {
        const Piece *piece = &g_array_index(pieces, Piece, k);
        double area = piece->length * mean_radius(piece);
        outwards += area * sin(piece->polar[0]);
        upwards += area * cos(piece->polar[0]);
    }
    bool is_level = fabs(outwards) <= 1e-9 * fabs(upwards);
    for (guint k = 0; k < pieces->len && (is_level ? upwards : outwards) < 0; k++) {
        Piece *piece = &g_array_index(pieces, Piece, k);
        piece->polar[0] = piece->polar[1] = wrapped(piece->polar[0] + PI);
    }
}

// On a smooth curve the normal turns evenly from the middle of a piece to that of the next.
static void smooth_normals(GArray *pieces) {
    guint count = pieces->len;
    if (count < 2) {
        return;
    }
    double *middle = g_new(double, count);
    for (guint k = 0; k < count; k++) {
        middle[k] = g_array_index(pieces, Piece, k).polar[0];
    }
    for (guint k = 0; k < count; k++) {
        Piece *piece = &g_array_index(pieces, Piece, k);
        double before = 0.5 * wrapped(middle[k] - middle[k > 0 ? k - 1 : k]);
        double after = 0.5 * wrapped(middle[k + 1 < count ? k + 1 : k] - middle[k]);
        piece->polar[0] = middle[k] - (k > 0 ? before : after);
        piece->polar[1] = middle[k] + (k + 1 < count ? after : before);
    }
    g_free(middle);
}

static double area_within(const Piece *piece, double part) {
    double at = piece->from[0] + part * (piece->to[0] - piece->from[0]);
    return part * piece->length * 0.5 * (piece->from[0] + at);
}

// Area before a share of the outline's length.
static double area_before(const GArray *pieces, double share) {
    double length = 0, area = 0;
    for (guint k = 0; k < pieces->len; k++) {
        length += g_array_index(pieces, Piece, k).length;
    }
    double rest = length * share;
    for (guint k = 0; k < pieces->len && rest > 0; k++) {
        const Piece *piece = &g_array_index(pieces, Piece, k);
        area = piece->below + area_within(piece, fmin(1, rest / piece->length));
        rest -= piece->length;
    }
    return area;
}

FrRevolved *fr_revolved_new(const FrPhyllotaxisParams *params) {
    bool is_own = params->outline.count >= 2;
    GArray *points = is_own ? fr_outline_points((const double(*)[2])params->outline.at,
                                                params->outline.count, params->smooth)
                            : form_points(params->form);
    FrRevolved *revolved = g_new0(FrRevolved, 1);
    revolved->pieces = cut(points, params->stretch);
    g_array_unref(points);
    face_outwards(revolved->pieces);
    if (is_own ? params->smooth : params->form == FR_FORM_SPHERE) {
        smooth_normals(revolved->pieces);
    }
    revolved->low = area_before(revolved->pieces, fmin(params->start, params->end));
    revolved->high = area_before(revolved->pieces, fmax(params->start, params->end));
    return revolved;
}

void fr_revolved_free(FrRevolved *revolved) {
    if (revolved != NULL) {
        g_array_unref(revolved->pieces);
        g_free(revolved);
    }
}

double fr_revolved_area(const FrRevolved *revolved) {
    return revolved->high - revolved->low;
}

FrRevolvedPoint fr_revolved_at(const FrRevolved *revolved, double before) {
    const GArray *pieces = revolved->pieces;
    if (pieces->len == 0) {
        return (FrRevolvedPoint){0};
    }
    double wanted = revolved->low + before * (revolved->high - revolved->low);
    guint first = 0, last = pieces->len; // below of the first is not more
    while (last - first > 1) {
        guint middle = (first + last) / 2;
        *(g_array_index(pieces, Piece, middle).below <= wanted ? &first : &last) = middle;
    }
    const Piece *piece = &g_array_index(pieces, Piece, first);
    double area = fmax(0, (wanted - piece->below) / piece->length);
    double start = piece->from[0], rise = piece->to[0] - piece->from[0];
    double root = start + sqrt(fmax(0, start * start + 2 * rise * area));
    double part = root > 0 ? fmin(1, 2 * area / root) : before;
    return (FrRevolvedPoint){
        .radius = start + part * rise,
        .height = piece->from[1] + part * (piece->to[1] - piece->from[1]),
        .polar = piece->polar[0] + part * (piece->polar[1] - piece->polar[0]),
    };
}
