// A leaf as three surfaces: a petiole of constant radius and two patches from the midrib to the
// margins. Beneš. Generating a Model of Plant Using NURBS, Figure 5.
//
// A patch blends linearly from midrib to margin, S(u, v) = (1 − v) M(u) + v B(u); a blade that is
// curved across has cubic arcs instead. Both run through the rows of the outline (tensor product
// interpolation, The NURBS Book, section 9.2.5), and the halves share the midrib's control points.
// With exact margins a half is the Coons patch of midrib, margin, base and tip; where blades begin
// and end in points that is the linear blend.
//
// A blade with teeth has straight pieces along u, with a corner at every corner of a tooth.
#include "skin/nurbs_leaf.h"

#include "skin/margin.h"
#include "skin/shape.h"

#include <string.h>

enum { EVEN_ROWS = 16, LEAST_ROWS = 9, MOST_ROWS = 41, ACROSS_MOST = 4, PETIOLE_POINTS = 5 };
enum { ROWS_A_LOBE = 8, ROWS_OF_ALL = MOST_ROWS + ROWS_A_LOBE * FR_LOBES_MOST, STALK_ROWS = 16 };

uint64_t fr_nurbs_leaf_bytes_most(const FrBlade *blade, const FrNurbsParams *params) {
    uint64_t rows = params->margins == FR_MARGINS_EXACT ? FR_OUTLINE_FINE + 1 : ROWS_OF_ALL;
    if (fr_blade_has_teeth(blade)) {
        rows = 2 * rows + (uint64_t)blade->teeth * (FR_TOOTH_STEPS_MOST + 1);
    }
    uint64_t patch = rows * (ACROSS_MOST * 6 + 1) + 16, stalk = 9 * STALK_ROWS * 4 + 80;
    uint64_t each = (2 * patch + 2 * stalk) * sizeof(double) + 8 * sizeof(FrNurbsForm);
    return fr_count_multiply(each, fr_compound_leaflets(blade) + 1);
}

/// Closes the petiole before it: as a rim and its middle.
static void lay_cap(GArray *forms, const FrNurbsStation *end, bool is_tip) {
    const FrNurbsForm *last = &g_array_index(forms, FrNurbsForm, forms->len - 1);
    FrNurbsForm tube = is_tip ? g_array_index(forms, FrNurbsForm, forms->len - 2) : *last;
    uint32_t width = tube.count_u;
    FrNurbsForm *cap =
        fr_nurbs_form_add(forms, is_tip ? FR_NURBS_CAP : FR_NURBS_FOOT, tube.degree_u, width, 1, 2);
    static const double ruled[] = {0, 0, 1, 1};
    memcpy(cap->knots_u, tube.knots_u, sizeof(double) * (width + tube.degree_u + 1));
    memcpy(cap->knots_v, ruled, sizeof ruled);
    const double(*rim)[4] =
        (const double(*)[4])tube.points + (is_tip ? (size_t)(tube.count_v - 1) * width : 0);
    for (uint32_t i = 0; i < width; i++) {
        double *middle = cap->points[is_tip ? width + i : i];
        memcpy(cap->points[is_tip ? i : width + i], rim[i], sizeof *rim);
        memcpy(middle, end->at, sizeof end->at);
        middle[3] = rim[i][3];
    }
}

void fr_nurbs_stalk(GArray *forms, FrNurbsPath *path, const FrNurbsParams *params) {
    FrNurbsParams plain = *params;
    plain.join = FR_JOIN_NEAR;
    uint32_t rows = fr_nurbs_rows(path, &plain);
    if (rows == 0) {
        return;
    }
    FrNurbsCurve circle = fr_nurbs_circle((FrNurbsCircle)params->circle);
    FrNurbsSection section = {circle, circle, true, true, false};
    FrNurbsForm *tube =
        fr_nurbs_form_add(forms, FR_NURBS_TUBE, circle.degree, circle.count, 3, rows);
    memcpy(tube->knots_u, circle.knots, sizeof(double) * (circle.count + circle.degree + 1));
    fr_nurbs_sweep(path, &section, NULL, &plain, tube->points, tube->knots_v);
    if (params->thickness > 0.0) {
        lay_cap(forms, &path->stations[0], false);
        lay_cap(forms, &path->stations[path->count - 1], true);
    }
    fr_nurbs_curve_clear(&circle);
}

static void lay_petiole(GArray *forms, const FrBladeForm *form, const FrNurbsParams *params) {
    const FrBlade *blade = form->blade;
    if (!(blade->petiole_length > 0.0F && blade->petiole_radius > 0.0F)) {
        return;
    }
    FrNurbsPath path = {0};
    double radius = fmax((double)blade->petiole_radius, 1e-5);
    uint32_t pieces = fabsf(blade->petiole_bend) > 0.01F ? PETIOLE_POINTS - 1 : 1;
    for (uint32_t i = 0; i <= pieces; i++) {
        double at[3];
        fr_blade_petiole(form, (double)i / pieces, at);
        fr_nurbs_path_add(&path, at, radius, 1.0, FR_NONE);
    }
    fr_nurbs_stalk(forms, &path, params);
    fr_nurbs_path_clear(&path);
}

// Parameters along the blade: by the way the midrib and both margins go.
static void set_parameters(const FrBladeForm *form, const FrOutlineRow *rows, uint32_t count,
                           double *at) {
    double last[3][3];
    for (uint32_t i = 0; i < count; i++) {
        const double aside[3] = {-rows[i].left * form->width, 0.0, rows[i].right * form->width};
        at[i] = i > 0 ? at[i - 1] + 1e-6 * form->width : 0.0;
        for (int k = 0; k < 3; k++) {
            double point[3];
            fr_blade_point(form, rows[i].along, aside[k], point);
            for (int d = 0; d < 3 && i > 0; d++) {
                last[k][d] -= point[d];
            }
            at[i] += i > 0 ? sqrt(fr_dot3(last[k], last[k])) : 0.0;
            memcpy(last[k], point, sizeof point);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        at[i] /= at[count - 1];
    }
}

/// The point of a row at the part `out` of the way from the midrib to the margin, and its place in
/// pictures.
static void row_point(const FrBladeForm *form, const FrNurbsRows *rows, uint32_t row, double side,
                      double out, double point[4], double texture[2]) {
    const FrOutlineRow *r = &rows->rows[row];
    const FrNurbsMargin *margin = rows->margins != NULL ? &rows->margins[row][side > 0.0] : NULL;
    double width = side > 0.0 ? r->right : r->left;
    double along = margin != NULL ? r->along + out * (margin->along - r->along) : r->along;
    fr_blade_point(form, along, side * out * width * form->width, point);
    if (margin != NULL && out == 1.0) {
        memcpy(point, margin->at, sizeof margin->at);
    }
    point[3] = 1.0;
    texture[0] = fmin(fmax(0.5 + side * out * width, 0.0), 1.0);
    texture[1] = 1.0 - along;
}

// `side` −1 is the left half, 1 the right one, whose v begins at the margin.
static void lay_half(GArray *forms, const FrBladeForm *form, const FrNurbsRows *rows,
                     uint32_t across, double side) {
    const double *at = rows->at;
    uint32_t count = rows->count, degree = rows->margins != NULL ? 1 : 3;
    uint32_t kind = side > 0.0 ? FR_NURBS_RIGHT : FR_NURBS_LEFT;
    FrNurbsForm *half = fr_nurbs_form_add(forms, kind, degree, count, across - 1, across);
    const double ends[] = {0.0, 1.0 / 3, 2.0 / 3, 1.0};
    double parts[ACROSS_MOST];
    half->texture = g_malloc_n((size_t)across * count, sizeof *half->texture);
    for (uint32_t j = 0; j < across; j++) {
        parts[j] = across == 2 ? (double)j : ends[j];
        double out = side > 0.0 ? 1.0 - parts[j] : parts[j];
        for (uint32_t i = 0; i < count; i++) {
            size_t n = (size_t)j * count + i;
            row_point(form, rows, i, side, out, half->points[n], half->texture[n]);
        }
    }
    fr_nurbs_average_knots(at, count, degree, half->knots_u);
    fr_nurbs_average_knots(parts, across, across - 1, half->knots_v);
    for (uint32_t j = 0; j < across && degree > 1; j++) {
        fr_nurbs_interpolate(half->knots_u, 3, at, count, half->points[j * count], 3, 4);
        fr_nurbs_interpolate(half->knots_u, 3, at, count, half->texture[j * count], 2, 2);
    }
    for (uint32_t i = 0; i < count && across > 2; i++) {
        fr_nurbs_interpolate(half->knots_v, across - 1, parts, across, half->points[i], 3,
                             4 * count);
        fr_nurbs_interpolate(half->knots_v, across - 1, parts, across, half->texture[i], 2,
                             2 * count);
    }
}

// ---- exact margins -----------------------------------------------------------------------------

/// Every place of the outline where it bends, and as many more as the blade may bend at.
static uint32_t exact_rows(const FrOutline *outline, FrOutlineRow *rows) {
    uint32_t count = 0;
    for (int i = 0; i <= FR_OUTLINE_FINE; i++) {
        const double *l = &outline->left[i], *r = &outline->right[i];
        bool is_end = i == 0 || i == FR_OUTLINE_FINE;
        bool bends = !is_end && (fabs(l[1] - 2.0 * l[0] + l[-1]) > 1e-9 ||
                                 fabs(r[1] - 2.0 * r[0] + r[-1]) > 1e-9);
        if (is_end || bends || i % EVEN_ROWS == 0) {
            rows[count++] = (FrOutlineRow){(double)i / FR_OUTLINE_FINE, *l, *r};
        }
    }
    return count;
}

/// A line across half a blade at a row, from `begin` to `end` of the way to the margin.
static FrNurbsCurve line_across(const FrBladeForm *form, const FrOutlineRow *row, double side,
                                double begin, double end, uint32_t across) {
    FrNurbsCurve line = {.degree = across - 1, .count = across};
    line.knots = g_new(double, 2 * (size_t)across);
    line.points = g_malloc_n(across, sizeof *line.points);
    double parts[ACROSS_MOST], width = (side > 0.0 ? row->right : row->left) * form->width;
    for (uint32_t j = 0; j < across; j++) {
        parts[j] = (double)j / (across - 1);
        double out = begin + parts[j] * (end - begin);
        fr_blade_point(form, row->along, side * out * width, line.points[j]);
        line.points[j][3] = 1.0;
    }
    fr_nurbs_average_knots(parts, across, across - 1, line.knots);
    if (across > 2) {
        fr_nurbs_interpolate(line.knots, across - 1, parts, across, line.points[0], 3, 4);
    }
    return line;
}

/// The polygon through a line along half a blade: its midrib (`out` 0) or its margin (1).
static FrNurbsCurve line_along(const FrBladeForm *form, const FrOutlineRow *rows, uint32_t count,
                               const double *at, double side, double out) {
    FrNurbsCurve line = {.degree = 1, .count = count};
    line.knots = g_new(double, (size_t)count + 2);
    line.points = g_malloc_n(count, sizeof *line.points);
    for (uint32_t i = 0; i < count; i++) {
        double width = (side > 0.0 ? rows[i].right : rows[i].left) * form->width;
        fr_blade_point(form, rows[i].along, side * out * width, line.points[i]);
        line.points[i][3] = 1.0;
    }
    fr_nurbs_average_knots(at, count, 1, line.knots);
    return line;
}

static void lay_exact_half(GArray *forms, const FrBladeForm *form, const FrOutlineRow *rows,
                           uint32_t count, const double *at, uint32_t across, double side) {
    double begin = side > 0.0 ? 1.0 : 0.0, end = 1.0 - begin;
    FrNurbsCurve sides[4] = {line_along(form, rows, count, at, side, begin),
                             line_along(form, rows, count, at, side, end),
                             line_across(form, &rows[0], side, begin, end, across),
                             line_across(form, &rows[count - 1], side, begin, end, across)};
    uint32_t kind = side > 0.0 ? FR_NURBS_RIGHT : FR_NURBS_LEFT;
    FrNurbsForm *half = fr_nurbs_form_add(forms, kind, 1, count, across - 1, across);
    memcpy(half->knots_u, sides[0].knots, sizeof(double) * ((size_t)count + 2));
    memcpy(half->knots_v, sides[2].knots, sizeof(double) * 2 * across);
    fr_nurbs_coons(&sides[0], &sides[1], &sides[2], &sides[3], half->points);
    half->texture = g_malloc_n((size_t)across * count, sizeof *half->texture);
    for (uint32_t n = 0; n < across * count; n++) {
        const FrOutlineRow *row = &rows[n % count];
        double part = fr_nurbs_greville(half->knots_v, across - 1, n / count);
        double out = begin + part * (end - begin), width = side > 0.0 ? row->right : row->left;
        half->texture[n][0] = fmin(fmax(0.5 + side * out * width, 0.0), 1.0);
        half->texture[n][1] = 1.0 - row->along;
    }
    for (int k = 0; k < 4; k++) {
        fr_nurbs_curve_clear(&sides[k]);
    }
}

static void lay_exact(GArray *forms, const FrBladeForm *form, const FrOutline *outline,
                      uint32_t across) {
    FrOutlineRow rows[FR_OUTLINE_FINE + 1];
    double at[FR_OUTLINE_FINE + 1];
    uint32_t count = exact_rows(outline, rows);
    set_parameters(form, rows, count, at);
    lay_exact_half(forms, form, rows, count, at, across, 1.0);
    lay_exact_half(forms, form, rows, count, at, across, -1.0);
}

static void lay_rows(GArray *forms, const FrBladeForm *form, FrNurbsRows *rows, uint32_t across) {
    set_parameters(form, rows->rows, rows->count, rows->at);
    lay_half(forms, form, rows, across, 1.0);
    lay_half(forms, form, rows, across, -1.0);
    fr_nurbs_rows_clear(rows);
}

/// How many rows a blade with smooth margins has.
static uint32_t smooth_rows(const FrBlade *blade) {
    double waves = blade->wave != 0.0F ? 8.0 * fabs((double)blade->waves) : 0.0;
    double bumps = blade->undulation > 0.0F ? 4.0 * (double)blade->undulations : 0.0;
    double bends = fmin(fmax(waves, bumps), MOST_ROWS);
    uint32_t count =
        CLAMP(MAX(3U * blade->segments_along, (uint32_t)bends) + 1, LEAST_ROWS, MOST_ROWS);
    bool is_lobed = blade->margin == FR_MARGIN_LOBED;
    return count + (is_lobed ? ROWS_A_LOBE * MIN(blade->teeth, FR_LOBES_MOST) : 0);
}

void fr_nurbs_rows_clear(FrNurbsRows *rows) {
    g_free(rows->rows);
    g_free(rows->at);
    g_free(rows->margins);
}

void fr_nurbs_leaf(GArray *forms, const FrPlant *plant, const FrBlade *blade,
                   const FrNurbsParams *params) {
    if (blade->compound == FR_COMPOUND_SIMPLE) {
        fr_nurbs_blade(forms, plant, blade, params);
    } else {
        fr_nurbs_compound(forms, plant, blade, params);
    }
}

void fr_nurbs_blade(GArray *forms, const FrPlant *plant, const FrBlade *blade,
                    const FrNurbsParams *params) {
    FrBladeForm form;
    bool has_blade = fr_blade_form_init(&form, plant, blade);
    lay_petiole(forms, &form, params);
    FrOutline outline;
    fr_outline_init(&outline, plant, blade->outline);
    if (!has_blade || !(outline.area > 1e-6)) {
        return;
    }
    fr_outline_lobe(&outline, blade);
    fr_outline_thicken(&outline, blade);
    bool is_level = blade->curvature_across == 0.0F && blade->wave == 0.0F &&
                    blade->edge_curl == 0.0F && blade->undulation == 0.0F;
    uint32_t across = is_level ? 2 : ACROSS_MOST;
    bool is_exact = params->margins == FR_MARGINS_EXACT, is_toothed = fr_blade_has_teeth(blade);
    if (is_exact && !is_toothed) {
        lay_exact(forms, &form, &outline, across);
        return;
    }
    FrOutlineRow base[MAX(FR_OUTLINE_FINE + 1, ROWS_OF_ALL)];
    uint32_t count = is_exact ? exact_rows(&outline, base) : smooth_rows(blade);
    if (!is_exact) {
        fr_outline_rows(&outline, count - 1, base);
    }
    FrNurbsRows rows;
    if (is_toothed) {
        fr_nurbs_toothed(&form, base, count, &rows);
    } else {
        rows =
            (FrNurbsRows){g_memdup2(base, count * sizeof *base), g_new(double, count), NULL, count};
    }
    lay_rows(forms, &form, &rows, across);
}
