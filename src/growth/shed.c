// Branches that fall: those whose buds are mostly dark (Beneš, Andrysco, Šťava 2009, section 3.6:
// 80 % of the buds in less than 20 % light), those that bring less vigour than they cost (Palubicki
// et al. 2009), and those that have long been dead. Their cells become free, their place remembers
// their wood.
#include "growth/engine.h"

#include <math.h>
#include <string.h>

/// Of each internode: what stands on it and beyond.
typedef struct Crown {
    uint32_t buds, dark; ///< live ones, and those in too little light
    uint32_t internodes;
    uint32_t youngest; ///< step of the last birth
} Crown;

static void count_crowns(const FrGrownPlant *plant, const FrSpeciesParams *params, Crown *crowns) {
    const FrGrownNodes *nodes = &plant->nodes;
    memset(crowns, 0, nodes->count * sizeof *crowns);
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->node != FR_NONE && bud->state != FR_LIVE_DONE) {
            crowns[bud->node].buds++;
            crowns[bud->node].dark += (double)bud->light < params->shed_light;
        }
    }
    for (uint32_t i = nodes->count; i-- > 0;) {
        Crown *own = &crowns[i];
        own->internodes++;
        own->youngest = MAX(own->youngest, nodes->birth[i]);
        if (nodes->parent[i] != FR_NONE) {
            Crown *bearer = &crowns[nodes->parent[i]];
            bearer->buds += own->buds;
            bearer->dark += own->dark;
            bearer->internodes += own->internodes;
            bearer->youngest = MAX(bearer->youngest, own->youngest);
        }
    }
}

static bool falls(const FrGrowth *growth, const FrSpeciesParams *params, const FrGrownAxis *axis,
                  const Crown *crown) {
    if (axis->bearer == FR_NONE || growth->step < axis->birth + (uint64_t)params->shed_age) {
        return false;
    }
    bool by_light = params->shed == FR_SHED_LIGHT || params->shed == FR_SHED_BOTH;
    if (by_light && crown->buds > 0 &&
        (double)crown->dark >= params->shed_share * (double)crown->buds) {
        return true;
    }
    return params->shed != FR_SHED_NONE && params->shed_dead > 0 && crown->buds == 0 &&
           growth->step >= crown->youngest + (uint64_t)params->shed_dead;
}

/// Marks what falls; returns how many internodes.
static uint32_t mark(const FrGrowth *growth, const FrGrownPlant *plant, const Crown *crowns,
                     uint8_t *has_fallen) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    const FrGrownNodes *nodes = &plant->nodes;
    uint32_t count = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        const FrGrownAxis *axis = &plant->axes[nodes->axis[i]];
        has_fallen[i] = (parent != FR_NONE && has_fallen[parent]) ||
                        (axis->first == i && falls(growth, params, axis, &crowns[i]));
        count += has_fallen[i];
    }
    return count;
}

void fr_growth_free_cells(const FrGrowth *growth, const FrGrownPlant *plant,
                          const uint8_t *is_freed) {
    const FrGrownNodes *nodes = &plant->nodes;
    FrCell cells[FR_WALK_CELLS];
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t owner = plant->axes[nodes->axis[i]].owner;
        if (!is_freed[i] || owner == FR_NONE) {
            continue;
        }
        uint32_t count = fr_growth_walk(growth, plant, nodes->parent[i], nodes->at[i], cells);
        for (uint32_t k = 0; k < count; k++) {
            FrBrick *brick = fr_voxels_brick(growth->voxels, cells[k]);
            if (brick != NULL && brick->owners != NULL && *fr_voxels_at(brick, cells[k]) == owner) {
                *fr_voxels_at(brick, cells[k]) = FR_VOXEL_FREE;
                unsigned layer = (unsigned)cells[k].at[2] & 7;
                uint64_t bit = UINT64_C(1) << fr_voxels_bit(cells[k]);
                if ((brick->solid[layer] & bit) == 0) {
                    __atomic_fetch_and(&brick->taken[layer], ~bit, __ATOMIC_RELAXED);
                }
            }
        }
    }
}

/// What bore a fallen branch keeps as many pipes as it had: those of the branch beside all others,
/// or the number of all, which later ones fill up first.
static void remember_wood(FrGrownPlant *plant, const FrSpeciesParams *params,
                          const uint8_t *has_fallen, double *pipes) {
    FrGrownNodes *nodes = &plant->nodes;
    fr_growth_pipes(plant, params, pipes);
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        if (params->fallen_wood == FR_WOOD_REUSED) {
            nodes->wood[i] = fmaxf(nodes->wood[i], (float)pipes[i]);
        } else if (has_fallen[i] && parent != FR_NONE && !has_fallen[parent]) {
            nodes->wood[parent] += (float)pipes[i];
        }
    }
}

static void compact_nodes(FrGrownPlant *plant, const uint8_t *has_fallen, const uint32_t *axis_of,
                          uint32_t *node_of) {
    FrGrownNodes *nodes = &plant->nodes;
    uint32_t left = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        node_of[i] = has_fallen[i] ? FR_NONE : left;
        if (has_fallen[i]) {
            continue;
        }
        uint32_t parent = nodes->parent[i];
        nodes->parent[left] = parent == FR_NONE ? FR_NONE : node_of[parent];
        nodes->axis[left] = axis_of[nodes->axis[i]];
        nodes->at[left] = nodes->at[i];
        nodes->birth[left] = nodes->birth[i];
        nodes->light[left] = nodes->light[i];
        nodes->wood[left] = nodes->wood[i];
        left++;
    }
    nodes->count = left;
}

/// Where only the outer part of an axis falls, it ends further down.
static void shorten_axes(FrGrownPlant *plant, const uint8_t *has_fallen) {
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        FrGrownAxis *axis = &plant->axes[a];
        if (axis->first == FR_NONE || has_fallen[axis->first]) {
            continue;
        }
        while (has_fallen[axis->last]) {
            axis->last = plant->nodes.parent[axis->last];
            axis->internodes--;
        }
    }
}

/// An axis goes with its first internode, or with its bearer before it has any.
static void number_axes(const FrGrownPlant *plant, const uint8_t *has_fallen, uint32_t *axis_of) {
    uint32_t left = 0;
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        const FrGrownAxis *axis = &plant->axes[a];
        uint32_t node = axis->first != FR_NONE ? axis->first : axis->bearer;
        axis_of[a] = node != FR_NONE && has_fallen[node] ? FR_NONE : left++;
    }
}

static void compact_axes(FrGrowth *growth, FrGrownPlant *plant, const uint32_t *axis_of,
                         const uint32_t *node_of) {
    uint32_t left = 0;
    for (uint32_t a = 0; a < plant->axis_count; a++) {
        FrGrownAxis axis = plant->axes[a];
        if (axis_of[a] == FR_NONE) {
            if (axis.owner != FR_NONE) {
                growth->owners[axis.owner] = (FrOwner){FR_NONE, FR_NONE, FR_NONE, FR_NONE, 0};
            }
            continue;
        }
        axis.bearer = axis.bearer == FR_NONE ? FR_NONE : node_of[axis.bearer];
        axis.first = axis.first == FR_NONE ? FR_NONE : node_of[axis.first];
        axis.last = axis.last == FR_NONE ? FR_NONE : node_of[axis.last];
        if (axis.owner != FR_NONE) {
            growth->owners[axis.owner].axis = left;
            growth->owners[axis.owner].bearer = axis.bearer;
        }
        memcpy(&plant->axes[left++], &axis, sizeof axis);
    }
    plant->axis_count = left;
}

/// Buds go with what they sit on; an axis whose apex goes has ended.
static void compact_buds(FrGrownPlant *plant, const uint8_t *has_fallen) {
    uint32_t left = 0;
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        const FrLiveBud *bud = &plant->buds[b];
        if (bud->node != FR_NONE && has_fallen[bud->node]) {
            if (bud->state == FR_LIVE_GROWING) {
                plant->axes[bud->axis].is_growing = false;
            }
            continue;
        }
        if (b != left) {
            memcpy(&plant->buds[left], bud, sizeof *bud);
        }
        left++;
    }
    plant->bud_count = left;
}

static void renumber_buds(FrGrownPlant *plant, const uint32_t *axis_of, const uint32_t *node_of) {
    for (uint32_t b = 0; b < plant->bud_count; b++) {
        FrLiveBud *bud = &plant->buds[b];
        bud->node = bud->node == FR_NONE ? FR_NONE : node_of[bud->node];
        bud->axis = axis_of[bud->axis];
    }
}

void fr_growth_drop(FrGrowth *growth, FrGrownPlant *plant, const uint8_t *has_fallen, int worker) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    uint32_t nodes = plant->nodes.count;
    size_t numbers = (size_t)(nodes + plant->axis_count) * sizeof(uint32_t);
    double *pipes =
        fr_scratch_take(&growth->drop_scratch[worker], nodes * sizeof(double) + numbers);
    uint32_t *node_of = (uint32_t *)(void *)(pipes + nodes), *axis_of = node_of + nodes;
    for (uint32_t i = 0; i < nodes; i++) {
        plant->shed += has_fallen[i];
        if (has_fallen[i] && growth->shadows != NULL) {
            vec3s at = fr_grown_base(plant, i);
            g_array_append_val(growth->fallen[worker], at);
        }
    }
    fr_growth_free_cells(growth, plant, has_fallen);
    remember_wood(plant, params, has_fallen, pipes);
    number_axes(plant, has_fallen, axis_of);
    shorten_axes(plant, has_fallen);
    compact_buds(plant, has_fallen);
    compact_nodes(plant, has_fallen, axis_of, node_of);
    compact_axes(growth, plant, axis_of, node_of);
    renumber_buds(plant, axis_of, node_of);
}

void fr_growth_shed(FrGrowth *growth, FrGrownPlant *plant, int worker) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    uint32_t nodes = plant->nodes.count;
    if (params->shed == FR_SHED_NONE || params->fate == FR_FATE_COLONIZE || nodes == 0) {
        return;
    }
    Crown *crowns =
        fr_scratch_take(&growth->scratch[worker], nodes * (sizeof(Crown) + sizeof(uint8_t)));
    uint8_t *has_fallen = (uint8_t *)(crowns + nodes);
    count_crowns(plant, params, crowns);
    if (mark(growth, plant, crowns, has_fallen) > 0) {
        fr_growth_drop(growth, plant, has_fallen, worker);
    }
}
