/// @file optics.h
/// Materials of a document as light counts them. Private to scene.
#pragma once

#include "frond/light.h"

typedef struct FrOpticsTable FrOpticsTable;

FrOpticsTable *fr_optics_new(void);
void fr_optics_free(FrOpticsTable *table);
/// How a material throws back and lets through light; NULL is the plain wood or leaf. A blade lets
/// light through. The table keeps the material alive.
FR_MUST_USE FrStatus fr_optics_of(FrOpticsTable *table, FrMaterial *material, bool is_foliage,
                                  const FrContext *context, FrLightMaterial *optics);
/// An FrMaskFn; `table` is an FrOpticsTable.
bool fr_optics_is_hole(void *table, uint32_t mask, float s, float t);
