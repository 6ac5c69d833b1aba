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

// Here a cell is one number, sixteen bits for each axis: a step adds to it, and the cells of a
// brick are equal but for three bits of each.
#define IN_BRICK UINT64_C(0x000700070007)

static inline uint64_t code_of(FrCell cell) {
    return (uint64_t)cell.at[0] | (uint64_t)cell.at[1] << 16 | (uint64_t)cell.at[2] << 32;
}

/// `last` is the brick of the cell before, which needs no look-up if this one is in it too.
static inline FrCellPlace place_of(const FrVoxels *voxels, uint64_t code, uint64_t before,
                                   FrBrick *last) {
    FrCell cell = {{(int16_t)code, (int16_t)(code >> 16), (int16_t)(code >> 32)}};
    bool is_same = ((code ^ before) & ~IN_BRICK) == 0 && last != NULL;
    return (FrCellPlace){.brick = is_same ? last : fr_voxels_brick(voxels, cell),
                         .cell = cell,
                         .layer = (uint8_t)(code >> 32 & 7),
                         .bit = (uint8_t)((code >> 16 & 7) * 8 + (code & 7))};
}

void fr_path_find(const FrVoxels *voxels, const FrCell *cells, uint32_t count,
                  FrCellPlace *places) {
    FrBrick *last = NULL;
    uint64_t before = 0;
    for (uint32_t k = 0; k < count; k++) {
        uint64_t code = code_of(cells[k]);
        places[k] = place_of(voxels, code, before, last);
        last = places[k].brick;
        before = code;
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
    uint64_t way[3];
    for (int axis = 0; axis < 3; axis++) {
        uint64_t one = UINT64_C(1) << (16 * axis);
        way[axis] = (proposal->backwards >> axis & 1) != 0 ? -one : one;
    }
    if (proposal->cell_count == 1) {
        fr_path_find(growth->voxels, &proposal->first, 1, places);
    }
    uint64_t code = code_of(proposal->first);
    FrBrick *last = NULL;
    for (uint32_t k = 0; k + 1 < proposal->cell_count; k++) {
        uint64_t before = code;
        code += way[steps[k / STEPS_A_BYTE] >> (k % STEPS_A_BYTE * 2) & 3];
        places[k + 1] = place_of(growth->voxels, code, before, last);
        last = places[k + 1].brick;
    }
}
