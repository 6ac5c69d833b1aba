/// @file scene/solids.h
/// Everything of a scene that is in the way of growing plants, as triangles of the world. Private
/// to scene.
#pragma once

#include "frond/growth.h"
#include "frond/scene.h"
#include "frond/terrain.h"

typedef struct FrSolids {
    GArray *all; ///< FrGrowthObstacle, which own their arrays
} FrSolids;

FrSolids fr_solids_new(void);
void fr_solids_clear(FrSolids *solids);
/// A level ground at z = 0 over a box, if that is within.
void fr_solids_add_level(FrSolids *solids, const vec3s box[2]);
/// The ground within a box, hills or level, if the scene has any; and all obstacles.
FR_MUST_USE FrStatus fr_solids_add_surroundings(FrSolids *solids, const FrScene *scene,
                                                const FrHills *hills, const vec3s box[2],
                                                const FrContext *context);
/// Tells obstacles that enclose nothing because their meshes are open.
void fr_solids_tell_open(const FrSurroundings *surroundings, const FrContext *context);
/// A plant where it stands.
FR_MUST_USE FrStatus fr_solids_add_plant(FrSolids *solids, const FrPlant *plant,
                                         const FrStand *stand, const FrContext *context);
/// Its wood alone.
FR_MUST_USE FrStatus fr_solids_add_wood(FrSolids *solids, const FrPlant *plant,
                                        const FrStand *stand, const FrContext *context);
/// Changes where any of it does.
FrDigest fr_solids_digest(const FrSolids *solids);
