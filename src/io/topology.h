/// @file topology.h
/// What hangs on what in a plant, for formats that write it as a tree of axes and internodes.
#pragma once

#include "frond/plant.h"

/// Lists of what each internode bears, without what is shed; FR_NONE ends each.
typedef struct FrTopology {
    const FrPlant *plant;
    uint32_t *first_axis;  ///< by node: the first axis it bears
    uint32_t *next_axis;   ///< by axis: the next with the same bearer
    uint32_t *first_organ; ///< by node
    uint32_t *next_organ;  ///< by organ
    uint32_t first_stem;   ///< axes without a bearer, a list as well
    uint32_t first_loose;  ///< organs without a node
} FrTopology;

void fr_topology_init(FrTopology *topology, const FrPlant *plant);
void fr_topology_clear(FrTopology *topology);
/// The internode that goes on from one: the next of its axis, or the first of an axis that
/// continues it; FR_NONE.
uint32_t fr_topology_next(const FrTopology *topology, uint32_t node);

/// An internode as a walk comes to it.
typedef struct FrTopologyStep {
    uint32_t first; ///< node that it begins with: its first straight part, if it is bent
    uint32_t node;  ///< node that it ends with
    uint32_t axis;  ///< that begins with it; FR_NONE: it goes on from the internode before
    uint32_t order; ///< 0 for stems, 1 for their branches, …
} FrTopologyStep;

/// How long an internode is along its parts, m.
double fr_topology_length(const FrTopology *topology, const FrTopologyStep *step);

/// Walks all internodes of a stem: each, then all of its branches, then what goes on from it.
/// `leave` (may be NULL) comes when all that hangs on it is done. Stops when `enter` says false.
void fr_topology_walk(const FrTopology *topology, uint32_t stem,
                      bool (*enter)(void *user, const FrTopologyStep *step),
                      void (*leave)(void *user, const FrTopologyStep *step), void *user);
