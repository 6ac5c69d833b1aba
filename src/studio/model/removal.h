/// @file removal.h
/// What to tell of something that is taken out of a document.
#pragma once

#include "studio/model/document.h"

/// A sentence without a full stop, to be told once it is gone: what goes, and who still names it or
/// is linked to nothing without it. Free with g_free().
char *studio_removal_words(const StudioDocument *document, uint32_t element);
