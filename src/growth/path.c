// The cells of a proposal's segment. Each lies beside the one before, so besides the first only the
// axis of every step is kept: a few bytes, where cells themselves would be a quarter of all that a
// step reads and writes. Their bricks are looked up again, but only where the segment enters one.
#include "growth/propose.h"

#include <string.h>

enum { STEPS_A_BYTE = 4 };

static uint8_t *steps_of(const FrGrowth *growth, const FrProposal *proposal) {
    return growth->steps + (size_t)(proposal - growth->proposals) * growth->step_stride;
}

uint32_t fr_path_stride(uint32_t cells) {
    return (cells + STEPS_A_BYTE - 1) / STEPS_A_BYTE;
}

/// A cell beside, or in, the brick of the one before.
static inline FrCellPlace place_of(const FrVoxels *voxels, FrCell cell, FrCell before,
                                   FrBrick *last) {
    const int16_t *a = cell.at, *b = before.at;
    bool is_same = (((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) & ~(FR_BRICK_WIDTH - 1)) == 0;
    return (FrCellPlace){.brick = is_same && last != NULL ? last : fr_voxels_brick(voxels, cell),
                         .cell = cell,
                         .layer = (uint8_t)(cell.at[2] & (FR_BRICK_WIDTH - 1)),
                         .bit = (uint8_t)fr_voxels_bit(cell)};
}

void fr_path_find(const FrVoxels *voxels, const FrCell *cells, uint32_t count,
                  FrCellPlace *places) {
    FrBrick *last = NULL;
    for (uint32_t k = 0; k < count; k++) {
        places[k] = place_of(voxels, cells[k], cells[k > 0 ? k - 1 : 0], last);
        last = places[k].brick;
    }
}

void fr_path_keep(const FrGrowth *growth, FrProposal *proposal, const FrCellPlace *places) {
    uint8_t *steps = steps_of(growth, proposal);
    int down[3] = {0, 0, 0};
    proposal->first = places[0].cell;
    memset(steps, 0, growth->step_stride);
    for (uint32_t k = 0; k + 1 < proposal->cell_count; k++) {
        const int16_t *from = places[k].cell.at, *to = places[k + 1].cell.at;
        int axis = (to[1] != from[1]) + 2 * (to[2] != from[2]); // a step goes along one
        steps[k / STEPS_A_BYTE] |= (uint8_t)(axis << (k % STEPS_A_BYTE * 2));
        for (int i = 0; i < 3; i++) {
            down[i] |= to[i] < from[i];
        }
    }
    proposal->backwards = (uint8_t)(down[0] | down[1] << 1 | down[2] << 2);
}

void fr_path_places(const FrGrowth *growth, const FrProposal *proposal, FrCellPlace *places) {
    const uint8_t *steps = steps_of(growth, proposal);
    int16_t way[3];
    for (int axis = 0; axis < 3; axis++) {
        way[axis] = (proposal->backwards >> axis & 1) != 0 ? -1 : 1;
    }
    FrCell at = proposal->first;
    FrBrick *last = NULL;
    if (proposal->cell_count == 1) {
        fr_path_find(growth->voxels, &at, 1, places);
    }
    for (uint32_t k = 0; k + 1 < proposal->cell_count; k++) {
        FrCell before = at;
        int axis = steps[k / STEPS_A_BYTE] >> (k % STEPS_A_BYTE * 2) & 3;
        at.at[axis] = (int16_t)(at.at[axis] + way[axis]);
        places[k + 1] = place_of(growth->voxels, at, before, last);
        last = places[k + 1].brick;
    }
}
