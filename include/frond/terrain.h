/// @file terrain.h
/// The ground of a scene that has a `<terrain>`.
#pragma once

#include "frond/surroundings.h"

typedef struct FrHills FrHills;

/// NULL without a terrain, or after an error. The terrain need not outlive it.
FR_API FR_MUST_USE FrStatus fr_hills_new(const FrTerrain *terrain, const FrContext *context,
                                         FrHills **hills);
FR_API void fr_hills_free(FrHills *hills);
/// Its triangles, before they are sized, turned and moved.
FR_API FrMeshFile *fr_hills_mesh(const FrHills *hills);
/// The height of its highest surface at a place; false where there is none.
FR_API bool fr_hills_height(const FrHills *hills, double x, double y, double *height);
