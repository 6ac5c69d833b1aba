// Seeds that do not grow as others, or what is around them, leave no room for a first internode.
#include "growth/engine.h"

#include <math.h>
#include <stdlib.h>

// ---- after steps: plants of no internode --------------------------------------------------------

static bool is_bare(const FrGrownPlant *plant) {
    return plant->place == FR_PLACE_FREE && !plant->is_dead && plant->nodes.count == 0 &&
           plant->axis_count == 1 && plant->axes[0].internodes == 0;
}

/// Those that are told of their seeds already: an obstacle, the arena or the envelope is in the
/// way.
static bool *find_told(const FrGrowth *growth, const FrSeed *seeds) {
    const FrGrowthSetup setup = {.params = growth->params,
                                 .obstacles = growth->obstacles,
                                 .obstacle_count = growth->obstacle_count};
    return fr_seeds_find_hindered(&setup, growth->species, growth->voxels->cell, growth->up, seeds,
                                  growth->plant_count);
}

static void tell_bare(const FrGrowth *growth, uint32_t species, const FrSeed *seeds,
                      const bool *is_told, const FrContext *context) {
    FrMisplaced bare = {0};
    uint32_t count = 0;
    for (uint32_t i = 0; i < growth->plant_count; i++) {
        if (growth->plants[i].seed.species == species) {
            count++;
            if (is_bare(&growth->plants[i]) && !is_told[i]) {
                fr_misplaced_note(&bare, &seeds[i]);
            }
        }
    }
    if (bare.count > 0) {
        const FrSeed *first = bare.first;
        fr_diags_add(context->diags, FR_WARNING, "no-internode", first->span,
                     "%u of %u plants of '%s' have not made one internode, the first of them at "
                     "%g,%g,%g: no way from the seed was free within its envelope and the arena",
                     bare.count, count, growth->species[species].name, first->at[0], first->at[1],
                     first->at[2]);
    }
}

void fr_growth_tell_bare(const FrGrowth *growth, const FrSeed *seeds, const FrContext *context) {
    bool has_any = false;
    for (uint32_t i = 0; i < growth->plant_count && growth->step > 0; i++) {
        has_any |= is_bare(&growth->plants[i]);
    }
    if (has_any) {
        bool *is_told = find_told(growth, seeds);
        for (uint32_t s = 0; s < growth->species_count; s++) {
            tell_bare(growth, s, seeds, is_told, context);
        }
        g_free(is_told);
    }
}

// ---- before: seeds on each other ----------------------------------------------------------------

/// A seed in a cube as wide as it looks around.
typedef struct Cube {
    double at[3]; ///< numbers of the cube
    const FrSeed *seed;
} Cube;

static int compare_cubes(const void *a, const void *b) {
    const Cube *p = a, *q = b;
    int order = 0;
    for (int axis = 0; axis < 3 && order == 0; axis++) {
        order = (p->at[axis] > q->at[axis]) - (p->at[axis] < q->at[axis]);
    }
    return order;
}

/// The first of sorted cubes that is not before one.
static uint32_t first_from(const Cube *cubes, uint32_t count, Cube least) {
    uint32_t low = 0, high = count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (compare_cubes(&cubes[middle], &least) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static bool is_near(const FrSeed *a, const FrSeed *b, double reach) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        square += (a->at[axis] - b->at[axis]) * (a->at[axis] - b->at[axis]);
    }
    return a != b && square < reach * reach;
}

/// Cubes that are above each other follow each other.
static bool has_neighbour(const Cube *cubes, uint32_t count, const Cube *own, double reach) {
    bool has_any = false;
    for (int column = 0; column < 9 && !has_any; column++) {
        double x = own->at[0] + column / 3 - 1, y = own->at[1] + column % 3 - 1;
        uint32_t i = first_from(cubes, count, (Cube){{x, y, own->at[2] - 1}, NULL});
        for (; i < count && cubes[i].at[0] == x && cubes[i].at[1] == y &&
               cubes[i].at[2] <= own->at[2] + 1 && !has_any;
             i++) {
            has_any = is_near(own->seed, cubes[i].seed, reach);
        }
    }
    return has_any;
}

/// Half a cell: two first internodes that begin in one cell end in one box in most directions.
static double room_of(const FrReadySpecies *species, double width) {
    return species->params.collide ? width / 2 : 0;
}

void fr_seeds_tell_crowded(const FrReadySpecies *species, double width, const FrSeed *seeds,
                           uint32_t count, const FrContext *context) {
    Cube *cubes = g_new(Cube, (size_t)count + 1);
    for (uint32_t i = 0; i < count; i++) {
        const double *at = seeds[i].at;
        cubes[i] =
            (Cube){{floor(at[0] / width), floor(at[1] / width), floor(at[2] / width)}, &seeds[i]};
    }
    qsort(cubes, count, sizeof *cubes, compare_cubes);
    const FrSeed *first = NULL;
    uint32_t crowded = 0;
    for (uint32_t i = 0; i < count; i++) {
        const FrSeed *seed = cubes[i].seed;
        double reach = room_of(&species[seed->species], width);
        if (reach > 0 && has_neighbour(cubes, count, &cubes[i], reach)) {
            crowded++;
            first = first == NULL || seed < first ? seed : first;
        }
    }
    g_free(cubes);
    if (first != NULL) {
        fr_diags_add(context->diags, FR_WARNING, "seeds-together", first->span,
                     "%u of %u seeds stand so near to others that their first internodes are in "
                     "each other's way, the first of them at %g,%g,%g: some of them may not grow",
                     crowded, count, first->at[0], first->at[1], first->at[2]);
    }
}
