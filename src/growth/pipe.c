// Radii by the pipe model (Shinozaki, Yoda, Hozumi, Kira 1964; Murray 1926 for exponent 3): r^e is
// the sum of the children's r^e; what has been shed is remembered, so trunks never thin.
#include "growth/engine.h"

#include <math.h>

void fr_growth_pipes(const FrGrownPlant *plant, double taper, double *pipes) {
    const FrGrownNodes *nodes = &plant->nodes;
    for (uint32_t i = 0; i < nodes->count; i++) {
        pipes[i] = (double)nodes->wood[i];
    }
    for (uint32_t i = nodes->count; i-- > 0;) {
        // A tip has one pipe, and each internode adds a little for its own leaves.
        pipes[i] = pipes[i] > 0 ? pipes[i] + taper : 1;
        if (nodes->parent[i] != FR_NONE) {
            pipes[nodes->parent[i]] += pipes[i];
        }
    }
}

void fr_growth_radii(const FrReadySpecies *species, const double *pipes, uint32_t count,
                     float *radii) {
    const FrSpeciesParams *params = &species->params;
    double exponent = 1 / params->pipe_exponent;
    double last = 1, root = 1; // neighbours often have equally many
    for (uint32_t i = 0; i < count; i++) {
        if (pipes[i] != last) {
            last = pipes[i];
            root = pow(MAX(last, 1), exponent);
        }
        radii[i] = (float)(params->tip_radius * root);
    }
}
