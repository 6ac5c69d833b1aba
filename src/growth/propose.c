// Proposals of new internodes and who gets the space.
//
// Collision after Beneš, Andrysco, Šťava 2009, section 3.6: first a box of cells around the new
// tip, then the cells of the segment. Who gets cells that several buds ask for in one step is
// settled by claims: the smallest key wins, whoever asks first. Losers try again beside the
// winners.
#include "growth/propose.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

static vec3s bud_at(const FrGrownPlant *plant, const FrLiveBud *bud) {
    return bud->node == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[bud->node];
}

static void world_of(const FrGrownPlant *plant, vec3s at, double world[3]) {
    for (int axis = 0; axis < 3; axis++) {
        world[axis] = plant->seed.at[axis] + (double)at.raw[axis];
    }
}

// ---- what is in the way -----------------------------------------------------------------------

/// True if a bud may come near what an axis of this number owns: its own axis, the one it branches
/// off, and those that branch off with it.
static bool is_related(const FrGrowth *growth, const FrProposal *proposal, uint32_t owner) {
    if (owner >= FR_VOXEL_GROUND) {
        return owner == FR_VOXEL_GROUND &&
               growth->plants[proposal->plant].buds[proposal->bud].node == FR_NONE;
    }
    FrOwner of = growth->owners[owner];
    if (of.plant != proposal->plant) {
        return false;
    }
    const FrGrownPlant *plant = &growth->plants[of.plant];
    const FrLiveBud *bud = &plant->buds[proposal->bud];
    if (of.axis == bud->axis || plant->axes[of.axis].bearer == bud->node) {
        return true;
    }
    return plant->axes[bud->axis].internodes == 0 && bud->node != FR_NONE &&
           plant->nodes.axis[bud->node] == of.axis;
}

/// True if another bud's claim to a cell comes before and is not that of one at the same node.
static bool is_claimed(const FrGrowth *growth, const FrProposal *proposal, FrCell cell) {
    const FrBrick *brick = fr_voxels_brick(growth->voxels, cell);
    if (brick == NULL || brick->claim == NULL) {
        return false;
    }
    uint32_t claim = brick->claim[fr_voxels_index(cell)];
    if (claim >= proposal->rank) {
        return false;
    }
    const FrProposal *other = &growth->proposals[growth->by_rank[claim]];
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    return other->plant != proposal->plant ||
           plant->buds[other->bud].node != plant->buds[proposal->bud].node;
}

static bool is_blocked(const FrGrowth *growth, const FrProposal *proposal, FrCell cell,
                       bool by_claims) {
    if (by_claims) {
        return is_claimed(growth, proposal, cell);
    }
    uint32_t owner = fr_voxels_owner(growth->voxels, cell);
    return owner != FR_VOXEL_FREE && !is_related(growth, proposal, owner);
}

/// The box around the tip: true if something stands in it.
static bool box_is_blocked(const FrGrowth *growth, const FrProposal *proposal, FrCell tip,
                           bool by_claims) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    int half = (int)fr_species_of(growth, plant)->params.box / 2;
    for (int z = -half; z <= half; z++) {
        for (int y = -half; y <= half; y++) {
            for (int x = -half; x <= half; x++) {
                int at[3] = {tip.at[0] + x, tip.at[1] + y, tip.at[2] + z};
                bool is_outside = ((at[0] | at[1] | at[2]) & ~(FR_VOXELS_WIDTH - 1)) != 0;
                FrCell cell = {{(int16_t)at[0], (int16_t)at[1], (int16_t)at[2]}};
                if (!is_outside && is_blocked(growth, proposal, cell, by_claims)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// The cells of the segment, without the first, in which its bearer stands.
static bool walk_is_blocked(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells,
                            uint32_t count, bool by_claims) {
    for (uint32_t i = 1; i < count; i++) {
        if (is_blocked(growth, proposal, cells[i], by_claims)) {
            return true;
        }
    }
    return false;
}

uint32_t fr_growth_walk(const FrGrowth *growth, const FrGrownPlant *plant, uint32_t parent,
                        vec3s to, FrCell *cells) {
    double begin[3], end[3];
    world_of(plant, parent == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[parent], begin);
    world_of(plant, to, end);
    return fr_voxels_walk(growth->voxels, begin, end, cells);
}

static uint32_t walk(const FrGrowth *growth, const FrProposal *proposal, FrCell *cells) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    return fr_growth_walk(growth, plant, plant->buds[proposal->bud].node, proposal->at, cells);
}

static bool is_in_way(const FrGrowth *growth, const FrProposal *proposal, bool by_claims) {
    FrCell cells[FR_WALK_CELLS];
    uint32_t count = walk(growth, proposal, cells);
    return box_is_blocked(growth, proposal, cells[count - 1], by_claims) ||
           walk_is_blocked(growth, proposal, cells, count, by_claims);
}

static bool is_in_arena(const FrGrowth *growth, const FrGrownPlant *plant, vec3s at) {
    double world[3];
    world_of(plant, at, world);
    for (int axis = 0; axis < 3; axis++) {
        if (world[axis] < (double)growth->params.min.raw[axis] ||
            world[axis] > (double)growth->params.max.raw[axis]) {
            return false;
        }
    }
    return true;
}

// ---- proposing --------------------------------------------------------------------------------

/// Finds a free way, or says that there is none.
static void propose(const FrGrowth *growth, FrProposal *proposal, bool is_again) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    const FrReadySpecies *species = fr_species_of(growth, plant);
    const FrLiveBud *bud = &plant->buds[proposal->bud];
    vec3s from = bud_at(plant, bud);
    uint32_t trials = (uint32_t)species->params.trials;
    // Whoever has lost looks beside what the winner has taken; the wanted way may still be free.
    for (uint32_t trial = 0; trial < trials + is_again; trial++) {
        proposal->direction = fr_growth_direction(growth, plant, bud, trial);
        proposal->at = glms_vec3_add(from, glms_vec3_scale(proposal->direction, bud->length));
        if (is_in_arena(growth, plant, proposal->at) &&
            fr_envelope_holds(species, proposal->at, growth->up) &&
            (!species->params.collide || !is_in_way(growth, proposal, false))) {
            proposal->state = species->params.collide ? FR_PROPOSAL_ASKS : FR_PROPOSAL_WON;
            return;
        }
    }
    proposal->state = FR_PROPOSAL_BLOCKED;
}

typedef struct Round {
    FrGrowth *growth;
    uint32_t *open; ///< proposals still to be settled
    bool is_again;
} Round;

static void propose_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    for (size_t i = begin; i < end; i++) {
        propose(round->growth, &round->growth->proposals[round->open[i]], round->is_again);
    }
}

// ---- claiming ---------------------------------------------------------------------------------

static void claim_cell(uint32_t *claim, uint32_t rank) {
    uint32_t old = __atomic_load_n(claim, __ATOMIC_RELAXED);
    while (rank < old && !__atomic_compare_exchange_n(claim, &old, rank, true, __ATOMIC_RELAXED,
                                                      __ATOMIC_RELAXED)) {
    }
}

static void claim_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    const FrGrowth *growth = round->growth;
    for (size_t i = begin; i < end; i++) {
        const FrProposal *proposal = &growth->proposals[round->open[i]];
        if (proposal->state != FR_PROPOSAL_ASKS) {
            continue;
        }
        FrCell cells[FR_WALK_CELLS];
        uint32_t count = walk(growth, proposal, cells);
        for (uint32_t k = 1; k < count; k++) {
            FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
            claim_cell(&brick->claim[fr_voxels_index(cells[k])], proposal->rank);
        }
    }
}

static void decide_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    FrGrowth *growth = round->growth;
    for (size_t i = begin; i < end; i++) {
        FrProposal *proposal = &growth->proposals[round->open[i]];
        if (proposal->state == FR_PROPOSAL_ASKS) {
            bool has_lost = is_in_way(growth, proposal, true);
            proposal->next = has_lost ? FR_PROPOSAL_LOST : FR_PROPOSAL_WON;
        }
    }
}

/// Winners move into the cells that they have claimed first.
static void occupy_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    FrGrowth *growth = round->growth;
    for (size_t i = begin; i < end; i++) {
        const FrProposal *proposal = &growth->proposals[round->open[i]];
        if (proposal->state != FR_PROPOSAL_ASKS || proposal->next != FR_PROPOSAL_WON) {
            continue;
        }
        const FrGrownPlant *plant = &growth->plants[proposal->plant];
        uint32_t owner = plant->axes[plant->buds[proposal->bud].axis].owner;
        FrCell cells[FR_WALK_CELLS];
        uint32_t count = walk(growth, proposal, cells);
        for (uint32_t k = 1; k < count; k++) {
            FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
            uint32_t index = fr_voxels_index(cells[k]);
            uint64_t bit = UINT64_C(1) << fr_voxels_bit(cells[k]);
            uint64_t *taken = &brick->taken[cells[k].at[2] & 7];
            // Near a fork a cell may be a relative's already; then it stays so.
            if (brick->claim[index] == proposal->rank && brick->owner[index] == FR_VOXEL_FREE) {
                brick->owner[index] = owner;
                __atomic_fetch_or(taken, bit, __ATOMIC_RELAXED);
            }
        }
    }
}

static void unclaim_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    FrGrowth *growth = round->growth;
    for (size_t i = begin; i < end; i++) {
        FrProposal *proposal = &growth->proposals[round->open[i]];
        if (proposal->state != FR_PROPOSAL_ASKS) {
            continue;
        }
        FrCell cells[FR_WALK_CELLS];
        uint32_t count = walk(growth, proposal, cells);
        for (uint32_t k = 1; k < count; k++) {
            FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
            __atomic_store_n(&brick->claim[fr_voxels_index(cells[k])], FR_NONE, __ATOMIC_RELAXED);
        }
        proposal->state = proposal->next;
    }
}

/// Makes the bricks that will be claimed: the one thing that cannot be done at the same time.
static void reserve(FrGrowth *growth, const uint32_t *open, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        const FrProposal *proposal = &growth->proposals[open[i]];
        if (proposal->state != FR_PROPOSAL_ASKS) {
            continue;
        }
        FrCell cells[FR_WALK_CELLS];
        uint32_t cell_count = walk(growth, proposal, cells);
        for (uint32_t k = 1; k < cell_count; k++) {
            fr_voxels_reserve(growth->voxels, cells[k]);
        }
    }
}

void fr_growth_settle(FrGrowth *growth, uint32_t *open, uint32_t count, const FrContext *context) {
    enum { GRAIN = 256, AGAIN = 3 };
    for (int attempt = 0; attempt <= AGAIN && count > 0; attempt++) {
        Round round = {.growth = growth, .open = open, .is_again = attempt > 0};
        fr_parallel_for(context->pool, count, GRAIN, propose_range, &round, NULL);
        reserve(growth, open, count);
        fr_parallel_for(context->pool, count, GRAIN, claim_range, &round, NULL);
        fr_parallel_for(context->pool, count, GRAIN, decide_range, &round, NULL);
        fr_parallel_for(context->pool, count, GRAIN, occupy_range, &round, NULL);
        fr_parallel_for(context->pool, count, GRAIN, unclaim_range, &round, NULL);
        uint32_t left = 0;
        for (uint32_t i = 0; i < count; i++) {
            if (growth->proposals[open[i]].state == FR_PROPOSAL_LOST) {
                open[left++] = open[i];
            }
        }
        count = left;
    }
}
