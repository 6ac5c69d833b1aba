// Radii by the pipe model (Shinozaki, Yoda, Hozumi, Kira 1964; Murray 1926 for exponent 3): r^e is
// the sum of the children's r^e; what has been shed is remembered, so trunks never thin: as pipes
// that stay, or as the most pipes that there have been.
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

void fr_growth_pipes(const FrGrownPlant *plant, const FrSpeciesParams *params, double *pipes) {
    const FrGrownNodes *nodes = &plant->nodes;
    bool is_kept = params->fallen_wood == FR_WOOD_KEPT;
    for (uint32_t i = 0; i < nodes->count; i++) {
        pipes[i] = is_kept ? (double)nodes->wood[i] : 0;
    }
    for (uint32_t i = nodes->count; i-- > 0;) {
        // A tip has one pipe, and each internode adds a little for its own leaves.
        pipes[i] = pipes[i] > 0 ? pipes[i] + params->taper : 1;
        if (nodes->parent[i] != FR_NONE) {
            pipes[nodes->parent[i]] += pipes[i];
        }
    }
    for (uint32_t i = 0; i < nodes->count && !is_kept; i++) {
        pipes[i] = fmax(pipes[i], (double)nodes->wood[i]);
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

float *fr_growth_radii_of(const FrGrowth *growth, const FrGrownPlant *plant) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    uint32_t count = plant->nodes.count;
    double *pipes = g_new(double, count + 1);
    float *radii = g_new(float, count + 1);
    fr_growth_pipes(plant, &species->params, pipes);
    fr_growth_radii(species, pipes, count, radii);
    g_free(pipes);
    return radii;
}

double fr_growth_wood(const FrGrowth *growth, uint32_t plant) {
    FR_ASSERT(plant < growth->plant_count);
    const FrGrownPlant *of = &growth->plants[plant];
    float *radii = fr_growth_radii_of(growth, of);
    double volume = 0;
    for (uint32_t i = 0; i < of->nodes.count; i++) {
        uint32_t parent = of->nodes.parent[i];
        vec3s from = parent == FR_NONE ? (vec3s){{0, 0, 0}} : of->nodes.at[parent];
        double radius = (double)radii[i];
        volume += G_PI * radius * radius * (double)glms_vec3_distance(from, of->nodes.at[i]);
    }
    g_free(radii);
    return volume;
}
