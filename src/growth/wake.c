// Which sleeping buds wake. A growing apex keeps the buds of its axis asleep within its reach
// (Beneš, Andrysco, Šťava 2009, section 3.6); once it is gone, they are free.
#include "growth/engine.h"

/// True if the auxin of the axis' apex does not reach the bud.
static bool is_free(const FrSpeciesParams *params, const FrGrownAxis *axis, const FrLiveBud *bud) {
    if (bud->is_relay || !axis->is_growing) {
        return true;
    }
    return (double)(axis->internodes - bud->place) > params->auxin_reach;
}

void fr_growth_wake_bud(FrGrownPlant *plant, FrLiveBud *bud, uint64_t step) {
    bud->axis = fr_grown_add_axis(plant, bud->node, bud->row, bud->key);
    plant->axes[bud->axis].birth = (uint16_t)MIN(step, UINT16_MAX);
    bud->state = FR_LIVE_GROWING;
    bud->is_relay = 0;
    bud->age = 0;
}

void fr_growth_wake(const FrGrowth *growth, FrGrownPlant *plant) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    for (uint32_t i = 0; i < plant->bud_count; i++) {
        FrLiveBud *bud = &plant->buds[i];
        bud->age = (uint16_t)MIN(bud->age + 1u, UINT16_MAX);
        if (bud->state != FR_LIVE_ASLEEP || params->fate == FR_FATE_FLUX ||
            params->fate == FR_FATE_PRIORITY) {
            continue;
        }
        if (bud->age > params->patience) {
            bud->state = FR_LIVE_DONE;
        } else if (bud->age >= params->dormancy && (double)bud->light >= params->wake_light &&
                   is_free(params, &plant->axes[bud->axis], bud)) {
            fr_growth_wake_bud(plant, bud, growth->step);
        }
    }
}
