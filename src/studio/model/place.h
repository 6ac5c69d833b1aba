/// @file place.h
/// Elements by a name that outlives edits of others: "frond/plant:oak/pgraph/tree:limb". Where an
/// element has no id its number among those of its tag stands behind a #.
#pragma once

#include "frond/contents.h"

/// Free with g_free().
char *studio_place_of(const FrContents *contents, uint32_t element);
/// The element of that place, FR_NONE.
uint32_t studio_place_find(const FrContents *contents, const char *place);
/// For each element the how manieth of its tag it is within its parent, from 1 on; 0: the only one.
/// Free with g_free().
uint32_t *studio_place_numbers(const FrContents *contents);
/// The `<plant>` around an element or the element itself; FR_NONE.
uint32_t studio_place_plant(const FrContents *contents, uint32_t element);
