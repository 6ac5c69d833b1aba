/// @file backend.h
/// What a backend of light has to do. Private to light.
#pragma once

#include "frond/light.h"

/// Errors leave the backend without a scene. `query` answers in the backend's own measure; light.c
/// divides by the reference.
typedef struct FrLightBackend {
    FrStatus (*set_scene)(FrLight *light, const FrLightScene *scene, const FrContext *context);
    FrStatus (*query)(FrLight *light, const vec3s *points, size_t count, const FrContext *context,
                      FrLightAnswer *answers);
    void (*forget)(FrLight *light);                                    ///< NULL: nothing to drop
    const double *(*absorbed)(const FrLight *light, uint32_t stand);   ///< NULL: unknown
    void (*rays)(const FrLight *light, uint32_t most, GArray *rays);   ///< NULL: it keeps none
    void (*cells)(const FrLight *light, uint32_t most, GArray *cells); ///< NULL: it has none
    void (*stats)(const FrLight *light, FrLightStats *stats);          ///< adds to zeros
    void (*free)(FrLight *light);
} FrLightBackend;

/// Stands first in the struct of every backend.
struct FrLight {
    const FrLightBackend *backend;
    bool has_scene;
    float reference; ///< the intensity at the reference; 1 without one
};
