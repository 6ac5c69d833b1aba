/// @file ground.h
/// What a pointer means in a scene: the point of the ground below it, or what stands there.
#pragma once

#include "frond/pick.h"
#include "frond/terrain.h"

typedef struct StudioGround StudioGround;

typedef enum StudioHitKind {
    STUDIO_HIT_NOTHING, ///< the ray goes to the sky
    STUDIO_HIT_GROUND,
    STUDIO_HIT_OBSTACLE,
    STUDIO_HIT_PLANT,
} StudioHitKind;

typedef struct StudioHit {
    StudioHitKind kind;
    double at[3];    ///< where the ray meets it
    double foot[3];  ///< of a plant where it stands; else as `at`
    uint32_t origin; ///< byte of the document where the element begins that it belongs to; 0: none
    uint32_t number; ///< of a plant: which of a row or an area it is
} StudioHit;

/// The ground of a document and its visible obstacles. The document need not outlive it. Immutable;
/// for any thread.
StudioGround *studio_ground_new(const FrDocument *document, const FrContext *context);
/// NULL stays NULL: level ground without obstacles, here and in all that follows.
StudioGround *studio_ground_ref(StudioGround *ground);
void studio_ground_unref(StudioGround *ground);
/// The height of the ground at a place; 0 beside a terrain.
double studio_ground_height(const StudioGround *ground, double x, double y);
/// Where a ray (unit length) meets the ground first; false: it never does, or farther away than
/// `farthest`.
bool studio_ground_meet(const StudioGround *ground, const double origin[3],
                        const double direction[3], double farthest, double at[3]);
/// How far from what is looked at something may be set down: twice as far as it is looked at from
/// and the box around the scene is wide (min > max: nothing stands). A pointer just below the
/// horizon means no place that anyone would see.
double studio_ground_reach(double distance, const double min[3], const double max[3]);
/// What a ray meets first of a scene (NULL: an empty one) that was built from the same document.
StudioHit studio_ground_hit(const StudioGround *ground, const FrScene *scene,
                            const double origin[3], const double direction[3], double spread);
/// The box around all internodes of what an element has placed (its byte); false: there is nothing.
bool studio_ground_bounds(const FrScene *scene, uint32_t origin, double min[3], double max[3]);
