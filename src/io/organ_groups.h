/// @file organ_groups.h
/// A plant's organs by shape and material, for formats that share a mesh among equal ones.
#pragma once

#include "frond/skin.h"

/// Organs of one shape and material.
typedef struct FrOrganGroup {
    uint32_t shape, material; ///< indices into the plant's; material may be FR_NONE
    const char *word;         ///< what the first of them is called, borrowed from the plant
    float enlarged;           ///< by the level of detail, which shows fewer but larger leaves
    GArray *organs;           ///< uint32_t: those that are seen
} FrOrganGroup;

/// The groups (of FrOrganGroup) that skin shows, in the order in which each first occurs. Fails as
/// fr_skin_plant() does; *groups is to be released all the same.
FrStatus fr_organ_groups_new(const FrPlant *plant, const FrSkinParams *skin,
                             const FrContext *context, GArray **groups);
/// Position, rotation (exactly of length 1) and scale of an organ of a group in its plant, z up.
void fr_organ_group_pose(const FrPlant *plant, const FrOrganGroup *group, uint32_t organ,
                         double at[3], double rotation[4], double *scale);
