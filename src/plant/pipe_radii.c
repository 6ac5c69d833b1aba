// The pipe model: Shinozaki, Yoda, Hozumi, Kira 1964, A quantitative analysis of plant form.
// A stem is a bundle of pipes, one for each tip it feeds, so its cross-section (radius to the
// power of 2, or of Murray's 3 and anything between) is the sum of those that it bears.
#include "frond/plant.h"

#include <math.h>

static double root(double bundle, double exponent) {
    return exponent == 2.0   ? sqrt(bundle)
           : exponent == 3.0 ? cbrt(bundle)
                             : pow(bundle, 1.0 / exponent);
}

void fr_plant_pipe_radii(FrPlant *plant, double exponent, double tip_radius) {
    FR_ASSERT(exponent >= 1.0 && exponent <= 4.0 && tip_radius >= 0.0);
    FrNodes *nodes = &plant->nodes;
    FrAxes *axes = &plant->axes;
    // In units of one tip's pipe, so that the sums neither overflow nor vanish.
    double *bundle = g_new0(double, nodes->count);
    double last_bundle = 1.0;
    double last_radius = tip_radius;
    for (uint32_t i = nodes->count; i-- > 0;) {
        double own = bundle[i] > 0.0 ? bundle[i] : 1.0;
        if (nodes->parent[i] != FR_NONE) {
            bundle[nodes->parent[i]] += own;
        }
        // Along an unbranched stretch the bundle stays the same, and so does its root.
        if (own != last_bundle) {
            last_bundle = own;
            last_radius = tip_radius * root(own, exponent);
        }
        nodes->radius[i] = (float)last_radius;
    }
    g_free(bundle);
    for (uint32_t a = 0; a < axes->count; a++) {
        if (axes->first[a] != FR_NONE) {
            axes->base_radius[a] = nodes->radius[axes->first[a]];
        }
    }
}
