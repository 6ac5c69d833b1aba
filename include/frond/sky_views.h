/// @file sky_views.h
/// Light by views of the sky (Beneš 1996, An Efficient Estimation of Light in Simulation of Plant
/// Development; Beneš, Andrysco, Šťava 2009, Interactive Modeling of Virtual Ecosystems): from each
/// point a fixed set of directions is looked into, and what can be seen of the light counts.
///
/// Light is direct, or comes straight through leaves; walls throw none back. For that there is the
/// density of rays.
#pragma once

#include "frond/light.h"

typedef struct FrSkyViewSettings {
    int64_t count; ///< m: suns are a view each, the sky has the rest and at least one, 1 to 4096
    bool is_even;  ///< every view of sun and sky counts the same: the intensity is n / m
    bool is_mean;  ///< the direction is the mean of what is seen, not the brightest spot
    float near;    ///< m: what is nearer to a point does not shade it, its own stem above all
} FrSkyViewSettings;

/// 20 views, weighed by their light, the brightest spot, 0.02 m.
FR_API FrSkyViewSettings fr_sky_views_default(void);
/// A backend that looks. The intensity is 1 under open sky; where no sun and no sky shine it is
/// that of the lamps in their unit per square metre. Among equally bright spots the direction is
/// their mean.
FR_API FrLight *fr_sky_views_new(const FrSkyViewSettings *settings);
