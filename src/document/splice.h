/// @file splice.h
/// Changes of a document's text: what takes the place of which bytes.
#pragma once

#include "document/tree.h"
#include "frond/contents.h"

/// Sets an attribute; `value` NULL takes it away. `place` (may be NULL) receives where the value
/// stands afterwards.
FrSplice fr_splice_attribute(const FrXmlTree *tree, uint32_t node, const char *name,
                             const char *value, FrXmlRange *place);
/// Where the text of an element stands: from its first to its last piece that is not blank, or
/// where there is none, where one would stand. False if other elements or comments part it.
bool fr_splice_text_range(const FrXmlTree *tree, uint32_t node, FrXmlRange *range);
/// Replaces the text of an element; an empty splice if that is parted.
FrSplice fr_splice_content(const FrXmlTree *tree, uint32_t node, const char *text);
FrSplice fr_splice_insert(const FrXmlTree *tree, uint32_t parent, uint32_t after, const char *xml);
FrSplice fr_splice_remove(const FrXmlTree *tree, uint32_t node);
/// The bytes between the tags of an element; empty behind its last attribute if it has one tag.
FrXmlRange fr_splice_inside(const FrXmlTree *tree, uint32_t node);
/// Does splices that do not overlap, in any order; `size` receives the length.
char *fr_splice_apply(const FrXmlTree *tree, GArray *splices, size_t *size);
