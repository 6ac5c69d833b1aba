/// @file view.h
/// What a build hands to whoever draws it: tubes as they are kept, leaves as placements of a few
/// shapes, lines of the skeleton, and how materials look.
#pragma once

#include "frond/rebuild.h"
#include "frond/shading.h"

/// 32 bytes, as a graphics card takes it.
typedef struct StudioLeaf {
    float at[3];
    float scale;
    float turn[4]; ///< quaternion x, y, z, w
} StudioLeaf;

/// Leaves of one shape and material: `count` from `first` on, in an order such that the first k of
/// them are spread evenly over all.
typedef struct StudioBatch {
    uint32_t shape, material;
    uint32_t first, count;
    float reach; ///< m, of a leaf from its base, in the mean
} StudioBatch;

/// A shape at its full detail and as coarse as can be; NULL where it could not be made.
typedef struct StudioShape {
    FrMesh *fine, *coarse;
} StudioShape;

typedef struct StudioLook {
    FrMaterial *material;  ///< a reference
    FrDigest digest;       ///< of all that its pictures depend on
    float tint[3];         ///< linear; of what has no picture
    float picture_tint[3]; ///< linear; multiplies the picture
    float alpha_cutoff, translucency, roughness, relief, mirror, clear;
} StudioLook;

/// A point of the skeleton: lines run from each first to each second of a pair.
typedef struct StudioPoint {
    float at[3];
    float order; ///< botanical, of its axis
} StudioPoint;

/// How many there are of coarse wood.
enum { STUDIO_COARSE_LEVELS = 3 };

typedef struct StudioPlant {
    const FrPlant *plant;                      ///< borrowed
    const FrSkin *wood;                        ///< borrowed
    FrMesh *coarse_wood[STUDIO_COARSE_LEVELS]; ///< for while the view moves, the first is the
                                               ///< finest; NULL: not made yet
    FrMesh *foliage;     ///< of a plant whose leaves are deformed, or all of one that is shown as
                         ///< rational surfaces; else NULL
    bool is_rational;    ///< shown as rational surfaces: no wood is drawn
    GArray *leaves;      ///< StudioLeaf
    GArray *batches;     ///< StudioBatch
    GArray *shapes;      ///< StudioShape, by shape of the plant
    GArray *looks;       ///< StudioLook, by material of the plant
    GArray *points;      ///< StudioPoint
    vec3s middle;        ///< of a ball around all of it …
    float radius;        ///< … that is m wide; < 0: there is nothing
    double leaf_seconds; ///< that placing its leaves took
} StudioPlant;

typedef struct StudioView {
    const FrScene *scene;  ///< borrowed
    GPtrArray *plants;     ///< StudioPlant *, as many as the scene has
    uint32_t coarse_nodes; ///< internodes that the coarse wood of a plant may have
    FrShading shading;     ///< the light that it is shown in; set by who shows it
} StudioView;

/// All but coarse_wood, of what a rebuild holds; borrowed from it until its next update.
StudioView *studio_view_new(const FrRebuild *rebuild, const FrContext *context);
/// The same of any scene, with the skin of each of its plants.
StudioView *studio_view_of(const FrScene *scene, const FrSkin *const *skins,
                           const FrContext *context);
/// How many internodes stand in it.
uint64_t studio_view_nodes(const StudioView *view);
/// Takes over the coarse wood of the view before (NULL: none), where the wood has not changed
/// since.
void studio_view_take_coarse(StudioView *view, StudioView *old);
/// Makes the coarse wood where there is none yet.
void studio_view_add_coarse(StudioView *view, const FrContext *context);
void studio_view_free(StudioView *view);
/// The digest of all that a material's pictures depend on.
FrDigest studio_look_digest(const FrMaterialParams *params);
