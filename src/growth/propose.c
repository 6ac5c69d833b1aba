// Proposals of new internodes and who gets the space. Who gets cells that several buds ask for in
// one step is settled by claims: the smallest key wins, whoever asks first (the published rule
// visits buds in random order). Losers try again beside the winners.
#include "growth/propose.h"

#include <cglm/struct.h>
#include <math.h>

static vec3s bud_at(const FrGrownPlant *plant, const FrLiveBud *bud) {
    return bud->node == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[bud->node];
}

static FrCell *cells_of(const FrGrowth *growth, uint32_t proposal) {
    return growth->cells + (size_t)proposal * growth->cell_stride;
}

static bool is_in_arena(const FrGrowth *growth, const FrGrownPlant *plant, vec3s at) {
    for (int axis = 0; axis < 3; axis++) {
        double where = plant->seed.at[axis] + (double)at.raw[axis];
        if (where < (double)growth->params.min.raw[axis] ||
            where > (double)growth->params.max.raw[axis]) {
            return false;
        }
    }
    return true;
}

/// A trunk that begins outside of its envelope grows until it is within.
static bool is_in_envelope(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud,
                           vec3s from, vec3s to) {
    const FrReadySpecies *species = fr_species_of(growth, plant);
    return fr_envelope_holds(species, to, growth->up) ||
           (plant->axes[bud->axis].order == 0 && !fr_envelope_holds(species, from, growth->up));
}

// ---- proposing --------------------------------------------------------------------------------

/// Finds a free way, or says that there is none.
static void propose(const FrGrowth *growth, uint32_t index, bool is_again) {
    FrProposal *proposal = &growth->proposals[index];
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
            is_in_envelope(growth, plant, bud, from, proposal->at) &&
            (!species->params.collide ||
             fr_growth_is_free(growth, proposal, cells_of(growth, index)))) {
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
    bool is_alone; ///< one thread
} Round;

static void propose_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    for (size_t i = begin; i < end; i++) {
        propose(round->growth, round->open[i], round->is_again);
    }
}

// ---- claiming ---------------------------------------------------------------------------------

/// One thread alone needs no locked access, which costs as much as all the rest of a claim.
static void claim_alone(FrBrick *brick, FrCell cell, uint32_t rank) {
    FrVoxel *voxel = fr_voxels_at(brick, cell);
    voxel->claim = MIN(voxel->claim, rank);
    brick->asked[cell.at[2] & 7] |= UINT64_C(1) << fr_voxels_bit(cell);
}

static void claim_cell(FrBrick *brick, FrCell cell, uint32_t rank) {
    uint32_t *claim = &fr_voxels_at(brick, cell)->claim;
    uint32_t old = __atomic_load_n(claim, __ATOMIC_RELAXED);
    while (rank < old && !__atomic_compare_exchange_n(claim, &old, rank, true, __ATOMIC_RELAXED,
                                                      __ATOMIC_RELAXED)) {
    }
    __atomic_fetch_or(&brick->asked[cell.at[2] & 7], UINT64_C(1) << fr_voxels_bit(cell),
                      __ATOMIC_RELAXED);
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
        const FrCell *cells = cells_of(growth, round->open[i]);
        for (uint32_t k = 1; k < proposal->cell_count; k++) {
            FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
            if (round->is_alone) {
                claim_alone(brick, cells[k], proposal->rank);
            } else {
                claim_cell(brick, cells[k], proposal->rank);
            }
        }
    }
}

/// A winner moves into the cells that it has claimed first. Near a fork a cell may be a relative's
/// already; then it stays so.
static void occupy(FrGrowth *growth, const FrProposal *proposal, const FrCell *cells) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    uint32_t owner = plant->axes[plant->buds[proposal->bud].axis].owner;
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
        FrVoxel *voxel = fr_voxels_at(brick, cells[k]);
        if (voxel->claim == proposal->rank && voxel->owner == FR_VOXEL_FREE) {
            voxel->owner = owner;
            __atomic_fetch_or(&brick->taken[cells[k].at[2] & 7],
                              UINT64_C(1) << fr_voxels_bit(cells[k]), __ATOMIC_RELAXED);
        }
    }
}

/// Claims alone decide; owners are only written, so winners can move in at once.
static void decide_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    FrGrowth *growth = round->growth;
    for (size_t i = begin; i < end; i++) {
        FrProposal *proposal = &growth->proposals[round->open[i]];
        if (proposal->state != FR_PROPOSAL_ASKS) {
            continue;
        }
        const FrCell *cells = cells_of(growth, round->open[i]);
        bool has_won = fr_growth_is_first(growth, proposal, cells);
        proposal->next = has_won ? FR_PROPOSAL_WON : FR_PROPOSAL_LOST;
        if (has_won) {
            occupy(growth, proposal, cells);
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
        const FrCell *cells = cells_of(growth, round->open[i]);
        for (uint32_t k = 1; k < proposal->cell_count; k++) {
            FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
            __atomic_store_n(&fr_voxels_at(brick, cells[k])->claim, FR_NONE, __ATOMIC_RELAXED);
            __atomic_store_n(&brick->asked[cells[k].at[2] & 7], 0, __ATOMIC_RELAXED);
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
        const FrCell *cells = cells_of(growth, open[i]);
        for (uint32_t k = 1; k < proposal->cell_count; k++) {
            fr_voxels_reserve(growth->voxels, cells[k]);
        }
    }
}

void fr_growth_settle(FrGrowth *growth, uint32_t *open, uint32_t count, const FrContext *context) {
    enum { GRAIN = 256, AGAIN = 3 };
    for (int attempt = 0; attempt <= AGAIN && count > 0; attempt++) {
        Round round = {.growth = growth,
                       .open = open,
                       .is_again = attempt > 0,
                       .is_alone = fr_pool_threads(context->pool) == 1};
        fr_parallel_for(context->pool, count, GRAIN, propose_range, &round, NULL);
        reserve(growth, open, count);
        fr_parallel_for(context->pool, count, GRAIN, claim_range, &round, NULL);
        fr_parallel_for(context->pool, count, GRAIN, decide_range, &round, NULL);
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
