/// @file growing.h
/// Plants of a scene that grow together, step by step, in each other's light. Private to scene.
#pragma once

#include "frond/lighting.h"

typedef struct FrGrowing FrGrowing;

/// True for what asks the scene: an L-system with open symbols where there is a `<light>`, or with
/// some that ask for free space.
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
/// True if any of them asks for free space.
bool fr_growing_asks_space(const FrGrowing *growing);
/// Makes the light and the room they grow in, if there are any. `is_moving`: by plant of the scene,
/// set for what grows in another way; those that grow here are set besides.
FR_MUST_USE FrStatus fr_growing_begin(FrGrowing *growing, const FrScene *scene, uint8_t *is_moving,
                                      const FrContext *context);
/// The most steps that any takes.
uint64_t fr_growing_longest(const FrGrowing *growing);
/// True while any has steps left.
bool fr_growing_has_steps(const FrGrowing *growing);
/// Lets plants go on with as many steps as `next`, of the same plants, may take, in a scene of
/// which nothing is the same object. False, and nothing done, if they have made more of them.
bool fr_growing_go_on(FrGrowing *growing, const FrGrowing *next);
/// One time around the loop.
FR_MUST_USE FrStatus fr_growing_step(FrGrowing *growing, FrScene *scene, const FrContext *context);
/// Shows the plants as they are now, which may be a step ahead of those shown. On failure all stays
/// as it was.
FR_MUST_USE FrStatus fr_growing_show_ahead(FrGrowing *growing, FrScene *scene,
                                           const FrContext *context);
/// Shows those again that were shown before.
void fr_growing_show_again(FrGrowing *growing, FrScene *scene);
/// Tells that these plants of the scene (FrPlant *; NULL: all) are freed.
void fr_growing_detach(FrGrowing *growing, const GPtrArray *plants);
/// The scene's plants as they have been derived; `old` receives those that were there before.
FR_MUST_USE FrStatus fr_growing_draw(FrGrowing *growing, FrScene *scene, const FrContext *context,
                                     GPtrArray *old);
/// Where the plants are, to go back to.
typedef struct FrGrowingMark FrGrowingMark;
FrGrowingMark *fr_growing_mark(const FrGrowing *growing);
void fr_growing_mark_free(FrGrowingMark *mark);
/// Goes back, also from within a step that has failed. The limits must be those of then at least.
void fr_growing_return(FrGrowing *growing, const FrGrowingMark *mark, const FrContext *context);
/// Lets plants that have begun in a changed document go on where `old` has them: those that stand
/// where they stood and are the same L-system as far as they have grown; others stay at their
/// axiom. Returns which of the old ones each is, FR_NONE if none, to be freed with g_free().
uint32_t *fr_growing_inherit(FrGrowing *growing, const FrGrowing *old, const FrContext *context);
/// Makes a mark of the old plants one of those that go on.
void fr_growing_mark_inherit(FrGrowingMark *mark, const FrGrowing *growing,
                             const uint32_t *origins);
/// All that has grown, appended.
void fr_growing_save(const FrGrowing *growing, GByteArray *out);
/// Takes up such a state. FR_ERR_DOCUMENT with a diagnostic if it is none of these plants; after a
/// failure they are as they were.
FR_MUST_USE FrStatus fr_growing_restore(FrGrowing *growing, const void *bytes, size_t size,
                                        FrSpan span, const FrContext *context);
/// The plants as they stand in the end.
FR_MUST_USE FrStatus fr_growing_finish(FrGrowing *growing, FrScene *scene,
                                       const FrContext *context);
