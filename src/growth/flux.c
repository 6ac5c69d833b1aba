// Vigour shared out at forks: the extended Borchert-Honda model (Borchert, Honda 1984; Palubicki,
// Horel, Longay, Runions, Lane, Měch, Prusinkiewicz 2009, section 5). Light flows from the buds to
// the base, where it becomes vigour; at each fork vigour goes to the axis and to its branches in
// proportion to their light, the axis with weight λ (`favour`), branches with 1 − λ.
//
// A bud with vigour v makes ⌊v⌋ internodes, v / ⌊v⌋ steps long each.
#include "growth/vigour.h"

#include <math.h>

double fr_vigour_favour(const FrSpeciesParams *params, uint64_t age) {
    double since = (double)age - (double)params->favour_from;
    double part = CLAMP(since / (double)params->favour_over, 0, 1);
    return params->favour + part * (params->favour_old - params->favour);
}

static void gather(const FrGrownPlant *plant, FrFlow *flow) {
    const FrGrownNodes *nodes = &plant->nodes;
    memset(flow, 0, nodes->count * sizeof *flow);
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->node == FR_NONE || bud->state == FR_LIVE_DONE) {
            continue;
        }
        FrFlow *at = &flow[bud->node];
        bool goes_on = nodes->axis[bud->node] == bud->axis && bud->state == FR_LIVE_GROWING;
        *(goes_on ? &at->main : &at->lateral) += (double)bud->light;
        at->count++;
    }
    for (uint32_t i = nodes->count; i-- > 0;) {
        uint32_t parent = nodes->parent[i];
        flow[i].count++;
        if (parent != FR_NONE) {
            bool goes_on = nodes->axis[parent] == nodes->axis[i];
            *(goes_on ? &flow[parent].main : &flow[parent].lateral) +=
                flow[i].main + flow[i].lateral;
            flow[parent].count += flow[i].count;
        }
    }
}

/// What comes to one that stands on a node and brings so much light.
static double share_of(const FrFlow *at, double favour, double light, bool goes_on) {
    double weight = goes_on ? favour : 1 - favour;
    double all = favour * at->main + (1 - favour) * at->lateral;
    return all > 0 ? at->vigour * weight * light / all : 0;
}

void fr_growth_flux(const FrGrowth *growth, FrGrownPlant *plant, FrFlow *flow) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    const FrGrownNodes *nodes = &plant->nodes;
    double favour = fr_vigour_favour(params, growth->step);
    gather(plant, flow);
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        double light = flow[i].main + flow[i].lateral;
        if (parent == FR_NONE) {
            flow[i].vigour = params->vigour_base + params->vigour * light;
        } else {
            bool goes_on = nodes->axis[parent] == nodes->axis[i];
            flow[i].vigour = share_of(&flow[parent], favour, light, goes_on);
        }
        if (plant->axes[nodes->axis[i]].first == i) {
            plant->axes[nodes->axis[i]].vigour = (float)flow[i].vigour;
        }
    }
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        FrLiveBud *bud = &plant->buds[b];
        double light = (double)bud->light;
        if (bud->node == FR_NONE) {
            bud->vigour = (float)(params->vigour_base + params->vigour * light);
        } else {
            bool goes_on = bud->state == FR_LIVE_GROWING;
            bud->vigour = (float)share_of(&flow[bud->node], favour, light, goes_on);
        }
    }
}
