/// @file octree.h
/// An octree of references to rays, grown on demand around the places that were asked for.
/// Private to light.
///
/// A cell refers to every ray that passes through it. The root, a cube about the scene, stands for
/// all rays and keeps no list. Cells exist only down to where they were wanted; the list of a new
/// one is sieved from its parent's. Which rays a cell refers to depends on nothing but the rays;
/// their order in the list does not matter to anyone.
#pragma once

#include "light/paths.h"

typedef struct FrSlots {
    uint32_t *at;
    uint32_t count, capacity;
} FrSlots;

static inline void fr_slots_push(FrSlots *slots, uint32_t slot) {
    if (slots->count == slots->capacity) {
        slots->capacity = MAX(16, slots->capacity + slots->capacity / 2);
        slots->at = g_renew(uint32_t, slots->at, slots->capacity);
    }
    slots->at[slots->count++] = slot;
}

typedef struct FrCell {
    uint32_t parent, child[8]; ///< FR_NONE
    uint32_t at[3];            ///< in cells of its level
    uint16_t level;            ///< 0: the root
    uint32_t round;            ///< in which it was last wanted
    bool is_free;
    FrSlots rays; ///< empty for the root
} FrCell;

typedef struct FrOctree {
    GArray *cells; ///< FrCell; the root first
    GArray *free_cells;
    GArray *unfilled; ///< uint32_t, in the order in which they were made
    double min[3], width;
    uint32_t round;
} FrOctree;

FrOctree *fr_octree_new(void);
void fr_octree_free(FrOctree *tree);
/// Makes the root a cube; drops all cells.
void fr_octree_reset(FrOctree *tree, const double min[3], double width);
static inline double fr_octree_cell_width(const FrOctree *tree, uint32_t level) {
    return ldexp(tree->width, -(int)level);
}
/// The cell of a level; FR_NONE if there is none.
uint32_t fr_octree_find(const FrOctree *tree, uint32_t level, const uint32_t at[3]);
/// The same, made if need be and kept through this round. Its list is there after
/// fr_octree_fill().
uint32_t fr_octree_want(FrOctree *tree, uint32_t level, const uint32_t at[3]);
/// Makes the lists of new cells, level by level. FR_ERR_LIMIT if rays and references may take more
/// than FrLimits.bytes; then cells are still to be filled.
FR_MUST_USE FrStatus fr_octree_fill(FrOctree *tree, const FrPaths *paths, const FrContext *context);
/// Begins a round: what is not wanted in it may go.
void fr_octree_next_round(FrOctree *tree);
/// Removes the cells that were not wanted in this round.
void fr_octree_prune(FrOctree *tree);
/// Follows the changes of the paths since they were settled. Errors as above.
FR_MUST_USE FrStatus fr_octree_update(FrOctree *tree, const FrPaths *paths,
                                      const FrContext *context);
uint64_t fr_octree_cell_count(const FrOctree *tree);
uint64_t fr_octree_reference_count(const FrOctree *tree);
uint64_t fr_octree_bytes(const FrOctree *tree);

/// How far a ray has to be followed so that nothing of it within the root is left out.
static inline double fr_octree_reach(const FrOctree *tree, const FrRay *ray) {
    if (ray->distance < INFINITY) {
        return ray->distance;
    }
    double reach = 2.0 * tree->width;
    for (int c = 0; c < 3; c++) {
        reach += fabs((double)ray->origin[c] - (tree->min[c] + 0.5 * tree->width));
    }
    return reach;
}
