/// @file scene/terrain.h
/// The ground of a scene that has a `<terrain>`. Private to scene.
#pragma once

#include "frond/scene.h"

typedef struct FrHills FrHills;

/// NULL without a terrain, or after an error.
FR_MUST_USE FrStatus fr_hills_new(const FrTerrain *terrain, const FrContext *context,
                                  FrHills **hills);
void fr_hills_free(FrHills *hills);
/// Its triangles, before they are sized, turned and moved.
FrMeshFile *fr_hills_mesh(const FrHills *hills);
/// The height of its highest surface at a place; false where there is none.
bool fr_hills_height(const FrHills *hills, double x, double y, double *height);
