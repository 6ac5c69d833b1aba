/// @file rebuild.h
/// A document shown while it is edited: after a change only what depends on it is done again.
///
///     FrRebuild *shown = fr_rebuild_new(&params, FR_UP_Y);
///     fr_rebuild_update(shown, document, -1, &context);        first: everything
///     fr_document_set(document, "leaf.width", "0.05", &context);
///     fr_rebuild_update(shown, document, -1, &context);        then: the leaves' vertices
///
/// Plants and meshes have the bits that fr_scene_build() and fr_skin_plant() give. What depends on
/// what: docs/rebuilding.md.
#pragma once

#include "frond/scene.h"

typedef struct FrRebuild FrRebuild;

/// What the last update did, of how much.
typedef struct FrRebuildWork {
    uint64_t instances, instances_made; ///< of components of p-graphs
    FrSkinWork skin;                    ///< of all plants together
} FrRebuildWork;

FR_API FrRebuild *fr_rebuild_new(const FrSkinParams *params, FrUpAxis up);
FR_API void fr_rebuild_free(FrRebuild *rebuild);
/// Shows the document as it is now, whatever was shown before; `seed` is as in fr_scene_build().
/// Plants are the same if their ids and seeds are. What fails or is cancelled leaves scene and
/// skins as they were. Plants of p-graphs are taken over in parts, others are grown anew; of all
/// only the vertices that differ are written.
FR_API FR_MUST_USE FrStatus fr_rebuild_update(FrRebuild *rebuild, const FrDocument *document,
                                              int64_t seed, const FrContext *context);
/// The scene, NULL before the first update; borrowed until the next one that succeeds. It does not
/// need the document.
FR_API const FrScene *fr_rebuild_scene(const FrRebuild *rebuild);
/// The skin of a plant of the scene.
FR_API const FrSkin *fr_rebuild_skin(const FrRebuild *rebuild, uint32_t plant);
FR_API FrRebuildWork fr_rebuild_work(const FrRebuild *rebuild);
