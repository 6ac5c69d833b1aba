// The octree of ray references (Van Haevre, Di Fiore, Bekaert, Van Reeth 2004, section 3): split
// around refinement points, references pushed down from parents, empty cells removed.
#include "light/octree.h"

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
        GArray *rays = cell_at(tree, i)->rays;
        if (rays != NULL) {
            g_array_unref(rays);
        }
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
    made->rays = g_array_new(FALSE, FALSE, sizeof(uint32_t));
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

/// A cell as a box, and slack for rounding.
typedef struct Box {
    double middle[3], half;
} Box;

static Box box_of(const FrOctree *tree, const FrCell *cell) {
    Box box;
    double width = fr_octree_cell_width(tree, cell->level);
    for (int c = 0; c < 3; c++) {
        box.middle[c] = tree->min[c] + (cell->at[c] + 0.5) * width;
    }
    box.half = 0.5 * width + 1e-9 * tree->width;
    return box;
}

// A segment and a box, by separating axes (Gottschalk, Lin, Manocha 1996); true where in doubt.
static inline bool passes(const Box *box, const FrRay *ray, double reach) {
    double w[3], m[3], a[3];
    for (int c = 0; c < 3; c++) {
        w[c] = (double)ray->direction[c];
        a[c] = fabs(w[c]);
        m[c] = (double)ray->origin[c] - box->middle[c] + 0.5 * reach * w[c];
        if (fabs(m[c]) > box->half + 0.5 * reach * a[c]) {
            return false;
        }
    }
    return fabs(m[1] * w[2] - m[2] * w[1]) <= box->half * (a[1] + a[2]) &&
           fabs(m[2] * w[0] - m[0] * w[2]) <= box->half * (a[2] + a[0]) &&
           fabs(m[0] * w[1] - m[1] * w[0]) <= box->half * (a[0] + a[1]);
}

// Sieves the parent's rays; below the root, which stands for all.
static void fill_cell(const FrOctree *tree, FrCell *cell, const FrPaths *paths) {
    Box box = box_of(tree, cell);
    const GArray *above = cell_at(tree, cell->parent)->rays;
    uint32_t count = above != NULL ? above->len : paths->count;
    g_array_set_size(cell->rays, 0);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t slot = above != NULL ? g_array_index(above, uint32_t, i) : i;
        const FrRay *ray = &paths->rays[slot];
        if (ray->photon != FR_NONE && passes(&box, ray, fr_octree_reach(tree, ray))) {
            g_array_append_val(cell->rays, slot);
        }
    }
}

typedef struct Filling {
    const FrOctree *tree;
    const FrPaths *paths;
    const uint32_t *cells;
} Filling;

static void fill_cells(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Filling *filling = data;
    for (size_t i = begin; i < end; i++) {
        fill_cell(filling->tree, cell_at(filling->tree, filling->cells[i]), filling->paths);
    }
}

enum { MOST_LEVELS = 32 };

void fr_octree_fill(FrOctree *tree, const FrPaths *paths, FrPool *pool) {
    GArray *levels[MOST_LEVELS] = {NULL};
    for (guint i = 0; i < tree->unfilled->len; i++) {
        uint32_t cell = g_array_index(tree->unfilled, uint32_t, i);
        uint16_t level = cell_at(tree, cell)->level;
        if (levels[level] == NULL) {
            levels[level] = g_array_new(FALSE, FALSE, sizeof(uint32_t));
        }
        g_array_append_val(levels[level], cell);
    }
    g_array_set_size(tree->unfilled, 0);
    for (int level = 1; level < MOST_LEVELS; level++) {
        if (levels[level] != NULL) {
            Filling filling = {tree, paths, (const uint32_t *)(void *)levels[level]->data};
            fr_parallel_for(pool, levels[level]->len, 1, fill_cells, &filling, NULL);
            g_array_unref(levels[level]);
        }
    }
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
    g_array_unref(cell->rays);
    cell->rays = NULL;
    g_array_append_val(tree->free_cells, index);
}

// A cell that was wanted has wanted its parents too, so what goes is whole branches.
void fr_octree_prune(FrOctree *tree) {
    for (guint i = 1; i < tree->cells->len; i++) {
        const FrCell *cell = cell_at(tree, i);
        if (cell->rays != NULL && cell->round != tree->round) {
            free_cell(tree, i);
        }
    }
}

// Every filled cell drops what has changed.
static void drop_stale(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Filling *filling = data;
    for (size_t i = begin; i < end; i++) {
        GArray *rays = cell_at(filling->tree, (uint32_t)i)->rays;
        guint kept = 0;
        for (guint k = 0; rays != NULL && k < rays->len; k++) {
            uint32_t slot = g_array_index(rays, uint32_t, k);
            if (!filling->paths->rays[slot].is_stale) {
                g_array_index(rays, uint32_t, kept++) = slot;
            }
        }
        if (rays != NULL) {
            g_array_set_size(rays, kept);
        }
    }
}

static void insert(FrOctree *tree, uint32_t index, const FrRay *ray, uint32_t slot, double reach) {
    const FrCell *cell = cell_at(tree, index);
    for (int i = 0; i < 8; i++) {
        if (cell->child[i] == FR_NONE) {
            continue;
        }
        FrCell *child = cell_at(tree, cell->child[i]);
        Box box = box_of(tree, child);
        if (passes(&box, ray, reach)) {
            g_array_append_val(child->rays, slot);
            insert(tree, cell->child[i], ray, slot, reach); // at most MOST_LEVELS deep
        }
    }
}

void fr_octree_update(FrOctree *tree, const FrPaths *paths, FrPool *pool) {
    if (paths->is_all_new) {
        for (guint i = 1; i < tree->cells->len; i++) {
            if (cell_at(tree, i)->rays != NULL) {
                g_array_append_val(tree->unfilled, i);
            }
        }
        fr_octree_fill(tree, paths, pool);
        return;
    }
    if (tree->cells->len <= 1) {
        return;
    }
    Filling filling = {.tree = tree, .paths = paths};
    fr_parallel_for(pool, tree->cells->len, 16, drop_stale, &filling, NULL);
    for (guint i = 0; i < paths->fresh->len; i++) {
        uint32_t slot = g_array_index(paths->fresh, uint32_t, i);
        const FrRay *ray = &paths->rays[slot];
        insert(tree, 0, ray, slot, fr_octree_reach(tree, ray));
    }
}

uint64_t fr_octree_cell_count(const FrOctree *tree) {
    return tree->cells->len - tree->free_cells->len;
}

uint64_t fr_octree_reference_count(const FrOctree *tree) {
    uint64_t count = 0;
    for (guint i = 1; i < tree->cells->len; i++) {
        const FrCell *cell = cell_at(tree, i);
        count += cell->rays != NULL ? cell->rays->len : 0;
    }
    return count;
}

uint64_t fr_octree_bytes(const FrOctree *tree) {
    return tree->cells->len * sizeof(FrCell) + fr_octree_reference_count(tree) * sizeof(uint32_t);
}
