// Edges of blades.
//
// Teeth stand on the straight edges between the rows of the blade, evenly by the way along them, so
// a blade needs no more rows for them. A tooth is a strip from points of the edge to points above
// it: height h(t) = tri(t)^e with e from 1/4 (round) to 4 (hollow), or a half circle; serrate ones
// have their peak late and lean to the tip. Lobes cut the outline itself: half widths are
// multiplied by 1 − depth · (1 − ((1 − cos) / 2)^1/e).
#include "skin/margin.h"

#include <cglm/struct.h>

#include <math.h>

enum { STEPS_MOST = 6, TEETH_GONE = 2 };

// Part of the edge at its base and tip without teeth.
#define FIRST 0.06
#define LAST 0.97
// How far before its edge a tooth takes its colour from, part of the half width.
#define WITHIN 0.06

static double exponent_of(const FrBlade *blade) {
    return pow(2.0, 4.0 * (double)blade->tooth_sharpness - 2.0);
}

// ---- lobes -------------------------------------------------------------------------------------

void fr_outline_lobe(FrOutline *outline, const FrBlade *blade) {
    if (blade->margin != FR_MARGIN_LOBED || blade->teeth == 0) {
        return;
    }
    double lobes = MIN(blade->teeth, FR_LOBES_MOST), depth = fmin((double)blade->tooth_depth, 0.95);
    double e = 1.0 / exponent_of(blade), area = 0.0;
    for (int i = 0; i <= FR_OUTLINE_FINE; i++) {
        // The last lobe is the tip of the blade.
        double turn = (double)i / FR_OUTLINE_FINE * (lobes + 0.5) - 0.5;
        double cut = pow(0.5 - 0.5 * cos(2.0 * G_PI * turn), e);
        double keep = turn > 0.0 ? 1.0 - depth * (1.0 - cut) : 1.0 - depth;
        outline->left[i] *= keep;
        outline->right[i] *= keep;
        double weight = i == 0 || i == FR_OUTLINE_FINE ? 0.5 : 1.0;
        area += weight * (outline->left[i] + outline->right[i]);
    }
    outline->area = area / FR_OUTLINE_FINE;
}

// ---- teeth -------------------------------------------------------------------------------------

uint64_t fr_margin_vertices_most(const FrBlade *blade) {
    bool has_teeth = blade->margin != FR_MARGIN_ENTIRE && blade->margin != FR_MARGIN_LOBED;
    return has_teeth ? (uint64_t)blade->teeth * 4 * (STEPS_MOST + 1) : 0;
}

// One side's edge: a polygon through the ends of the rows.
typedef struct Edge {
    const FrBladeForm *form;
    const FrOutlineRow *rows;
    uint32_t count;
    double side;     // −1 left, 1 right
    double *way;     // m, up to each row
    double *corners; // 3 a row
} Edge;

// A point of the edge: which row is before it, and how far it is on to the next.
typedef struct Foot {
    uint32_t row;
    double part;
} Foot;

static double half_at(const Edge *edge, uint32_t row) {
    const FrOutlineRow *r = &edge->rows[row];
    return fmax(edge->side < 0.0 ? r->left : r->right, 1e-3) * edge->form->width;
}

static void edge_init(Edge *edge) {
    for (uint32_t i = 0; i < edge->count; i++) {
        const FrOutlineRow *row = &edge->rows[i];
        double *at = &edge->corners[3 * (size_t)i], square = 0.0;
        double aside = row->left + row->right < 2e-3 ? 0.0 : half_at(edge, i);
        fr_blade_point(edge->form, row->along, edge->side * aside, at);
        for (int k = 0; k < 3 && i > 0; k++) {
            square += (at[k] - at[k - 3]) * (at[k] - at[k - 3]);
        }
        edge->way[i] = i > 0 ? edge->way[i - 1] + sqrt(square) : 0.0;
    }
}

static Foot foot_at(const Edge *edge, double way) {
    uint32_t row = 0;
    while (row + 2 < edge->count && edge->way[row + 1] < way) {
        row++;
    }
    double length = edge->way[row + 1] - edge->way[row];
    double part = length > 0.0 ? (way - edge->way[row]) / length : 0.0;
    return (Foot){row, fmin(fmax(part, 0.0), 1.0)};
}

static vec3s edge_point(const Edge *edge, Foot foot) {
    const double *a = &edge->corners[3 * (size_t)foot.row];
    vec3s point;
    for (int k = 0; k < 3; k++) {
        point.raw[k] = (float)(a[k] + foot.part * (a[k + 3] - a[k]));
    }
    return point;
}

// A step of a tooth: where along it, how far the upper point leans on, how high it is.
typedef struct ToothStep {
    double along, lean, height;
} ToothStep;

static uint32_t tooth_steps(const FrBlade *blade, const FrDetail *detail, ToothStep *steps) {
    bool is_serrate = blade->margin == FR_MARGIN_SERRATE;
    double e = exponent_of(blade), peak = is_serrate ? 0.7 : 0.5, lean = is_serrate ? 0.35 : 0.0;
    if (blade->margin == FR_MARGIN_CRENATE) {
        uint32_t count = detail->lod > 0 ? 4 : STEPS_MOST;
        for (uint32_t i = 0; i <= count; i++) {
            double angle = G_PI * i / count;
            steps[i] = (ToothStep){0.5 - 0.5 * cos(angle), 0.0, sin(angle)};
        }
        return count;
    }
    bool is_straight = detail->lod > 0 || fabs(e - 1.0) < 0.2;
    uint32_t each = is_straight ? 1 : 2;
    for (uint32_t i = 0; i <= 2 * each; i++) {
        double up = i <= each ? (double)i / each : 2.0 - (double)i / each;
        double height = pow(up, e);
        double along = i <= each ? peak * up : 1.0 - (1.0 - peak) * up;
        steps[i] = (ToothStep){along, lean * height, height};
    }
    return 2 * each;
}

static void lay_tooth(FrShapeMesh *mesh, const Edge *edge, double from, double length, double high,
                      const ToothStep *steps, uint32_t count) {
    const FrBladeForm *form = edge->form;
    uint32_t before[2] = {0, 0};
    for (uint32_t i = 0; i <= count; i++) {
        Foot foot = foot_at(edge, from + length * steps[i].along);
        const FrOutlineRow *low = &edge->rows[foot.row], *next = low + 1;
        double along = low->along + foot.part * (next->along - low->along);
        double half = half_at(edge, foot.row);
        half += foot.part * (half_at(edge, foot.row + 1) - half);
        vec3s normal = fr_blade_normal(form, along, edge->side * half);
        vec3s at = edge_point(edge, foot);
        vec3s onward = glms_vec3_sub(edge_point(edge, (Foot){foot.row, 1.0}),
                                     edge_point(edge, (Foot){foot.row, 0.0}));
        onward = glms_vec3_normalize(onward);
        vec3s out = glms_vec3_scale(glms_vec3_cross(onward, normal), (float)edge->side);
        float u = (float)(0.5 + edge->side * (1.0 - WITHIN) * half / form->width);
        uint32_t foot_at_edge = fr_shape_vertex(mesh, at, normal, u, (float)(1.0 - along));
        vec3s top = glms_vec3_muladds(out, (float)(high * steps[i].height), at);
        top = glms_vec3_muladds(onward, (float)(length * steps[i].lean), top);
        uint32_t above = steps[i].height > 1e-6
                             ? fr_shape_vertex(mesh, top, normal, u, (float)(1.0 - along))
                             : foot_at_edge;
        uint32_t a = before[0], b = foot_at_edge, c = above, d = before[1];
        if (i > 0 && edge->side > 0.0) {
            fr_shape_triangle(mesh, a, d, c);
            fr_shape_triangle(mesh, a, c, b);
        } else if (i > 0) {
            fr_shape_triangle(mesh, a, c, d);
            fr_shape_triangle(mesh, a, b, c);
        }
        before[0] = foot_at_edge;
        before[1] = above;
    }
}

void fr_margin_teeth(FrShapeMesh *mesh, const FrBladeForm *form, const FrOutlineRow *rows,
                     uint32_t count, const FrDetail *detail) {
    const FrBlade *blade = form->blade;
    if (fr_margin_vertices_most(blade) == 0 || detail->lod >= TEETH_GONE || count < 2) {
        return;
    }
    ToothStep steps[STEPS_MOST + 1];
    uint32_t step_count = tooth_steps(blade, detail, steps);
    uint32_t teeth = fr_shape_segments(blade->teeth, 1, blade->teeth, detail);
    for (double side = -1.0; side < 2.0; side += 2.0) {
        Edge edge = {
            form, rows, count, side, g_new(double, count), g_new(double, 3 * (size_t)count)};
        edge_init(&edge);
        double all = edge.way[count - 1], each = (LAST - FIRST) * all / teeth;
        for (uint32_t k = 0; k < teeth && all > 0.0; k++) {
            // They shrink to both ends.
            double place = (k + 0.5) / teeth,
                   size = fmin(1.0, 4.0 * fmin(place, 1.0 - place) + 0.25);
            double high = (double)blade->tooth_depth * form->width * size;
            lay_tooth(mesh, &edge, FIRST * all + k * each, each, high, steps, step_count);
        }
        g_free(edge.way);
        g_free(edge.corners);
    }
}
