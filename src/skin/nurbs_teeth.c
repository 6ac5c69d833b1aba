// Teeth of a blade as corners of its margin. Both halves have their rows at the same parts of their
// edges, so that they share the midrib.
//
// Rows that went straight across would pass over one another where the margin turns to the tip.
// They go along the normals of the outline instead: the normal at the half width x meets the midrib
// at along + (x² / 2)′ / length².
#include "skin/nurbs_leaf.h"

#include "skin/margin.h"

#include <stdlib.h>
#include <string.h>

/// Rows nearer than this part of an edge are one.
#define NEAR 1e-6
/// How far a tooth leans on at most, over its foot: it does not hang over the next one.
#define LEAN_MOST 0.97
/// How far rows go on along the midrib at least, for what they go on along the margin.
#define APART 0.4

static int compare_reals(const void *a, const void *b) {
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/// Parts of the edges where they or their teeth have corners, rising from 0 to 1.
static GArray *corners_of(const FrEdge edges[2], const FrToothStep *steps, uint32_t step_count) {
    GArray *parts = g_array_new(FALSE, FALSE, sizeof(double));
    for (int side = 0; side < 2; side++) {
        for (uint32_t i = 0; i < edges[side].count; i++) {
            double part = edges[side].way[i] / edges[side].way[edges[side].count - 1];
            g_array_append_val(parts, part);
        }
    }
    uint32_t teeth = edges[0].form->blade->teeth;
    for (uint32_t k = 0; k < teeth; k++) {
        FrTooth tooth = fr_tooth_at(edges[0].form, k, teeth);
        for (uint32_t s = 0; s <= step_count; s++) {
            double part = tooth.from + tooth.length * steps[s].along;
            g_array_append_val(parts, part);
        }
    }
    g_array_sort(parts, compare_reals);
    double *at = (double *)(void *)parts->data;
    uint32_t kept = 1;
    for (uint32_t i = 1; i < parts->len; i++) {
        if (at[i] > at[kept - 1] + NEAR) {
            at[kept++] = at[i];
        }
    }
    at[kept - 1] = 1.0;
    g_array_set_size(parts, kept);
    return parts;
}

/// The tooth over a part of the edge, and the step between its steps there; none is level.
static FrTooth tooth_over(const FrBladeForm *form, double part, const FrToothStep *steps,
                          uint32_t step_count, FrToothStep *step) {
    uint32_t teeth = form->blade->teeth;
    FrTooth first = fr_tooth_at(form, 0, teeth);
    double number = floor((part - first.from) / first.length + NEAR);
    *step = (FrToothStep){0};
    if (!(number >= 0.0 && number < teeth)) {
        return (FrTooth){part, 0.0, 0.0};
    }
    FrTooth tooth = fr_tooth_at(form, (uint32_t)number, teeth);
    double along = fmin(fmax((part - tooth.from) / tooth.length, 0.0), 1.0);
    uint32_t s = 1;
    while (s < step_count && steps[s].along < along) {
        s++;
    }
    double width = steps[s].along - steps[s - 1].along;
    double way = width > 0.0 ? (along - steps[s - 1].along) / width : 1.0;
    *step = (FrToothStep){along, steps[s - 1].lean + way * (steps[s].lean - steps[s - 1].lean),
                          steps[s - 1].height + way * (steps[s].height - steps[s - 1].height)};
    return tooth;
}

static double square_slope(const FrEdge *edge, uint32_t row) {
    const FrOutlineRow *a = &edge->rows[row > 0 ? row - 1 : 0];
    const FrOutlineRow *b = &edge->rows[MIN(row + 1, edge->count - 1)];
    double from = edge->side < 0.0 ? a->left : a->right;
    double to = edge->side < 0.0 ? b->left : b->right, way = b->along - a->along;
    return way > 0.0 ? 0.5 * (to * to - from * from) / way : 0.0;
}

/// Where the normal of the outline at `along` comes from the midrib.
static double root_of(const FrEdge *edge, double along) {
    uint32_t row = 0;
    while (row + 2 < edge->count && edge->rows[row + 1].along < along) {
        row++;
    }
    double low = edge->rows[row].along, width = edge->rows[row + 1].along - low;
    double part = width > 0.0 ? fmin(fmax((along - low) / width, 0.0), 1.0) : 0.0;
    double slope = (1.0 - part) * square_slope(edge, row) + part * square_slope(edge, row + 1);
    double flat = edge->form->width / fmax((double)edge->form->blade->length, 1e-6);
    return along + flat * flat * slope;
}

static void end_row(const FrBladeForm *form, const FrOutlineRow *base, FrOutlineRow *row,
                    FrNurbsMargin margins[2]) {
    *row = *base;
    fr_blade_point(form, row->along, -row->left * form->width, margins[0].at);
    fr_blade_point(form, row->along, row->right * form->width, margins[1].at);
    margins[0].along = margins[1].along = row->along;
}

static void tooth_row(const FrEdge edges[2], const FrTooth *tooth, const FrToothStep *step,
                      FrOutlineRow *row, FrNurbsMargin margins[2]) {
    static const FrToothStep level = {0};
    FrTooth below = {tooth->from + tooth->length * (step->along + step->lean), 0.0, 0.0};
    double halves[2], root = 0.0;
    for (int side = 0; side < 2; side++) {
        FrToothCorner corner = fr_tooth_corner(&edges[side], tooth, step);
        for (int k = 0; k < 3; k++) {
            margins[side].at[k] = (double)corner.top.raw[k];
        }
        corner = fr_tooth_corner(&edges[side], &below, &level);
        margins[side].along = corner.along;
        halves[side] = corner.half / edges[side].form->width;
        root += 0.5 * root_of(&edges[side], corner.along);
    }
    *row = (FrOutlineRow){fmin(fmax(root, 0.0), 1.0), halves[0], halves[1]};
}

static double foot_of(const FrNurbsRows *rows, uint32_t row) {
    return 0.5 * (rows->margins[row][0].along + rows->margins[row][1].along);
}

/// Rows go on along the midrib by a part of what they go on along the margin, at least.
static void keep_apart(FrNurbsRows *rows) {
    for (uint32_t i = 1; i + 1 < rows->count; i++) {
        double least = APART * fmax(foot_of(rows, i) - foot_of(rows, i - 1), 0.0);
        rows->rows[i].along = fmax(rows->rows[i].along, rows->rows[i - 1].along + least);
    }
    for (uint32_t i = rows->count - 1; i-- > 1;) {
        double least = APART * fmax(foot_of(rows, i + 1) - foot_of(rows, i), 0.0);
        rows->rows[i].along = fmin(rows->rows[i].along, rows->rows[i + 1].along - least);
    }
}

void fr_nurbs_toothed(const FrBladeForm *form, const FrOutlineRow *base, uint32_t base_count,
                      FrNurbsRows *rows) {
    FrToothStep steps[FR_TOOTH_STEPS_MOST + 1];
    uint32_t step_count = fr_tooth_steps(form->blade, false, steps);
    for (uint32_t s = 0; s <= step_count; s++) {
        steps[s].lean = fmin(steps[s].lean, fmax(LEAN_MOST - steps[s].along, 0.0));
    }
    FrEdge edges[2];
    fr_edge_init(&edges[0], form, base, base_count, -1.0);
    fr_edge_init(&edges[1], form, base, base_count, 1.0);
    GArray *parts = corners_of(edges, steps, step_count);
    *rows = (FrNurbsRows){.rows = g_new(FrOutlineRow, parts->len),
                          .at = g_new(double, parts->len),
                          .margins = g_malloc_n(parts->len, sizeof *rows->margins),
                          .count = parts->len};
    end_row(form, &base[0], &rows->rows[0], rows->margins[0]);
    for (uint32_t i = 1; i + 1 < parts->len; i++) {
        FrToothStep step;
        FrTooth tooth = tooth_over(form, g_array_index(parts, double, i), steps, step_count, &step);
        tooth_row(edges, &tooth, &step, &rows->rows[i], rows->margins[i]);
    }
    end_row(form, &base[base_count - 1], &rows->rows[parts->len - 1],
            rows->margins[parts->len - 1]);
    keep_apart(rows);
    g_array_unref(parts);
    fr_edge_clear(&edges[0]);
    fr_edge_clear(&edges[1]);
}
