/// @file grower.h
/// A scene whose plants grow bud by bud, taken step by step, forth and back, and shown after each.
#pragma once

#include "frond/document.h"
#include "frond/growth.h"
#include "studio/model/view.h"

typedef struct StudioGrower StudioGrower;

/// Whether a document has such plants: then a grower shows it, and no rebuild.
bool studio_grower_is_wanted(const FrDocument *document);
StudioGrower *studio_grower_new(void);
void studio_grower_free(StudioGrower *grower);
/// Takes over a document if it returns FR_OK. `digest` is that of its text. With `goes_on` another
/// text changes what will grow and leaves what has grown, if it can; else all begins anew. What
/// fails leaves what was there.
FR_MUST_USE FrStatus studio_grower_take(StudioGrower *grower, FrDocument *document, FrDigest digest,
                                        bool goes_on, const FrContext *context);
/// Goes to a step, back as far as it can; `step` < 0: as many as the document says. What fails or
/// is cancelled leaves it where it has come.
FR_MUST_USE FrStatus studio_grower_go(StudioGrower *grower, int64_t step, const FrContext *context);
/// The step it is at, and how many the document asks for.
uint64_t studio_grower_step(const StudioGrower *grower);
uint64_t studio_grower_step_count(const StudioGrower *grower);
/// Whether the plants with an id grow bud by bud.
bool studio_grower_grows(const StudioGrower *grower, const char *plant);
/// How its plants grow, to be looked at; NULL: nothing has been shown, or nothing grows bud by bud.
const FrGrowth *studio_grower_growth(const StudioGrower *grower);
/// What stands now; borrowed until it goes on. Free with studio_view_free().
FR_MUST_USE FrStatus studio_grower_view(StudioGrower *grower, const FrContext *context,
                                        StudioView **view);
