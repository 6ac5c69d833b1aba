// What the density of rays keeps, for who wants to see it: ways of photons, cells of the octree.
#include "light/density.h"

static const FrDensity *density_in(const FrLight *light) {
    return (const FrDensity *)(const void *)light;
}

static void add_ray(const FrDensity *density, const FrRay *ray, GArray *rays) {
    double reach = fr_octree_reach(density->tree, ray);
    FrLightRay shown = {
        .photon = ray->photon, .bounce = ray->bounce, .is_met = ray->distance < INFINITY};
    if (!shown.is_met) { // as far as the scene reaches
        reach = fmin(reach, density->tree->width);
    }
    for (int c = 0; c < 3; c++) {
        shown.from.raw[c] = ray->origin[c];
        shown.to.raw[c] = (float)((double)ray->origin[c] + reach * (double)ray->direction[c]);
    }
    g_array_append_val(rays, shown);
}

void fr_density_rays(const FrLight *light, uint32_t most, GArray *rays) {
    const FrDensity *density = density_in(light);
    const FrPaths *paths = density->paths;
    uint32_t count = density->is_whole ? MIN(most, paths->photon_count) : 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t photon = (uint32_t)((uint64_t)i * paths->photon_count / count);
        for (uint32_t r = paths->first[photon]; r != FR_NONE; r = paths->rays[r].next) {
            add_ray(density, &paths->rays[r], rays);
        }
    }
}

static bool is_innermost(const FrCell *cell) {
    for (int i = 0; i < 8; i++) {
        if (cell->child[i] != FR_NONE) {
            return false;
        }
    }
    return true;
}

// Whether a cell is one of those that stand for all where none deeper than `deepest` is shown.
static bool is_shown(const FrCell *cell, uint32_t deepest) {
    return !cell->is_free &&
           (cell->level == deepest || (cell->level < deepest && is_innermost(cell)));
}

static uint32_t count_shown(const FrOctree *tree, uint32_t deepest) {
    uint32_t count = 0;
    for (guint i = 0; i < tree->cells->len; i++) {
        count += is_shown(&g_array_index(tree->cells, FrCell, i), deepest);
    }
    return count;
}

void fr_density_cells(const FrLight *light, uint32_t most, GArray *cells) {
    const FrDensity *density = density_in(light);
    const FrOctree *tree = density->tree;
    uint32_t deepest = 0;
    for (guint i = 0; i < tree->cells->len; i++) {
        deepest = MAX(deepest, g_array_index(tree->cells, FrCell, i).level);
    }
    while (deepest > 0 && count_shown(tree, deepest) > most) {
        deepest--;
    }
    for (guint i = 0; density->is_whole && i < tree->cells->len; i++) {
        const FrCell *cell = &g_array_index(tree->cells, FrCell, i);
        if (!is_shown(cell, deepest)) {
            continue;
        }
        FrLightCell shown = {.width = fr_octree_cell_width(tree, cell->level),
                             .level = cell->level,
                             .ray_count = cell->level == 0
                                              ? (uint32_t)fr_paths_ray_count(density->paths)
                                              : cell->rays.count};
        for (int c = 0; c < 3; c++) {
            shown.min[c] = tree->min[c] + shown.width * cell->at[c];
        }
        g_array_append_val(cells, shown);
    }
}
