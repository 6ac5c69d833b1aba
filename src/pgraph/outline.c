// Forms of leaves: half outlines from base to tip.
#include "pgraph/prepare.h"

#include <math.h>

enum { OUTLINE_POINTS = 25 };

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
    PETAL
};

static const Form forms[] = {
    [ELLIPTIC] = {0.5, 0.5},   [OVATE] = {0.5, 0.95},       [OBOVATE] = {0.95, 0.5},
    [LANCEOLATE] = {0.7, 1.4}, [OBLANCEOLATE] = {1.4, 0.7}, [LINEAR] = {0.12, 0.3},
    [CORDATE] = {0.12, 0.85},  [ORBICULAR] = {0.42, 0.42},  [RHOMBIC] = {1, 1},
    [SPATULATE] = {2.2, 0.35}, [DELTOID] = {0.1, 0.9},      [PETAL] = {0.8, 0.22},
};

uint32_t fr_leaf_outline(FrPlant *plant, int outline) {
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
        double t = 0.5 - 0.5 * cos(3.14159265358979323846 * k / (OUTLINE_POINTS - 1));
        points[k][0] = t;
        points[k][1] = 0.5 * pow(t, form.base) * pow(1 - t, form.tip) / most;
    }
    points[0][0] = points[0][1] = points[OUTLINE_POINTS - 1][1] = 0;
    points[OUTLINE_POINTS - 1][0] = 1;
    return fr_plant_add_profile(plant, (const double(*)[2])points, OUTLINE_POINTS, false);
}
