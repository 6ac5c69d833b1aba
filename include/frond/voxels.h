/// @file voxels.h
/// Space in cells that know what stands in them: 4096³ cells of which only the bricks of 8³ that
/// hold something exist.
///
/// A cell is free, solid (an obstacle), or owned: the number of a branch. Bits of a brick of one
/// kind fill one cache line, so most questions touch no more. In a round of proposals free cells
/// can also be *asked* for: they bear the number of who is the first of all that ask, and become
/// owned as soon as they are marked as *taken*.
#pragma once

#include "frond/context.h"
#include "frond/vector.h"

#include <pthread.h>

enum {
    FR_VOXELS_WIDTH = 4096, ///< cells along each axis
    FR_BRICK_WIDTH = 8,
    FR_BRICK_CELLS = 512,
    FR_WALK_CELLS = 256, ///< most cells of a segment that fr_voxels_walk() is asked for
};

/// Owners that are no branch.
#define FR_VOXEL_FREE UINT32_MAX
#define FR_VOXEL_SOLID (UINT32_MAX - 1)
#define FR_VOXEL_GROUND (UINT32_MAX - 2)

typedef struct FrCell {
    int16_t at[3]; ///< 0 … FR_VOXELS_WIDTH − 1
} FrCell;

/// 8³ cells. Bit y·8 + x of word z.
typedef struct FrBrick {
    uint64_t taken[8]; ///< owned or solid
    uint64_t asked[8]; ///< free, and asked for
    uint32_t *owners;  ///< by fr_voxels_slot(); where nobody owns a cell, who asks for it; NULL: no
                       ///< branches in here
    uint64_t contested; ///< by fr_voxels_cube(): several have asked for one of its cells, once
    uint64_t rest[6];   ///< of the cache line
    uint64_t solid[8];  ///< an obstacle
    uint64_t ground[8]; ///< … that roots pass
} FrBrick;

/// Bricks hang in blocks of 8³, blocks in a table of 64³. Inside obstacles all places share one
/// brick, and one block of it; whoever writes there gets a brick of its own.
typedef struct FrVoxels {
    double origin[3];  ///< lowest corner, m
    double cell;       ///< m
    FrBrick ***top;    ///< [64³] blocks [8³] bricks; NULL where there is nothing
    uint64_t bytes;    ///< held
    FrBrick inside[2]; ///< all solid; all ground
    FrBrick **inside_block[2];
    GPtrArray *slabs; ///< private: memory of bricks and blocks
    size_t slab_used, slab_size;
    GPtrArray *spare;     ///< private: blocks that are not used any more
    pthread_mutex_t lock; ///< private: of the slabs
} FrVoxels;

FR_API FrVoxels *fr_voxels_new(const double origin[3], double cell);
FR_API void fr_voxels_free(FrVoxels *voxels);
/// The brick of a cell, made if there is none; NULL where the machine has no memory for it. Not
/// thread-safe.
FR_API FrBrick *fr_voxels_make(FrVoxels *voxels, FrCell cell);
/// The same with room for owners and claims; several threads may ask at once, and look up bricks
/// meanwhile.
FR_API FrBrick *fr_voxels_reserve(FrVoxels *voxels, FrCell cell);
/// Cells from the one of `from` to the one of `to`, in order, each beside the one before
/// (Amanatides and Woo 1987). Returns how many. Both ends must be inside, and the
/// sum of how far they lie apart along each axis below FR_WALK_CELLS cells.
FR_API uint32_t fr_voxels_walk(const FrVoxels *voxels, const double from[3], const double to[3],
                               FrCell *cells);

/// Triangles that become solid.
typedef struct FrVoxelSurface {
    const vec3s *positions;
    const uint32_t *indices; ///< three a triangle
    uint32_t index_count;
    bool is_ground;
    FrSpan span; ///< where a document asks for them
} FrVoxelSurface;

/// FR_CANCELLED, or FR_ERR_LIMIT with a diagnostic if all voxels and `more` bytes are above
/// FrLimits.bytes.
FR_API FR_MUST_USE FrStatus fr_voxels_check(const FrVoxels *voxels, uint64_t more, FrSpan span,
                                            const FrContext *context);
/// Makes every cell solid that a triangle touches. Parts outside are left out, and those more than
/// a brick beyond `end`. Some may be solid already where it fails.
FR_API FR_MUST_USE FrStatus fr_voxels_add_triangles(FrVoxels *voxels, const FrVoxelSurface *surface,
                                                    const double end[3], const FrContext *context);
/// True if a triangle touches a cell of this width, which fr_voxels_add_triangles() then makes
/// solid.
FR_API bool fr_voxels_touches(const FrVoxelSurface *surface, const double origin[3], double width,
                              FrCell cell);
/// Makes every cell solid whose middle a closed surface of triangles encloses, up to the end of
/// the brick of `end`. What is deep inside costs no memory. Some may be solid already where it
/// fails.
FR_API FR_MUST_USE FrStatus fr_voxels_fill(FrVoxels *voxels, const FrVoxelSurface *surface,
                                           const double end[3], const FrContext *context);
/// Makes all cells of the brick that begins at `first` solid. False if there is no memory.
FR_API bool fr_voxels_fill_brick(FrVoxels *voxels, FrCell first, bool is_ground);
/// Lets the blocks of all 64 layers from z on that are inside obstacles share one.
FR_API void fr_voxels_share_blocks(FrVoxels *voxels, int z);
/// Makes all obstacles go, and keeps what is owned.
FR_API void fr_voxels_clear_solid(FrVoxels *voxels);
/// Makes what `other`, of the same cells, has for owners the owners here; what is solid stays.
FR_API void fr_voxels_take_owners(FrVoxels *voxels, const FrVoxels *other);
/// Sets the bits of a brick whose owners have been written.
FR_API void fr_voxels_note_owners(FrBrick *brick);
/// Calls `visit` for every brick that has owners, in order of its place.
FR_API void fr_voxels_each_owned(const FrVoxels *voxels,
                                 void (*visit)(void *data, FrCell first, FrBrick *brick),
                                 void *data);

/// The cell of a point; false if it lies outside.
static inline bool fr_voxels_cell(const FrVoxels *voxels, const double at[3], FrCell *cell) {
    for (int axis = 0; axis < 3; axis++) {
        double where = (at[axis] - voxels->origin[axis]) / voxels->cell;
        if (!(where >= 0 && where < FR_VOXELS_WIDTH)) {
            return false;
        }
        cell->at[axis] = (int16_t)where;
    }
    return true;
}

/// The brick of a cell; NULL if there is none.
static inline FrBrick *fr_voxels_brick(const FrVoxels *voxels, FrCell cell) {
    unsigned x = (unsigned)cell.at[0], y = (unsigned)cell.at[1], z = (unsigned)cell.at[2];
    FrBrick **block =
        __atomic_load_n(&voxels->top[((z >> 6) * 64 + (y >> 6)) * 64 + (x >> 6)], __ATOMIC_ACQUIRE);
    return block == NULL
               ? NULL
               : __atomic_load_n(&block[((z >> 3 & 7) * 8 + (y >> 3 & 7)) * 8 + (x >> 3 & 7)],
                                 __ATOMIC_ACQUIRE);
}

/// The brick of cell i of a segment, where `last` is that of the cell before.
static inline FrBrick *fr_voxels_next_brick(const FrVoxels *voxels, const FrCell *cells, uint32_t i,
                                            FrBrick *last) {
    const int16_t *a = cells[i].at, *b = cells[i - 1].at;
    bool is_same = (((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) & ~(FR_BRICK_WIDTH - 1)) == 0;
    return is_same && last != NULL ? last : fr_voxels_brick(voxels, cells[i]);
}

static inline unsigned fr_voxels_bit(FrCell cell) {
    return ((unsigned)cell.at[1] & 7) * 8 + ((unsigned)cell.at[0] & 7);
}

/// Number of the cube of 2³ cells that a bit of a layer is in.
static inline unsigned fr_voxels_cube(unsigned layer, unsigned bit) {
    return (layer >> 1) * 16 + (bit >> 4) * 4 + (bit >> 1 & 3);
}

/// Where a brick keeps the owner of a bit of a layer: the eight of a cube lie together.
static inline unsigned fr_voxels_slot(unsigned layer, unsigned bit) {
    return fr_voxels_cube(layer, bit) * 8 + (layer & 1) * 4 + (bit >> 3 & 1) * 2 + (bit & 1);
}

/// Where the owner of a cell is written, in a brick that has owners.
static inline uint32_t *fr_voxels_at(const FrBrick *brick, FrCell cell) {
    return &brick->owners[fr_voxels_slot((unsigned)cell.at[2] & 7, fr_voxels_bit(cell))];
}

/// True for the bricks and blocks that all places inside obstacles share.
static inline bool fr_voxels_is_inside(const FrVoxels *voxels, const FrBrick *brick) {
    return brick == &voxels->inside[0] || brick == &voxels->inside[1];
}

static inline bool fr_voxels_is_inside_block(const FrVoxels *voxels, FrBrick **block) {
    return block == voxels->inside_block[0] || block == voxels->inside_block[1];
}

/// What stands in a cell.
static inline uint32_t fr_voxels_owner(const FrVoxels *voxels, FrCell cell) {
    const FrBrick *brick = fr_voxels_brick(voxels, cell);
    unsigned bit = fr_voxels_bit(cell), layer = (unsigned)cell.at[2] & 7;
    if (brick == NULL || (brick->taken[layer] >> bit & 1) == 0) {
        return FR_VOXEL_FREE;
    }
    if (brick->solid[layer] >> bit & 1) {
        return brick->ground[layer] >> bit & 1 ? FR_VOXEL_GROUND : FR_VOXEL_SOLID;
    }
    return *fr_voxels_at(brick, cell);
}
