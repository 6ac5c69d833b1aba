/// @file growing.h
/// Plants of a scene that grow together, step by step, in each other's light. Private to scene.
#pragma once

#include "frond/lighting.h"

typedef struct FrGrowing FrGrowing;

/// True for what answers light: an L-system with open symbols in a scene that has a `<light>`.
bool fr_growing_is_wanted(const FrScene *scene, const FrPlantDef *definition);
/// Who looks on while plants grow: `see` is shown the first plant of a definition in each step, as
/// it was derived and again as the light has answered it, and at last as it stands in the end.
/// NULL: nobody.
typedef struct FrGrowingWatch {
    const FrPlantDef *definition;
    FrDerivedFn see;
    void *user;
} FrGrowingWatch;

/// Plants that grow at most `steps` steps.
FrGrowing *fr_growing_new(uint64_t steps, FrGrowingWatch watch);
void fr_growing_free(FrGrowing *growing);
/// A plant that begins where `stand` is; it becomes the last of the scene's plants, empty as yet.
/// `seed` < 0: what its text says.
FR_MUST_USE FrStatus fr_growing_add(FrGrowing *growing, FrScene *scene,
                                    const FrPlantDef *definition, int64_t seed,
                                    const FrStand *stand, const FrContext *context);
/// True if there are any.
bool fr_growing_is_any(const FrGrowing *growing);
/// Makes the light they grow in, if there are any.
FR_MUST_USE FrStatus fr_growing_begin(FrGrowing *growing, const FrScene *scene,
                                      const FrContext *context);
/// True while any has steps left.
bool fr_growing_has_steps(const FrGrowing *growing);
/// One time around the loop.
FR_MUST_USE FrStatus fr_growing_step(FrGrowing *growing, FrScene *scene, const FrContext *context);
/// The plants as they stand in the end.
FR_MUST_USE FrStatus fr_growing_finish(FrGrowing *growing, FrScene *scene,
                                       const FrContext *context);
/// Grows them all to their ends, from where fr_growing_begin() put them.
FR_MUST_USE FrStatus fr_growing_run(FrGrowing *growing, FrScene *scene, const FrContext *context);
