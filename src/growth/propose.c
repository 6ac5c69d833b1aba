// Proposals of new internodes and who gets the space. Who gets cells that several buds ask for in
// one step is settled by claims: the smallest key wins, whoever asks first (the published rule
// visits buds in random order). Losers try again beside the winners.
//
// A claim is the axis' number in a free cell, marked as asked for. Owners lie scattered in memory,
// so they are written once: what is won is only marked as taken, and read again only where several
// have met.
#include "growth/propose.h"

#include <cglm/struct.h>
#include <math.h>

static vec3s bud_at(const FrGrownPlant *plant, const FrLiveBud *bud) {
    return bud->node == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[bud->node];
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

/// Finds a free way and its cells, or says that there is none.
static void propose(const FrGrowth *growth, uint32_t index, bool is_again, FrCell *cells) {
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
            (!species->params.collide || fr_growth_is_free(growth, proposal, cells))) {
            proposal->state = species->params.collide ? FR_PROPOSAL_ASKS : FR_PROPOSAL_WON;
            return;
        }
    }
    proposal->state = FR_PROPOSAL_BLOCKED;
}

enum { AHEAD = 8 };

typedef struct Round {
    FrGrowth *growth;
    uint32_t *open; ///< proposals still to be settled
    bool is_again;
} Round;

// ---- claiming ---------------------------------------------------------------------------------

static void set_bit(uint64_t *bits, uint64_t bit) {
    if ((__atomic_load_n(bits, __ATOMIC_RELAXED) & bit) == 0) {
        __atomic_fetch_or(bits, bit, __ATOMIC_RELAXED);
    }
}

/// Asks for a free cell: the first of all that do stays in it. Returns whether another one does.
static bool ask(const FrGrowth *growth, uint32_t *owner, uint32_t own) {
    uint32_t old = FR_VOXEL_FREE;
    while (
        !__atomic_compare_exchange_n(owner, &old, own, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
        if (fr_claim_is_before(growth, old, own)) {
            return true;
        }
    }
    return old != FR_VOXEL_FREE;
}

/// Asks for every cell that nobody owns yet; what is a relative's stays so.
static void claim(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells) {
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        FrBrick *brick = fr_voxels_reserve(growth->voxels, cells[k]);
        unsigned layer = (unsigned)cells[k].at[2] & 7, bit = fr_voxels_bit(cells[k]);
        if ((brick->taken[layer] >> bit & 1) == 0) {
            if (ask(growth, fr_voxels_at(brick, cells[k]), proposal->own)) {
                set_bit(&brick->contested, UINT64_C(1) << fr_voxels_cube(layer, bit));
            }
            set_bit(&brick->asked[layer], UINT64_C(1) << bit);
        }
    }
}

/// Has the memory brought that a claim will write: it comes while others look for their ways.
static void fetch(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells) {
    FrBrick *brick = NULL;
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        brick = fr_voxels_next_brick(growth->voxels, cells, k, brick);
        uint32_t *owners = brick == NULL ? NULL : __atomic_load_n(&brick->owners, __ATOMIC_ACQUIRE);
        if (owners != NULL) {
            unsigned layer = (unsigned)cells[k].at[2] & 7;
            __builtin_prefetch(&owners[fr_voxels_slot(layer, fr_voxels_bit(cells[k]))], 1);
        }
    }
}

/// Ways are looked for among what is owned, which claims leave as it is.
static void propose_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    FrCell cells[AHEAD][FR_WALK_CELLS];
    for (size_t i = begin; i < end + AHEAD; i++) {
        if (i >= begin + AHEAD) {
            FrProposal *proposal = &round->growth->proposals[round->open[i - AHEAD]];
            if (proposal->state == FR_PROPOSAL_ASKS) {
                claim(round->growth, proposal, cells[i % AHEAD]);
                fr_path_keep(round->growth, proposal, cells[i % AHEAD]);
            }
        }
        if (i < end) {
            propose(round->growth, round->open[i], round->is_again, cells[i % AHEAD]);
            FrProposal *proposal = &round->growth->proposals[round->open[i]];
            if (proposal->state == FR_PROPOSAL_ASKS) {
                fetch(round->growth, proposal, cells[i % AHEAD]);
            }
        }
    }
}

static void decide_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    const FrGrowth *growth = round->growth;
    FrCell cells[FR_WALK_CELLS];
    for (size_t i = begin; i < end; i++) {
        FrProposal *proposal = &growth->proposals[round->open[i]];
        if (proposal->state == FR_PROPOSAL_ASKS) {
            fr_path_cells(growth, proposal, cells);
            bool is_first = fr_growth_is_first(growth, proposal, cells);
            proposal->next = is_first ? FR_PROPOSAL_WON : FR_PROPOSAL_LOST;
        }
    }
}

/// True for a cell in which a proposal is the first of all that ask for it.
static bool has_first(const FrBrick *brick, FrCell cell, uint32_t own) {
    unsigned layer = (unsigned)cell.at[2] & 7, bit = fr_voxels_bit(cell);
    if ((__atomic_load_n(&brick->taken[layer], __ATOMIC_RELAXED) >> bit & 1) != 0) {
        return false; // a relative's
    }
    return (brick->contested >> fr_voxels_cube(layer, bit) & 1) == 0 ||
           __atomic_load_n(fr_voxels_at(brick, cell), __ATOMIC_RELAXED) == own;
}

/// A winner takes the cells in which it is the first; a loser leaves them as they were.
static void settle(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells) {
    FrBrick *brick = NULL;
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        brick = fr_voxels_next_brick(growth->voxels, cells, k, brick);
        unsigned layer = (unsigned)cells[k].at[2] & 7;
        __atomic_store_n(&brick->asked[layer], 0, __ATOMIC_RELAXED);
        if (!has_first(brick, cells[k], proposal->own)) {
            continue;
        }
        if (proposal->next == FR_PROPOSAL_WON) {
            __atomic_fetch_or(&brick->taken[layer], UINT64_C(1) << fr_voxels_bit(cells[k]),
                              __ATOMIC_RELAXED);
        } else {
            __atomic_store_n(fr_voxels_at(brick, cells[k]), FR_VOXEL_FREE, __ATOMIC_RELAXED);
        }
    }
}

static void settle_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    FrCell cells[FR_WALK_CELLS];
    for (size_t i = begin; i < end; i++) {
        FrProposal *proposal = &round->growth->proposals[round->open[i]];
        if (proposal->state == FR_PROPOSAL_ASKS) {
            fr_path_cells(round->growth, proposal, cells);
            settle(round->growth, proposal, cells);
            proposal->state = proposal->next;
        }
    }
}

void fr_growth_settle(FrGrowth *growth, uint32_t *open, uint32_t count, const FrContext *context) {
    enum { GRAIN = 256, AGAIN = 3 };
    for (int attempt = 0; attempt <= AGAIN && count > 0; attempt++) {
        Round round = {.growth = growth, .open = open, .is_again = attempt > 0};
        fr_parallel_for(context->pool, count, GRAIN, propose_range, &round, NULL);
        fr_parallel_for(context->pool, count, GRAIN, decide_range, &round, NULL);
        fr_parallel_for(context->pool, count, GRAIN, settle_range, &round, NULL);
        uint32_t left = 0;
        for (uint32_t i = 0; i < count; i++) {
            if (growth->proposals[open[i]].state == FR_PROPOSAL_LOST) {
                open[left++] = open[i];
            }
        }
        count = left;
    }
}
