/// @file adopt.h
/// Takes plants of other documents, as presets are, into a document, with what they are made of.
#pragma once

#include "studio/model/document.h"

/// Copies a plant of `from`, and the curves, functions, materials and plants of it, into the
/// document: one step, `key` as in studio_history_replace(). What is there already, the same to the
/// byte, is used; what is another thing of the same name gets a new one. `plant` NULL: the first.
/// `*id` receives the plant's id here, to be freed with g_free(); NULL and false if there is no
/// such plant or the document is broken.
bool studio_adopt(StudioDocument *document, FrSource *from, const char *plant, const char *key,
                  char **id);
/// The text of what stands at the top of `theirs` and is not, the same to the byte, in `mine`: of
/// those `wanted` (by GUINT_TO_POINTER), or of all (NULL). Free with g_free().
char *studio_adopt_xml(const FrContents *mine, const FrContents *theirs, GHashTable *wanted);
/// The last thing of a document that such things are put behind; FR_NONE: none is there.
uint32_t studio_adopt_behind(const FrContents *mine);
