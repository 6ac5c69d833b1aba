/// @file counts.h
/// How many instances the components of a scene have.
#pragma once

#include "frond/scene.h"

/// How many instances a component of a plant has.
typedef struct StudioCount {
    char *plant, *component;
    uint64_t instances;
} StudioCount;

/// StudioCount. Free with g_array_unref().
GArray *studio_counts_of(const FrScene *scene);
