/// @file subgraph.h
/// Parts of p-graphs as documents of their own, and such documents put into p-graphs.
#pragma once

#include "studio/model/document.h"

/// The text of a document that has a component (its id; a Camera: all) of a plant with everything
/// beneath it, and what they use of the document. Its plant is called `name` as far as ids allow.
/// Files are named as in the document. Free with g_free(); NULL: there is no such component.
char *studio_subgraph_text(const StudioDocument *document, uint32_t plant, const char *id,
                           const char *name);

/// Why the first plant of a document cannot be put into a graph, in a sentence; NULL: it can.
const char *studio_subgraph_refusal(FrSource *from);
/// The elements of that plant which are put into graphs, and those that they use (by
/// GUINT_TO_POINTER). Free with g_hash_table_unref().
GHashTable *studio_subgraph_elements(const FrContents *from);
/// Puts the components of the first plant of `from` into the graph of a plant, with what they use:
/// one step. Names that mean something else here get new ones. What hangs on the Camera there is
/// linked from `parent` (its id; NULL: from nothing). `*id` (may be NULL) receives the id of the
/// first of that, to be freed with g_free(). False if nothing changed.
bool studio_insert_subgraph(StudioDocument *document, uint32_t plant, FrSource *from,
                            const char *parent, char **id);
