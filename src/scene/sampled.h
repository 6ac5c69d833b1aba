/// @file sampled.h
/// Plants of linked components whose Worlds sample the light of the scene. Private to scene.
#pragma once

#include "frond/lighting.h"

typedef struct FrSampled FrSampled;

/// True for a p-graph with such a World in a scene that has a `<light>`.
bool fr_sampled_is_wanted(const FrScene *scene, const FrPlantDef *definition);
FrSampled *fr_sampled_new(void);
void fr_sampled_free(FrSampled *sampled);
/// A plant at `stand`; it becomes the last of the scene's plants, empty as yet. A `seed` < 0 is its
/// own, and so is a `time` of its clock that is NAN.
void fr_sampled_add(FrSampled *sampled, FrScene *scene, const FrPlantDef *definition, int64_t seed,
                    double time, const FrStand *stand);
/// Builds them one after the other, each in the light that the scene leaves it so far.
FR_MUST_USE FrStatus fr_sampled_build(FrSampled *sampled, const FrDocument *document,
                                      FrScene *scene, const FrContext *context);
