/// @file rational.h
/// Plants that are shown as rational surfaces. Private to scene.
#pragma once

#include "frond/scene.h"

/// Gives a plant what its definition says of its surfaces when the clocks show `time`; NAN: what
/// the definition's own shows.
void fr_rational_set(FrScenePlant *plant, const FrPlantDef *definition, double time);
/// `seed`, continued by the settings of a plant that is shown as surfaces.
FrDigest fr_rational_digest(FrDigest seed, const FrScenePlant *plant);
