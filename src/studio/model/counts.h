/// @file counts.h
/// How many instances the components of what is shown have, how many of its plants there are, and
/// how long all that takes.
#pragma once

#include "studio/model/grower.h"

/// How many instances a component of a plant has, and how long they take.
typedef struct StudioCount {
    char *plant, *component;
    uint64_t instances;
    double seconds; ///< that one thread needs to make them all and their skin, by a sample; NAN:
                    ///< unknown
    double skin_seconds; ///< of these, for skin and leaves
} StudioCount;

/// StudioCount. Free with g_array_unref().
GArray *studio_counts_of(const StudioView *view);

/// A plant of the document, all that stand of it together.
typedef struct StudioPlantLoad {
    char *plant;
    uint64_t stands;
    double seconds; ///< to make and skin them; of what grows bud by bud, its part of the time that
                    ///< the growth took so far, by its internodes. NAN: unknown
} StudioPlantLoad;

/// StudioPlantLoad, from the counts of the view. `grower` NULL: nothing grows bud by bud. Free with
/// g_array_unref().
GArray *studio_plant_loads(const StudioView *view, const GArray *counts,
                           const StudioGrower *grower);
