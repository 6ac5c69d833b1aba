#include "pgraph/near.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>

#define NO_POINT UINT32_MAX
// Cells farther out than this are one; no surface is so large in its own spacing.
#define FARTHEST 1e9

enum { FIRST_POINTS = 64, GROWTH = 4 };

typedef struct Point {
    double at[3];
    uint32_t next; // in its bucket
} Point;

struct FrNear {
    Point *points;
    double area, width; // of the surface; of a cell
    uint32_t most, count, room;
    uint32_t mask;         // of hashes; buckets are its successor
    uint32_t *first;       // by bucket
    double min[3], max[3]; // of the points
};

static int64_t cell_of(const FrNear *near, double at) {
    return (int64_t)fmax(-FARTHEST, fmin(floor(at / near->width), FARTHEST));
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
    }
    uint32_t bucket = bucket_of(near, cell);
    point->next = near->first[bucket];
    near->first[bucket] = index;
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
    for (uint32_t k = 0; k < near->count; k++) {
        chain(near, k);
    }
}

FrNear *fr_near_new(double area, uint32_t most) {
    FrNear *near = g_new0(FrNear, 1);
    *near = (FrNear){.area = area, .most = most};
    near->points = g_new(Point, MAX(most, 1));
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
        nearest = fmin(nearest, square);
    }
    return nearest;
}

// The cells from low to high that hold points at all, of those `ring` away from the middle one.
typedef struct Reach {
    int64_t middle[3], low[3], high[3];
    double inside[3]; ///< where the place is in the middle cell, 0 to 1 of its width
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
    int64_t to = MIN(reach->middle[0] + ring, reach->high[0]);
    int64_t from = reach->middle[0] - ring;
    from = is_edge ? MAX(from, reach->low[0]) : from;
    for (cell[0] = from; cell[0] <= to; cell[0] += is_edge ? 1 : 2 * ring) {
        if (cell[0] >= reach->low[0] && clear + clear_of(near, reach, 0, cell[0]) < nearest) {
            nearest = nearest_in(near, cell, at, nearest);
        }
    }
    return nearest;
}

static double nearest_in_ring(const FrNear *near, const Reach *reach, int64_t ring,
                              const double at[3], double nearest) {
    int64_t from[3], to[3], cell[3];
    for (int r = 1; r < 3; r++) {
        from[r] = MAX(reach->middle[r] - ring, reach->low[r]);
        to[r] = MIN(reach->middle[r] + ring, reach->high[r]);
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

double fr_near_distance(const FrNear *near, const double at[3], double enough) {
    double nearest = INFINITY;
    if (near->count == 0) {
        return nearest;
    }
    Reach reach = {.enough = enough};
    int64_t last = 0;
    for (int r = 0; r < 3; r++) {
        reach.middle[r] = cell_of(near, at[r]);
        reach.inside[r] = at[r] / near->width - (double)reach.middle[r];
        reach.low[r] = cell_of(near, near->min[r]);
        reach.high[r] = cell_of(near, near->max[r]);
        last = MAX(last, llabs(reach.high[r] - reach.middle[r]));
        last = MAX(last, llabs(reach.middle[r] - reach.low[r]));
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
