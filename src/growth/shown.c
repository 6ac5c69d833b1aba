// What a growth knows between steps, for who wants to see it: buds and occupied space.
#include "growth/engine.h"

GArray *fr_growth_buds(const FrGrowth *growth) {
    GArray *buds = g_array_new(FALSE, FALSE, sizeof(FrGrowthBud));
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        for (uint32_t i = 0; i < plant->bud_count; i++) {
            const FrLiveBud *bud = &plant->buds[i];
            FrGrowthBud seen = {.at = fr_bud_world(plant, bud),
                                .direction = bud->direction,
                                .towards = bud->brightest,
                                .light = bud->light,
                                .plant = p,
                                .is_growing = bud->state == FR_LIVE_GROWING};
            g_array_append_val(buds, seen);
        }
    }
    return buds;
}

// ---- occupied space ---------------------------------------------------------------------------

typedef void (*BrickFn)(void *user, const FrBrick *brick, FrCell first);

static void each_brick(const FrVoxels *voxels, BrickFn visit, void *user) {
    for (int block = 0; block < 64 * 64 * 64; block++) {
        FrBrick **bricks = voxels->top[block];
        bool is_seen = bricks != NULL && !fr_voxels_is_inside_block(voxels, bricks);
        for (int i = 0; is_seen && i < 512; i++) {
            FrCell first = {{(int16_t)((block % 64) * 64 + i % 8 * 8),
                             (int16_t)((block / 64 % 64) * 64 + i / 8 % 8 * 8),
                             (int16_t)((block / 4096) * 64 + i / 64 * 8)}};
            if (bricks[i] != NULL && !fr_voxels_is_inside(voxels, bricks[i])) {
                visit(user, bricks[i], first);
            }
        }
    }
}

static uint64_t taken(const FrBrick *brick, int layer) {
    return brick->taken[layer] & ~brick->ground[layer];
}

typedef struct Counts {
    uint64_t cells, bricks;
} Counts;

static void count_brick(void *user, const FrBrick *brick, FrCell first) {
    (void)first;
    Counts *counts = user;
    uint64_t cells = 0;
    for (int layer = 0; layer < FR_BRICK_WIDTH; layer++) {
        cells += (uint64_t)__builtin_popcountll(taken(brick, layer));
    }
    counts->cells += cells;
    counts->bricks += cells > 0;
}

// Cubes of 1 cell, or of `width` cells that hold any.
typedef struct Cubes {
    const FrGrowth *growth;
    int width;
    GHashTable *known; // place in cubes → index + 1
    GArray *cells;
} Cubes;

static void add_cube(Cubes *cubes, FrCell at, uint32_t plant) {
    const FrVoxels *voxels = cubes->growth->voxels;
    FrGrowthCell cell = {.width = cubes->width * voxels->cell, .plant = plant};
    uint64_t place = 0;
    for (int c = 0; c < 3; c++) {
        int k = at.at[c] / cubes->width;
        cell.min[c] = voxels->origin[c] + cell.width * k;
        place = place * FR_VOXELS_WIDTH + (uint64_t)k;
    }
    gpointer key = GSIZE_TO_POINTER((gsize)place);
    guint known = GPOINTER_TO_UINT(g_hash_table_lookup(cubes->known, key));
    if (known > 0) {
        FrGrowthCell *old = &g_array_index(cubes->cells, FrGrowthCell, known - 1);
        old->plant = old->plant == plant ? plant : FR_NONE;
        return;
    }
    g_array_append_val(cubes->cells, cell);
    g_hash_table_insert(cubes->known, key, GUINT_TO_POINTER(cubes->cells->len));
}

static uint32_t plant_in(const FrGrowth *growth, const FrBrick *brick, FrCell cell) {
    unsigned bit = fr_voxels_bit(cell), layer = (unsigned)cell.at[2] & 7;
    if ((brick->solid[layer] >> bit & 1) != 0 || brick->owners == NULL) {
        return FR_NONE;
    }
    return growth->owners[*fr_voxels_at(brick, cell)].plant;
}

static void add_brick(void *user, const FrBrick *brick, FrCell first) {
    Cubes *cubes = user;
    for (int i = 0; i < FR_BRICK_CELLS; i++) {
        FrCell cell = {{(int16_t)(first.at[0] + i % 8), (int16_t)(first.at[1] + i / 8 % 8),
                        (int16_t)(first.at[2] + i / 64)}};
        if ((taken(brick, i / 64) >> (i % 64) & 1) != 0) {
            add_cube(cubes, cell, plant_in(cubes->growth, brick, cell));
        }
    }
}

GArray *fr_growth_cells(const FrGrowth *growth, uint32_t most) {
    Counts counts = {0};
    each_brick(growth->voxels, count_brick, &counts);
    Cubes cubes = {.growth = growth,
                   .width = counts.cells <= most ? 1 : FR_BRICK_WIDTH,
                   .known = g_hash_table_new(g_direct_hash, g_direct_equal),
                   .cells = g_array_new(FALSE, FALSE, sizeof(FrGrowthCell))};
    each_brick(growth->voxels, add_brick, &cubes);
    while (cubes.cells->len > most && cubes.width < FR_VOXELS_WIDTH) {
        cubes.width *= 2;
        g_array_set_size(cubes.cells, 0);
        g_hash_table_remove_all(cubes.known);
        each_brick(growth->voxels, add_brick, &cubes);
    }
    g_hash_table_unref(cubes.known);
    return cubes.cells;
}
