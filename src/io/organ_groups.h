/// @file organ_groups.h
/// A plant's organs by shape and material, for formats that share a mesh among equal ones.
#pragma once

#include "frond/plant.h"

/// Organs of one shape and material.
typedef struct FrOrganGroup {
    uint32_t shape, material; ///< indices into the plant's; material may be FR_NONE
    const char *word;         ///< what the first of them is called, borrowed from the plant
    GArray *organs;           ///< uint32_t: those that are seen
} FrOrganGroup;

/// The groups (of FrOrganGroup) in the order in which each first occurs.
GArray *fr_organ_groups_new(const FrPlant *plant);
/// Position, rotation (exactly of length 1) and scale of an organ in its plant, z up.
void fr_organ_group_pose(const FrPlant *plant, uint32_t organ, double at[3], double rotation[4],
                         double *scale);
