/// @file scatter.h
/// What becomes of a photon that meets a surface. Private to light.
#pragma once

#include "frond/light.h"
#include "frond/random.h"

/// Russian roulette (Arvo, Kirk 1990): the photon is thrown back, let through or absorbed with the
/// probabilities of `optics`, and keeps its whole power. `normal`, of any length, points to where
/// the photon came from. False: absorbed. Otherwise `direction` is the new one, unit to rounding.
bool fr_scatter(const FrOptics *optics, const double normal[3], FrKey key, float direction[3]);
