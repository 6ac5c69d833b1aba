// Forms of leaves: half outlines from base to tip, or both halves where they differ.
// Superformula: Gielis. A generic geometric transformation that unifies a wide range of natural and
// abstract shapes. American Journal of Botany 90 (3), 2003.
#include "pgraph/prepare.h"

#include <math.h>

#define PI 3.14159265358979323846

enum { OUTLINE_POINTS = 25, SUPER_POINTS = 181 };

// Width w(t) = t^base (1 − t)^tip over its greatest value, which lies at base/(base + tip):
// a small exponent is blunt, 1 is a straight edge to a point, more is drawn out.
typedef struct Form {
    double base, tip;
} Form;

enum {
    ELLIPTIC,
    OVATE,
    OBOVATE,
    LANCEOLATE,
    OBLANCEOLATE,
    LINEAR,
    CORDATE,
    ORBICULAR,
    RHOMBIC,
    SPATULATE,
    DELTOID,
    PETAL,
    SUPERFORMULA
};

static const Form forms[] = {
    [ELLIPTIC] = {0.5, 0.5},   [OVATE] = {0.5, 0.95},       [OBOVATE] = {0.95, 0.5},
    [LANCEOLATE] = {0.7, 1.4}, [OBLANCEOLATE] = {1.4, 0.7}, [LINEAR] = {0.12, 0.3},
    [CORDATE] = {0.12, 0.85},  [ORBICULAR] = {0.42, 0.42},  [RHOMBIC] = {1, 1},
    [SPATULATE] = {2.2, 0.35}, [DELTOID] = {0.1, 0.9},      [PETAL] = {0.8, 0.22},
};

// Radius towards `angle`, 0 where it has no bound.
static double super_radius(const FrLeafParams *leaf, double angle) {
    double turn = 0.25 * leaf->super_m * angle;
    double sum = pow(fabs(cos(turn) / leaf->super_a), leaf->super_n2) +
                 pow(fabs(sin(turn) / leaf->super_b), leaf->super_n3);
    double radius = pow(sum, -1 / leaf->super_n1);
    return radius <= 1e6 ? radius : 0;
}

// The right half, from the base, half a turn from the tip; as long as the leaf and as wide.
static uint32_t superformula(FrPlant *plant, const FrLeafParams *leaf) {
    double points[SUPER_POINTS][2], low = INFINITY, high = -INFINITY, widest = 0;
    for (int k = 0; k < SUPER_POINTS; k++) {
        double angle = PI * (1 - (double)k / (SUPER_POINTS - 1));
        double radius = super_radius(leaf, angle);
        points[k][0] = radius * cos(angle);
        points[k][1] = radius * sin(angle);
        low = fmin(low, points[k][0]);
        high = fmax(high, points[k][0]);
        widest = fmax(widest, points[k][1]);
    }
    if (!(high - low > 1e-9) || !(widest > 1e-9)) {
        return FR_NONE;
    }
    for (int k = 0; k < SUPER_POINTS; k++) {
        points[k][0] = (points[k][0] - low) / (high - low);
        points[k][1] = 0.5 * points[k][1] / widest;
    }
    return fr_plant_add_profile(plant, (const double(*)[2])points, SUPER_POINTS, false);
}

// Both halves, the left one from the tip back to the base.
static uint32_t two_sided(FrPlant *plant, const FrPoints *right, const FrPoints *left) {
    uint32_t count = (uint32_t)(right->count + left->count);
    double(*points)[2] = g_malloc_n(count, sizeof *points);
    for (size_t k = 0; k < right->count; k++) {
        points[k][0] = right->at[k][0];
        points[k][1] = right->at[k][1];
    }
    for (size_t k = 0; k < left->count; k++) {
        points[count - 1 - k][0] = left->at[k][0];
        points[count - 1 - k][1] = -left->at[k][1];
    }
    uint32_t profile = fr_plant_add_profile(plant, (const double(*)[2])points, count, true);
    g_free(points);
    return profile;
}

static uint32_t form_outline(FrPlant *plant, int outline) {
    FR_ASSERT(outline >= 0 && (size_t)outline < G_N_ELEMENTS(forms));
    if (outline == ELLIPTIC) {
        return FR_NONE; // what blades are without an outline
    }
    Form form = forms[outline];
    double widest = form.base / (form.base + form.tip);
    double most = pow(widest, form.base) * pow(1 - widest, form.tip);
    double points[OUTLINE_POINTS][2];
    for (int k = 0; k < OUTLINE_POINTS; k++) {
        // Denser at both ends, where outlines are round.
        double t = 0.5 - 0.5 * cos(PI * k / (OUTLINE_POINTS - 1));
        points[k][0] = t;
        points[k][1] = 0.5 * pow(t, form.base) * pow(1 - t, form.tip) / most;
    }
    points[0][0] = points[0][1] = points[OUTLINE_POINTS - 1][1] = 0;
    points[OUTLINE_POINTS - 1][0] = 1;
    return fr_plant_add_profile(plant, (const double(*)[2])points, OUTLINE_POINTS, false);
}

uint32_t fr_leaf_outline(FrPlant *plant, const FrLeafParams *leaf) {
    const FrPoints *points = &leaf->outline_points;
    if (points->count < 2) {
        return leaf->outline == SUPERFORMULA ? superformula(plant, leaf)
                                             : form_outline(plant, leaf->outline);
    }
    if (leaf->left_points.count >= 2) {
        return two_sided(plant, points, &leaf->left_points);
    }
    return fr_plant_add_profile(plant, (const double(*)[2])points->at, (uint32_t)points->count,
                                false);
}
