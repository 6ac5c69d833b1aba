/// @file light_density.h
/// Light as the density of rays: photons are sent from the lamps, their paths are kept, and the
/// rays near a point tell how bright it is there and from where.
///
/// Direct and indirect light, any mix of materials. After a change of the scene only the rays that
/// meet it are traced again. Also tells what every element of a surface absorbs.
#pragma once

#include "frond/light.h"
#include "frond/param.h"

#define FR_DENSITY_PARAMS(X)                                                                       \
    X(INTEGER, photons, "200000", 1, 1000000000, "", "", "photons sent from all lamps together")   \
    X(REAL, distance, "0.1", 0.000001, 1000, "m", "",                                              \
      "rays within this distance of a point tell its light")                                       \
    X(CHOICE, estimator, "fixed", 0, 2, "", "fixed nearest track",                                 \
      "what is counted: rays within the distance, the nearest rays, or how far rays run within")   \
    X(INTEGER, neighbours, "50", 2, 1000000, "", "", "how many rays 'nearest' takes")              \
    X(INTEGER, bounces, "64", 0, 60000, "", "", "longest path; a safety, as surfaces end paths")   \
    X(INTEGER, seed, "1", 0, 9007199254740991, "", "", "seed of all paths")

typedef struct FrDensityParams {
    FR_DENSITY_PARAMS(FR_PARAM_FIELD)
    FrSpan span; ///< where a document asks for so many photons, for messages
} FrDensityParams;

FR_API const FrParamTable *fr_density_table(void);
FR_API FrDensityParams fr_density_default(void);
/// Density of rays; `threads` of the context's pool are those that the search structure may use
/// later. FR_ERR_LIMIT if there are more photons, or they take more bytes, than FrLimits allows.
FR_API FR_MUST_USE FrStatus fr_light_density_new(const FrDensityParams *params,
                                                 const FrContext *context, FrLight **light);
