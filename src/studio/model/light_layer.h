/// @file light_layer.h
/// What cannot be seen of a scene, made visible: its light as rays, cells of the octree and
/// colours; of plants that grow bud by bud their buds, the space they occupy, and particles. It
/// looks on the builder's thread, so that nothing waits for it, and hands overlays to the main one.
#pragma once

#include "frond/light.h"
#include "studio/model/builder.h"
#include "studio/model/overlay.h"

typedef enum StudioFieldKind {
    STUDIO_FIELD_NONE,
    STUDIO_FIELD_X, ///< slices across an axis
    STUDIO_FIELD_Y,
    STUDIO_FIELD_Z,
    STUDIO_FIELD_POINTS, ///< points of a grid
    STUDIO_FIELD_ORGANS, ///< leaves, flowers and tips
    STUDIO_FIELD_COUNT
} StudioFieldKind;

/// What shall be seen.
typedef struct StudioLightWish {
    bool rays, cells, buds, voxels, particles;
    StudioFieldKind field;
    double slice;     ///< where a slice lies in the box around the scene, 0 to 1
    uint32_t photons; ///< whose rays are shown
} StudioLightWish;

typedef enum StudioSightLayer {
    STUDIO_SIGHT_FIELD,
    STUDIO_SIGHT_CELLS,
    STUDIO_SIGHT_RAYS,
    STUDIO_SIGHT_VOXELS,
    STUDIO_SIGHT_PARTICLES,
    STUDIO_SIGHT_BUDS,
    STUDIO_SIGHT_COUNT
} StudioSightLayer;

/// What was seen.
typedef struct StudioSight {
    StudioOverlay *layers[STUDIO_SIGHT_COUNT]; ///< NULL: not wished, or there is none of it
    double slice_at;                           ///< m; of a slice
    double top;          ///< what the brightest colour stands for; 0: there is no field
    FrLightAnswer probe; ///< the light at the reference
    bool has_probe;      ///< light was asked for there
    bool has_rays;       ///< the light of this document is a density of rays
    bool has_growth;     ///< plants grow bud by bud
    FrLightStats stats;  ///< of the light
    char *problem;       ///< why there is no light, in a sentence; NULL
} StudioSight;

typedef struct StudioLightLayer StudioLightLayer;

/// `wake` is called from the builder's thread when there is something to be taken.
StudioLightLayer *studio_light_layer_new(StudioWake wake, void *user);
/// The builder must be gone or watched by no one.
void studio_light_layer_free(StudioLightLayer *layer);
/// Changes what shall be seen; studio_builder_look() makes it seen.
void studio_light_layer_set(StudioLightLayer *layer, const StudioLightWish *wish);
/// A StudioWatch, whose user is the layer.
void studio_light_layer_look(void *layer, const StudioSeen *seen, const FrContext *context);
/// What was seen last; NULL: nothing new. Free with studio_sight_free().
StudioSight *studio_light_layer_take(StudioLightLayer *layer);
void studio_sight_free(StudioSight *sight);
/// The name of the viewport's layer that shows it.
const char *studio_sight_name(StudioSightLayer layer);
