/// @file skeleton_mtg.h
#pragma once

#include "frond/skeleton.h"

/// Reads a multiscale tree graph as lines: an entity with the features XX, YY, ZZ ends one, with
/// its radius or half its diameter. Where the graph has such a feature, entities without are no
/// wood and left out, such as leaves. Frees the array with g_free().
FrStatus fr_skeleton_read_mtg(const FrSource *source, const FrContext *context,
                              FrSegment **segments, size_t *count);
