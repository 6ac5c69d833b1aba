// Collision after Beneš, Andrysco, Šťava 2009, section 3.6: first a box of cells around the new
// tip, then the cells of the segment (Amanatides, Woo 1987). Bits of whole layers are compared at
// once; only where one is set is asked whose it is.
//
// The same cells are looked at for two questions: what stands there, and whose claim comes first.
#include "growth/propose.h"

#include <math.h>
#include <stdlib.h>

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
    double apart = 0;
    for (int axis = 0; axis < 3; axis++) {
        apart += fabs(end[axis] - begin[axis]);
    }
    if (apart / growth->voxels->cell + 3 >= FR_WALK_CELLS) {
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

/// True for a cell of what a plant stands on, which its first internode rises from.
static bool is_footing(const FrGrowth *growth, const FrProposal *proposal, FrCell cell) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    int reach = params->keeps_off == FR_KEEPS_OFF_INTERNODE ? 1 + (int)params->box / 2 : 1;
    FrCell foot;
    if (proposal->node != FR_NONE || !fr_voxels_cell(growth->voxels, plant->seed.at, &foot) ||
        fr_voxels_owner(growth->voxels, foot) != FR_VOXEL_SOLID) {
        return false;
    }
    bool is_near = true;
    for (int axis = 0; axis < 3; axis++) {
        is_near &= abs(cell.at[axis] - foot.at[axis]) <= reach;
    }
    return is_near;
}

typedef enum Question { IS_STANDING, IS_CLAIMED } Question;

/// A proposal and the question that is asked for it.
typedef struct Asked {
    const FrGrowth *growth;
    const FrProposal *proposal;
    const FrCellPlace *places; ///< of its segment
    Question question;
} Asked;

/// True if the first of who ask for a cell is before the bud, and is not one at the same node.
static bool comes_before(const FrGrowth *growth, const FrProposal *proposal, uint32_t first) {
    if (first == proposal->own) {
        return false;
    }
    FrOwner of = growth->owners[first];
    bool is_sibling = of.plant == proposal->plant && of.node == proposal->node;
    return !is_sibling && fr_claim_is_before(growth, first, proposal->own);
}

/// True for a cell of the segment itself, which box and segment need not both look at.
static bool is_own_cell(const Asked *asked, const FrCellPlace *place) {
    for (uint32_t k = asked->proposal->cell_count; k-- > 1;) {
        const FrCellPlace *own = &asked->places[k];
        if (own->brick == place->brick && own->layer == place->layer && own->bit == place->bit) {
            return true;
        }
    }
    return false;
}

static const uint64_t *bits_of(const FrBrick *brick, Question question) {
    return question == IS_STANDING ? brick->taken : brick->asked;
}

static bool has_bit(const Asked *asked, const FrCellPlace *place) {
    return place->brick != NULL &&
           (bits_of(place->brick, asked->question)[place->layer] >> place->bit & 1) != 0;
}

/// A cell whose bit is set: true if it is in the bud's way.
static inline bool cell_blocks(const Asked *asked, const FrCellPlace *place) {
    const FrBrick *brick = place->brick;
    unsigned layer = place->layer, bit = place->bit;
    unsigned slot = fr_voxels_slot(layer, bit); // a brick of nothing but obstacles has no owners
    if (asked->question == IS_CLAIMED) {
        bool is_contested = (brick->contested >> fr_voxels_cube(layer, bit) & 1) != 0;
        return (is_contested || !is_own_cell(asked, place)) &&
               comes_before(asked->growth, asked->proposal, brick->owners[slot]);
    }
    uint32_t whose = brick->solid[layer] >> bit & 1
                         ? (brick->ground[layer] >> bit & 1 ? FR_VOXEL_GROUND : FR_VOXEL_SOLID)
                         : brick->owners[slot];
    return !is_related(asked->growth, asked->proposal, whose) &&
           !(whose == FR_VOXEL_SOLID && is_footing(asked->growth, asked->proposal, place->cell));
}

/// Cells low … high of the brick that begins at `first`, numbered within it.
static inline bool part_blocks(const Asked *asked, FrBrick *brick, FrCell first,
                               const unsigned low[3], const unsigned high[3]) {
    uint64_t row = (UINT64_C(2) << high[0]) - (UINT64_C(1) << low[0]);
    uint64_t rows = (row * UINT64_C(0x0101010101010101)) >> (8 * (7 - (high[1] - low[1])))
                                                                << (8 * low[1]);
    const uint64_t *bits = bits_of(brick, asked->question);
    for (unsigned layer = low[2]; layer <= high[2]; layer++) {
        for (uint64_t left = bits[layer] & rows; left != 0; left &= left - 1) {
            int bit = __builtin_ctzll(left);
            FrCellPlace place = {
                .brick = brick,
                .cell = {{(int16_t)(first.at[0] + (bit & 7)), (int16_t)(first.at[1] + (bit >> 3)),
                          (int16_t)(first.at[2] + (int)layer)}},
                .layer = (uint8_t)layer,
                .bit = (uint8_t)bit};
            if (cell_blocks(asked, &place)) {
                return true;
            }
        }
    }
    return false;
}

static const FrSpeciesParams *params_of(const Asked *asked) {
    const FrGrowth *growth = asked->growth;
    return &fr_species_of(growth, &growth->plants[asked->proposal->plant])->params;
}

/// Cells up to `half` around one.
static bool wide_box_blocks(const Asked *asked, FrCell cell, int half) {
    const FrGrowth *growth = asked->growth;
    int low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = MAX(cell.at[axis] - half, 0);
        high[axis] = MIN(cell.at[axis] + half, FR_VOXELS_WIDTH - 1);
    }
    int brick[3];
    for (brick[2] = low[2] >> 3; brick[2] <= high[2] >> 3; brick[2]++) {
        for (brick[1] = low[1] >> 3; brick[1] <= high[1] >> 3; brick[1]++) {
            for (brick[0] = low[0] >> 3; brick[0] <= high[0] >> 3; brick[0]++) {
                FrCell first;
                unsigned from[3], to[3];
                for (int axis = 0; axis < 3; axis++) {
                    int begin = brick[axis] * FR_BRICK_WIDTH;
                    first.at[axis] = (int16_t)begin;
                    from[axis] = (unsigned)(MAX(low[axis], begin) - begin);
                    to[axis] = (unsigned)(MIN(high[axis], begin + FR_BRICK_WIDTH - 1) - begin);
                }
                FrBrick *at = fr_voxels_brick(growth->voxels, first);
                if (at != NULL && part_blocks(asked, at, first, from, to)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// The box around a cell: true if something is in the way in it.
static inline bool box_blocks(const Asked *asked, const FrCellPlace *middle) {
    int half = (int)params_of(asked)->box / 2;
    return half > 0 ? wide_box_blocks(asked, middle->cell, half)
                    : has_bit(asked, middle) && cell_blocks(asked, middle);
}

/// The cells of the segment, without the first, in which its bearer stands.
static inline bool segment_blocks(const Asked *asked) {
    bool has_boxes = params_of(asked)->keeps_off == FR_KEEPS_OFF_INTERNODE;
    for (uint32_t i = 1; i < asked->proposal->cell_count; i++) {
        const FrCellPlace *place = &asked->places[i];
        if ((has_bit(asked, place) && cell_blocks(asked, place)) ||
            (has_boxes && box_blocks(asked, place))) {
            return true;
        }
    }
    return false;
}

bool fr_growth_tip(const FrGrowth *growth, const FrProposal *proposal, FrCell *tip) {
    double end[3];
    world_of(&growth->plants[proposal->plant], proposal->at, end);
    return fr_voxels_cell(growth->voxels, end, tip);
}

bool fr_growth_is_free(const FrGrowth *growth, FrProposal *proposal, FrCellPlace *places) {
    const FrGrownPlant *plant = &growth->plants[proposal->plant];
    const Asked asked = {growth, proposal, places, IS_STANDING};
    FrCell tip, cells[FR_WALK_CELLS];
    if (!fr_growth_tip(growth, proposal, &tip)) {
        return false;
    }
    FrCellPlace end;
    fr_path_find(growth->voxels, &tip, 1, &end);
    if (box_blocks(&asked, &end)) {
        return false;
    }
    proposal->cell_count =
        fr_growth_walk(growth, plant, plant->buds[proposal->bud].node, proposal->at, cells);
    fr_path_find(growth->voxels, cells, proposal->cell_count, places);
    return proposal->cell_count > 0 && !segment_blocks(&asked);
}

bool fr_growth_is_first(const FrGrowth *growth, const FrProposal *proposal,
                        const FrCellPlace *places) {
    const Asked asked = {growth, proposal, places, IS_CLAIMED};
    return !box_blocks(&asked, &places[proposal->cell_count - 1]) && !segment_blocks(&asked);
}
