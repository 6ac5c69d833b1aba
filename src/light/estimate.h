/// @file estimate.h
/// Light at a point from the rays that pass near it. Private to light.
///
/// Sums are of integers (directions and lengths in parts of FR_TALLY_UNIT), so that their order
/// does not matter: an answer depends on which rays there are, not on how they are found.
#pragma once

#include "light/octree.h"

typedef enum FrEstimatorKind {
    FR_ESTIMATE_FIXED,   ///< rays within a distance (histogram)
    FR_ESTIMATE_NEAREST, ///< the nearest rays, however far
    FR_ESTIMATE_TRACK,   ///< how far rays run within a distance
} FrEstimatorKind;

typedef struct FrEstimator {
    FrEstimatorKind kind;
    double distance;
    uint32_t neighbours;
    double power;   ///< of a photon
    uint32_t level; ///< of the cells that are searched for `distance`
} FrEstimator;

#define FR_TALLY_UNIT 0x1p20

typedef struct FrTally {
    int64_t count;   ///< rays
    int64_t weight;  ///< their lengths, in units of twice the distance
    int64_t flow[3]; ///< sum of directions, times lengths where lengths count
} FrTally;

/// Where a ray comes nearest to a point.
typedef struct FrApproach {
    double at[3];
    double square; ///< of the distance
} FrApproach;

static inline double fr_dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline FrApproach fr_ray_approach(const FrRay *ray, double reach, const double point[3]) {
    double direction[3], away[3];
    for (int c = 0; c < 3; c++) {
        direction[c] = (double)ray->direction[c];
        away[c] = point[c] - (double)ray->origin[c];
    }
    double along = fr_dot3(away, direction) / fr_dot3(direction, direction);
    along = along < 0.0 ? 0.0 : (along > reach ? reach : along);
    FrApproach approach = {.square = 0.0};
    for (int c = 0; c < 3; c++) {
        approach.at[c] = (double)ray->origin[c] + along * direction[c];
        double gap = point[c] - approach.at[c];
        approach.square += gap * gap;
    }
    return approach;
}

/// True if a ball lies within the root of the tree.
bool fr_ball_is_inside(const FrOctree *tree, const double point[3], double radius);
/// The range of cells of a level that a ball within the root touches.
void fr_ball_cells(const FrOctree *tree, uint32_t level, const double point[3], double radius,
                   uint32_t low[3], uint32_t high[3]);
/// True if a cell of a level is the one a place lies in.
static inline bool fr_cell_holds(const FrOctree *tree, double inverse_width, const uint32_t at[3],
                                 const double place[3]) {
    for (int c = 0; c < 3; c++) {
        if (floor((place[c] - tree->min[c]) * inverse_width) != (double)at[c]) {
            return false;
        }
    }
    return true;
}

/// Adds a ray whose nearest place to the point is within the distance.
void fr_tally_add(FrTally *tally, const FrEstimator *how, const FrRay *ray, double reach,
                  const double point[3]);
FrLightAnswer fr_tally_answer(const FrTally *tally, const FrEstimator *how);

/// Answers for points around which the tree has cells, or which are outside of it.
FR_MUST_USE FrStatus fr_estimate(const FrOctree *tree, const FrPaths *paths, const FrEstimator *how,
                                 const vec3s *points, size_t count, const FrContext *context,
                                 FrLightAnswer *answers);
/// The nearest rays. Grows the tree where the wanted number is not found within the distance.
FR_MUST_USE FrStatus fr_estimate_nearest(FrOctree *tree, const FrPaths *paths,
                                         const FrEstimator *how, const vec3s *points, size_t count,
                                         const FrContext *context, FrLightAnswer *answers);
/// Wants the cells of a level that a ball touches; none where the ball is not within the root.
void fr_want_ball(FrOctree *tree, uint32_t level, const double point[3], double radius);
/// One answer from a look at all rays, for any estimator.
FrLightAnswer fr_estimate_from_all(const FrPaths *paths, const FrEstimator *how, vec3s point);
