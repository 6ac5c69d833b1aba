// Where a branch grows out of its parent.
#pragma once

#include "skin/plan.h"

/// How much wider than the branch it begins, for a collar of size 1.
#define FR_COLLAR_FLARE 0.3F

/// The base of a branch. Found twice, when counting and when writing, from the plant alone.
typedef struct FrCollar {
    vec3s origin;        ///< of the branch
    vec3s direction;     ///< unit, of the branch as it leaves the parent
    vec3s exit;          ///< where its axis leaves the parent's surface
    vec3s along;         ///< unit, the parent's direction there
    vec3s outward;       ///< unit, the surface's normal there
    float radius;        ///< m, of the branch
    float parent_radius; ///< m
    float exit_distance; ///< m, from origin to exit
    float join;          ///< m along the branch: clear of the parent all around
    float clear;         ///< m along the branch: no ring at a node before
    /// Too near the parent's end for a collar: it begins with a plain ring around `exit` of
    /// `parent_radius`, across `along`.
    bool is_nested;
    bool has_join; ///< a ring stands at `join`
    uint8_t rings; ///< on and above the parent's surface, before `join`
} FrCollar;

FrCollar fr_collar_find(const FrPlan *plan, const FrTube *tube, uint32_t sides);

/// Point, direction and radius of a tube `distance` metres along it, by its nodes.
void fr_tube_at(const FrPlan *plan, const FrTube *tube, float distance, vec3s *at, float *radius);

enum { FR_LIMB_MOST = 50 };

/// The parent near a branch as it is skinned: its rings.
typedef struct FrLimb {
    struct FrLimbRing {
        vec3s at, tangent;
        float radius;
        float s; ///< m along the rings
    } rings[FR_LIMB_MOST];
    uint32_t count;
    float exit;    ///< s of the collar's exit
    float sink;    ///< part of the radius that is surely inside the parent's polygon
    uint32_t node; ///< bearer
    const FrSection *section;
} FrLimb;

void fr_limb_find(const FrPlan *plan, const FrTube *tube, const FrCollar *collar, FrLimb *limb);

/// Where the column of a branch that is `spoke` away from its axis meets the parent's surface.
void fr_collar_foot(const FrPlan *plan, const FrCollar *collar, const FrLimb *limb, vec3s spoke,
                    vec3s *position, vec3s *normal);
/// How far along the branch that is, were the parent a cylinder.
float fr_collar_distance(const FrCollar *collar, vec3s spoke);
