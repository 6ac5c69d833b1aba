// Outlines of blades, and the few rows of a mesh that represent them.
//
// A piecewise linear curve with n knots fits best where the knots are spread as the square root of
// the second derivative (de Boor, A Practical Guide to Splines, chapter III). An inscribed polygon
// is too small; it is widened so that the blade keeps its area at every level of detail.
#include "skin/outline.h"

#include <math.h>

// A blade without a petiole is this wide where it sits, in parts of its width: half of it.
#define LEAST_BASE 0.02

static void widest(double *half, double along_a, double y_a, double along_b, double y_b) {
    if (along_a > along_b) {
        widest(half, along_b, y_b, along_a, y_a);
        return;
    }
    double low = fmax(along_a, 0.0) * FR_OUTLINE_FINE, high = fmin(along_b, 1.0) * FR_OUTLINE_FINE;
    for (double at = ceil(low - 1e-9); at <= high + 1e-9 && at <= FR_OUTLINE_FINE; at += 1.0) {
        double length = along_b - along_a;
        double part = length > 0.0 ? (at / FR_OUTLINE_FINE - along_a) / length : 0.5;
        double y = y_a + fmin(fmax(part, 0.0), 1.0) * (y_b - y_a);
        int index = (int)at;
        half[index] = fmax(half[index], fmin(y, 0.5));
    }
}

static void trace(FrOutline *outline, const FrProfile *profile) {
    uint32_t edges = profile->is_closed ? profile->count : profile->count - 1;
    for (uint32_t i = 0; i < edges; i++) {
        const double *a = profile->points[i], *b = profile->points[(i + 1) % profile->count];
        if (!isfinite(a[0] + a[1] + b[0] + b[1])) {
            continue;
        }
        widest(outline->right, a[0], a[1], b[0], b[1]);
        if (profile->is_closed) {
            widest(outline->left, a[0], -a[1], b[0], -b[1]);
        }
    }
    for (int i = 0; i <= FR_OUTLINE_FINE && !profile->is_closed; i++) {
        outline->left[i] = outline->right[i];
    }
}

void fr_outline_init(FrOutline *outline, const FrPlant *plant, uint32_t profile) {
    *outline = (FrOutline){0};
    const FrProfile *form =
        profile < plant->profiles->len ? &g_array_index(plant->profiles, FrProfile, profile) : NULL;
    if (form != NULL && form->count >= 2) {
        trace(outline, form);
    } else {
        for (int i = 0; i <= FR_OUTLINE_FINE; i++) {
            double x = 2.0 * i / FR_OUTLINE_FINE - 1.0;
            outline->left[i] = outline->right[i] = 0.5 * sqrt(fmax(1.0 - x * x, 0.0));
        }
    }
    for (int i = 0; i < FR_OUTLINE_FINE; i++) {
        double sum = outline->left[i] + outline->right[i];
        outline->area += (sum + outline->left[i + 1] + outline->right[i + 1]) / 2.0;
    }
    outline->area /= FR_OUTLINE_FINE;
}

// Widens one half from its base to its widest place, and narrows the rest to keep its area.
static void thicken_half(double *half, double least) {
    int widest_at = 0;
    double before = 0.0, held = 0.0, free = 0.0;
    for (int i = 0; i <= FR_OUTLINE_FINE; i++) {
        widest_at = half[i] > half[widest_at] ? i : widest_at;
        before += half[i];
    }
    least = fmin(least, half[widest_at]);
    for (int i = 0; i <= FR_OUTLINE_FINE; i++) {
        half[i] = i < widest_at ? fmax(half[i], least) : half[i];
        held += fmin(half[i], least);
        free += fmax(half[i] - least, 0.0);
    }
    double narrower = free > 0.0 ? fmax(before - held, 0.0) / free : 1.0;
    for (int i = 0; i <= FR_OUTLINE_FINE; i++) {
        half[i] = half[i] > least ? least + narrower * (half[i] - least) : half[i];
    }
}

void fr_outline_thicken(FrOutline *outline, const FrBlade *blade) {
    bool has_petiole = blade->petiole_length > 0.0F && blade->petiole_radius > 0.0F;
    double least = (double)blade->petiole_radius / (double)blade->width;
    if (!has_petiole) {
        // Full bases look whole as they are.
        const int near = FR_OUTLINE_FINE / 50;
        least = outline->left[near] + outline->right[near] < 2.0 * LEAST_BASE ? LEAST_BASE : 0.0;
    }
    if (!(least > 0.0)) {
        return;
    }
    thicken_half(outline->left, least);
    thicken_half(outline->right, least);
    outline->least = least;
}

// How much of the bending of the outline lies before each fine step, in parts of all.
static void spread(const FrOutline *outline, double *before) {
    before[0] = 0.0;
    for (int i = 1; i <= FR_OUTLINE_FINE; i++) {
        double bend = 0.0;
        for (int k = i - 1; k <= i && k > 0 && k < FR_OUTLINE_FINE; k++) {
            const double *l = &outline->left[k], *r = &outline->right[k];
            bend += fabs(l[1] - 2.0 * l[0] + l[-1]) + fabs(r[1] - 2.0 * r[0] + r[-1]);
        }
        before[i] = before[i - 1] + sqrt(bend);
    }
    double all = before[FR_OUTLINE_FINE];
    for (int i = 1; i <= FR_OUTLINE_FINE; i++) {
        // Half evenly, since the blade may bend too.
        double even = (double)i / FR_OUTLINE_FINE;
        before[i] = all > 1e-9 ? 0.5 * before[i] / all + 0.5 * even : even;
    }
}

static double at(const double *half, double along) {
    double x = along * FR_OUTLINE_FINE;
    int low = (int)fmin(x, FR_OUTLINE_FINE - 1);
    return half[low] + (x - low) * (half[low + 1] - half[low]);
}

void fr_outline_rows(const FrOutline *outline, uint32_t segments, FrOutlineRow *rows) {
    double before[FR_OUTLINE_FINE + 1];
    spread(outline, before);
    int fine = 0;
    for (uint32_t i = 0; i <= segments; i++) {
        double wanted = (double)i / segments;
        while (fine < FR_OUTLINE_FINE - 1 && before[fine + 1] < wanted) {
            fine++;
        }
        double step = before[fine + 1] - before[fine];
        double part = step > 0.0 ? fmin(fmax((wanted - before[fine]) / step, 0.0), 1.0) : 0.0;
        double along = i == segments ? 1.0 : (fine + part) / FR_OUTLINE_FINE;
        rows[i] = (FrOutlineRow){along, at(outline->left, along), at(outline->right, along)};
    }
    double area = 0.0;
    for (uint32_t i = 0; i < segments; i++) {
        double sum = rows[i].left + rows[i].right + rows[i + 1].left + rows[i + 1].right;
        area += 0.5 * sum * (rows[i + 1].along - rows[i].along);
    }
    // Too few rows to see the outline at all: a rectangle.
    bool is_blind = area < 0.25 * outline->area;
    double wider = is_blind ? 0.0 : outline->area / fmax(area, 1e-12);
    for (uint32_t i = 0; i <= segments; i++) {
        // The base keeps its least width.
        double left = fmin(rows[i].left, outline->least);
        double right = fmin(rows[i].right, outline->least);
        rows[i].left = is_blind ? 0.5 * outline->area : fmax(wider * rows[i].left, left);
        rows[i].right = is_blind ? 0.5 * outline->area : fmax(wider * rows[i].right, right);
    }
}
