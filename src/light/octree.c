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

/// A segment made ready for tests against boxes.
typedef struct Line {
    double middle[3], half[3]; ///< half: from the middle to an end, without sign
    double way[3], size[3];    ///< direction, with and without sign
} Line;

static inline Line line_of(const FrRay *ray, double reach) {
    Line line;
    for (int c = 0; c < 3; c++) {
        line.way[c] = (double)ray->direction[c];
        line.size[c] = fabs(line.way[c]);
        line.middle[c] = (double)ray->origin[c] + 0.5 * reach * line.way[c];
        line.half[c] = 0.5 * reach * line.size[c];
    }
    return line;
}

// A segment and a box, by separating axes (Gottschalk, Lin, Manocha 1996); true where in doubt.
static inline bool passes(const Box *box, const Line *line) {
    const double *w = line->way, *a = line->size;
    double m[3];
    for (int c = 0; c < 3; c++) {
        m[c] = line->middle[c] - box->middle[c];
        if (fabs(m[c]) > box->half + line->half[c]) {
            return false;
        }
    }
    return fabs(m[1] * w[2] - m[2] * w[1]) <= box->half * (a[1] + a[2]) &&
           fabs(m[2] * w[0] - m[0] * w[2]) <= box->half * (a[2] + a[0]) &&
           fabs(m[0] * w[1] - m[1] * w[0]) <= box->half * (a[0] + a[1]);
}

enum { CHILDREN_AT_ONCE = 4 };

/// Some new cells of one parent, which are filled together.
typedef struct Litter {
    uint32_t parent, count;
    uint32_t cells[CHILDREN_AT_ONCE];
} Litter;

typedef struct Filling {
    const FrOctree *tree;
    const FrPaths *paths;
    const Litter *litters;
} Filling;

// Sieves the parent's rays; those of the root are all.
static void fill_litter(const FrOctree *tree, const Litter *litter, const FrPaths *paths) {
    const FrSlots *above = litter->parent != 0 ? &cell_at(tree, litter->parent)->rays : NULL;
    uint32_t count = above != NULL ? above->count : paths->count;
    FrSlots found[CHILDREN_AT_ONCE];
    Box boxes[CHILDREN_AT_ONCE];
    for (uint32_t k = 0; k < litter->count; k++) {
        FrCell *cell = cell_at(tree, litter->cells[k]);
        boxes[k] = box_of(tree, cell);
        found[k] = cell->rays;
        found[k].count = 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t slot = above != NULL ? above->at[i] : i;
        const FrRay *ray = &paths->rays[slot];
        if (ray->photon == FR_NONE) {
            continue;
        }
        Line line = line_of(ray, fr_octree_reach(tree, ray));
        for (uint32_t k = 0; k < litter->count; k++) {
            if (passes(&boxes[k], &line)) {
                fr_slots_push(&found[k], slot);
            }
        }
    }
    for (uint32_t k = 0; k < litter->count; k++) {
        cell_at(tree, litter->cells[k])->rays = found[k];
    }
}

static void fill_litters(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Filling *filling = data;
    for (size_t i = begin; i < end; i++) {
        fill_litter(filling->tree, &filling->litters[i], filling->paths);
    }
}

static int compare_by_parent(const void *a, const void *b, void *user) {
    const FrOctree *tree = user;
    const FrCell *left = cell_at(tree, *(const uint32_t *)a);
    const FrCell *right = cell_at(tree, *(const uint32_t *)b);
    if (left->level != right->level) {
        return left->level < right->level ? -1 : 1;
    }
    return left->parent < right->parent ? -1 : left->parent > right->parent;
}

// The next cells of one level, in litters; `*next` is moved on.
static GArray *take_level(const FrOctree *tree, guint *next) {
    GArray *litters = g_array_new(FALSE, FALSE, sizeof(Litter));
    const GArray *cells = tree->unfilled;
    uint16_t level = cell_at(tree, g_array_index(cells, uint32_t, *next))->level;
    Litter litter = {.count = 0};
    for (; *next < cells->len; ++*next) {
        uint32_t index = g_array_index(cells, uint32_t, *next);
        const FrCell *cell = cell_at(tree, index);
        if (cell->level != level) {
            break;
        }
        if (litter.count > 0 &&
            (litter.parent != cell->parent || litter.count == CHILDREN_AT_ONCE)) {
            g_array_append_val(litters, litter);
            litter.count = 0;
        }
        litter.parent = cell->parent;
        litter.cells[litter.count++] = index;
    }
    g_array_append_val(litters, litter);
    return litters;
}

void fr_octree_fill(FrOctree *tree, const FrPaths *paths, FrPool *pool) {
    g_array_sort_with_data(tree->unfilled, compare_by_parent, tree);
    for (guint next = 0; next < tree->unfilled->len;) {
        GArray *litters = take_level(tree, &next);
        Filling filling = {tree, paths, (const Litter *)(void *)litters->data};
        fr_parallel_for(pool, litters->len, 1, fill_litters, &filling, NULL);
        g_array_unref(litters);
    }
    g_array_set_size(tree->unfilled, 0);
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

// Every filled cell drops what has changed.
static void drop_stale(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Filling *filling = data;
    for (size_t i = begin; i < end; i++) {
        FrSlots *rays = &cell_at(filling->tree, (uint32_t)i)->rays;
        uint32_t kept = 0;
        for (uint32_t k = 0; k < rays->count; k++) {
            if (!filling->paths->rays[rays->at[k]].is_stale) {
                rays->at[kept++] = rays->at[k];
            }
        }
        rays->count = kept;
    }
}

// As many calls deep as the tree has levels.
static void insert(FrOctree *tree, uint32_t index, const Line *line, uint32_t slot) {
    const FrCell *cell = cell_at(tree, index);
    for (int i = 0; i < 8; i++) {
        if (cell->child[i] == FR_NONE) {
            continue;
        }
        FrCell *child = cell_at(tree, cell->child[i]);
        Box box = box_of(tree, child);
        if (passes(&box, line)) {
            fr_slots_push(&child->rays, slot);
            insert(tree, cell->child[i], line, slot);
        }
    }
}

void fr_octree_update(FrOctree *tree, const FrPaths *paths, FrPool *pool) {
    if (paths->is_all_new) {
        for (guint i = 1; i < tree->cells->len; i++) {
            if (!cell_at(tree, i)->is_free) {
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
        Line line = line_of(ray, fr_octree_reach(tree, ray));
        insert(tree, 0, &line, slot);
    }
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
