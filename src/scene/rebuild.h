/// @file scene/rebuild.h
/// How fr_scene_build() hands p-graphs to a rebuild.
#pragma once

#include "frond/rebuild.h"

/// A plant of a scene that was built by its definition and seed alone.
typedef struct FrScenePart {
    uint32_t plant;       ///< of the scene
    char *key;            ///< of id and seed; to be freed with g_free()
    FrPgraphBuild *build; ///< owns the plant; NULL: the scene does
} FrScenePart;

/// What a scene was made of.
typedef struct FrSceneParts {
    GArray *parts; ///< FrScenePart
    /// The build that the last scene had under a key, NULL.
    const FrPgraphBuild *(*last_of)(void *data, const char *key);
    void *data;
} FrSceneParts;

/// As fr_scene_build(); `parts` may be NULL. A scene that is freed must not own plants of builds.
FR_MUST_USE FrStatus fr_scene_build_parts(const FrDocument *document, int64_t seed,
                                          const FrContext *context, FrSceneParts *parts,
                                          FrScene **scene);
/// Plants that builds own are theirs to free.
void fr_scene_forget_parts(FrScene *scene, const FrSceneParts *parts);
