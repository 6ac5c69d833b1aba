/// @file scene/ecosystem.h
/// The plants of a scene that grow bud by bud. Private to scene.
#pragma once

#include "scene/placing.h"

typedef struct FrEcosystem FrEcosystem;

/// `seed` < 0: as the document says. Keeps `history` steps to go back. With a `previous` one (NULL)
/// it goes on with what has grown there: that one's plants are the first of the scene, and it ends
/// when this one begins.
FrEcosystem *fr_ecosystem_new(const FrDocument *document, int64_t seed, uint32_t history,
                              FrEcosystem *previous, FrScene *scene);
void fr_ecosystem_free(FrEcosystem *ecosystem);
/// A seed, unless it is a plant of the previous one; its plant becomes the last of the scene's,
/// empty as yet.
void fr_ecosystem_add(FrEcosystem *ecosystem, FrScene *scene, const FrPlaced *placed);
bool fr_ecosystem_is_empty(const FrEcosystem *ecosystem);
/// Makes the world: solids of all that stands in the scene, seeds, particles. After a failure the
/// previous one is as it was.
FR_MUST_USE FrStatus fr_ecosystem_begin(FrEcosystem *ecosystem, const FrScene *scene,
                                        const FrHills *hills, const FrContext *context);
/// Says what is wrong with species, seeds and particles without making any of it.
FR_MUST_USE FrStatus fr_ecosystem_check(const FrEcosystem *ecosystem, const FrScene *scene,
                                        const FrHills *hills, const FrContext *context);
/// One step, which is told in the scene's.
FR_MUST_USE FrStatus fr_ecosystem_step(FrEcosystem *ecosystem, FrScene *scene,
                                       const FrContext *context);
/// Takes what stands in the scene now as the solids of the world.
FR_MUST_USE FrStatus fr_ecosystem_renew(FrEcosystem *ecosystem, const FrScene *scene,
                                        const FrHills *hills, const FrContext *context);
/// The plants as they are now; `old` receives those that were there before.
FR_MUST_USE FrStatus fr_ecosystem_draw(const FrEcosystem *ecosystem, FrScene *scene,
                                       const FrContext *context, GPtrArray *old);
/// Tells wood that reaches into obstacles; the plants are drawn.
void fr_ecosystem_tell_grown(const FrEcosystem *ecosystem, const FrScene *scene,
                             const FrContext *context);
/// Sets those of the scene's plants that grow bud by bud.
void fr_ecosystem_mark(const FrEcosystem *ecosystem, uint8_t *is_growing);
/// NULL before it has begun.
FrGrowth *fr_ecosystem_growth(const FrEcosystem *ecosystem);
uint32_t fr_ecosystem_history(const FrEcosystem *ecosystem);
/// What its state depends on besides: the document, its seed, what stands in the way.
FrDigest fr_ecosystem_digest(const FrEcosystem *ecosystem);
/// One plant of a species in a world of its own: light all around, level ground, all steps.
FR_MUST_USE FrStatus fr_ecosystem_grow_alone(const FrDocument *document,
                                             const FrPlantDef *definition, uint64_t seed,
                                             const FrContext *context, FrPlant **plant);
