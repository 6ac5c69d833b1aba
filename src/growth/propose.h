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
    uint32_t node; ///< that the bud sits at, FR_NONE: the ground
    uint32_t own;  ///< owner's number of its axis
    uint32_t
        branched_off;    ///< of the axis that the first internode of its axis leaves, else FR_NONE
    uint32_t cell_count; ///< of its segment; the first is the one it begins in
    uint32_t rank;       ///< its place among all proposals of the round, by key
    vec3s direction;     ///< unit
    vec3s at;            ///< new tip, relative to the seed
    uint8_t state, next;
};

/// Ranks the first `count` proposals by their keys.
void fr_growth_rank(FrGrowth *growth, uint32_t count);
/// Settles proposals `open` (indices into growth->proposals, overwritten): each ends as WON, LOST
/// or BLOCKED, and winners own their cells.
void fr_growth_settle(FrGrowth *growth, uint32_t *open, uint32_t count, const FrContext *context);

// ---- collide.c --------------------------------------------------------------------------------
/// True if nothing that stands is in a proposal's way; then its cells are noted.
bool fr_growth_is_free(const FrGrowth *growth, FrProposal *proposal, FrCell *cells);
/// True if no claim to its cells comes before its own.
bool fr_growth_is_first(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells);
