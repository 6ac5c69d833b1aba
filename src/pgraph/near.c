#include "pgraph/near.h"

#include "pgraph/zorder.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

#define NO_POINT UINT32_MAX
// Cells farther out than this are one; no surface is so large in its own spacing.
#define FARTHEST 1e9

enum { FIRST_POINTS = 64, GROWTH = 2 };

typedef struct Point {
    double at[3];
    uint32_t next; // in its bucket
} Point;

struct FrNear {
    Point *points;
    double area, width; // of the surface; of a cell
    uint32_t most, count, room;
    uint32_t mask;           // of hashes; buckets are its successor
    uint32_t *first;         // by bucket
    double min[3], max[3];   // of the points
    int64_t low[3], high[3]; // cells of these
};

static int64_t cell_of(const FrNear *near, double at) {
    double cell = floor(at / near->width);
    return cell > -FARTHEST ? cell < FARTHEST ? (int64_t)cell : (int64_t)FARTHEST
                            : (int64_t)-FARTHEST;
}

// Eight cells that touch have buckets side by side.
static uint32_t bucket_of(const FrNear *near, const int64_t cell[3]) {
    uint64_t hash = (uint64_t)(cell[0] >> 1) * UINT64_C(0x9e3779b97f4a7c15) ^
                    (uint64_t)(cell[1] >> 1) * UINT64_C(0xc2b2ae3d27d4eb4f) ^
                    (uint64_t)(cell[2] >> 1) * UINT64_C(0x165667b19e3779f9);
    uint32_t corner = (uint32_t)((cell[2] & 1) << 2 | (cell[1] & 1) << 1 | (cell[0] & 1));
    return (((uint32_t)(hash ^ hash >> 32) << 3) & near->mask) | corner;
}

static void chain(FrNear *near, uint32_t index) {
    Point *point = &near->points[index];
    int64_t cell[3];
    for (int r = 0; r < 3; r++) {
        cell[r] = cell_of(near, point->at[r]);
        near->low[r] = MIN(near->low[r], cell[r]);
        near->high[r] = MAX(near->high[r], cell[r]);
    }
    uint32_t bucket = bucket_of(near, cell);
    point->next = near->first[bucket];
    near->first[bucket] = index;
}

// Lays the points so that those near each other are mostly side by side in memory.
static void sort_points(FrNear *near) {
    if (near->count == 0) {
        return;
    }
    FrZorder order = fr_zorder(near->min, near->max);
    uint64_t *items = g_new(uint64_t, 2 * (size_t)near->count);
    for (uint32_t k = 0; k < near->count; k++) {
        items[k] = fr_zorder_item(&order, near->points[k].at, k);
    }
    fr_zorder_sort(items, items + near->count, near->count);
    Point *sorted = g_new(Point, near->most);
    for (uint32_t k = 0; k < near->count; k++) {
        sorted[k] = near->points[fr_zorder_number(items[k])];
    }
    g_free(items);
    g_free(near->points);
    near->points = sorted;
}

// Makes room for so many points, in cells a little wider than these will be apart: then the nearest
// one is mostly in a cell that touches the middle one.
static void make_room(FrNear *near, uint32_t room) {
    near->room = room;
    near->width = 1.25 * sqrt(fmax(near->area, 1e-30) / room);
    uint32_t buckets = 8;
    while (buckets < 2 * (uint64_t)room && buckets < 1u << 31) {
        buckets *= 2;
    }
    near->mask = buckets - 1;
    near->first = g_renew(uint32_t, near->first, buckets);
    for (uint32_t bucket = 0; bucket < buckets; bucket++) {
        near->first[bucket] = NO_POINT;
    }
    for (int r = 0; r < 3; r++) {
        near->low[r] = INT64_MAX;
        near->high[r] = INT64_MIN;
    }
    sort_points(near);
    for (uint32_t k = 0; k < near->count; k++) {
        chain(near, k);
    }
}

FrNear *fr_near_new(double area, uint32_t most) {
    FrNear *near = g_new0(FrNear, 1);
    *near = (FrNear){.area = area, .most = MAX(most, 1)};
    near->points = g_new(Point, near->most);
    make_room(near, FIRST_POINTS);
    return near;
}

void fr_near_free(FrNear *near) {
    if (near != NULL) {
        g_free(near->first);
        g_free(near->points);
        g_free(near);
    }
}

void fr_near_settle(FrNear *near) {
    make_room(near, MAX(near->count, FIRST_POINTS));
}

void fr_near_add(FrNear *near, const double at[3]) {
    if (near->count == near->room) {
        make_room(near, near->room > near->most / GROWTH ? near->most : near->room * GROWTH);
    }
    for (int r = 0; r < 3; r++) {
        near->points[near->count].at[r] = at[r];
        near->min[r] = near->count > 0 ? fmin(near->min[r], at[r]) : at[r];
        near->max[r] = near->count > 0 ? fmax(near->max[r], at[r]) : at[r];
    }
    chain(near, near->count++);
}

static double nearest_in(const FrNear *near, const int64_t cell[3], const double at[3],
                         double nearest) {
    for (uint32_t k = near->first[bucket_of(near, cell)]; k != NO_POINT; k = near->points[k].next) {
        const double *point = near->points[k].at;
        double square = 0;
        for (int r = 0; r < 3; r++) {
            double off = point[r] - at[r];
            square += off * off;
        }
        nearest = square < nearest ? square : nearest;
    }
    return nearest;
}

// What is asked for.
typedef struct Reach {
    int64_t middle[3]; ///< cell of the place
    double inside[3];  ///< where the place is in the middle cell, 0 to 1 of its width
    double enough;
} Reach;

// How far the place is from cell `at` along one axis, squared, a little less than exact.
static double clear_of(const FrNear *near, const Reach *reach, int r, int64_t at) {
    double off = (double)(at - reach->middle[r]) - reach->inside[r];
    double out = near->width * (off > 0 ? off : off < -1 ? -1 - off : 0);
    return (1 - 1e-6) * out * out;
}

// The cells of a row that are `ring` away, all of them if the row is; nearest before and after.
static double nearest_in_row(const FrNear *near, const Reach *reach, int64_t cell[3], int64_t ring,
                             bool is_edge, double clear, const double at[3], double nearest) {
    int64_t to = MIN(reach->middle[0] + ring, near->high[0]);
    int64_t from = reach->middle[0] - ring;
    from = is_edge ? MAX(from, near->low[0]) : from;
    for (cell[0] = from; cell[0] <= to; cell[0] += is_edge ? 1 : 2 * ring) {
        if (cell[0] >= near->low[0] && clear + clear_of(near, reach, 0, cell[0]) < nearest) {
            nearest = nearest_in(near, cell, at, nearest);
        }
    }
    return nearest;
}

static double nearest_in_ring(const FrNear *near, const Reach *reach, int64_t ring,
                              const double at[3], double nearest) {
    int64_t from[3], to[3], cell[3];
    for (int r = 1; r < 3; r++) {
        from[r] = MAX(reach->middle[r] - ring, near->low[r]);
        to[r] = MIN(reach->middle[r] + ring, near->high[r]);
    }
    for (cell[2] = from[2]; cell[2] <= to[2]; cell[2]++) {
        double layer = clear_of(near, reach, 2, cell[2]);
        for (cell[1] = from[1]; cell[1] <= to[1] && layer < nearest; cell[1]++) {
            double clear = layer + clear_of(near, reach, 1, cell[1]);
            bool is_edge = ring == 0 || llabs(cell[2] - reach->middle[2]) == ring ||
                           llabs(cell[1] - reach->middle[1]) == ring;
            if (clear < nearest) {
                nearest = nearest_in_row(near, reach, cell, ring, is_edge, clear, at, nearest);
            }
            if (nearest <= reach->enough) {
                return nearest;
            }
        }
    }
    return nearest;
}

double fr_near_distance(const FrNear *near, const double at[3], double most, double enough) {
    double nearest = most;
    if (near->count == 0) {
        return nearest;
    }
    Reach reach = {.enough = enough};
    int64_t last = 0;
    for (int r = 0; r < 3; r++) {
        reach.middle[r] = cell_of(near, at[r]);
        reach.inside[r] = at[r] / near->width - (double)reach.middle[r];
        last = MAX(last, llabs(near->high[r] - reach.middle[r]));
        last = MAX(last, llabs(reach.middle[r] - near->low[r]));
    }
    for (int64_t ring = 0; ring <= last; ring++) {
        double clear = (double)(ring - 1) * near->width;
        if (nearest <= enough || (clear > 0 && clear * clear >= nearest)) {
            break;
        }
        nearest = nearest_in_ring(near, &reach, ring, at, nearest);
    }
    return nearest;
}
