// What differs along a leaf itself, from its base to its tip, as curves of its shape.
#include "pgraph/prepare.h"

#include <math.h>

enum { POINTS = 33 };

typedef struct Sampled {
    double points[POINTS][2];
} Sampled;

static Sampled sample(const FrNumber *number, uint32_t parameter, FrEvaluator *evaluator) {
    Sampled sampled;
    for (int k = 0; k < POINTS; k++) {
        sampled.points[k][0] = evaluator->vars.value[FR_VAR_s] = (double)k / (POINTS - 1);
        sampled.points[k][1] = fr_value(evaluator, number, parameter);
    }
    evaluator->vars.value[FR_VAR_s] = 0;
    return sampled;
}

static uint32_t add(FrPlant *plant, const Sampled *sampled) {
    return fr_plant_add_profile(plant, (const double(*)[2])sampled->points, POINTS, false);
}

// The mean size at the middles of halved steps, where skin reads it: it spreads a turn by a curve
// over its mean.
static double mean_size(const Sampled *sampled) {
    double sum = 0;
    for (int k = 0; k + 1 < POINTS; k++) {
        double a = sampled->points[k][1], b = sampled->points[k + 1][1];
        sum += fabs(0.75 * a + 0.25 * b) + fabs(0.25 * a + 0.75 * b);
    }
    return sum / (2 * (POINTS - 1));
}

static void bend_along(FrBlade *blade, const FrLeafParams *leaf, FrEvaluator *evaluator,
                       FrPlant *plant) {
    Sampled turn = sample(&leaf->curvature_along, FR_LEAF_curvature_along, evaluator);
    if (leaf->along_curve != NULL) {
        Sampled spread;
        for (int k = 0; k < POINTS; k++) {
            spread.points[k][1] = fr_curve_eval(leaf->along_curve, turn.points[k][0]);
        }
        double mean = mean_size(&spread);
        for (int k = 0; k < POINTS; k++) {
            turn.points[k][1] *= mean > 0 ? spread.points[k][1] / mean : 0;
        }
    }
    blade->curvature_along = (float)mean_size(&turn);
    blade->along_curve = add(plant, &turn);
}

bool fr_leaf_is_along(const FrLeafParams *leaf) {
    return fr_number_uses(&leaf->curvature_along, FR_VAR_s) ||
           fr_number_uses(&leaf->curvature_across, FR_VAR_s) ||
           fr_number_uses(&leaf->fold, FR_VAR_s) || fr_number_uses(&leaf->twist, FR_VAR_s) ||
           fr_number_uses(&leaf->wave, FR_VAR_s);
}

void fr_leaf_along(FrBlade *blade, const FrLeafParams *leaf, FrEvaluator *evaluator,
                   FrPlant *plant) {
    const struct {
        const FrNumber *number;
        uint32_t parameter, *curve;
        float *value;
    } rows[] = {
        {&leaf->curvature_across, FR_LEAF_curvature_across, &blade->across_along,
         &blade->curvature_across},
        {&leaf->fold, FR_LEAF_fold, &blade->fold_along, &blade->fold},
        {&leaf->twist, FR_LEAF_twist, &blade->twist_along, &blade->twist},
        {&leaf->wave, FR_LEAF_wave, &blade->wave_along, &blade->wave},
    };
    if (fr_number_uses(&leaf->curvature_along, FR_VAR_s)) {
        bend_along(blade, leaf, evaluator, plant);
    }
    for (size_t k = 0; k < G_N_ELEMENTS(rows); k++) {
        if (fr_number_uses(rows[k].number, FR_VAR_s)) {
            Sampled sampled = sample(rows[k].number, rows[k].parameter, evaluator);
            *rows[k].value = 1;
            *rows[k].curve = add(plant, &sampled) + 1;
        }
    }
}
