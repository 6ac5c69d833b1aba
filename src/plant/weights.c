// Radii of branches by weights. Beneš, Generating a Model of Plant Using NURBS: the weight that an
// order gives a branch is its radius. Weibel and Strahler: one thickness an order, `ratio` apart.
// Holton. Strands, gravity and botanical tree imagery. Computer Graphics Forum 13(1), 1994: a
// branch holds a strand for each tip above, and its cross-section grows with their number.
#include "frond/plant.h"

#include <math.h>

/// Thicker than this is no branch, however many orders there are.
#define THICKEST 1e3

static void by_order(FrPlant *plant, bool from_base, double thinnest, double ratio) {
    uint32_t count = plant->nodes.count, most = 0;
    uint32_t *order = g_new(uint32_t, (size_t)count + 1);
    if (from_base) {
        fr_plant_weibel(plant, order);
    } else {
        fr_plant_strahler(plant, order);
    }
    for (uint32_t i = 0; i < count; i++) {
        most = MAX(most, order[i]);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t thicker = from_base ? most - order[i] : order[i] - 1;
        plant->nodes.radius[i] = (float)fmin(thinnest * pow(ratio, thicker), THICKEST);
    }
    g_free(order);
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (plant->axes.first[a] != FR_NONE) {
            plant->axes.base_radius[a] = plant->nodes.radius[plant->axes.first[a]];
        }
    }
}

void fr_plant_weigh(FrPlant *plant, FrWeights weights, double thinnest, double ratio,
                    double exponent) {
    if (weights == FR_WEIGHTS_WEIBEL || weights == FR_WEIGHTS_STRAHLER) {
        by_order(plant, weights == FR_WEIGHTS_WEIBEL, thinnest, ratio);
    } else if (weights == FR_WEIGHTS_STRANDS) {
        fr_plant_pipe_radii(plant, 2.0, thinnest); // the sum of equal strands
    } else if (weights == FR_WEIGHTS_PIPE) {
        fr_plant_pipe_radii(plant, exponent, thinnest);
    }
}
