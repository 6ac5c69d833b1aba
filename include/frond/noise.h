/// @file noise.h
/// Smooth noise in [-1, 1], a pure function of position and key (gradient noise after Perlin 2002
/// with gradients from the counter-based hash of random.h).
#pragma once

#include "frond/random.h"

FR_API double fr_noise1(FrKey key, double x);
FR_API double fr_noise2(FrKey key, double x, double y);
FR_API double fr_noise3(FrKey key, double x, double y, double z);
/// As fr_noise2, repeating every `period` ≥ 1 units in both directions: for tileable textures.
FR_API double fr_noise2_tiled(FrKey key, double x, double y, int period);
