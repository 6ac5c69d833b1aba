/// @file recursion.h
/// Which prototypes take part in a recursion together, and where it begins.
///
/// A recursion is a set of prototypes that can reach each other by links: a strongly connected
/// component of the p-graph (Tarjan 1972). Of its members, those with a depth are counted on the
/// path from the root; every way round must meet one of them, or it would never end.
#pragma once

#include "pgraph/graph.h"

typedef struct FrRecursions {
    uint32_t count;         ///< sets of prototypes, recursive or single
    uint32_t *of;           ///< set of each prototype
    bool *is_recursive;     ///< of each prototype: follows upon itself by some way
    uint32_t *slot;         ///< of each prototype: its place among the counted of its set, FR_NONE
    uint32_t *slots;        ///< of each set: how many are counted
    uint32_t *first_link;   ///< of each prototype and one more: into `links`
    uint32_t *links;        ///< indices of links, by source, as they were added
    uint32_t *first_member; ///< of each set and one more: into `members`
    uint32_t *members;      ///< prototypes, by set
    GArray *roots;          ///< uint32_t, prototypes the expansion begins with
    bool *is_reached;       ///< of each prototype: from a root
} FrRecursions;

/// Finds recursions, roots and what they reach. Cost: linear in prototypes and links.
void fr_recursions_find(FrRecursions *recursions, const FrPgraph *graph);
void fr_recursions_clear(FrRecursions *recursions);
/// A link of a way round without any depth, or FR_NONE if every recursion ends.
uint32_t fr_recursions_endless_link(const FrRecursions *recursions, const FrPgraph *graph);
