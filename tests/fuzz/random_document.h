/// @file random_document.h
/// Documents made by chance from the rows of the elements and parameters themselves: what the
/// tables allow is what is tried, new components and attributes too.
#pragma once

#include <glib.h>
#include <stdint.h>

/// The text of document `number` of all; the same number gives the same text. Every value is
/// within its hard range. Free with g_free().
char *random_document(uint64_t number);
