/// @file contents.h
/// What a document says, without comments and the blanks between its elements. Private to scene.
#pragma once

#include "frond/document.h"

/// Of the same contents two documents grow the same.
FrDigest fr_contents_digest(FrDigest seed, const FrDocument *document);
