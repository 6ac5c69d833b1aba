/// @file propose.h
/// Proposals of new internodes, and the claims that settle them.
#pragma once

#include "growth/engine.h"

enum {
    FR_PROPOSAL_ASKS,    ///< has found a way and asks for its cells
    FR_PROPOSAL_WON,     ///< gets it
    FR_PROPOSAL_LOST,    ///< another one has taken its cells in this step
    FR_PROPOSAL_BLOCKED, ///< has found no free way
};

struct FrProposal {
    uint32_t plant, bud;
    uint32_t rank;   ///< its place among all proposals of the round, by key
    vec3s direction; ///< unit
    vec3s at;        ///< new tip, relative to the seed
    uint8_t state, next;
};

/// Settles proposals `open` (indices into growth->proposals, overwritten): each ends as WON, LOST
/// or BLOCKED, and winners own their cells.
void fr_growth_settle(FrGrowth *growth, uint32_t *open, uint32_t count, const FrContext *context);
