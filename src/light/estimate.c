// Density of rays around a point (Van Haevre, Di Fiore, Bekaert, Van Reeth 2004, section 4).
//
// Each ray whose segment meets a ball of radius d about the point adds its power over the ball's
// shadow π d²: an unbiased estimate of the fluence. Its mean is also that of power times length
// within the ball over its volume, as the mean chord is 4 d / 3; the latter is calmer near
// surfaces.
//
// A ball touches at most 27 cells of more than half its width. A ray that passes through several
// of them is counted in the one where it comes nearest to the point. Each cell's rays are brought
// together once for all points around it and judged in floats; where rounding could decide, in
// doubles.
#include "light/estimate.h"

#include <string.h>

enum { POINTS_AT_ONCE = 16384 };

bool fr_ball_is_inside(const FrOctree *tree, const double point[3], double radius) {
    for (int c = 0; c < 3; c++) {
        double at = point[c] - tree->min[c];
        if (!(at - radius > 0.0) || !(at + radius < tree->width)) {
            return false;
        }
    }
    return true;
}

void fr_ball_cells(const FrOctree *tree, uint32_t level, const double point[3], double radius,
                   uint32_t low[3], uint32_t high[3]) {
    double inverse = 1.0 / fr_octree_cell_width(tree, level);
    for (int c = 0; c < 3; c++) {
        double at = point[c] - tree->min[c];
        low[c] = (uint32_t)((at - radius) * inverse);
        high[c] = MIN((uint32_t)((at + radius) * inverse), (1u << level) - 1);
    }
}

void fr_want_ball(FrOctree *tree, uint32_t level, const double point[3], double radius) {
    if (!fr_ball_is_inside(tree, point, radius)) {
        return;
    }
    uint32_t low[3], high[3], at[3];
    fr_ball_cells(tree, level, point, radius, low, high);
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++) {
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++) {
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
                fr_octree_want(tree, level, at);
            }
        }
    }
}

// How much of a ray is within the ball, in diameters.
static double chord(const FrRay *ray, double reach, const double point[3], double radius) {
    double direction[3], away[3], square = 0.0;
    for (int c = 0; c < 3; c++) {
        direction[c] = (double)ray->direction[c];
        away[c] = point[c] - (double)ray->origin[c];
    }
    double length = fr_dot3(direction, direction);
    double middle = fr_dot3(away, direction) / length;
    for (int c = 0; c < 3; c++) {
        double gap = away[c] - middle * direction[c];
        square += gap * gap;
    }
    double half = sqrt(fmax(0.0, (radius * radius - square) / length));
    double inside = fmin(middle + half, reach) - fmax(middle - half, 0.0);
    return fmax(0.0, inside) * sqrt(length) / (2.0 * radius);
}

void fr_tally_add(FrTally *tally, const FrEstimator *how, const FrRay *ray, double reach,
                  const double point[3]) {
    double weight = how->kind == FR_ESTIMATE_TRACK ? chord(ray, reach, point, how->distance) : 1.0;
    tally->count++;
    tally->weight += (int64_t)(weight * FR_TALLY_UNIT);
    for (int c = 0; c < 3; c++) {
        tally->flow[c] += (int64_t)(weight * (double)ray->direction[c] * FR_TALLY_UNIT);
    }
}

FrLightAnswer fr_tally_answer(const FrTally *tally, const FrEstimator *how) {
    FrLightAnswer answer = {.samples = (uint32_t)MIN(tally->count, UINT32_MAX)};
    double weight = (double)tally->weight / FR_TALLY_UNIT;
    double r = how->distance, shadow = G_PI * r * r;
    double volume = 4.0 / 3.0 * G_PI * r * r * r;
    answer.intensity =
        (float)(how->power *
                (how->kind == FR_ESTIMATE_TRACK ? 2.0 * r * weight / volume : weight / shadow));
    double flow[3] = {(double)tally->flow[0], (double)tally->flow[1], (double)tally->flow[2]};
    double length = sqrt(fr_dot3(flow, flow));
    if (length > 0.0 && weight > 0.0) {
        answer.confidence = (float)fmin(1.0, length / FR_TALLY_UNIT / weight);
        for (int c = 0; c < 3; c++) {
            answer.direction.raw[c] = (float)(-flow[c] / length);
        }
    }
    return answer;
}

enum { RAYS_AT_ONCE = 256 };

/// The rays of a cell side by side, relative to its middle: each as the place where it comes
/// nearest to the middle, a direction, how far it runs to both sides, and its direction in parts
/// of FR_TALLY_UNIT.
typedef struct Bundle {
    float *at[3], *direction[3], *back, *ahead;
    int32_t *flow[3];
    void *memory;
    const uint32_t *slots;
    uint32_t count;
    double middle[3], width;
} Bundle;

static Bundle new_bundle(uint32_t most) {
    Bundle bundle = {.memory = g_malloc_n(MAX(most, 1), 8 * sizeof(float) + 3 * sizeof(int32_t))};
    float *next = bundle.memory;
    for (int c = 0; c < 3; c++, next += 2 * (size_t)most) {
        bundle.at[c] = next;
        bundle.direction[c] = next + most;
    }
    bundle.back = next;
    bundle.ahead = next + most;
    for (int c = 0; c < 3; c++) {
        bundle.flow[c] = (int32_t *)(void *)(next + (2 + (size_t)c) * most);
    }
    return bundle;
}

static void gather(Bundle *bundle, const FrOctree *tree, const FrCell *cell, const FrPaths *paths) {
    bundle->width = fr_octree_cell_width(tree, cell->level);
    bundle->slots = cell->rays.at;
    bundle->count = cell->rays.count;
    for (int c = 0; c < 3; c++) {
        bundle->middle[c] = tree->min[c] + (cell->at[c] + 0.5) * bundle->width;
    }
    for (uint32_t i = 0; i < bundle->count; i++) {
        const FrRay *ray = &paths->rays[bundle->slots[i]];
        double reach = fr_octree_reach(tree, ray), along = 0.0;
        for (int c = 0; c < 3; c++) {
            along += (bundle->middle[c] - (double)ray->origin[c]) * (double)ray->direction[c];
        }
        along = along < 0.0 ? 0.0 : (along > reach ? reach : along);
        for (int c = 0; c < 3; c++) {
            double direction = (double)ray->direction[c];
            double place = (double)ray->origin[c] + along * direction;
            bundle->at[c][i] = (float)(place - bundle->middle[c]);
            bundle->direction[c][i] = ray->direction[c];
            bundle->flow[c][i] = (int32_t)(direction * FR_TALLY_UNIT);
        }
        bundle->back[i] = (float)-along;
        bundle->ahead[i] = (float)(reach - along);
    }
}

/// A point as a bundle sees it. What is nearer than `sure` and comes nearest within the cell by
/// that much counts; what is farther than `most` does not; between them rounding could decide.
typedef struct Sieve {
    float at[3];
    float sure, most;           ///< squares of distances
    float sure_half, most_half; ///< of the cell
} Sieve;

static Sieve sieve_for(const Bundle *bundle, const double point[3], double radius) {
    // Far more than the rounding of floats this near to the middle.
    double slack = 1e-4 * bundle->width;
    Sieve sieve = {.sure = (float)((radius - slack) * (radius - slack)),
                   .most = (float)((radius + slack) * (radius + slack)),
                   .sure_half = (float)(0.5 * bundle->width - slack),
                   .most_half = (float)(0.5 * bundle->width + slack)};
    for (int c = 0; c < 3; c++) {
        sieve.at[c] = (float)(point[c] - bundle->middle[c]);
    }
    return sieve;
}

// 2: surely within, 1: in doubt, 0: surely not, for some rays of the bundle; no branches, so that
// several are judged at once.
static void judge(const Bundle *bundle, const Sieve *sieve, uint32_t begin, uint32_t count,
                  int32_t *restrict verdict) {
    const float *restrict ax = bundle->at[0] + begin, *restrict ay = bundle->at[1] + begin;
    const float *restrict az = bundle->at[2] + begin, *restrict dx = bundle->direction[0] + begin;
    const float *restrict dy = bundle->direction[1] + begin;
    const float *restrict dz = bundle->direction[2] + begin;
    const float *restrict back = bundle->back + begin, *restrict ahead = bundle->ahead + begin;
    const float x = sieve->at[0], y = sieve->at[1], z = sieve->at[2];
    const float sure = sieve->sure, most = sieve->most;
    const float sure_half = sieve->sure_half, most_half = sieve->most_half;
    for (uint32_t i = 0; i < count; i++) {
        float px = x - ax[i], py = y - ay[i], pz = z - az[i];
        float along = px * dx[i] + py * dy[i] + pz * dz[i];
        along = along > back[i] ? along : back[i];
        along = along < ahead[i] ? along : ahead[i];
        float qx = ax[i] + along * dx[i], qy = ay[i] + along * dy[i], qz = az[i] + along * dz[i];
        px = x - qx;
        py = y - qy;
        pz = z - qz;
        float square = px * px + py * py + pz * pz;
        qx = fabsf(qx);
        qy = fabsf(qy);
        qz = fabsf(qz);
        float out = qx > qy ? qx : qy;
        out = out > qz ? out : qz;
        int32_t may = (square <= most) & (out <= most_half);
        int32_t must = (square <= sure) & (out <= sure_half);
        verdict[i] = may + must;
    }
}

// Adds up those that are surely within; returns how many are in doubt.
static int32_t add_sure(const Bundle *bundle, uint32_t begin, uint32_t count,
                        const int32_t *restrict verdict, FrTally *tally) {
    const int32_t *restrict fx = bundle->flow[0] + begin, *restrict fy = bundle->flow[1] + begin;
    const int32_t *restrict fz = bundle->flow[2] + begin;
    int32_t sure = 0, doubt = 0, x = 0, y = 0, z = 0; // of RAYS_AT_ONCE units at most
    for (uint32_t i = 0; i < count; i++) {
        int32_t mask = -(verdict[i] >> 1);
        sure -= mask;
        doubt += verdict[i] & 1;
        x += fx[i] & mask;
        y += fy[i] & mask;
        z += fz[i] & mask;
    }
    tally->count += sure;
    tally->weight += sure * (int64_t)FR_TALLY_UNIT;
    tally->flow[0] += x;
    tally->flow[1] += y;
    tally->flow[2] += z;
    return doubt;
}

/// A point and a cell that its ball touches.
typedef struct Pair {
    uint32_t cell, point;
    FrTally tally;
} Pair;

typedef struct Job {
    const FrOctree *tree;
    const FrPaths *paths;
    const FrEstimator *how;
    const vec3s *points;
    Pair *pairs;
    const uint32_t *runs; ///< where the pairs of one cell begin, one more than there are
    Bundle *bundles;      ///< one for each thread
    FrLightAnswer *answers;
    const uint32_t *outside; ///< points outside of the tree
} Job;

static void test_exactly(const Job *job, const FrCell *cell, const FrRay *ray,
                         const double point[3], FrTally *tally) {
    const double radius = job->how->distance;
    double reach = fr_octree_reach(job->tree, ray);
    FrApproach approach = fr_ray_approach(ray, reach, point);
    if (approach.square <= radius * radius &&
        fr_cell_holds(job->tree, 1.0 / fr_octree_cell_width(job->tree, cell->level), cell->at,
                      approach.at)) {
        fr_tally_add(tally, job->how, ray, reach, point);
    }
}

static void tally_pair(const Job *job, const FrCell *cell, const Bundle *bundle, Pair *pair) {
    double point[3];
    for (int c = 0; c < 3; c++) {
        point[c] = (double)job->points[pair->point].raw[c];
    }
    Sieve sieve = sieve_for(bundle, point, job->how->distance);
    if (job->how->kind == FR_ESTIMATE_TRACK) {
        sieve.sure = -1.0f; // lengths are always computed exactly
    }
    int32_t verdict[RAYS_AT_ONCE];
    for (uint32_t begin = 0; begin < bundle->count; begin += RAYS_AT_ONCE) {
        uint32_t count = MIN(bundle->count - begin, (uint32_t)RAYS_AT_ONCE);
        judge(bundle, &sieve, begin, count, verdict);
        if (add_sure(bundle, begin, count, verdict, &pair->tally) == 0) {
            continue;
        }
        for (uint32_t i = 0; i < count; i++) {
            if (verdict[i] == 1) {
                test_exactly(job, cell, &job->paths->rays[bundle->slots[begin + i]], point,
                             &pair->tally);
            }
        }
    }
}

static void tally_runs(void *data, size_t begin, size_t end, int worker) {
    const Job *job = data;
    for (size_t r = begin; r < end; r++) {
        Pair *first = &job->pairs[job->runs[r]];
        const FrCell *cell = &g_array_index(job->tree->cells, FrCell, first->cell);
        Bundle *bundle = &job->bundles[worker];
        gather(bundle, job->tree, cell, job->paths);
        for (uint32_t i = job->runs[r]; i < job->runs[r + 1]; i++) {
            tally_pair(job, cell, bundle, &job->pairs[i]);
        }
    }
}

static int compare_pairs(const void *a, const void *b) {
    const Pair *left = a, *right = b;
    if (left->cell != right->cell) {
        return left->cell < right->cell ? -1 : 1;
    }
    return left->point < right->point ? -1 : left->point > right->point;
}

static void add_pairs(const FrOctree *tree, const FrEstimator *how, const double point[3],
                      uint32_t index, GArray *pairs) {
    uint32_t low[3], high[3], at[3];
    fr_ball_cells(tree, how->level, point, how->distance, low, high);
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++) {
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++) {
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
                Pair pair = {.cell = fr_octree_find(tree, how->level, at), .point = index};
                FR_ASSERT(pair.cell != FR_NONE);
                g_array_append_val(pairs, pair);
            }
        }
    }
}

// Where the pairs of one cell begin; returns the longest list among the cells.
static uint32_t find_runs(const FrOctree *tree, const GArray *pairs, GArray *runs) {
    uint32_t longest = 0;
    for (uint32_t i = 0; i <= pairs->len; i++) {
        if (i == 0 || i == pairs->len ||
            g_array_index(pairs, Pair, i).cell != g_array_index(pairs, Pair, i - 1).cell) {
            g_array_append_val(runs, i);
            if (i < pairs->len) {
                uint32_t cell = g_array_index(pairs, Pair, i).cell;
                longest = MAX(longest, g_array_index(tree->cells, FrCell, cell).rays.count);
            }
        }
    }
    return longest;
}

static void answer_outside(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Job *job = data;
    for (size_t i = begin; i < end; i++) {
        uint32_t point = job->outside[i];
        job->answers[point] = fr_estimate_from_all(job->paths, job->how, job->points[point]);
    }
}

static void answer_inside(Job *job, GArray *pairs, GArray *runs, const FrContext *context) {
    qsort(pairs->data, pairs->len, sizeof(Pair), compare_pairs);
    uint32_t longest = find_runs(job->tree, pairs, runs);
    int threads = fr_pool_threads(context->pool);
    job->bundles = g_new(Bundle, (size_t)threads);
    for (int i = 0; i < threads; i++) {
        job->bundles[i] = new_bundle(longest);
    }
    job->pairs = (Pair *)(void *)pairs->data;
    job->runs = (const uint32_t *)(void *)runs->data;
    fr_parallel_for(context->pool, runs->len - 1, 1, tally_runs, job, context->progress);
    for (int i = 0; i < threads; i++) {
        g_free(job->bundles[i].memory);
    }
    g_free(job->bundles);
}

static void sum_pairs(const GArray *pairs, FrTally *tallies) {
    for (guint i = 0; i < pairs->len; i++) {
        const Pair *pair = &g_array_index(pairs, Pair, i);
        FrTally *tally = &tallies[pair->point];
        tally->count += pair->tally.count;
        tally->weight += pair->tally.weight;
        for (int c = 0; c < 3; c++) {
            tally->flow[c] += pair->tally.flow[c];
        }
    }
}

static void answer_some(const FrOctree *tree, const FrPaths *paths, const FrEstimator *how,
                        const vec3s *points, uint32_t count, const FrContext *context,
                        FrLightAnswer *answers) {
    Job job = {.tree = tree, .paths = paths, .how = how, .points = points, .answers = answers};
    GArray *pairs = g_array_new(FALSE, FALSE, sizeof(Pair));
    GArray *runs = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    GArray *outside = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    FrTally *tallies = g_new0(FrTally, count);
    for (uint32_t i = 0; i < count; i++) {
        double point[3] = {(double)points[i].x, (double)points[i].y, (double)points[i].z};
        if (fr_ball_is_inside(tree, point, how->distance)) {
            add_pairs(tree, how, point, i, pairs);
        } else {
            g_array_append_val(outside, i);
        }
    }
    if (pairs->len > 0) {
        answer_inside(&job, pairs, runs, context);
    }
    sum_pairs(pairs, tallies);
    for (uint32_t i = 0; i < count; i++) {
        answers[i] = fr_tally_answer(&tallies[i], how);
    }
    job.outside = (const uint32_t *)(void *)outside->data;
    fr_parallel_for(context->pool, outside->len, 1, answer_outside, &job, context->progress);
    g_free(tallies);
    g_array_unref(pairs);
    g_array_unref(runs);
    g_array_unref(outside);
}

FrStatus fr_estimate(const FrOctree *tree, const FrPaths *paths, const FrEstimator *how,
                     const vec3s *points, size_t count, const FrContext *context,
                     FrLightAnswer *answers) {
    for (size_t begin = 0; begin < count; begin += POINTS_AT_ONCE) {
        uint32_t some = (uint32_t)MIN(count - begin, (size_t)POINTS_AT_ONCE);
        answer_some(tree, paths, how, points + begin, some, context, answers + begin);
        if (fr_progress_is_cancelled(context->progress)) {
            return FR_CANCELLED;
        }
    }
    return FR_OK;
}
