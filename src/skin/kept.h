/// @file kept.h
/// A skin that is kept: two steps of fr_skin_update(), for scenes of several plants that change all
/// together or not at all.
#pragma once

#include "frond/skin.h"

/// Plans and counts; takes the memory that will be needed. What fails leaves the skin as it was,
/// and so does fr_skin_drop(). `has_same_rows` is as in fr_skin_update().
FR_MUST_USE FrStatus fr_skin_plan(FrSkin *skin, const FrPlant *plant, bool has_same_rows,
                                  const FrContext *context);
/// Writes what has been planned; cannot fail. The plant must still be there.
void fr_skin_write(FrSkin *skin, const FrPlant *plant, const FrContext *context);
/// Forgets a plan that has not been written.
void fr_skin_drop(FrSkin *skin);
