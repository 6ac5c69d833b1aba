// Auxin by chance (Stava, Pirk, Kratt, Chen, Měch, Deussen, Beneš 2014, Inverse Procedural
// Modelling of Trees): each growing apex makes auxin, of which a part is left after each internode
// on its way down; a bud wakes with probability light · exp(−auxin that reaches it).
#include "growth/engine.h"

#include <math.h>
#include <string.h>

double *fr_growth_auxin(const FrGrownPlant *plant, const FrSpeciesParams *params,
                        FrScratch *scratch) {
    const FrGrownNodes *nodes = &plant->nodes;
    double *auxin = fr_scratch_take(scratch, (nodes->count + 1) * sizeof *auxin);
    memset(auxin, 0, (nodes->count + 1) * sizeof *auxin);
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->state == FR_LIVE_GROWING && bud->node != FR_NONE) {
            auxin[bud->node] += params->auxin;
        }
    }
    for (uint32_t i = nodes->count; i-- > 0;) {
        if (nodes->parent[i] != FR_NONE) {
            auxin[nodes->parent[i]] += auxin[i] * params->auxin_left;
        }
    }
    return auxin;
}
