// Plants that die as a whole. The pipe model (Shinozaki, Yoda, Hozumi, Kira 1964) runs a strand of
// living wood from every live bud to the ground; what the buds gather must pay for the strands. In
// a dense stand those that are overtopped cannot, and it thins itself (Yoda, Kira, Ogawa, Hozumi
// 1963).
#include "growth/engine.h"

#include <cglm/struct.h>
#include <string.h>

/// Light that the buds gather less what their strands take.
static double balance_of(const FrGrownPlant *plant, const FrSpeciesParams *params, float *way) {
    const FrGrownNodes *nodes = &plant->nodes;
    for (uint32_t i = 0; i < nodes->count; i++) { // along the wood to the ground
        uint32_t parent = nodes->parent[i];
        vec3s from = parent == FR_NONE ? (vec3s){{0, 0, 0}} : nodes->at[parent];
        way[i] = (parent == FR_NONE ? 0 : way[parent]) + glms_vec3_distance(from, nodes->at[i]);
    }
    double balance = 0;
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->state != FR_LIVE_DONE) {
            double strand = bud->node == FR_NONE ? 0 : (double)way[bud->node];
            balance += (double)bud->light - params->upkeep - params->wood_upkeep * strand;
        }
    }
    return balance;
}

static void die(FrGrowth *growth, FrGrownPlant *plant, int worker) {
    plant->is_dead = 1;
    plant->bud_count = 0;
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        plant->axes[a].is_growing = false;
    }
    if (fr_species_of(growth, plant)->params.dead == FR_DEAD_FALLS) {
        uint8_t *has_fallen = fr_scratch_take(&growth->scratch[worker], plant->nodes.count);
        memset(has_fallen, 1, plant->nodes.count);
        fr_growth_drop(growth, plant, has_fallen, worker);
    }
}

bool fr_growth_starve(FrGrowth *growth, FrGrownPlant *plant, int worker) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    uint32_t nodes = plant->nodes.count;
    bool may_starve = params->upkeep > 0 || params->wood_upkeep > 0;
    if (!may_starve || params->fate == FR_FATE_COLONIZE || plant->is_dead || nodes == 0) {
        return false;
    }
    float *way = fr_scratch_take(&growth->scratch[worker], nodes * sizeof *way);
    bool is_starving = balance_of(plant, params, way) < 0;
    plant->starving = is_starving ? (uint16_t)MIN(plant->starving + 1u, UINT16_MAX) : 0;
    if (plant->starving < params->endurance) {
        return false;
    }
    die(growth, plant, worker);
    return true;
}
