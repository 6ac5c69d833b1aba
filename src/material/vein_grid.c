#include "material/vein_grid.h"

#include <math.h>

void fr_vein_grid_init(FrVeinGrid *grid, float half_width, float cell) {
    grid->cell = cell;
    grid->left = -half_width;
    grid->columns = (int)(2 * half_width / cell) + 1;
    grid->rows = (int)(1 / cell) + 1;
    size_t cells = (size_t)grid->columns * (size_t)grid->rows;
    grid->first = g_new(int32_t, cells);
    for (size_t i = 0; i < cells; i++) {
        grid->first[i] = -1;
    }
    grid->points = g_array_new(FALSE, FALSE, sizeof(FrGridPoint));
}

void fr_vein_grid_clear(FrVeinGrid *grid) {
    g_free(grid->first);
    g_array_unref(grid->points);
}

static int column_of(const FrVeinGrid *grid, float x) {
    int column = (int)floorf((x - grid->left) / grid->cell);
    return CLAMP(column, 0, grid->columns - 1);
}

static int row_of(const FrVeinGrid *grid, float y) {
    int row = (int)floorf(y / grid->cell);
    return CLAMP(row, 0, grid->rows - 1);
}

void fr_vein_grid_add(FrVeinGrid *grid, float x, float y) {
    int32_t *first = &grid->first[row_of(grid, y) * grid->columns + column_of(grid, x)];
    FrGridPoint point = {.x = x, .y = y, .next = *first};
    *first = (int32_t)grid->points->len;
    g_array_append_val(grid->points, point);
}

void fr_vein_grid_visit(const FrVeinGrid *grid, float x, float y, float radius,
                        void (*visit)(void *data, uint32_t point, float distance), void *data) {
    const FrGridPoint *points = (const FrGridPoint *)(void *)grid->points->data;
    int last_row = row_of(grid, y + radius), last_column = column_of(grid, x + radius);
    for (int row = row_of(grid, y - radius); row <= last_row; row++) {
        for (int column = column_of(grid, x - radius); column <= last_column; column++) {
            int32_t at = grid->first[row * grid->columns + column];
            for (; at >= 0; at = points[at].next) {
                float distance = hypotf(points[at].x - x, points[at].y - y);
                if (distance <= radius) {
                    visit(data, (uint32_t)at, distance);
                }
            }
        }
    }
}

typedef struct Nearest {
    uint32_t point;
    float distance;
} Nearest;

static void keep_nearest(void *data, uint32_t point, float distance) {
    Nearest *nearest = data;
    if (distance < nearest->distance || (distance == nearest->distance && point < nearest->point)) {
        *nearest = (Nearest){.point = point, .distance = distance};
    }
}

uint32_t fr_vein_grid_nearest(const FrVeinGrid *grid, float x, float y, float radius) {
    Nearest nearest = {.point = UINT32_MAX, .distance = INFINITY};
    // Most queries are answered by the cells around; only then the whole radius is searched.
    for (float reach = fminf(grid->cell, radius);; reach = fminf(reach * 4, radius)) {
        fr_vein_grid_visit(grid, x, y, reach, keep_nearest, &nearest);
        if (nearest.point != UINT32_MAX || reach >= radius) {
            return nearest.point;
        }
    }
}
