// The octree of ray references (Van Haevre, Di Fiore, Bekaert, Van Reeth 2004, section 3): split
// around refinement points, references pushed down from parents, empty cells removed.
#include "light/octree.h"

#include "light/segments.h"

#include <string.h>

FrOctree *fr_octree_new(void) {
    FrOctree *tree = g_new0(FrOctree, 1);
    tree->cells = g_array_new(FALSE, FALSE, sizeof(FrCell));
    tree->free_cells = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    tree->unfilled = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    return tree;
}

static FrCell *cell_at(const FrOctree *tree, uint32_t cell) {
    return &g_array_index(tree->cells, FrCell, cell);
}

static void drop_cells(FrOctree *tree) {
    for (guint i = 0; i < tree->cells->len; i++) {
        g_free(cell_at(tree, i)->rays.at);
    }
    g_array_set_size(tree->cells, 0);
    g_array_set_size(tree->free_cells, 0);
    g_array_set_size(tree->unfilled, 0);
}

void fr_octree_free(FrOctree *tree) {
    if (tree == NULL) {
        return;
    }
    drop_cells(tree);
    g_array_unref(tree->cells);
    g_array_unref(tree->free_cells);
    g_array_unref(tree->unfilled);
    g_free(tree);
}

static FrCell new_cell(uint32_t parent, uint16_t level) {
    FrCell cell = {.parent = parent, .level = level};
    memset(cell.child, 0xff, sizeof cell.child); // FR_NONE
    return cell;
}

void fr_octree_reset(FrOctree *tree, const double min[3], double width) {
    drop_cells(tree);
    FrCell root = new_cell(FR_NONE, 0);
    g_array_append_val(tree->cells, root);
    memcpy(tree->min, min, sizeof tree->min);
    tree->width = width;
}

// Which child of a cell of level `level` leads to a cell `at` of level `deepest`.
static int octant(const uint32_t at[3], uint32_t level, uint32_t deepest) {
    uint32_t shift = deepest - level - 1;
    return (int)((at[0] >> shift & 1) | (at[1] >> shift & 1) << 1 | (at[2] >> shift & 1) << 2);
}

uint32_t fr_octree_find(const FrOctree *tree, uint32_t level, const uint32_t at[3]) {
    uint32_t cell = 0;
    for (uint32_t l = 0; l < level && cell != FR_NONE; l++) {
        cell = cell_at(tree, cell)->child[octant(at, l, level)];
    }
    return cell;
}

static uint32_t make_child(FrOctree *tree, uint32_t parent, int which) {
    uint32_t cell = tree->cells->len;
    if (tree->free_cells->len > 0) {
        cell = g_array_index(tree->free_cells, uint32_t, tree->free_cells->len - 1);
        g_array_set_size(tree->free_cells, tree->free_cells->len - 1);
    } else {
        g_array_set_size(tree->cells, cell + 1);
    }
    FrCell *above = cell_at(tree, parent);
    FrCell *made = cell_at(tree, cell);
    *made = new_cell(parent, (uint16_t)(above->level + 1));
    for (int c = 0; c < 3; c++) {
        made->at[c] = above->at[c] << 1 | (uint32_t)(which >> c & 1);
    }
    above->child[which] = cell;
    g_array_append_val(tree->unfilled, cell);
    return cell;
}

uint32_t fr_octree_want(FrOctree *tree, uint32_t level, const uint32_t at[3]) {
    uint32_t cell = 0;
    for (uint32_t l = 0; l < level; l++) {
        cell_at(tree, cell)->round = tree->round;
        int which = octant(at, l, level);
        uint32_t child = cell_at(tree, cell)->child[which];
        cell = child != FR_NONE ? child : make_child(tree, cell, which);
    }
    cell_at(tree, cell)->round = tree->round;
    return cell;
}

/// Children of one cell that rays are sieved into.
typedef struct Litter {
    uint32_t parent;
    uint32_t children; ///< bits
    uint16_t level;    ///< of the parent
    uint32_t begin;    ///< of the parent's list; the rays before are known to the children
} Litter;

typedef struct Sieving {
    const FrOctree *tree;
    const FrPaths *paths;
    const Litter *litters;
    const uint32_t *slots; ///< what comes in at the root; NULL: all rays
    uint32_t slot_count;
} Sieving;

static void middle_of(const FrOctree *tree, const FrCell *cell, double middle[3]) {
    double width = fr_octree_cell_width(tree, cell->level);
    for (int c = 0; c < 3; c++) {
        middle[c] = tree->min[c] + (cell->at[c] + 0.5) * width;
    }
}

enum { AHEAD = 24 }; ///< rays that are fetched from memory before they are needed

static inline void fetch(const FrRay *ray) {
    __builtin_prefetch(ray);
    __builtin_prefetch(&ray->bounce); // a ray may lie in two lines of the cache
}

static void sieve_litter(const Sieving *sieving, const Litter *litter) {
    const FrOctree *tree = sieving->tree;
    const FrCell *above = cell_at(tree, litter->parent);
    bool is_root = litter->parent == 0;
    const uint32_t *slots = is_root ? sieving->slots : above->rays.at;
    uint32_t count = is_root ? sieving->slot_count : above->rays.count;
    float quarter = (float)(0.25 * fr_octree_cell_width(tree, above->level));
    double middle[3];
    FrSegments segments;
    uint32_t held[FR_SEGMENTS];
    int32_t octants[FR_SEGMENTS];
    middle_of(tree, above, middle);
    for (uint32_t i = litter->begin; i < count;) {
        uint32_t n = 0;
        for (; i < count && n < FR_SEGMENTS; i++) {
            uint32_t slot = slots != NULL ? slots[i] : i;
            const FrRay *ray = &sieving->paths->rays[slot];
            if (slots != NULL && i + AHEAD < count) {
                fetch(&sieving->paths->rays[slots[i + AHEAD]]);
            }
            if (ray->photon != FR_NONE) {
                fr_segments_set(&segments, n, ray, fr_octree_reach(tree, ray), middle, quarter);
                held[n++] = slot;
            }
        }
        fr_segments_octants(&segments, n, quarter, octants);
        for (uint32_t k = 0; k < n; k++) {
            for (uint32_t bits = (uint32_t)octants[k] & litter->children; bits != 0;
                 bits &= bits - 1) {
                FrCell *child = cell_at(tree, above->child[g_bit_nth_lsf(bits, -1)]);
                fr_slots_push(&child->rays, held[k]);
            }
        }
    }
}

static void sieve_litters(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Sieving *sieving = data;
    for (size_t i = begin; i < end; i++) {
        sieve_litter(sieving, &sieving->litters[i]);
    }
}

// A segment passes through four octants of a cell, rarely through more.
enum { MOST_OCTANTS = 4 };

// What the rays and all lists may take once these litters are filled.
static FrStatus check_bytes(const Sieving *sieving, guint litter_count, const FrContext *context) {
    uint64_t references = 0;
    for (guint i = 0; i < litter_count; i++) {
        const Litter *litter = &sieving->litters[i];
        uint32_t count = litter->parent == 0 ? sieving->slot_count
                                             : cell_at(sieving->tree, litter->parent)->rays.count;
        uint64_t children = (uint64_t)MIN(__builtin_popcount(litter->children), MOST_OCTANTS);
        references += (count - litter->begin) * children;
    }
    uint64_t bytes = fr_paths_bytes(sieving->paths) + fr_octree_bytes(sieving->tree) +
                     references * sizeof(uint32_t);
    return fr_limit_check(bytes, context->limits.bytes, "bytes", "the light", sieving->paths->span,
                          context->diags);
}

// Level by level, as the list of a cell must be whole before its children are filled from it.
static FrStatus sieve(FrOctree *tree, const FrPaths *paths, const uint32_t *slots,
                      uint32_t slot_count, const GArray *litters, const FrContext *context) {
    for (guint next = 0, end; next < litters->len; next = end) {
        const Litter *first = &g_array_index(litters, Litter, next);
        for (end = next + 1;
             end < litters->len && g_array_index(litters, Litter, end).level == first->level;) {
            end++;
        }
        Sieving sieving = {tree, paths, first, slots, slot_count};
        FrStatus status = check_bytes(&sieving, end - next, context);
        if (status != FR_OK) {
            return status;
        }
        fr_parallel_for(context->pool, end - next, 1, sieve_litters, &sieving, NULL);
    }
    return FR_OK;
}

static int compare_litters(const void *a, const void *b) {
    const Litter *left = a, *right = b;
    if (left->level != right->level) {
        return left->level < right->level ? -1 : 1;
    }
    return left->parent < right->parent ? -1 : left->parent > right->parent;
}

FrStatus fr_octree_fill(FrOctree *tree, const FrPaths *paths, const FrContext *context) {
    GArray *litters = g_array_new(FALSE, FALSE, sizeof(Litter));
    for (guint i = 0; i < tree->unfilled->len; i++) {
        uint32_t index = g_array_index(tree->unfilled, uint32_t, i);
        FrCell *cell = cell_at(tree, index);
        const FrCell *above = cell_at(tree, cell->parent);
        Litter litter = {.parent = cell->parent, .level = above->level};
        for (uint32_t k = 0; k < 8; k++) {
            litter.children |= above->child[k] == index ? 1u << k : 0;
        }
        cell->rays.count = 0;
        g_array_append_val(litters, litter);
    }
    g_array_sort(litters, compare_litters);
    guint kept = 0;
    for (guint i = 0; i < litters->len; i++) {
        const Litter *litter = &g_array_index(litters, Litter, i);
        Litter *last = kept > 0 ? &g_array_index(litters, Litter, kept - 1) : NULL;
        if (last != NULL && last->parent == litter->parent) {
            last->children |= litter->children;
        } else {
            g_array_index(litters, Litter, kept++) = *litter;
        }
    }
    g_array_set_size(litters, kept);
    FrStatus status = sieve(tree, paths, NULL, paths->count, litters, context);
    g_array_unref(litters);
    if (status == FR_OK) {
        g_array_set_size(tree->unfilled, 0);
    }
    return status;
}

void fr_octree_next_round(FrOctree *tree) {
    tree->round++;
}

static void free_cell(FrOctree *tree, uint32_t index) {
    FrCell *cell = cell_at(tree, index);
    FrCell *above = cell_at(tree, cell->parent);
    for (int i = 0; i < 8; i++) {
        if (above->child[i] == index) {
            above->child[i] = FR_NONE;
        }
    }
    g_free(cell->rays.at);
    cell->rays = (FrSlots){0};
    cell->is_free = true;
    g_array_append_val(tree->free_cells, index);
}

// A cell that was wanted has wanted its parents too, so what goes is whole branches.
void fr_octree_prune(FrOctree *tree) {
    for (guint i = 1; i < tree->cells->len; i++) {
        const FrCell *cell = cell_at(tree, i);
        if (!cell->is_free && cell->round != tree->round) {
            free_cell(tree, i);
        }
    }
}

/// The cells, and which rays have changed.
typedef struct Dropping {
    const FrOctree *tree;
    const uint64_t *stale; ///< a bit for each slot
} Dropping;

// Every filled cell drops what has changed.
static void drop_stale(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Dropping *dropping = data;
    for (size_t i = begin; i < end; i++) {
        FrSlots *rays = &cell_at(dropping->tree, (uint32_t)i)->rays;
        uint32_t kept = 0;
        for (uint32_t k = 0; k < rays->count; k++) {
            uint32_t slot = rays->at[k];
            rays->at[kept] = slot;
            kept += (dropping->stale[slot / 64] >> slot % 64 & 1) == 0;
        }
        rays->count = kept;
    }
}

static void drop_all_stale(FrOctree *tree, const FrPaths *paths, FrPool *pool) {
    const GArray *changed[2] = {paths->fresh, paths->free_slots};
    uint64_t *stale = g_new0(uint64_t, paths->count / 64 + 1);
    for (int a = 0; a < 2; a++) {
        for (guint i = 0; i < changed[a]->len; i++) {
            uint32_t slot = g_array_index(changed[a], uint32_t, i);
            stale[slot / 64] |= (uint64_t)paths->rays[slot].is_stale << slot % 64;
        }
    }
    Dropping dropping = {tree, stale};
    fr_parallel_for(pool, tree->cells->len, 16, drop_stale, &dropping, NULL);
    g_free(stale);
}

// The rays that are new go down from the root; of the other cells' lists they are the end.
static FrStatus add_fresh(FrOctree *tree, const FrPaths *paths, const FrContext *context) {
    GArray *litters = g_array_new(FALSE, FALSE, sizeof(Litter));
    for (guint i = 0; i < tree->cells->len; i++) {
        const FrCell *cell = cell_at(tree, i);
        Litter litter = {.parent = i, .level = cell->level, .begin = cell->rays.count};
        for (uint32_t k = 0; k < 8 && !cell->is_free; k++) {
            litter.children |= cell->child[k] != FR_NONE ? 1u << k : 0;
        }
        if (litter.children != 0) {
            g_array_append_val(litters, litter);
        }
    }
    g_array_sort(litters, compare_litters);
    FrStatus status = sieve(tree, paths, (const uint32_t *)(void *)paths->fresh->data,
                            paths->fresh->len, litters, context);
    g_array_unref(litters);
    return status;
}

FrStatus fr_octree_update(FrOctree *tree, const FrPaths *paths, const FrContext *context) {
    if (paths->is_all_new) {
        for (guint i = 1; i < tree->cells->len; i++) {
            if (!cell_at(tree, i)->is_free) {
                g_array_append_val(tree->unfilled, i);
            }
        }
        return fr_octree_fill(tree, paths, context);
    }
    if (tree->cells->len > 1 && paths->fresh->len + paths->free_slots->len > 0) {
        drop_all_stale(tree, paths, context->pool);
        return add_fresh(tree, paths, context);
    }
    return FR_OK;
}

uint64_t fr_octree_cell_count(const FrOctree *tree) {
    return tree->cells->len - tree->free_cells->len;
}

uint64_t fr_octree_reference_count(const FrOctree *tree) {
    uint64_t count = 0;
    for (guint i = 1; i < tree->cells->len; i++) {
        count += cell_at(tree, i)->rays.count;
    }
    return count;
}

uint64_t fr_octree_bytes(const FrOctree *tree) {
    return tree->cells->len * sizeof(FrCell) + fr_octree_reference_count(tree) * sizeof(uint32_t);
}
