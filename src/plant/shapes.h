/// @file shapes.h
/// The indices by which fr_plant_add_shape() and fr_plant_add_profile() find equal ones.
#pragma once

#include "frond/plant.h"

GHashTable *fr_shape_index_new(void);
GHashTable *fr_profile_index_new(void);
/// The digest of a profile's points, continued from `seed`.
FrDigest fr_profile_digest(FrDigest seed, const FrProfile *profile);
