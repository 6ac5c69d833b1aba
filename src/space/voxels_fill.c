// The inside of obstacles into voxels: eight cells of a row at once.
#include "frond/solid.h"
#include "frond/voxels.h"

#include <glib.h>
#include <math.h>

typedef struct Filling {
    FrVoxels *voxels;
    const FrVoxelSurface *surface;
    const FrContext *context;
    uint64_t cells;
    FrStatus status;
} Filling;

static void count_run(void *data, int64_t first, int64_t last, int64_t y, int64_t z) {
    (void)y;
    (void)z;
    ((Filling *)data)->cells += (uint64_t)(last - first + 1);
}

static void fill_run(void *data, int64_t first, int64_t last, int64_t y, int64_t z) {
    Filling *filling = data;
    if (filling->status == FR_OK && fr_progress_is_cancelled(filling->context->progress)) {
        filling->status = FR_CANCELLED;
    }
    for (int64_t x = first; x <= last && filling->status == FR_OK; x = (x | 7) + 1) {
        FrCell cell = {{(int16_t)x, (int16_t)y, (int16_t)z}};
        FrBrick *brick = fr_voxels_make(filling->voxels, cell);
        if (brick == NULL) {
            fr_diags_add(filling->context->diags, FR_ERROR, "out-of-memory", filling->surface->span,
                         "there is no memory for what is solid in the arena");
            filling->status = FR_ERR_MACHINE;
            return;
        }
        int64_t end = MIN(last, x | 7);
        uint64_t bits = ((UINT64_C(2) << (end - x)) - 1) << fr_voxels_bit(cell);
        uint64_t known = brick->solid[z & 7];
        brick->taken[z & 7] |= bits;
        brick->solid[z & 7] |= bits;
        if (filling->surface->is_ground) {
            brick->ground[z & 7] |= bits & ~known;
        } else {
            brick->ground[z & 7] &= ~bits;
        }
    }
}

FrStatus fr_voxels_fill(FrVoxels *voxels, const FrVoxelSurface *surface, const double end[3],
                        const FrContext *context) {
    enum { LINE = 64 };
    FrCellGrid grid = {.cell = voxels->cell};
    for (int axis = 0; axis < 3; axis++) {
        double cells = ceil((end[axis] - voxels->origin[axis]) / voxels->cell);
        grid.origin[axis] = voxels->origin[axis];
        grid.counts[axis] = (int64_t)fmin(fmax(cells, 1), FR_VOXELS_WIDTH);
    }
    Filling filling = {voxels, surface, context, 0, FR_OK};
    fr_solid_cells(surface->positions, surface->indices, surface->index_count, &grid, count_run,
                   &filling);
    uint64_t brick = (sizeof(FrBrick) + LINE - 1) / LINE * LINE;
    filling.status =
        fr_voxels_check(voxels, filling.cells / FR_BRICK_CELLS * brick, surface->span, context);
    if (filling.status == FR_OK && filling.cells > 0) {
        fr_solid_cells(surface->positions, surface->indices, surface->index_count, &grid, fill_run,
                       &filling);
    }
    return filling.status;
}
