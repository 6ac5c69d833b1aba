// The inside of obstacles into voxels: eight cells of a row at once.
#include "frond/solid.h"
#include "frond/voxels.h"

#include <glib.h>
#include <math.h>

typedef struct Filling {
    FrVoxels *voxels;
    bool is_ground;
    uint64_t cells;
} Filling;

static void count_run(void *data, int64_t first, int64_t last, int64_t y, int64_t z) {
    (void)y;
    (void)z;
    ((Filling *)data)->cells += (uint64_t)(last - first + 1);
}

static void fill_run(void *data, int64_t first, int64_t last, int64_t y, int64_t z) {
    const Filling *filling = data;
    for (int64_t x = first; x <= last; x = (x | 7) + 1) {
        FrCell cell = {{(int16_t)x, (int16_t)y, (int16_t)z}};
        FrBrick *brick = fr_voxels_make(filling->voxels, cell);
        int64_t end = MIN(last, x | 7);
        uint64_t bits = ((UINT64_C(2) << (end - x)) - 1) << fr_voxels_bit(cell);
        uint64_t known = brick->solid[z & 7];
        brick->taken[z & 7] |= bits;
        brick->solid[z & 7] |= bits;
        if (filling->is_ground) {
            brick->ground[z & 7] |= bits & ~known;
        } else {
            brick->ground[z & 7] &= ~bits;
        }
    }
}

bool fr_voxels_fill(FrVoxels *voxels, const vec3s *positions, const uint32_t *indices,
                    uint32_t index_count, bool is_ground, const double end[3], uint64_t most) {
    FrCellGrid grid = {.cell = voxels->cell};
    for (int axis = 0; axis < 3; axis++) {
        double cells = ceil((end[axis] - voxels->origin[axis]) / voxels->cell);
        grid.origin[axis] = voxels->origin[axis];
        grid.counts[axis] = (int64_t)fmin(fmax(cells, 1), FR_VOXELS_WIDTH);
    }
    Filling filling = {voxels, is_ground, 0};
    fr_solid_cells(positions, indices, index_count, &grid, count_run, &filling);
    if (filling.cells / FR_BRICK_CELLS * sizeof(FrBrick) > most) {
        return false;
    }
    fr_solid_cells(positions, indices, index_count, &grid, fill_run, &filling);
    return true;
}
