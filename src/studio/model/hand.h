/// @file hand.h
/// From what was picked to the path that edits by hand are kept under.
#pragma once

#include "frond/document.h"

/// The path in the i-tree of the instance of a component whose key is `key`; NULL: it has none that
/// can be told, or the text is not right. Builds the plant once more. Free with g_free().
char *studio_hand_path(FrSource *source, const char *folder, const char *plant,
                       const char *component, FrKey key);
