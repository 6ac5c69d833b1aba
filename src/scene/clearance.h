/// @file clearance.h
/// How much room there is at a place of a scene that grows: how far it is to the wood of other
/// plants and to obstacles. Private to scene.
#pragma once

#include "frond/scene.h"
#include "frond/terrain.h"
#include "space/stems.h"

/// Farther than that nothing stands, m.
#define FR_CLEARANCE_FREE 1e6

typedef struct FrClearance FrClearance;

/// `is_moving` says of each plant of the scene whether it still changes; the others and all
/// obstacles are taken up now. FR_ERR_LIMIT if that takes too much memory.
FR_MUST_USE FrStatus fr_clearance_new(const FrScene *scene, const uint8_t *is_moving,
                                      const FrContext *context, FrClearance **room);
void fr_clearance_free(FrClearance *room);
/// Takes up the plants that move as they are now.
FR_MUST_USE FrStatus fr_clearance_update(FrClearance *room, const FrScene *scene,
                                         const FrContext *context);
/// From a point of the world to what stands nearest, without plant `own`: 0 inside of it,
/// FR_CLEARANCE_FREE if there is nothing. The ground does not count.
double fr_clearance_around(const FrClearance *room, const double at[3], uint32_t own);
/// How far it is free along a unit vector, to a millimetre.
double fr_clearance_ahead(const FrClearance *room, const double at[3], const double along[3],
                          uint32_t own);
/// The internodes of a plant where it stands, those that are seen; returns how many. `stems` has
/// room for as many as the plant has nodes.
uint32_t fr_clearance_stems(const FrPlant *plant, const FrStand *stand, FrStem *stems);
