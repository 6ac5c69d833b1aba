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

enum { TEETH_GONE = 2 };

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

bool fr_blade_has_teeth(const FrBlade *blade) {
    return blade->margin != FR_MARGIN_ENTIRE && blade->margin != FR_MARGIN_LOBED &&
           blade->teeth > 0;
}

uint64_t fr_margin_vertices_most(const FrBlade *blade) {
    return fr_blade_has_teeth(blade) ? (uint64_t)blade->teeth * 4 * (FR_TOOTH_STEPS_MOST + 1) : 0;
}

// A point of the edge: which row is before it, and how far it is on to the next.
typedef struct Foot {
    uint32_t row;
    double part;
} Foot;

static double half_at(const FrEdge *edge, uint32_t row) {
    const FrOutlineRow *r = &edge->rows[row];
    return fmax(edge->side < 0.0 ? r->left : r->right, 1e-3) * edge->form->width;
}

void fr_edge_init(FrEdge *edge, const FrBladeForm *form, const FrOutlineRow *rows, uint32_t count,
                  double side) {
    *edge =
        (FrEdge){form, rows, count, side, g_new(double, count), g_new(double, 3 * (size_t)count)};
    for (uint32_t i = 0; i < count; i++) {
        const FrOutlineRow *row = &rows[i];
        double *at = &edge->corners[3 * (size_t)i], square = 0.0;
        double aside = row->left + row->right < 2e-3 ? 0.0 : half_at(edge, i);
        fr_blade_point(form, row->along, side * aside, at);
        for (int k = 0; k < 3 && i > 0; k++) {
            square += (at[k] - at[k - 3]) * (at[k] - at[k - 3]);
        }
        edge->way[i] = i > 0 ? edge->way[i - 1] + sqrt(square) : 0.0;
    }
}

void fr_edge_clear(FrEdge *edge) {
    g_free(edge->way);
    g_free(edge->corners);
}

static Foot foot_at(const FrEdge *edge, double way) {
    uint32_t row = 0;
    while (row + 2 < edge->count && edge->way[row + 1] < way) {
        row++;
    }
    double length = edge->way[row + 1] - edge->way[row];
    double part = length > 0.0 ? (way - edge->way[row]) / length : 0.0;
    return (Foot){row, fmin(fmax(part, 0.0), 1.0)};
}

static vec3s edge_point(const FrEdge *edge, Foot foot) {
    const double *a = &edge->corners[3 * (size_t)foot.row];
    vec3s point;
    for (int k = 0; k < 3; k++) {
        point.raw[k] = (float)(a[k] + foot.part * (a[k + 3] - a[k]));
    }
    return point;
}

uint32_t fr_tooth_steps(const FrBlade *blade, bool is_coarse,
                        FrToothStep steps[FR_TOOTH_STEPS_MOST + 1]) {
    bool is_serrate = blade->margin == FR_MARGIN_SERRATE;
    double e = exponent_of(blade), peak = is_serrate ? 0.7 : 0.5, lean = is_serrate ? 0.35 : 0.0;
    if (blade->margin == FR_MARGIN_CRENATE) {
        uint32_t count = is_coarse ? 4 : FR_TOOTH_STEPS_MOST;
        for (uint32_t i = 0; i <= count; i++) {
            double angle = G_PI * i / count;
            steps[i] = (FrToothStep){0.5 - 0.5 * cos(angle), 0.0, sin(angle)};
        }
        return count;
    }
    bool is_straight = is_coarse || fabs(e - 1.0) < 0.2;
    uint32_t each = is_straight ? 1 : 2;
    for (uint32_t i = 0; i <= 2 * each; i++) {
        double up = i <= each ? (double)i / each : 2.0 - (double)i / each;
        double height = pow(up, e);
        double along = i <= each ? peak * up : 1.0 - (1.0 - peak) * up;
        steps[i] = (FrToothStep){along, lean * height, height};
    }
    return 2 * each;
}

FrTooth fr_tooth_at(const FrBladeForm *form, uint32_t tooth, uint32_t teeth) {
    // They shrink to both ends.
    double place = (tooth + 0.5) / teeth, each = (LAST - FIRST) / teeth;
    double size = fmin(1.0, 4.0 * fmin(place, 1.0 - place) + 0.25);
    return (FrTooth){FIRST + tooth * each, each,
                     (double)form->blade->tooth_depth * form->width * size};
}

FrToothCorner fr_tooth_corner(const FrEdge *edge, const FrTooth *tooth, const FrToothStep *step) {
    double all = edge->way[edge->count - 1];
    Foot foot = foot_at(edge, all * (tooth->from + tooth->length * step->along));
    const FrOutlineRow *low = &edge->rows[foot.row], *next = low + 1;
    FrToothCorner corner = {.along = low->along + foot.part * (next->along - low->along),
                            .half = half_at(edge, foot.row),
                            .foot = edge_point(edge, foot)};
    corner.half += foot.part * (half_at(edge, foot.row + 1) - corner.half);
    corner.normal = fr_blade_normal(edge->form, corner.along, edge->side * corner.half);
    vec3s onward = glms_vec3_normalize(glms_vec3_sub(edge_point(edge, (Foot){foot.row, 1.0}),
                                                     edge_point(edge, (Foot){foot.row, 0.0})));
    vec3s out = glms_vec3_scale(glms_vec3_cross(onward, corner.normal), (float)edge->side);
    corner.top = glms_vec3_muladds(out, (float)(tooth->height * step->height), corner.foot);
    corner.top = glms_vec3_muladds(onward, (float)(all * tooth->length * step->lean), corner.top);
    return corner;
}

static void lay_tooth(FrShapeMesh *mesh, const FrEdge *edge, const FrTooth *tooth,
                      const FrToothStep *steps, uint32_t count) {
    uint32_t before[2] = {0, 0};
    for (uint32_t i = 0; i <= count; i++) {
        FrToothCorner corner = fr_tooth_corner(edge, tooth, &steps[i]);
        float v = (float)(1.0 - corner.along);
        float u = (float)(0.5 + edge->side * (1.0 - WITHIN) * corner.half / edge->form->width);
        uint32_t foot = fr_shape_vertex(mesh, corner.foot, corner.normal, u, v);
        uint32_t above =
            steps[i].height > 1e-6 ? fr_shape_vertex(mesh, corner.top, corner.normal, u, v) : foot;
        uint32_t a = before[0], b = foot, c = above, d = before[1];
        if (i > 0 && edge->side > 0.0) {
            fr_shape_triangle(mesh, a, d, c);
            fr_shape_triangle(mesh, a, c, b);
        } else if (i > 0) {
            fr_shape_triangle(mesh, a, c, d);
            fr_shape_triangle(mesh, a, b, c);
        }
        before[0] = foot;
        before[1] = above;
    }
}

void fr_margin_teeth(FrShapeMesh *mesh, const FrBladeForm *form, const FrOutlineRow *rows,
                     uint32_t count, const FrDetail *detail) {
    const FrBlade *blade = form->blade;
    if (!fr_blade_has_teeth(blade) || detail->lod >= TEETH_GONE || count < 2) {
        return;
    }
    FrToothStep steps[FR_TOOTH_STEPS_MOST + 1];
    uint32_t step_count = fr_tooth_steps(blade, detail->lod > 0, steps);
    uint32_t teeth = fr_shape_segments(blade->teeth, 1, blade->teeth, detail);
    for (double side = -1.0; side < 2.0; side += 2.0) {
        FrEdge edge;
        fr_edge_init(&edge, form, rows, count, side);
        for (uint32_t k = 0; k < teeth && edge.way[count - 1] > 0.0; k++) {
            FrTooth tooth = fr_tooth_at(form, k, teeth);
            lay_tooth(mesh, &edge, &tooth, steps, step_count);
        }
        fr_edge_clear(&edge);
    }
}
