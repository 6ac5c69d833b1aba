/// @file counts.h
/// How many instances the components of a scene have.
#pragma once

#include "frond/scene.h"

/// How many instances a component of a plant has, and how long they take.
typedef struct StudioCount {
    char *plant, *component;
    uint64_t instances;
    double seconds; ///< that one thread needs to make them all, by a sample; NAN: unknown
} StudioCount;

/// StudioCount. Free with g_array_unref().
GArray *studio_counts_of(const FrScene *scene);
