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

/// Where a proposal wants to go, by trial.
static void aim(const FrGrowth *growth, FrProposal *proposal, uint32_t trial) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    const FrLiveBud *bud = &plant->buds[proposal->bud];
    proposal->direction = fr_growth_direction(growth, plant, bud, trial);
    proposal->at =
        glms_vec3_add(bud_at(plant, bud), glms_vec3_scale(proposal->direction, bud->length));
}

/// Finds a free way and its cells, or says that there is none. It aims already by the first trial.
static void propose(const FrGrowth *growth, FrProposal *proposal, bool is_again,
                    FrCellPlace *places) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    const FrReadySpecies *species = fr_species_of(growth, plant);
    const FrLiveBud *bud = &plant->buds[proposal->bud];
    uint32_t trials = (uint32_t)species->params.trials;
    // Whoever has lost looks beside what the winner has taken; the wanted way may still be free.
    for (uint32_t trial = 0; trial < trials + is_again; trial++) {
        if (trial > 0) {
            aim(growth, proposal, trial);
        }
        if (is_in_arena(growth, plant, proposal->at) &&
            is_in_envelope(growth, plant, bud, bud_at(plant, bud), proposal->at) &&
            (!species->params.collide || fr_growth_is_free(growth, proposal, places)) &&
            fr_climb_is_clear(growth, plant, bud, proposal->at)) {
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

static FrProposal *proposal_at(const Round *round, size_t i) {
    return &round->growth->proposals[round->open[i]];
}

// ---- memory -----------------------------------------------------------------------------------
// Proposals are served a few at a time: the memory of one is brought while the others are served.

enum { AHEAD = 8, TOGETHER = 32 };

typedef FrCellPlace Places[FR_WALK_CELLS];

/// Has the memory brought that tells what stands where a proposal aims.
static void fetch_tip(const FrGrowth *growth, const FrProposal *proposal) {
    FrCell tip;
    FrBrick *brick = NULL;
    if (fr_growth_tip(growth, proposal, &tip)) {
        brick = fr_voxels_brick(growth->voxels, tip);
    }
    if (brick != NULL) {
        __builtin_prefetch(brick->taken);
        __builtin_prefetch(&brick->owners);
    }
}

/// Has the owner of a cell brought.
static inline void fetch_owner(const FrCellPlace *place) {
    uint32_t *owners =
        place->brick == NULL ? NULL : __atomic_load_n(&place->brick->owners, __ATOMIC_ACQUIRE);
    if (owners != NULL) {
        __builtin_prefetch(&owners[fr_voxels_slot(place->layer, place->bit)], 1);
    }
}

/// True for a cell that several may have asked for.
static inline bool is_contested(const FrCellPlace *place) {
    return (__atomic_load_n(&place->brick->contested, __ATOMIC_RELAXED) >>
                fr_voxels_cube(place->layer, place->bit) &
            1) != 0;
}

/// Half of what is done for a proposal that asks.
typedef void (*Half)(const Round *round, FrProposal *proposal, FrCellPlace *places);

/// The cells of a segment, and the owners of those that several ask for brought: nobody reads the
/// others.
static void look_up(const Round *round, FrProposal *proposal, FrCellPlace *places) {
    fr_path_places(round->growth, proposal, places);
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        if (is_contested(&places[k])) {
            fetch_owner(&places[k]);
        }
    }
}

static inline void serve(const Round *round, size_t begin, size_t end, Half first, Half second) {
    Places places[AHEAD];
    for (size_t i = begin; i < end + AHEAD; i++) {
        FrProposal *last = i < begin + AHEAD ? NULL : proposal_at(round, i - AHEAD);
        if (last != NULL && last->state == FR_PROPOSAL_ASKS) {
            second(round, last, places[i % AHEAD]);
        }
        FrProposal *next = i < end ? proposal_at(round, i) : NULL;
        if (next != NULL && next->state == FR_PROPOSAL_ASKS) {
            first(round, next, places[i % AHEAD]);
        }
    }
}

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
static void claim(const FrGrowth *growth, const FrProposal *proposal, const FrCellPlace *places) {
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        const FrCellPlace *place = &places[k];
        FrBrick *brick = place->brick;
        if (brick == NULL || __atomic_load_n(&brick->owners, __ATOMIC_ACQUIRE) == NULL) {
            brick = fr_voxels_reserve(growth->voxels, place->cell);
        }
        unsigned layer = place->layer, bit = place->bit;
        if ((brick->taken[layer] >> bit & 1) == 0) {
            if (ask(growth, &brick->owners[fr_voxels_slot(layer, bit)], proposal->own)) {
                set_bit(&brick->contested, UINT64_C(1) << fr_voxels_cube(layer, bit));
            }
            set_bit(&brick->asked[layer], UINT64_C(1) << bit);
        }
    }
}

/// Ways are looked for among what is owned, which claims leave as it is.
static void look_for_way(const Round *round, FrProposal *proposal, FrCellPlace *places) {
    propose(round->growth, proposal, round->is_again, places);
    for (uint32_t k = 1; proposal->state == FR_PROPOSAL_ASKS && k < proposal->cell_count; k++) {
        fetch_owner(&places[k]);
    }
}

static void claim_way(const Round *round, FrProposal *proposal, FrCellPlace *places) {
    claim(round->growth, proposal, places);
    fr_path_keep(round->growth, proposal, places);
}

static void propose_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Round *round = data;
    for (size_t from = begin; from < end; from += TOGETHER) {
        size_t to = MIN(from + TOGETHER, end);
        for (size_t i = from; i < to; i++) {
            FrProposal *proposal = proposal_at(round, i);
            aim(round->growth, proposal, 0);
            fetch_tip(round->growth, proposal);
            proposal->state = FR_PROPOSAL_ASKS;
        }
        serve(round, from, to, look_for_way, claim_way);
    }
}

static void decide(const Round *round, FrProposal *proposal, FrCellPlace *places) {
    bool is_first = fr_growth_is_first(round->growth, proposal, places);
    proposal->next = is_first ? FR_PROPOSAL_WON : FR_PROPOSAL_LOST;
}

static void decide_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    serve(data, begin, end, look_up, decide);
}

/// A winner takes the cells in which it is the first; a loser leaves them as they were.
static void settle(const Round *round, FrProposal *proposal, FrCellPlace *places) {
    (void)round;
    for (uint32_t k = 1; k < proposal->cell_count; k++) {
        const FrCellPlace *place = &places[k];
        FrBrick *brick = place->brick;
        uint64_t bit = UINT64_C(1) << place->bit;
        uint32_t *owner = &brick->owners[fr_voxels_slot(place->layer, place->bit)];
        __atomic_store_n(&brick->asked[place->layer], 0, __ATOMIC_RELAXED);
        bool is_relative =
            (__atomic_load_n(&brick->taken[place->layer], __ATOMIC_RELAXED) & bit) != 0;
        if (is_relative ||
            (is_contested(place) && __atomic_load_n(owner, __ATOMIC_RELAXED) != proposal->own)) {
            continue;
        }
        if (proposal->next == FR_PROPOSAL_WON) {
            __atomic_fetch_or(&brick->taken[place->layer], bit, __ATOMIC_RELAXED);
        } else {
            __atomic_store_n(owner, FR_VOXEL_FREE, __ATOMIC_RELAXED);
        }
    }
    proposal->state = proposal->next;
}

static void settle_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    serve(data, begin, end, look_up, settle);
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
