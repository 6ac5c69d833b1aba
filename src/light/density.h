/// @file density.h
/// What the backend of ray density holds. Private to light.
#pragma once

#include "frond/light_density.h"
#include "light/backend.h"
#include "light/estimate.h"

typedef struct FrDensity {
    FrLight light; ///< first
    FrDensityParams params;
    FrSurfaces *surfaces;
    FrPaths *paths;
    FrOctree *tree;
    FrDigest lit_by;  ///< of lamps and bounds; what the paths started from
    bool is_whole;    ///< paths and tree are those of the scene
    bool is_pruning;  ///< the next query removes cells that it does not want
    double power;     ///< of all lamps
    double *absorbed; ///< by element
    uint64_t element_count;
    uint64_t recast;
    uint64_t point_count; ///< asked for since the last fr_light_forget()
} FrDensity;

/// How the backend estimates: params and power of a photon.
FrEstimator fr_density_estimator(const FrDensity *density);

// density_shown.c, for fr_light_rays() and fr_light_cells().

void fr_density_rays(const FrLight *light, uint32_t most, GArray *rays);
void fr_density_cells(const FrLight *light, uint32_t most, GArray *cells);
