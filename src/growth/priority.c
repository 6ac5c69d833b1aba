// Vigour shared out by rank: the priority model of Palubicki et al. 2009, section 5. All that
// stands on an axis, its apex and its branches and buds, is ranked by mean light; what is first has
// weight `rank_first`, which falls to `rank_last` over the first `rank_part` of the ranks.
#include "growth/vigour.h"

#include <math.h>

/// Something that takes vigour from an axis.
typedef struct Taker {
    double light, mean; ///< in all, and for each internode and bud
    FrKey key;          ///< tells equals apart
    uint32_t axis;      ///< that it takes from
    uint32_t what;      ///< index of a branch's first internode, or of a bud
    bool is_bud;
} Taker;

static int compare(const void *a, const void *b) {
    const Taker *one = a, *other = b;
    if (one->axis != other->axis) {
        return one->axis < other->axis ? -1 : 1;
    }
    if (one->mean != other->mean) {
        return one->mean > other->mean ? -1 : 1;
    }
    return one->key < other->key ? -1 : one->key > other->key;
}

/// Light of everything, to the base.
static void gather(const FrGrownPlant *plant, FrFlow *flow) {
    const FrGrownNodes *nodes = &plant->nodes;
    memset(flow, 0, nodes->count * sizeof *flow);
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->node != FR_NONE && bud->state != FR_LIVE_DONE) {
            flow[bud->node].main += (double)bud->light;
            flow[bud->node].count++;
        }
    }
    for (uint32_t i = nodes->count; i-- > 0;) {
        flow[i].count++;
        if (nodes->parent[i] != FR_NONE) {
            flow[nodes->parent[i]].main += flow[i].main;
            flow[nodes->parent[i]].count += flow[i].count;
        }
    }
}

static uint32_t list_takers(const FrGrownPlant *plant, const FrFlow *flow, Taker *takers) {
    uint32_t count = 0;
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        const FrGrownAxis *axis = &plant->axes[a];
        if (axis->first != FR_NONE && axis->bearer != FR_NONE) {
            const FrFlow *own = &flow[axis->first];
            takers[count++] = (Taker){.light = own->main,
                                      .mean = own->main / own->count,
                                      .key = axis->key,
                                      .axis = plant->nodes.axis[axis->bearer],
                                      .what = axis->first};
        }
    }
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->node != FR_NONE && bud->state != FR_LIVE_DONE) {
            takers[count++] = (Taker){.light = (double)bud->light,
                                      .mean = (double)bud->light,
                                      .key = bud->key,
                                      .axis = plant->nodes.axis[bud->node],
                                      .what = b,
                                      .is_bud = true};
        }
    }
    qsort(takers, count, sizeof *takers, compare);
    return count;
}

static double weight_of(const FrSpeciesParams *params, uint32_t rank, uint32_t count) {
    double falling = params->rank_part * (count - 1);
    double part = falling > 0 ? MIN(rank / falling, 1) : (rank > 0);
    return params->rank_first + part * (params->rank_last - params->rank_first);
}

/// Shares the vigour of one axis out to its takers.
static void share_out(FrGrownPlant *plant, const FrSpeciesParams *params, FrFlow *flow,
                      const Taker *takers, uint32_t count) {
    const FrGrownAxis *from = &plant->axes[takers[0].axis];
    double vigour = flow[from->first].vigour, all = 0;
    for (uint32_t i = 0; i < count; i++) {
        all += takers[i].light * weight_of(params, i, count);
    }
    for (uint32_t i = 0; i < count; i++) {
        const Taker *taker = &takers[i];
        double weight = taker->light * weight_of(params, i, count);
        double share = all > 0 ? vigour * weight / all : 0;
        if (taker->is_bud) {
            plant->buds[taker->what].vigour = (float)share;
        } else {
            flow[taker->what].vigour = share;
            plant->axes[plant->nodes.axis[taker->what]].vigour = (float)share;
        }
    }
}

void fr_growth_priority(const FrGrowth *growth, FrGrownPlant *plant, FrFlow *flow,
                        FrScratch *scratch) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    const FrGrownNodes *nodes = &plant->nodes;
    gather(plant, flow);
    size_t most = (size_t)plant->axis_count + plant->bud_count;
    Taker *takers = fr_scratch_take(scratch, most * sizeof *takers + 1);
    uint32_t count = list_takers(plant, flow, takers);
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        double light = (double)plant->buds[b].light;
        plant->buds[b].vigour = (float)(params->vigour_base + params->vigour * light);
    }
    if (nodes->count > 0) {
        flow[0].vigour = params->vigour_base + params->vigour * flow[0].main;
        plant->axes[nodes->axis[0]].vigour = (float)flow[0].vigour;
    }
    // Axes come after those that bear them, so each has its vigour when its turn comes.
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        for (end = begin; end < count && takers[end].axis == takers[begin].axis;) {
            end++;
        }
        share_out(plant, params, flow, takers + begin, end - begin);
    }
    for (uint32_t i = 0; i < nodes->count; i++) {
        if (plant->axes[nodes->axis[i]].first != i && nodes->parent[i] != FR_NONE) {
            flow[i].vigour = flow[nodes->parent[i]].vigour;
        }
    }
}
