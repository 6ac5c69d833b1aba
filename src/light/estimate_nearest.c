// The nearest rays to a point (Silverman 1986, Density Estimation for Statistics and Data Analysis,
// section 2.5), and any estimate from a look at all rays.
//
// Of k rays the farthest sets the radius r, so only the k − 1 others are chance: power (k − 1) /
// (π r²) has no bias. How many rays a ball of the fixed distance holds tells about how large one
// with enough of them is; where it is still too small, its radius and the cells that are searched
// double together.
#include "light/estimate.h"

/// A ray near a point.
typedef struct Near {
    double square;
    uint32_t slot, photon;
    uint16_t bounce;
} Near;

// Equal distances are told apart by what names a ray, not by where it is stored.
static int compare_near(const void *a, const void *b) {
    const Near *left = a, *right = b;
    if (left->square != right->square) {
        return left->square < right->square ? -1 : 1;
    }
    if (left->photon != right->photon) {
        return left->photon < right->photon ? -1 : 1;
    }
    return left->bounce < right->bounce ? -1 : left->bounce > right->bounce;
}

static void note(GArray *found, const FrRay *ray, uint32_t slot, double square) {
    Near near = {.square = square, .slot = slot, .photon = ray->photon, .bounce = ray->bounce};
    g_array_append_val(found, near);
}

static FrLightAnswer answer_from(GArray *found, const FrPaths *paths, const FrEstimator *how) {
    g_array_sort(found, compare_near);
    uint32_t count = MIN(found->len, how->neighbours);
    FrTally tally = {0};
    FrEstimator at = *how;
    for (uint32_t i = 0; i < count; i++) {
        const Near *near = &g_array_index(found, Near, i);
        at.distance = sqrt(near->square);
        fr_tally_add(&tally, &at, &paths->rays[near->slot], 0.0, (const double[3]){0});
    }
    FrLightAnswer answer = fr_tally_answer(&tally, &at);
    double shadow = G_PI * at.distance * at.distance;
    answer.intensity =
        count > 1 && shadow > 0.0 ? (float)(how->power * (count - 1) / shadow) : 0.0f;
    return answer;
}

FrLightAnswer fr_estimate_from_all(const FrPaths *paths, const FrEstimator *how, vec3s point) {
    double at[3] = {(double)point.x, (double)point.y, (double)point.z};
    double most = how->kind == FR_ESTIMATE_NEAREST ? INFINITY : how->distance * how->distance;
    GArray *found = g_array_new(FALSE, FALSE, sizeof(Near));
    FrTally tally = {0};
    for (uint32_t i = 0; i < paths->count; i++) {
        const FrRay *ray = &paths->rays[i];
        if (ray->photon == FR_NONE) {
            continue;
        }
        double reach = ray->distance;
        FrApproach approach = fr_ray_approach(ray, reach, at);
        if (!(approach.square <= most)) {
            continue;
        }
        if (how->kind == FR_ESTIMATE_NEAREST) {
            note(found, ray, i, approach.square);
        } else {
            fr_tally_add(&tally, how, ray, reach, at);
        }
    }
    FrLightAnswer answer = how->kind == FR_ESTIMATE_NEAREST ? answer_from(found, paths, how)
                                                            : fr_tally_answer(&tally, how);
    g_array_unref(found);
    return answer;
}

typedef struct Job {
    const FrOctree *tree;
    const FrPaths *paths;
    const FrEstimator *how;
    const vec3s *points;
    uint32_t *open; ///< points to be answered at this level
    uint32_t level;
    double radius;
    bool *is_answered;
    FrLightAnswer *answers;
} Job;

static void search_cell(const Job *job, const uint32_t at[3], const double point[3],
                        GArray *found) {
    uint32_t index = fr_octree_find(job->tree, job->level, at);
    FR_ASSERT(index != FR_NONE);
    const FrCell *cell = &g_array_index(job->tree->cells, FrCell, index);
    double inverse = 1.0 / fr_octree_cell_width(job->tree, job->level);
    for (uint32_t i = 0; i < cell->rays.count; i++) {
        uint32_t slot = cell->rays.at[i];
        const FrRay *ray = &job->paths->rays[slot];
        FrApproach approach = fr_ray_approach(ray, fr_octree_reach(job->tree, ray), point);
        if (approach.square <= job->radius * job->radius &&
            fr_cell_holds(job->tree, inverse, at, approach.at)) {
            note(found, ray, slot, approach.square);
        }
    }
}

static void search_ball(const Job *job, const double point[3], GArray *found) {
    uint32_t low[3], high[3], at[3];
    fr_ball_cells(job->tree, job->level, point, job->radius, low, high);
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++) {
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++) {
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
                search_cell(job, at, point, found);
            }
        }
    }
}

static void answer_open(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Job *job = data;
    GArray *found = g_array_new(FALSE, FALSE, sizeof(Near));
    for (size_t i = begin; i < end; i++) {
        uint32_t index = job->open[i];
        vec3s at = job->points[index];
        double point[3] = {(double)at.x, (double)at.y, (double)at.z};
        job->is_answered[index] = true;
        if (job->level == 0 || !fr_ball_is_inside(job->tree, point, job->radius)) {
            job->answers[index] = fr_estimate_from_all(job->paths, job->how, at);
            continue;
        }
        g_array_set_size(found, 0);
        search_ball(job, point, found);
        if (found->len >= job->how->neighbours) {
            job->answers[index] = answer_from(found, job->paths, job->how);
        } else {
            job->is_answered[index] = false;
        }
    }
    g_array_unref(found);
}

// The level of the smallest cells whose ball should hold twice the wanted rays.
static uint8_t first_level(const FrEstimator *how, uint32_t samples) {
    uint32_t level = how->level;
    for (uint64_t wanted = 8 * (uint64_t)how->neighbours; samples >= wanted && level < 20;
         wanted *= 4) {
        level++;
    }
    return (uint8_t)level;
}

// Answers at one level what is to be looked for there or deeper and has no answer yet.
static FrStatus answer_level(Job *job, FrOctree *tree, const uint8_t *levels, size_t count,
                             const FrContext *context) {
    uint32_t open_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (levels[i] >= job->level && !job->is_answered[i]) {
            const float *at = job->points[i].raw;
            double point[3] = {(double)at[0], (double)at[1], (double)at[2]};
            job->open[open_count++] = i;
            if (job->level > 0) {
                fr_want_ball(tree, job->level, point, job->radius);
            }
        }
    }
    FrStatus status = fr_octree_fill(tree, job->paths, context);
    if (status == FR_OK) {
        fr_parallel_for(context->pool, open_count, 16, answer_open, job, context->progress);
    }
    return status;
}

FrStatus fr_estimate_nearest(FrOctree *tree, const FrPaths *paths, const FrEstimator *how,
                             const vec3s *points, size_t count, const FrContext *context,
                             FrLightAnswer *answers) {
    FrEstimator fixed = *how;
    fixed.kind = FR_ESTIMATE_FIXED;
    FrStatus status = fr_estimate(tree, paths, &fixed, points, count, context, answers);
    if (status != FR_OK) {
        return status;
    }
    uint8_t *levels = g_new(uint8_t, count), deepest = 0;
    for (size_t i = 0; i < count; i++) {
        levels[i] = first_level(how, answers[i].samples);
        deepest = MAX(deepest, levels[i]);
    }
    Job job = {.tree = tree,
               .paths = paths,
               .how = how,
               .points = points,
               .open = g_new(uint32_t, count),
               .is_answered = g_new0(bool, count),
               .answers = answers};
    for (int level = deepest; level >= 0 && status == FR_OK; level--) {
        job.level = (uint32_t)level;
        job.radius = ldexp(how->distance, (int)how->level - level);
        status = answer_level(&job, tree, levels, count, context);
    }
    g_free(levels);
    g_free(job.open);
    g_free(job.is_answered);
    return fr_progress_is_cancelled(context->progress) ? FR_CANCELLED : status;
}
