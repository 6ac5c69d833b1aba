/// @file adopt.h
/// Takes plants of other documents, as presets are, into a document, with what they are made of.
#pragma once

#include "studio/model/carry.h"

/// Copies a plant of `from`, and the curves, functions, materials and plants of it, into the
/// document: one step, `key` as in studio_history_replace(). What is there already, the same to the
/// byte, is used; what is another thing of the same name gets a new one. `plant` NULL: the first.
/// `*id` receives the plant's id here, to be freed with g_free(); NULL and false if there is no
/// such plant or the document is broken.
bool studio_adopt(StudioDocument *document, FrSource *from, const char *plant, const char *key,
                  char **id);
/// What of a document is taken over with a plant (by GUINT_TO_POINTER). Free with
/// g_hash_table_unref().
GHashTable *studio_adopt_elements(const FrContents *from);
/// The text of another document, whose files are in `folder`, with copies beside the document of
/// those that `wanted` of it names (NULL: all), so that they stay with it. Refused where the
/// document has no file yet.
StudioCarried studio_bring(const StudioDocument *document, const FrContents *theirs,
                           const char *folder, GHashTable *wanted);
/// The text of what stands at the top of `theirs` and is not, the same to the byte, in `mine`: of
/// those `wanted` (by GUINT_TO_POINTER), or of all (NULL). Free with g_free().
char *studio_adopt_xml(const FrContents *mine, const FrContents *theirs, GHashTable *wanted);
/// The last thing of a document that such things are put behind; FR_NONE: none is there.
uint32_t studio_adopt_behind(const FrContents *mine);
