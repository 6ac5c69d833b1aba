// What a phase of the step works on, gathered from all plants: counted plant by plant, then put
// where each plant's part begins.
#include "growth/propose.h"

#include <math.h>

/// What is gathered, for which internode of the shoots.
typedef struct Gathering {
    FrGrowth *growth;
    uint32_t internode;
} Gathering;

// ---- live buds --------------------------------------------------------------------------------

static void count_live(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Gathering *gathering = data;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &gathering->growth->plants[p];
        plant->live_count = plant->bud_count;
        plant->growing_count = 0;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            plant->growing_count += plant->buds[b].state == FR_LIVE_GROWING;
        }
    }
}

static void put_live(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Gathering *gathering = data;
    FrGrowth *growth = gathering->growth;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
        uint32_t growing = plant->first_growing, asleep = plant->first_asleep;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            FrLiveBud *bud = &plant->buds[b];
            uint32_t slot = bud->state == FR_LIVE_GROWING ? growing++ : asleep++;
            growth->live[slot] = (FrLiveBudAt){.bud = bud,
                                               .params = params,
                                               .world = fr_bud_world(plant, bud),
                                               .influence = (float)params->influence,
                                               .own_shade = sqrtf((float)params->foliage)};
        }
    }
}

uint32_t fr_growth_gather_live(FrGrowth *growth, uint32_t *count, const FrContext *context) {
    Gathering gathering = {growth, 0};
    fr_parallel_for(context->pool, growth->plant_count, 1, count_live, &gathering, NULL);
    uint32_t growing = 0, asleep = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        growing += growth->plants[p].growing_count;
    }
    for (uint32_t p = 0, before = 0; p < growth->plant_count; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        plant->first_growing = before;
        plant->first_asleep = growing + asleep;
        before += plant->growing_count;
        asleep += plant->live_count - plant->growing_count;
    }
    *count = growing + asleep;
    growth->live = fr_scratch_take(&growth->live_memory, (*count + 1u) * sizeof *growth->live);
    fr_parallel_for(context->pool, growth->plant_count, 1, put_live, &gathering, NULL);
    return growing;
}

// ---- proposals --------------------------------------------------------------------------------

static bool proposes(const FrLiveBud *bud, uint32_t internode) {
    return bud->state == FR_LIVE_GROWING && bud->shoot > internode;
}

static void count_proposals(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Gathering *gathering = data;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &gathering->growth->plants[p];
        plant->proposal_count = plant->owner_count = plant->longest_shoot = 0;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            if (proposes(&plant->buds[b], gathering->internode)) {
                plant->proposal_count++;
                plant->longest_shoot = MAX(plant->longest_shoot, plant->buds[b].shoot);
                plant->owner_count += plant->axes[plant->buds[b].axis].owner == FR_NONE;
            }
        }
    }
}

static FrProposal proposal_of(const FrGrownPlant *plant, uint32_t index, uint32_t b) {
    const FrLiveBud *bud = &plant->buds[b];
    const FrGrownAxis *axis = &plant->axes[bud->axis];
    bool is_first = axis->internodes == 0 && bud->node != FR_NONE;
    return (FrProposal){.plant = index,
                        .bud = b,
                        .node = bud->node,
                        .own = axis->owner,
                        .branched_off =
                            is_first ? plant->axes[plant->nodes.axis[bud->node]].owner : FR_NONE};
}

static void put_proposals(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Gathering *gathering = data;
    FrGrowth *growth = gathering->growth;
    for (size_t p = begin; p < end; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        uint32_t next = plant->first_proposal, owner = plant->first_owner;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            const FrLiveBud *bud = &plant->buds[b];
            if (!proposes(bud, gathering->internode)) {
                continue;
            }
            FrGrownAxis *axis = &plant->axes[bud->axis];
            if (axis->owner == FR_NONE) {
                growth->owners[owner] = (FrOwner){(uint32_t)p, bud->axis, axis->bearer, FR_NONE, 0};
                axis->owner = owner++;
            }
            growth->owners[axis->owner].node = bud->node;
            growth->owners[axis->owner].key = fr_random_bits(
                bud->key, FR_CHANCE_CLAIM, (uint32_t)growth->step * 64u + gathering->internode);
            growth->open[next] = next;
            growth->proposals[next] = proposal_of(plant, (uint32_t)p, b);
            next++;
        }
    }
}

static void room_for_proposals(FrGrowth *growth, uint32_t count) {
    size_t size = sizeof *growth->proposals + sizeof *growth->open + growth->step_stride;
    growth->proposals = fr_scratch_take(&growth->proposal_memory, (count + 1u) * size);
    growth->open = (uint32_t *)(void *)(growth->proposals + count);
    growth->steps = (uint8_t *)(growth->open + count);
}

uint32_t fr_growth_gather_proposals(FrGrowth *growth, uint32_t internode, bool *goes_on,
                                    const FrContext *context) {
    Gathering gathering = {growth, internode};
    fr_parallel_for(context->pool, growth->plant_count, 1, count_proposals, &gathering, NULL);
    uint32_t count = 0, owners = growth->owner_count;
    *goes_on = false;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        plant->first_proposal = count;
        plant->first_owner = owners;
        count += plant->proposal_count;
        owners += plant->owner_count;
        *goes_on |= plant->longest_shoot > internode + 1;
    }
    room_for_proposals(growth, count);
    fr_growth_reserve_owners(growth, owners);
    growth->owner_count = owners;
    fr_parallel_for(context->pool, growth->plant_count, 1, put_proposals, &gathering, NULL);
    return count;
}
