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
    vec3s direction;     ///< unit
    vec3s at;            ///< new tip, relative to the seed
    FrCell first;        ///< of its segment
    uint8_t backwards;   ///< bit of every axis along which its cells go down
    uint8_t state, next;
};

/// A cell of a segment, and where its memory is: looked up once for all that is asked about it.
typedef struct FrCellPlace {
    FrBrick *brick; ///< NULL: none yet
    FrCell cell;
    uint8_t layer, bit; ///< in the brick
} FrCellPlace;

/// True if one owner's proposal comes before another's. Equal keys hardly ever occur.
static inline bool fr_claim_is_before(const FrGrowth *growth, uint32_t one, uint32_t other) {
    uint64_t a = growth->owners[one].key, b = growth->owners[other].key;
    return a != b ? a < b : one < other;
}
/// Settles proposals `open` (indices into growth->proposals, overwritten): each ends as WON, LOST
/// or BLOCKED, and winners own their cells.
void fr_growth_settle(FrGrowth *growth, uint32_t *open, uint32_t count, const FrContext *context);

// ---- path.c -----------------------------------------------------------------------------------
/// Bytes that the segment of a proposal takes, with at most so many cells.
uint32_t fr_path_stride(uint32_t cells);
/// Where the cells of a segment are.
void fr_path_find(const FrVoxels *voxels, const FrCell *cells, uint32_t count, FrCellPlace *places);
/// Keeps the cells of a proposal's segment, `cell_count` of them.
void fr_path_keep(const FrGrowth *growth, FrProposal *proposal, const FrCellPlace *places);
/// The kept cells; the first of several, which nothing is asked about, is left out.
void fr_path_places(const FrGrowth *growth, const FrProposal *proposal, FrCellPlace *places);

// ---- collide.c --------------------------------------------------------------------------------
/// The cell that a proposal ends in; false if it ends outside of the voxels.
bool fr_growth_tip(const FrGrowth *growth, const FrProposal *proposal, FrCell *tip);
/// True if nothing that stands is in a proposal's way; then these are its cells.
bool fr_growth_is_free(const FrGrowth *growth, FrProposal *proposal, FrCellPlace *places);
/// True if nobody who asks for its cells comes before it.
bool fr_growth_is_first(const FrGrowth *growth, const FrProposal *proposal,
                        const FrCellPlace *places);
