// The fate of buds: how many internodes each makes in a step, and how long they are. By auxin a
// growing bud makes one, whose length follows the light; by vigour as many as its vigour pays for.
// What gets too little of it falls (Palubicki et al. 2009, section 5).
#include "growth/vigour.h"

#include <math.h>

/// Growing buds make an internode each.
static void by_auxin(const FrGrowth *growth, FrGrownPlant *plant) {
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        FrLiveBud *bud = &plant->buds[b];
        bud->shoot = bud->state == FR_LIVE_GROWING && !bud->is_resting;
        if (bud->shoot > 0) {
            bud->length = (float)fr_growth_length(growth, plant, bud);
        }
    }
}

/// Drops what has less vigour for each internode and bud than the species asks for.
static void drop_weak(FrGrowth *growth, FrGrownPlant *plant, const FrFlow *flow,
                      uint8_t *has_fallen, int worker) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    const FrGrownNodes *nodes = &plant->nodes;
    uint32_t fallen = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        has_fallen[i] =
            parent != FR_NONE &&
            (has_fallen[parent] || flow[i].vigour <= params->shed_vigour * flow[i].count);
        fallen += has_fallen[i];
    }
    if (fallen > 0) {
        fr_growth_drop(growth, plant, has_fallen, worker);
    }
}

/// Sleeping buds wake if their vigour pays for more than one internode.
static void by_vigour(FrGrowth *growth, FrGrownPlant *plant) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    uint32_t count = plant->bud_count;
    for (uint32_t b = 0; b < count; b++) {
        FrLiveBud *bud = &plant->buds[b];
        // A seed makes the one internode that the model begins with.
        double vigour = bud->node == FR_NONE ? 1 : MIN((double)bud->vigour, params->shoot);
        if (bud->state == FR_LIVE_ASLEEP && (vigour > 1 || bud->is_relay)) {
            fr_growth_wake_bud(plant, bud, growth->step);
        }
        bool grows = bud->state == FR_LIVE_GROWING && !bud->is_resting;
        bud->shoot = grows ? (uint8_t)vigour : 0;
        if (bud->shoot > 0) {
            bud->length = (float)(params->step * vigour / bud->shoot);
            fr_growth_look_around(growth, plant, bud);
        }
    }
}

void fr_growth_fates(FrGrowth *growth, FrGrownPlant *plant, int worker) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    if (growth->step <= (uint64_t)params->start) {
        for (uint32_t b = 0; b < plant->bud_count; b++) {
            plant->buds[b].shoot = 0;
        }
        return;
    }
    if (params->fate != FR_FATE_FLUX && params->fate != FR_FATE_PRIORITY) {
        by_auxin(growth, plant);
        return;
    }
    uint32_t nodes = plant->nodes.count;
    FrFlow *flow =
        fr_scratch_take(&growth->scratch[worker], nodes * (sizeof(FrFlow) + sizeof(uint8_t)) + 1);
    uint8_t *has_fallen = (uint8_t *)(flow + nodes);
    if (params->fate == FR_FATE_FLUX) {
        fr_growth_flux(growth, plant, flow);
    } else {
        fr_growth_priority(growth, plant, flow, &growth->drop_scratch[worker]);
    }
    if (params->shed == FR_SHED_VIGOUR || params->shed == FR_SHED_BOTH) {
        drop_weak(growth, plant, flow, has_fallen, worker);
    }
    by_vigour(growth, plant);
}
