// Sparse voxels: bricks of 8³ cells in blocks of 8³ bricks in a table of 64³ blocks. Segments are
// walked after Amanatides and Woo 1987, A Fast Voxel Traversal Algorithm for Ray Tracing.
#include "frond/voxels.h"

#include "math/lanes.h"

#include <math.h>
#include <string.h>
#include <sys/mman.h>

enum { TOP = 64 * 64 * 64, BLOCK = 512, SLAB = 1 << 22, HUGE_PAGE = 1 << 21 };

/// Zeroed memory in huge pages where the machine has them: bricks are met in no order, and looking
/// up their pages costs as much as they do. NULL where the machine has no more.
static char *new_slab(void) {
    char *slab =
        mmap(NULL, SLAB + HUGE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (slab == MAP_FAILED) {
        return NULL;
    }
    char *aligned = slab + (HUGE_PAGE - (uintptr_t)slab % HUGE_PAGE) % HUGE_PAGE;
    madvise(aligned, SLAB, MADV_HUGEPAGE);
    return slab;
}

static void free_slab(void *slab) {
    munmap(slab, SLAB + HUGE_PAGE);
}

/// Zeroed memory that lives as long as the voxels, in whole cache lines; NULL if there is none.
static void *take(FrVoxels *voxels, size_t size) {
    size = (size + 63) / 64 * 64;
    if (voxels->slab_used + size > voxels->slab_size) {
        char *slab = new_slab();
        if (slab == NULL) {
            return NULL;
        }
        g_ptr_array_add(voxels->slabs, slab);
        voxels->slab_size = SLAB;
        voxels->slab_used = 0;
    }
    char *slab = g_ptr_array_index(voxels->slabs, voxels->slabs->len - 1);
    char *aligned = slab + (HUGE_PAGE - (uintptr_t)slab % HUGE_PAGE) % HUGE_PAGE;
    void *memory = aligned + voxels->slab_used;
    voxels->slab_used += size;
    voxels->bytes += size;
    return memory;
}

/// Memory of a block that is not used any more; NULL: none.
static FrBrick **take_spare(FrVoxels *voxels) {
    if (voxels->spare->len == 0) {
        return NULL;
    }
    voxels->bytes += BLOCK * sizeof(FrBrick *);
    return g_ptr_array_steal_index_fast(voxels->spare, voxels->spare->len - 1);
}

FrVoxels *fr_voxels_new(const double origin[3], double cell) {
    FR_ASSERT(cell > 0);
    FrVoxels *voxels = g_new0(FrVoxels, 1);
    memcpy(voxels->origin, origin, sizeof voxels->origin);
    voxels->cell = cell;
    voxels->top = g_new0(FrBrick **, TOP);
    voxels->bytes = TOP * sizeof(FrBrick **);
    voxels->slabs = g_ptr_array_new_with_free_func(free_slab);
    voxels->spare = g_ptr_array_new();
    pthread_mutex_init(&voxels->lock, NULL);
    for (int is_ground = 0; is_ground < 2; is_ground++) {
        FrBrick *inside = &voxels->inside[is_ground];
        memset(inside->taken, 0xff, sizeof inside->taken);
        memset(inside->solid, 0xff, sizeof inside->solid);
        memset(inside->ground, is_ground ? 0xff : 0, sizeof inside->ground);
        voxels->inside_block[is_ground] = g_new(FrBrick *, BLOCK);
        for (int i = 0; i < BLOCK; i++) {
            voxels->inside_block[is_ground][i] = inside;
        }
    }
    return voxels;
}

void fr_voxels_free(FrVoxels *voxels) {
    if (voxels != NULL) {
        g_ptr_array_free(voxels->slabs, TRUE);
        g_ptr_array_free(voxels->spare, TRUE);
        g_free(voxels->inside_block[0]);
        g_free(voxels->inside_block[1]);
        pthread_mutex_destroy(&voxels->lock);
        g_free(voxels->top);
        g_free(voxels);
    }
}

FrStatus fr_voxels_check(const FrVoxels *voxels, uint64_t more, FrSpan span,
                         const FrContext *context) {
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    return fr_limit_check(fr_count_add(voxels->bytes, more), context->limits.bytes, "bytes",
                          "what is solid in the arena", span, context->diags);
}

static FrBrick ***top_of(const FrVoxels *voxels, FrCell cell) {
    unsigned x = (unsigned)cell.at[0], y = (unsigned)cell.at[1], z = (unsigned)cell.at[2];
    return &voxels->top[((z >> 6) * 64 + (y >> 6)) * 64 + (x >> 6)];
}

/// Where the brick of a cell hangs, in a block of its own; NULL if there is no memory.
static FrBrick **place_of(FrVoxels *voxels, FrCell cell) {
    unsigned x = (unsigned)cell.at[0], y = (unsigned)cell.at[1], z = (unsigned)cell.at[2];
    FrBrick ***top = top_of(voxels, cell), **block = *top;
    if (block == NULL || fr_voxels_is_inside_block(voxels, block)) {
        size_t size = BLOCK * sizeof(FrBrick *);
        FrBrick **own = take_spare(voxels);
        own = own == NULL ? take(voxels, size) : own;
        if (own == NULL) {
            return NULL;
        }
        if (block != NULL) {
            memcpy(own, block, size);
        } else {
            memset(own, 0, size);
        }
        __atomic_store_n(top, own, __ATOMIC_RELEASE);
        block = own;
    }
    return &block[((z >> 3 & 7) * 8 + (y >> 3 & 7)) * 8 + (x >> 3 & 7)];
}

FrBrick *fr_voxels_make(FrVoxels *voxels, FrCell cell) {
    FrBrick **place = place_of(voxels, cell);
    if (place == NULL || (*place != NULL && !fr_voxels_is_inside(voxels, *place))) {
        return place == NULL ? NULL : *place;
    }
    FrBrick *own = take(voxels, sizeof(FrBrick));
    if (own != NULL) {
        *own = *place == NULL ? (FrBrick){0} : **place;
        __atomic_store_n(place, own, __ATOMIC_RELEASE);
    }
    return own;
}

bool fr_voxels_fill_brick(FrVoxels *voxels, FrCell first, bool is_ground) {
    FrBrick *old = fr_voxels_brick(voxels, first);
    if (old == &voxels->inside[0] || (is_ground && old == &voxels->inside[1])) {
        return true; // what is ground to one and solid to another is solid
    }
    FrBrick **place = place_of(voxels, first);
    if (place == NULL) {
        return false;
    }
    if (old == NULL || fr_voxels_is_inside(voxels, old)) {
        *place = &voxels->inside[is_ground];
        return true;
    }
    for (unsigned layer = 0; layer < 8; layer++) {
        old->ground[layer] = is_ground ? old->ground[layer] | ~old->solid[layer] : 0;
        old->taken[layer] = old->solid[layer] = UINT64_MAX;
    }
    return true;
}

void fr_voxels_share_blocks(FrVoxels *voxels, int z) {
    for (int top = z / 64 * 4096; top < (z / 64 + 1) * 4096; top++) {
        FrBrick **block = voxels->top[top];
        if (block == NULL || !fr_voxels_is_inside(voxels, block[0]) ||
            fr_voxels_is_inside_block(voxels, block)) {
            continue;
        }
        int alike = 1;
        while (alike < BLOCK && block[alike] == block[0]) {
            alike++;
        }
        if (alike == BLOCK) {
            voxels->top[top] = voxels->inside_block[block[0] == &voxels->inside[1]];
            g_ptr_array_add(voxels->spare, block);
            voxels->bytes -= BLOCK * sizeof(FrBrick *);
        }
    }
}

FrBrick *fr_voxels_reserve(FrVoxels *voxels, FrCell cell) {
    FrBrick *brick = fr_voxels_brick(voxels, cell);
    if (brick != NULL && __atomic_load_n(&brick->owners, __ATOMIC_ACQUIRE) != NULL) {
        return brick;
    }
    pthread_mutex_lock(&voxels->lock);
    brick = fr_voxels_make(voxels, cell);
    FR_ASSERT(brick != NULL);
    if (brick->owners == NULL) {
        uint32_t *owners = take(voxels, FR_BRICK_CELLS * sizeof(uint32_t));
        FR_ASSERT(owners != NULL);
        memset(owners, 0xff, FR_BRICK_CELLS * sizeof(uint32_t));
        __atomic_store_n(&brick->owners, owners, __ATOMIC_RELEASE);
    }
    pthread_mutex_unlock(&voxels->lock);
    return brick;
}

// A walk asks for each cell which of three borders comes next, which no branch foresees. So it is
// asked with masks: all ones where it is so.
typedef double Number __attribute__((vector_size(16)));
typedef int64_t Mask __attribute__((vector_size(16)));

/// Along one axis.
typedef struct Borders {
    Number next; ///< where on the segment the next border lies; infinite after the last
    Number step; ///< from border to border
    Number left; ///< still to be crossed
} Borders;

static inline void cross(Borders *borders, Mask is_crossed) {
    const Number one = {1, 1}, infinite = {INFINITY, INFINITY};
    borders->left -= (Number)(is_crossed & (Mask)one);
    borders->next += (Number)(is_crossed & (Mask)borders->step);
    Mask is_last = borders->left == 0;
    borders->next = (Number)((is_last & (Mask)infinite) | (~is_last & (Mask)borders->next));
}

/// As many crossings as the cells lie apart along each axis, so rounding cannot miss the end.
FR_LANES_CLONES static void cross_borders(const Borders all[3], const int way[3], uint32_t count,
                                          FrCell *cells) {
    Borders x = all[0], y = all[1], z = all[2];
    const Mask ways[3] = {{way[0]}, {(int64_t)way[1] * 0x10000}, {(int64_t)way[2] * 0x100000000}};
    const int16_t *first = cells[0].at;
    // The cell as one number, sixteen bits for each axis.
    Mask cell = {(int64_t)first[0] | (int64_t)first[1] << 16 | (int64_t)first[2] << 32};
    for (uint32_t i = 1; i <= count; i++) {
        Mask x_or_y = x.next <= y.next, x_or_z = x.next <= z.next, y_or_z = y.next <= z.next;
        Mask is_x = x_or_y & x_or_z, is_y = ~x_or_y & y_or_z, is_z = ~(is_x | is_y);
        cell += (is_x & ways[0]) | (is_y & ways[1]) | (is_z & ways[2]);
        cross(&x, is_x);
        cross(&y, is_y);
        cross(&z, is_z);
        int64_t code = cell[0];
        cells[i] = (FrCell){{(int16_t)code, (int16_t)(code >> 16), (int16_t)(code >> 32)}};
    }
}

uint32_t fr_voxels_walk(const FrVoxels *voxels, const double from[3], const double to[3],
                        FrCell *cells) {
    FrCell at, end;
    bool is_inside = fr_voxels_cell(voxels, from, &at) && fr_voxels_cell(voxels, to, &end);
    FR_ASSERT(is_inside);
    Borders borders[3];
    int way[3];
    uint32_t left = 0;
    for (int axis = 0; axis < 3; axis++) {
        double along = (to[axis] - from[axis]) / voxels->cell;
        double where = (from[axis] - voxels->origin[axis]) / voxels->cell - (double)at.at[axis];
        double step = 1 / MAX(fabs(along), 0x1.0p-100);
        int crossed = abs(end.at[axis] - at.at[axis]);
        way[axis] = along > 0 ? 1 : -1;
        borders[axis].next[0] = crossed == 0 ? INFINITY : (along > 0 ? 1 - where : where) * step;
        borders[axis].step[0] = step;
        borders[axis].left[0] = crossed;
        left += (uint32_t)crossed;
    }
    FR_ASSERT(left < FR_WALK_CELLS);
    cells[0] = at;
    cross_borders(borders, way, left, cells);
    return left + 1;
}

void fr_voxels_each_owned(const FrVoxels *voxels,
                          void (*visit)(void *data, FrCell first, FrBrick *brick), void *data) {
    for (int top = 0; top < TOP; top++) {
        FrBrick **block = voxels->top[top];
        bool has_owners = block != NULL && !fr_voxels_is_inside_block(voxels, block);
        for (int i = 0; has_owners && i < BLOCK; i++) {
            if (block[i] != NULL && block[i]->owners != NULL) {
                FrCell first = {{(int16_t)((top % 64) * 64 + (i % 8) * 8),
                                 (int16_t)((top / 64 % 64) * 64 + (i / 8 % 8) * 8),
                                 (int16_t)((top / 4096) * 64 + (i / 64) * 8)}};
                visit(data, first, block[i]);
            }
        }
    }
}

/// Bits of a layer that have an owner.
static uint64_t owned_bits(const FrBrick *brick, unsigned layer) {
    uint64_t bits = 0;
    for (unsigned bit = 0; brick->owners != NULL && bit < 64; bit++) {
        uint32_t owner = brick->owners[fr_voxels_slot(layer, bit)];
        bits |= (uint64_t)(owner != FR_VOXEL_FREE) << bit;
    }
    return bits;
}

void fr_voxels_note_owners(FrBrick *brick) {
    for (unsigned layer = 0; layer < 8; layer++) {
        brick->taken[layer] = owned_bits(brick, layer) | brick->solid[layer];
    }
}

static void drop_owners(void *data, FrCell first, FrBrick *brick) {
    (void)data;
    (void)first;
    memset(brick->owners, 0xff, FR_BRICK_CELLS * sizeof *brick->owners);
    memcpy(brick->taken, brick->solid, sizeof brick->taken);
}

/// Writes the owners of a brick into that of other voxels.
static void hand_owners(void *data, FrCell first, FrBrick *brick) {
    FrBrick *into = fr_voxels_reserve(data, first);
    memcpy(into->owners, brick->owners, FR_BRICK_CELLS * sizeof *into->owners);
    for (unsigned layer = 0; layer < 8; layer++) {
        into->taken[layer] = into->solid[layer] | owned_bits(brick, layer);
    }
}

void fr_voxels_take_owners(FrVoxels *voxels, const FrVoxels *other) {
    fr_voxels_each_owned(voxels, drop_owners, NULL);
    fr_voxels_each_owned(other, hand_owners, voxels);
}

void fr_voxels_clear_solid(FrVoxels *voxels) {
    for (int top = 0; top < TOP; top++) {
        FrBrick **block = voxels->top[top];
        if (fr_voxels_is_inside_block(voxels, block)) {
            voxels->top[top] = block = NULL;
        }
        for (int i = 0; block != NULL && i < BLOCK; i++) {
            if (fr_voxels_is_inside(voxels, block[i])) {
                block[i] = NULL;
            }
            for (unsigned layer = 0; block[i] != NULL && layer < 8; layer++) {
                block[i]->solid[layer] = 0;
                block[i]->ground[layer] = 0;
            }
            if (block[i] != NULL) {
                fr_voxels_note_owners(block[i]);
            }
        }
    }
}
