// Collision after Beneš, Andrysco, Šťava 2009, section 3.6: first a box of cells around the new
// tip, then the cells of the segment (Amanatides, Woo 1987). Bits of whole layers are compared at
// once; only where one is set is asked whose it is.
#include "growth/propose.h"

#include <math.h>

static void world_of(const FrGrownPlant *plant, vec3s at, double world[3]) {
    for (int axis = 0; axis < 3; axis++) {
        world[axis] = plant->seed.at[axis] + (double)at.raw[axis];
    }
}

uint32_t fr_growth_walk(const FrGrowth *growth, const FrGrownPlant *plant, uint32_t parent,
                        vec3s to, FrCell *cells) {
    double begin[3], end[3];
    world_of(plant, parent == FR_NONE ? (vec3s){{0, 0, 0}} : plant->nodes.at[parent], begin);
    world_of(plant, to, end);
    double crossed = 3;
    for (int axis = 0; axis < 3; axis++) {
        crossed += fabs(end[axis] - begin[axis]) / growth->voxels->cell;
    }
    if (crossed >= FR_WALK_CELLS) {
        return 0; // longer than what takes part in collision may become
    }
    return fr_voxels_walk(growth->voxels, begin, end, cells);
}

/// True if a bud may come near what an axis of this number owns: its own axis, the one it branches
/// off, and those that branch off with it.
static bool is_related(const FrGrowth *growth, const FrProposal *proposal, uint32_t owner) {
    if (owner >= FR_VOXEL_GROUND) {
        return owner == FR_VOXEL_GROUND && proposal->node == FR_NONE;
    }
    if (owner == proposal->own || owner == proposal->branched_off) {
        return true;
    }
    FrOwner of = growth->owners[owner];
    return of.plant == proposal->plant && of.bearer == proposal->node;
}

/// True if another bud's claim comes before and is not that of one at the same node.
static bool comes_before(const FrGrowth *growth, const FrProposal *proposal, uint32_t claim) {
    if (claim >= proposal->rank) {
        return false;
    }
    const FrProposal *other = &growth->proposals[growth->by_rank[claim]];
    return other->plant != proposal->plant || other->node != proposal->node;
}

/// A cell whose bit is set: true if it is in the bud's way.
static bool cell_blocks(const FrGrowth *growth, const FrProposal *proposal, const FrBrick *brick,
                        unsigned layer, unsigned bit, bool by_claims) {
    unsigned slot = fr_voxels_slot(layer, bit);
    if (by_claims) {
        return comes_before(growth, proposal, brick->voxels[slot].claim);
    }
    uint32_t owner = brick->solid[layer] >> bit & 1
                         ? (brick->ground[layer] >> bit & 1 ? FR_VOXEL_GROUND : FR_VOXEL_SOLID)
                         : brick->voxels[slot].owner;
    return !is_related(growth, proposal, owner);
}

/// Cells low … high of one brick, numbered within it.
static bool part_blocks(const FrGrowth *growth, const FrProposal *proposal, const FrBrick *brick,
                        const unsigned low[3], const unsigned high[3], bool by_claims) {
    uint64_t row = (UINT64_C(2) << high[0]) - (UINT64_C(1) << low[0]);
    uint64_t rows = (row * UINT64_C(0x0101010101010101)) >> (8 * (7 - (high[1] - low[1])))
                                                                << (8 * low[1]);
    const uint64_t *bits = by_claims ? brick->asked : brick->taken;
    for (unsigned layer = low[2]; layer <= high[2]; layer++) {
        for (uint64_t left = bits[layer] & rows; left != 0; left &= left - 1) {
            unsigned bit = (unsigned)__builtin_ctzll(left);
            if (cell_blocks(growth, proposal, brick, layer, bit, by_claims)) {
                return true;
            }
        }
    }
    return false;
}

/// The box around the tip: true if something stands in it.
static bool box_blocks(const FrGrowth *growth, const FrProposal *proposal, FrCell tip,
                       bool by_claims) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    int half = (int)fr_species_of(growth, plant)->params.box / 2;
    int low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = MAX(tip.at[axis] - half, 0);
        high[axis] = MIN(tip.at[axis] + half, FR_VOXELS_WIDTH - 1);
    }
    int brick[3];
    for (brick[2] = low[2] >> 3; brick[2] <= high[2] >> 3; brick[2]++) {
        for (brick[1] = low[1] >> 3; brick[1] <= high[1] >> 3; brick[1]++) {
            for (brick[0] = low[0] >> 3; brick[0] <= high[0] >> 3; brick[0]++) {
                FrCell cell;
                unsigned from[3], to[3];
                for (int axis = 0; axis < 3; axis++) {
                    int begin = brick[axis] * FR_BRICK_WIDTH;
                    cell.at[axis] = (int16_t)begin;
                    from[axis] = (unsigned)(MAX(low[axis], begin) - begin);
                    to[axis] = (unsigned)(MIN(high[axis], begin + FR_BRICK_WIDTH - 1) - begin);
                }
                const FrBrick *at = fr_voxels_brick(growth->voxels, cell);
                if (at != NULL && part_blocks(growth, proposal, at, from, to, by_claims)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// The cells of the segment, without the first, in which its bearer stands.
static bool segment_blocks(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells,
                           bool by_claims) {
    for (uint32_t i = 1; i < proposal->cell_count; i++) {
        const FrBrick *brick = fr_voxels_brick(growth->voxels, cells[i]);
        unsigned layer = (unsigned)cells[i].at[2] & 7, bit = fr_voxels_bit(cells[i]);
        if (brick != NULL && ((by_claims ? brick->asked : brick->taken)[layer] >> bit & 1) != 0 &&
            cell_blocks(growth, proposal, brick, layer, bit, by_claims)) {
            return true;
        }
    }
    return false;
}

bool fr_growth_is_free(const FrGrowth *growth, FrProposal *proposal, FrCell *cells) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    double end[3];
    FrCell tip;
    world_of(plant, proposal->at, end);
    if (!fr_voxels_cell(growth->voxels, end, &tip) || box_blocks(growth, proposal, tip, false)) {
        return false;
    }
    proposal->cell_count =
        fr_growth_walk(growth, plant, plant->buds[proposal->bud].node, proposal->at, cells);
    return proposal->cell_count > 0 && !segment_blocks(growth, proposal, cells, false);
}

bool fr_growth_is_first(const FrGrowth *growth, const FrProposal *proposal, const FrCell *cells) {
    return !box_blocks(growth, proposal, cells[proposal->cell_count - 1], true) &&
           !segment_blocks(growth, proposal, cells, true);
}
