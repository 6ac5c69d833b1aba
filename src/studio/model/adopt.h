/// @file adopt.h
/// Takes plants of other documents, as presets are, into a document, with what they are made of.
#pragma once

#include "studio/model/document.h"

/// Copies a plant of `from`, and the curves, functions, materials and plants of it, into the
/// document: one step. What is there already, the same to the byte, is used; what is another thing
/// of the same name gets a new one. `plant` NULL: the first. `*id` receives the plant's id here, to
/// be freed with g_free(); NULL and false if there is no such plant or the document is broken.
bool studio_adopt(StudioDocument *document, FrSource *from, const char *plant, char **id);
