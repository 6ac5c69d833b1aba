#include "pgraph/bluenoise.h"

#include <glib.h>
#include <math.h>

enum {
    MOST_CELLS = 1024, // along a side
    MOST_TRIES = 200   // to find a place where points may be
};
#define NO_POINT UINT32_MAX

// Cells over the square from −1 to 1, each with a chain of its points: it finds the nearest point
// sooner and has no say in which it is.
typedef struct Grid {
    const double (*points)[2];
    uint32_t side;
    uint32_t *first, *next;
} Grid;

static uint32_t cell_of(const Grid *grid, double at) {
    double cell = floor(0.5 * (at + 1) * grid->side);
    return cell <= 0 ? 0 : cell >= grid->side - 1 ? grid->side - 1 : (uint32_t)cell;
}

static double nearest_in(const Grid *grid, uint32_t column, uint32_t row, const double at[2],
                         double nearest) {
    for (uint32_t k = grid->first[(size_t)row * grid->side + column]; k != NO_POINT;
         k = grid->next[k]) {
        double x = grid->points[k][0] - at[0], y = grid->points[k][1] - at[1];
        nearest = fmin(nearest, x * x + y * y);
    }
    return nearest;
}

// Squared distance to the nearest point; may stop as soon as it is not more than `enough`.
static double nearest_point(const Grid *grid, const double at[2], double enough) {
    int64_t side = grid->side;
    int64_t column = cell_of(grid, at[0]), row = cell_of(grid, at[1]);
    double nearest = INFINITY, width = 2.0 / (double)side;
    for (int64_t ring = 0; ring < side; ring++) {
        // What lies in further rings of cells is at least so far away.
        double clear = (double)(ring - 1) * width;
        if (nearest <= enough || (clear > 0 && clear * clear >= nearest)) {
            break;
        }
        int64_t top = MIN(row + ring, side - 1), right = MIN(column + ring, side - 1);
        for (int64_t y = MAX(row - ring, 0); y <= top; y++) {
            bool is_edge = y == row - ring || y == row + ring;
            int64_t step = is_edge || ring == 0 ? 1 : 2 * ring;
            for (int64_t x = column - ring; x <= right; x += step) {
                if (x >= 0) {
                    nearest = nearest_in(grid, (uint32_t)x, (uint32_t)y, at, nearest);
                }
            }
        }
    }
    return nearest;
}

static void draw(double point[2], FrStrewnForm form, double inner, FrKey key, uint32_t candidate) {
    double a = fr_random(key, 0, candidate), b = fr_random(key, 1, candidate);
    if (form == FR_STREWN_SQUARE) {
        point[0] = 2 * a - 1;
        point[1] = 2 * b - 1;
        return;
    }
    double hole = form == FR_STREWN_RING ? inner * inner : 0;
    double radius = sqrt(hole + (1 - hole) * a);
    point[0] = radius * cos(2 * G_PI * b);
    point[1] = radius * sin(2 * G_PI * b);
}

/// What a candidate is drawn from.
typedef struct Lots {
    FrStrewnForm form;
    double inner;
    const FrStrewnDensity *density;
} Lots;

/// Draws a candidate where a point may be; the density there, 0 if none was found.
static double draw_dense(double point[2], const Lots *lots, FrKey key, uint32_t candidate) {
    if (lots->density == NULL) {
        draw(point, lots->form, lots->inner, key, candidate);
        return 1;
    }
    for (uint32_t k = 0; k < MOST_TRIES; k++) {
        uint32_t number = candidate * MOST_TRIES + k;
        draw(point, lots->form, lots->inner, key, number);
        point[0] *= lots->density->reach[0];
        point[1] *= lots->density->reach[1];
        double density = lots->density->at(lots->density->data, point);
        if (fr_random(key, 2, number) < density) {
            return density;
        }
    }
    return 0;
}

/// The best of some candidates, NAN if there is none.
static void draw_best(double best[2], const Grid *grid, const Lots *lots, FrKey key,
                      uint32_t candidates) {
    double farthest = -1;
    best[0] = best[1] = NAN;
    for (uint32_t c = 0; c < candidates; c++) {
        double point[2];
        double density = draw_dense(point, lots, key, c);
        if (density <= 0) {
            continue;
        }
        double distance =
            candidates > 1 ? density * nearest_point(grid, point, farthest / density) : 0;
        if (distance > farthest) {
            farthest = distance;
            best[0] = point[0];
            best[1] = point[1];
        }
    }
}

void fr_bluenoise(double (*points)[2], uint32_t count, FrStrewnForm form, double inner,
                  uint32_t candidates, FrKey key, const FrStrewnDensity *density,
                  const FrProgress *progress) {
    const Lots lots = {form, inner, density};
    uint32_t side = (uint32_t)CLAMP(sqrt(count), 1, MOST_CELLS);
    Grid grid = {
        .points = (const double(*)[2])points,
        .side = side,
        .first = g_new(uint32_t, (size_t)side * side),
        .next = g_new(uint32_t, MAX(count, 1)),
    };
    for (size_t cell = 0; cell < (size_t)side * side; cell++) {
        grid.first[cell] = NO_POINT;
    }
    for (uint32_t i = 0; i < count; i++) {
        candidates = i % 256 == 0 && fr_progress_is_cancelled(progress) ? 1 : candidates;
        if (i > 0 && isnan(points[0][0])) {
            points[i][0] = points[i][1] = NAN;
            continue;
        }
        draw_best(points[i], &grid, &lots, fr_key_child(key, i), candidates);
        if (isnan(points[i][0])) {
            continue;
        }
        size_t cell = (size_t)cell_of(&grid, points[i][1]) * side + cell_of(&grid, points[i][0]);
        grid.next[i] = grid.first[cell];
        grid.first[cell] = i;
    }
    g_free(grid.first);
    g_free(grid.next);
}
