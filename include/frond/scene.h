/// @file scene.h
/// A document built: plants standing in a world, ready to be written, rendered or counted.
#pragma once

#include "frond/document.h"
#include "frond/light.h"
#include "frond/skin.h"

/// One plant of the scene, built once however often it stands there.
typedef struct FrScenePlant {
    FrPlant *plant;
    uint64_t instances;
    uint64_t *by_component; ///< instances by component, as many as plant->components has; of an
                            ///< L-system internodes and organs by the production they come from
    uint64_t modules;       ///< of the string, if an L-system made it
    FrLdrawn drawn;         ///< by its turtle
    bool has_nurbs;         ///< it is shown as rational surfaces …
    FrNurbsParams nurbs;    ///< … with these settings, at the time of its clock
    FrSpan nurbs_span;      ///< where they are written
    double *seconds;        ///< by component, as FrPgraphCounts has them; NULL: not of a rebuild
} FrScenePlant;

typedef struct FrStand {
    uint32_t plant; ///< index into plants
    double at[3];
    double turn; ///< radians about z
    double scale;
    uint32_t origin; ///< byte of the document where the element begins that has placed it; 0: none
    uint32_t number; ///< which of the plants of that element, a row or an area, from 0
    bool is_waiting; ///< a seed that has no place to stand; see fr_growth_add_seeds()
} FrStand;

/// One step of plants that grow in each other's light or bud by bud.
typedef struct FrSceneStep {
    uint64_t step;                 ///< from 1
    double seconds, light_seconds; ///< wall-clock: in all, and for the light
    uint64_t nodes, organs;        ///< of the growing plants before the step
    uint64_t queries;              ///< answered
    uint64_t rays_recast;          ///< traced anew because of what has grown
    bool grows_buds;               ///< what follows is known, and counts are those after the step
    uint64_t active_buds;          ///< growing
    uint64_t shed;                 ///< internodes that fell
    uint64_t collisions;           ///< buds that found no free way
    FrDigest digest;               ///< of the growth
} FrSceneStep;

typedef struct FrScene {
    char *name;
    GArray *plants;                     ///< FrScenePlant
    GArray *stands;                     ///< FrStand
    GPtrArray *views;                   ///< FrViewParams *, borrowed from the document
    const FrSceneParams *params;        ///< borrowed from the document
    const FrSurroundings *surroundings; ///< borrowed from the document; NULL: none
    uint32_t obstacles; ///< how many of the last plants and stands are obstacles, 0 or 1: one plant
                        ///< whose organs they are
    GArray *steps;      ///< FrSceneStep; NULL or empty: nothing grew in the light
    double light_seconds; ///< of all steps, and of sampling directions to the light
    FrLightStats light;   ///< of the last plants that answered it
    uint64_t seed;
    bool is_framed; ///< views show the box below, not what there is: sequences
    double frame_min[3], frame_max[3];
} FrScene;

/// Builds every plant that stands somewhere; a document without places shows its first plant at
/// the origin. L-systems with open symbols grow together, each place a plant of its own, if the
/// scene has a `<light>`. `seed` replaces the seeds of all plants unless it is negative; places
/// that have a seed of their own then still differ, by a mix of both. Together the plants take at
/// most FrLimits.bytes. The document must outlive the scene.
FR_API FR_MUST_USE FrStatus fr_scene_build(const FrDocument *document, int64_t seed,
                                           const FrContext *context, FrScene **scene);
/// Builds a plant that is no variation, alone; `seed` < 0 is its own, and so is a `time` that is
/// NAN. `counts` (may be NULL) is that of fr_pgraph_build() for a p-graph and empty for others.
FR_API FR_MUST_USE FrStatus fr_scene_grow(const FrDocument *document, const FrPlantDef *definition,
                                          int64_t seed, double time, const FrContext *context,
                                          FrScenePlant *plant, FrPgraphCounts *counts);
/// What is wrong with a document that only building it tells. What grows in the light is not grown:
/// it is looked at as it begins, and so is in the scene.
FR_API FR_MUST_USE FrStatus fr_scene_check(const FrDocument *document, int64_t seed,
                                           const FrContext *context, FrScene **scene);
/// Is shown an L-system that grows in the light of its scene; see fr_scene_derive().
typedef FrStatus (*FrDerivedFn)(void *user, FrLderivation *derivation, bool is_answered);
/// True if plants of this definition would grow in the light of the document's scene.
FR_API bool fr_scene_is_lit(const FrDocument *document, const FrPlantDef *definition);
/// Builds the scene and shows the first plant of the definition in each step, as it was derived
/// and again as the light has answered it, and at last as it stands in the end. An error of `see`
/// ends it.
FR_API FR_MUST_USE FrStatus fr_scene_derive(const FrDocument *document,
                                            const FrPlantDef *definition, int64_t seed,
                                            const FrContext *context, FrDerivedFn see, void *user);
/// The same as fr_scene_build() with the clocks of all plants at `time`, in years; NAN: as the
/// document says.
FR_API FR_MUST_USE FrStatus fr_scene_build_at(const FrDocument *document, int64_t seed, double time,
                                              const FrContext *context, FrScene **scene);
/// `count` instances of a plant side by side, of seeds `seed` (< 0: the plant's), `seed` + 1, …; a
/// plant that is no variation is varied by the default settings. The base keeps its own seed. Sun
/// and ground are the document's; views, made for the document's own scene, are left out.
FR_API FR_MUST_USE FrStatus fr_scene_collect(const FrDocument *document,
                                             const FrPlantDef *definition, int64_t seed,
                                             double time, uint32_t count, const FrContext *context,
                                             FrScene **scene);
/// A scene of one plant of a collection alone, at the origin, with its seed. It borrows the plant.
FR_API FrScene *fr_scene_single(const FrScene *scene, uint32_t plant);
/// How many plants the document places: by hand, in rows and strewn.
FR_API FR_MUST_USE FrStatus fr_scene_count(const FrDocument *document, const FrContext *context,
                                           uint64_t *count);
/// What a `<place>` would say that stands where that plant of a row or an area does (origin and
/// number as in FrStand); `place->plant` is borrowed from the document. False if there is none.
FR_API bool fr_scene_find_placed(const FrDocument *document, uint32_t origin, uint32_t number,
                                 const FrContext *context, FrPlace *place);
FR_API void fr_scene_free(FrScene *scene);
/// How many plants and stands of plants there are: those of obstacles come behind them.
FR_API uint32_t fr_scene_plant_count(const FrScene *scene);
FR_API uint32_t fr_scene_stand_count(const FrScene *scene);
/// Of plants, how they are shown as surfaces, and where they stand.
FR_API FrDigest fr_scene_digest(const FrScene *scene);
/// The triangles of a plant as it is shown: its skin, or those of its rational surfaces.
FR_API FR_MUST_USE FrStatus fr_scene_mesh(const FrScenePlant *plant, const FrSkinParams *skin,
                                          FrUpAxis up, const FrContext *context, FrMesh **mesh);
/// The smallest box around everything, organs' shapes included roughly; min > max if nothing has
/// an extent.
FR_API void fr_scene_bounds(const FrScene *scene, double min[3], double max[3]);
/// A lamp of the document as plants and pictures are lit by it; power in watts.
FR_API FrLamp fr_scene_lamp(const FrLampParams *params);
