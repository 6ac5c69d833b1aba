// One step of all plants: light, particles, vigour, then the internodes of each shoot one after the
// other (propose, claim, commit, sprout), then waking and shedding (Beneš, Andrysco, Šťava 2009,
// section 3.2, with its random order of buds replaced by claims that know no order).
#include "growth/propose.h"

#include <cglm/struct.h>
#include <string.h>

typedef struct Step {
    FrGrowth *growth;
    uint32_t internode; ///< of the shoots
} Step;

static void note_owner(FrGrowth *growth, uint32_t plant, uint32_t axis) {
    FrGrownAxis *of = &growth->plants[plant].axes[axis];
    if (of->owner != FR_NONE) {
        return;
    }
    if (growth->owner_count == growth->owner_capacity) {
        growth->owner_capacity = MAX(1024, growth->owner_capacity + growth->owner_capacity / 2);
        growth->owners = g_renew(FrOwner, growth->owners, growth->owner_capacity);
    }
    of->owner = growth->owner_count;
    growth->owners[growth->owner_count++] = (FrOwner){plant, axis};
}

static void room_for_proposals(FrGrowth *growth, uint32_t count) {
    if (count > growth->proposal_capacity) {
        growth->proposal_capacity = count + count / 2;
        growth->proposals = g_renew(FrProposal, growth->proposals, growth->proposal_capacity);
        growth->by_rank = g_renew(uint32_t, growth->by_rank, growth->proposal_capacity);
        growth->open = g_renew(uint32_t, growth->open, growth->proposal_capacity);
        growth->sort_keys = g_renew(uint64_t, growth->sort_keys, growth->proposal_capacity);
    }
}

/// Gathers a proposal for every shoot that has this internode still to make.
static uint32_t gather(FrGrowth *growth, uint32_t internode) {
    uint32_t count = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            count += plant->buds[b].state == FR_LIVE_GROWING && plant->buds[b].shoot > internode;
        }
    }
    room_for_proposals(growth, count);
    count = 0;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            const FrLiveBud *bud = &plant->buds[b];
            if (bud->state == FR_LIVE_GROWING && bud->shoot > internode) {
                growth->proposals[count] = (FrProposal){.plant = p, .bud = b};
                growth->sort_keys[count] = fr_random_bits(bud->key, FR_CHANCE_CLAIM,
                                                          (uint32_t)growth->step * 64u + internode);
                growth->open[count] = count;
                note_owner(growth, p, bud->axis);
                count++;
            }
        }
    }
    return count;
}

static int compare_keys(const void *a, const void *b, void *data) {
    const uint64_t *keys = data;
    uint64_t x = keys[*(const uint32_t *)a], y = keys[*(const uint32_t *)b];
    return x < y ? -1 : x > y;
}

static void rank(FrGrowth *growth, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        growth->by_rank[i] = i;
    }
    g_qsort_with_data(growth->by_rank, (int)count, sizeof(uint32_t), compare_keys,
                      growth->sort_keys);
    for (uint32_t i = 0; i < count; i++) {
        growth->proposals[growth->by_rank[i]].rank = i;
    }
}

/// What has been settled becomes wood.
static void commit(FrGrowth *growth, const FrProposal *proposal, uint32_t internode) {
    FrGrownPlant *plant = &growth->plants[proposal->plant];
    FrLiveBud *bud = &plant->buds[proposal->bud];
    if (proposal->state != FR_PROPOSAL_WON) {
        plant->collisions++;
        plant->contested += proposal->state == FR_PROPOSAL_LOST;
        plant->axes[bud->axis].is_growing = false;
        bud->state = FR_LIVE_DONE;
        return;
    }
    const FrReadySpecies *species = fr_species_of(growth, plant);
    uint32_t node = fr_grown_add_node(plant, bud->node, bud->axis, proposal->at);
    plant->nodes.birth[node] = (uint16_t)MIN(growth->step, UINT16_MAX);
    plant->nodes.light[node] = (uint8_t)(bud->light * 255);
    plant->max_order = MAX(plant->max_order, plant->axes[bud->axis].order);
    plant->born++;
    bud->node = node;
    fr_growth_turn(bud, proposal->direction, (float)species->params.twist);
    fr_growth_sprout(growth, plant, proposal->bud, node);
    (void)internode;
}

static void begin_plants(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrGrowth *growth = ((Step *)data)->growth;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        plant->born = plant->shed = plant->collisions = plant->contested = 0;
        const FrReadySpecies *species = fr_species_of(growth, plant);
        bool is_waiting = growth->step <= (uint64_t)species->params.start;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            FrLiveBud *bud = &plant->buds[b];
            bud->shoot = bud->state == FR_LIVE_GROWING && !is_waiting;
            if (bud->shoot > 0) {
                bud->length = (float)fr_growth_length(growth, plant, bud);
            }
        }
    }
}

static void end_plants(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrGrowth *growth = ((Step *)data)->growth;
    for (size_t p = begin; p < end; p++) {
        FrGrownPlant *plant = &growth->plants[p];
        fr_growth_wake(growth, plant);
        uint32_t left = 0;
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            if (plant->buds[b].state != FR_LIVE_DONE) {
                plant->buds[left++] = plant->buds[b];
            }
        }
        plant->bud_count = left;
    }
}

static void make_shoots(FrGrowth *growth, const FrContext *context) {
    for (uint32_t internode = 0;; internode++) {
        uint32_t count = gather(growth, internode);
        if (count == 0) {
            return;
        }
        rank(growth, count);
        fr_growth_settle(growth, growth->open, count, context);
        for (uint32_t i = 0; i < count; i++) {
            commit(growth, &growth->proposals[i], internode);
        }
    }
}

FrStatus fr_growth_step(FrGrowth *growth, const FrContext *context) {
    growth->step++;
    Step step = {.growth = growth};
    fr_parallel_for(context->pool, growth->plant_count, 1, begin_plants, &step, NULL);
    make_shoots(growth, context);
    fr_parallel_for(context->pool, growth->plant_count, 1, end_plants, &step, NULL);
    fr_growth_count(growth);
    return FR_OK;
}
