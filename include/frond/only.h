/// @file only.h
/// Plants taken out of a scene that has been built: they keep the shape that they have grown there.
#pragma once

#include "frond/scene.h"

/// Which of the plants that a document places are meant.
typedef struct FrOnly FrOnly;

/// What names mean. `oak` is all that stands of the plant with that id; `place-2`, `row-2`,
/// `strew-2` what the second element of that kind places, whose number is left out where it is the
/// only one; `row.3` the plant of a row that `except` calls 3. FR_ERR_USAGE with a diagnostic that
/// lists what there is if nothing is called so.
FR_API FR_MUST_USE FrStatus fr_only_new(const FrDocument *document, const char *const *names,
                                        size_t count, const FrContext *context, FrOnly **only);
/// The one plant that stands with this origin and number, as FrStand has them.
FR_API FrOnly *fr_only_one(uint32_t origin, uint32_t number);
FR_API void fr_only_free(FrOnly *only);
/// Takes all other plants and the obstacles out of a scene of that document. Those that stay are
/// moved together, so that the first stands at the origin, unless they stay `in_place`. False, and
/// nothing has changed, if none of them is in the scene; seeds that have no place to stand are not.
FR_API bool fr_only_apply(const FrOnly *only, FrScene *scene, bool in_place);
/// A copy of what stands, or after fr_only_apply() of what that leaves (`only` NULL: everything,
/// and obstacles); NULL if none of them is in the scene. It needs neither the scene nor the
/// document: what scenes borrow of that is not in it (`params`, `surroundings`: NULL, no views), so
/// models can be written of it, and it cannot be lit.
FR_API FrScene *fr_only_copy(const FrOnly *only, const FrScene *scene, bool in_place);
