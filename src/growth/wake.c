// Which sleeping buds wake. A growing apex keeps the buds of its axis asleep within its reach
// (Beneš, Andrysco, Šťava 2009, section 3.6), or by chance (auxin.c); once it is gone, they are
// free.
#include "growth/engine.h"

#include <math.h>

/// True if the auxin of growing apices does not reach the bud. `auxin` by node; NULL: by distance.
static bool is_free(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud,
                    const double *auxin) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    const FrGrownAxis *axis = &plant->axes[bud->axis];
    if (bud->is_relay) {
        return true;
    }
    if (auxin != NULL && bud->node != FR_NONE) {
        double chance = (double)bud->light * exp(-auxin[bud->node]);
        return fr_random(bud->key, FR_CHANCE_WAKE, (uint32_t)growth->step) < chance;
    }
    return !axis->is_growing || (double)(axis->internodes - bud->place) > params->auxin_reach;
}

void fr_growth_wake_bud(FrGrownPlant *plant, FrLiveBud *bud, uint64_t step) {
    uint8_t order = plant->axes[bud->axis].order; // relays go on with the axis that has ended
    bud->axis = fr_grown_add_axis(plant, bud->node, bud->row, bud->key);
    plant->axes[bud->axis].order = bud->is_relay ? order : plant->axes[bud->axis].order;
    plant->axes[bud->axis].birth = (uint16_t)MIN(step, UINT16_MAX);
    bud->state = FR_LIVE_GROWING;
    bud->is_relay = 0;
    bud->age = 0;
}

void fr_growth_wake(const FrGrowth *growth, FrGrownPlant *plant, FrScratch *scratch) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    bool is_by_vigour = params->fate == FR_FATE_FLUX || params->fate == FR_FATE_PRIORITY;
    const double *auxin = NULL;
    if (params->auxin > 0 && !is_by_vigour) {
        auxin = fr_growth_auxin(plant, params, scratch);
    }
    for (uint32_t i = 0; i < plant->bud_count; i++) {
        FrLiveBud *bud = &plant->buds[i];
        bud->age = (uint16_t)MIN(bud->age + 1u, UINT16_MAX);
        if (bud->state != FR_LIVE_ASLEEP || is_by_vigour) {
            continue;
        }
        if (bud->age > params->patience) {
            bud->state = FR_LIVE_DONE;
        } else if (bud->age >= params->dormancy && (double)bud->light >= params->wake_light &&
                   is_free(growth, plant, bud, auxin)) {
            fr_growth_wake_bud(plant, bud, growth->step);
        }
    }
}
