/// @file lsystem/split.h
/// The walk over a string in parts: what a part knows of those before it and leaves for the end.
#pragma once

#include "lsystem/build.h"

/// A node before a part on which something in it may stand.
typedef struct FrLfoot {
    uint32_t node, axis;
    uint16_t order; ///< of the axis
} FrLfoot;

/// A node of a part that stands on one before it. What is written of that is written at the end.
typedef struct FrLtie {
    uint32_t node, parent;
    uint32_t axis; ///< of the node
    uint32_t last; ///< of the part's nodes on that axis
    uint16_t order;
    bool goes_on;   ///< with the axis of its parent
    bool is_offset; ///< what begins an axis beside the parent's tip
} FrLtie;

/// What a builder has that writes only some rows of a plant.
typedef struct FrLbuilderPart {
    uint32_t first_node, first_axis, end_node, end_axis; ///< its rows
    const FrLfoot *feet;                                 ///< borrowed
    uint32_t feet_count;
    GArray *ties; ///< FrLtie
} FrLbuilderPart;

/// Reads a string as fr_lturtle_walk() does, on all threads. False, and nothing is done, where it
/// is small, has other symbols than those that move, turn and branch, branches too little, or
/// something of it must be kept in its order.
bool fr_lturtle_read_split(FrLturtle *turtle, const FrLstring *string);
/// Writes what a part has left for the end; parts in their order.
void fr_lbuilder_join(FrLbuilder *whole, const FrLbuilderPart *part);
