// The inside of obstacles into voxels, eight layers at a time, so that the rows of a whole column
// of bricks are known at once: where all 64 cross a brick from end to end it is solid, and shares
// the memory of all such bricks. So the time that the inside takes goes by bricks, and its memory
// by the surface.
#include "frond/solid.h"
#include "frond/voxels.h"

#include <glib.h>
#include <math.h>

enum { BRICKS = FR_VOXELS_WIDTH / FR_BRICK_WIDTH };

/// Cells first … last of a row.
typedef struct Run {
    int16_t first, last, y, z;
} Run;

typedef struct Filling {
    FrVoxels *voxels;
    const FrVoxelSurface *surface;
    const FrContext *context;
    FrCellGrid grid;
    GArray *columns[BRICKS]; ///< Run, by brick along y
} Filling;

static void note_run(void *data, int64_t first, int64_t last, int64_t y, int64_t z) {
    Filling *filling = data;
    Run run = {(int16_t)first, (int16_t)last, (int16_t)y, (int16_t)z};
    g_array_append_val(filling->columns[y / FR_BRICK_WIDTH], run);
}

/// Cells from … to of a row, all in one brick. False if there is no memory.
static bool fill_part(const Filling *filling, const Run *run, int from, int to) {
    bool is_ground = filling->surface->is_ground;
    FrCell cell = {{(int16_t)from, run->y, run->z}};
    FrBrick *brick = fr_voxels_brick(filling->voxels, cell);
    if (brick == &filling->voxels->inside[0] ||
        (is_ground && brick == &filling->voxels->inside[1])) {
        return true;
    }
    brick = fr_voxels_make(filling->voxels, cell);
    if (brick == NULL) {
        return false;
    }
    uint64_t bits = ((UINT64_C(2) << (to - from)) - 1) << fr_voxels_bit(cell);
    unsigned layer = (unsigned)run->z & 7;
    uint64_t known = brick->solid[layer];
    brick->taken[layer] |= bits;
    brick->solid[layer] |= bits;
    if (is_ground) {
        brick->ground[layer] |= bits & ~known;
    } else {
        brick->ground[layer] &= ~bits;
    }
    return true;
}

/// The bricks of a row that a run crosses from end to end: first > last if there are none.
static void whole_bricks(const Run *run, int *first, int *last) {
    *first = (run->first + FR_BRICK_WIDTH - 1) / FR_BRICK_WIDTH;
    *last = (run->last + 1) / FR_BRICK_WIDTH - 1;
}

/// The ends of a run, in bricks that it does not cross.
static bool fill_ends(const Filling *filling, const Run *run) {
    int first, last;
    whole_bricks(run, &first, &last);
    if (first > last) { // in one brick, or in two
        int end = MIN(run->last, run->first | 7);
        return fill_part(filling, run, run->first, end) &&
               (end == run->last || fill_part(filling, run, end + 1, run->last));
    }
    int begin = first * FR_BRICK_WIDTH, end = (last + 1) * FR_BRICK_WIDTH;
    return (run->first == begin || fill_part(filling, run, run->first, begin - 1)) &&
           (run->last + 1 == end || fill_part(filling, run, end, run->last));
}

/// A brick that some rows cross: each on its own.
static bool fill_crossed(const Filling *filling, const GArray *runs, int brick) {
    bool is_done = true;
    for (guint i = 0; i < runs->len && is_done; i++) {
        const Run *run = &g_array_index(runs, Run, i);
        int first, last, begin = brick * FR_BRICK_WIDTH;
        whole_bricks(run, &first, &last);
        if (first <= brick && brick <= last) {
            is_done = fill_part(filling, run, begin, begin + FR_BRICK_WIDTH - 1);
        }
    }
    return is_done;
}

/// The bricks of 8 × 8 rows.
static bool fill_column(const Filling *filling, const GArray *runs) {
    int change[BRICKS + 1] = {0}; // of how many rows cross a brick
    for (guint i = 0; i < runs->len; i++) {
        const Run *run = &g_array_index(runs, Run, i);
        int first, last;
        whole_bricks(run, &first, &last);
        if (first <= last) {
            change[first]++;
            change[last + 1]--;
        }
        if (!fill_ends(filling, run)) {
            return false;
        }
    }
    bool is_done = true;
    for (int brick = 0, rows = 0; brick < BRICKS && runs->len > 0 && is_done; brick++) {
        rows += change[brick];
        const Run *run = &g_array_index(runs, Run, 0);
        FrCell first = {{(int16_t)(brick * FR_BRICK_WIDTH), run->y & ~7, run->z & ~7}};
        if (rows == FR_BRICK_WIDTH * FR_BRICK_WIDTH) {
            is_done = fr_voxels_fill_brick(filling->voxels, first, filling->surface->is_ground);
        } else if (rows > 0) {
            is_done = fill_crossed(filling, runs, brick);
        }
    }
    return is_done;
}

/// What has been noted of eight layers.
static FrStatus fill_columns(const Filling *filling) {
    FrStatus status = FR_OK;
    for (int column = 0; column < BRICKS && status == FR_OK; column++) {
        GArray *runs = filling->columns[column];
        if (runs->len == 0) {
            continue;
        }
        status = fr_voxels_check(filling->voxels, 0, filling->surface->span, filling->context);
        if (status == FR_OK && !fill_column(filling, runs)) {
            fr_diags_add(filling->context->diags, FR_ERROR, "out-of-memory", filling->surface->span,
                         "there is no memory for what is solid in the arena");
            status = FR_ERR_MACHINE;
        }
    }
    return status;
}

// ---- triangles of layers ----------------------------------------------------------------------

/// Triangles by the first of the eight layers that they may cross.
typedef struct Sweep {
    int *last;          ///< by triangle
    uint32_t *by_first; ///< triangles in that order
    uint32_t start[BRICKS + 2];
    GArray *open;    ///< uint32_t: those that the layers may meet
    GArray *indices; ///< uint32_t: their corners
} Sweep;

static Sweep begin_sweep(const Filling *filling) {
    const FrVoxelSurface *surface = filling->surface;
    uint32_t count = surface->index_count / 3;
    Sweep sweep = {.last = g_new(int, count + 1u), .by_first = g_new(uint32_t, count + 1u)};
    int *first = g_new(int, count + 1u);
    double width = filling->grid.cell * FR_BRICK_WIDTH;
    for (uint32_t t = 0; t < count; t++) {
        double low = INFINITY, high = -INFINITY;
        for (uint32_t k = 0; k < 3; k++) {
            double z = (double)surface->positions[surface->indices[3 * t + k]].z;
            low = fmin(low, (z - filling->grid.origin[2]) / width);
            high = fmax(high, (z - filling->grid.origin[2]) / width);
        }
        first[t] = (int)CLAMP(floor(low - 0.001), 0, BRICKS);
        sweep.last[t] = (int)CLAMP(floor(high + 0.001), -1, BRICKS);
        sweep.start[first[t] + 1]++;
    }
    for (int layers = 0; layers <= BRICKS; layers++) {
        sweep.start[layers + 1] += sweep.start[layers];
    }
    uint32_t *next = g_memdup2(sweep.start, sizeof sweep.start);
    for (uint32_t t = 0; t < count; t++) {
        sweep.by_first[next[first[t]]++] = t;
    }
    g_free(next);
    g_free(first);
    sweep.open = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    sweep.indices = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    return sweep;
}

/// Goes on to the next eight layers.
static void move_sweep(Sweep *sweep, const FrVoxelSurface *surface, int layers) {
    g_array_append_vals(sweep->open, sweep->by_first + sweep->start[layers],
                        sweep->start[layers + 1] - sweep->start[layers]);
    g_array_set_size(sweep->indices, 0);
    guint left = 0;
    for (guint i = 0; i < sweep->open->len; i++) {
        uint32_t triangle = g_array_index(sweep->open, uint32_t, i);
        if (sweep->last[triangle] >= layers) {
            g_array_index(sweep->open, uint32_t, left++) = triangle;
            g_array_append_vals(sweep->indices, surface->indices + 3 * (size_t)triangle, 3);
        }
    }
    g_array_set_size(sweep->open, left);
}

static void end_sweep(Sweep *sweep) {
    g_free(sweep->last);
    g_free(sweep->by_first);
    g_array_unref(sweep->open);
    g_array_unref(sweep->indices);
}

static FrStatus fill_layers(Filling *filling, const Sweep *sweep, int layers) {
    FrCellGrid grid = filling->grid;
    grid.first[2] = layers * FR_BRICK_WIDTH;
    grid.counts[2] = MIN(grid.counts[2], grid.first[2] + FR_BRICK_WIDTH);
    for (int column = 0; column < BRICKS; column++) {
        g_array_set_size(filling->columns[column], 0);
    }
    fr_solid_cells(filling->surface->positions, (const uint32_t *)(void *)sweep->indices->data,
                   sweep->indices->len, &grid, note_run, filling);
    return fill_columns(filling);
}

FrStatus fr_voxels_fill(FrVoxels *voxels, const FrVoxelSurface *surface, const double end[3],
                        const FrContext *context) {
    Filling filling = {voxels, surface, context, {.cell = voxels->cell}, {NULL}};
    for (int axis = 0; axis < 3; axis++) {
        double bricks = (end[axis] - voxels->origin[axis]) / voxels->cell / FR_BRICK_WIDTH;
        filling.grid.origin[axis] = voxels->origin[axis];
        filling.grid.counts[axis] = (int64_t)fmin(fmax(ceil(bricks), 1), BRICKS) * FR_BRICK_WIDTH;
    }
    for (int column = 0; column < BRICKS; column++) {
        filling.columns[column] = g_array_new(FALSE, FALSE, sizeof(Run));
    }
    Sweep sweep = begin_sweep(&filling);
    FrStatus status = FR_OK;
    for (int layers = 0; layers * FR_BRICK_WIDTH < filling.grid.counts[2] && status == FR_OK;
         layers++) {
        move_sweep(&sweep, surface, layers);
        status = sweep.open->len > 0 ? fill_layers(&filling, &sweep, layers) : FR_OK;
        fr_voxels_share_blocks(voxels, layers * FR_BRICK_WIDTH);
    }
    if (status == FR_OK) {
        status = fr_voxels_check(voxels, 0, surface->span, context);
    }
    end_sweep(&sweep);
    for (int column = 0; column < BRICKS; column++) {
        g_array_unref(filling.columns[column]);
    }
    return status;
}
