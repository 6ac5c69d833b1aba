// The cells of a proposal's segment. Each lies beside the one before, so besides the first only the
// axis of every step is kept: a few bytes, where cells themselves would be a quarter of all that a
// step reads and writes.
#include "growth/propose.h"

#include <string.h>

enum { STEPS_A_BYTE = 4 };

static uint8_t *steps_of(const FrGrowth *growth, const FrProposal *proposal) {
    return growth->steps + (size_t)(proposal - growth->proposals) * growth->step_stride;
}

uint32_t fr_path_stride(uint32_t cells) {
    return (cells + STEPS_A_BYTE - 1) / STEPS_A_BYTE;
}

void fr_path_keep(const FrGrowth *growth, FrProposal *proposal, const FrCell *cells) {
    uint8_t *steps = steps_of(growth, proposal);
    proposal->first = cells[0];
    proposal->backwards = 0;
    memset(steps, 0, growth->step_stride);
    for (uint32_t k = 0; k + 1 < proposal->cell_count; k++) {
        for (int axis = 0; axis < 3; axis++) {
            int way = cells[k + 1].at[axis] - cells[k].at[axis];
            if (way != 0) {
                steps[k / STEPS_A_BYTE] |= (uint8_t)(axis << (k % STEPS_A_BYTE * 2));
                proposal->backwards |= (uint8_t)((way < 0) << axis);
            }
        }
    }
}

void fr_path_cells(const FrGrowth *growth, const FrProposal *proposal, FrCell *cells) {
    const uint8_t *steps = steps_of(growth, proposal);
    int way[3];
    for (int axis = 0; axis < 3; axis++) {
        way[axis] = (proposal->backwards >> axis & 1) != 0 ? -1 : 1;
    }
    FrCell at = proposal->first;
    cells[0] = at;
    for (uint32_t k = 0; k + 1 < proposal->cell_count; k++) {
        int axis = steps[k / STEPS_A_BYTE] >> (k % STEPS_A_BYTE * 2) & 3;
        at.at[axis] = (int16_t)(at.at[axis] + way[axis]);
        cells[k + 1] = at;
    }
}
