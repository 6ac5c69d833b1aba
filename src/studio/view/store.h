/// @file store.h
/// What the graphics card holds of a view: vertices, leaves, pictures. All calls need the context
/// of the viewport to be current.
#pragma once

#include "studio/model/builder.h"

#include <cglm/struct.h>
#include <epoxy/gl.h>

typedef struct StudioStore StudioStore;

/// What a surface does to light; the colour linear, and multiplied by that of the picture.
typedef struct StudioDress {
    float tint[3];
    float cutoff, translucency, roughness, relief, mirror, clear;
} StudioDress;

/// Something to draw in one call.
typedef struct StudioPiece {
    mat4s model;
    GLuint vertices, indices;
    size_t first_index, index_count;
    GLuint leaves; ///< 0: drawn once
    size_t first_leaf, leaf_count;
    float enlarge;                ///< leaves that stand for others
    GLuint picture, bumps, gloss; ///< maps of colour, normals and roughness; 0: none
    StudioDress look;
    bool is_blade;
    bool is_still; ///< no wind moves it
    uint64_t triangles;
} StudioPiece;

/// How much there is.
typedef struct StudioAmount {
    uint64_t triangles, leaves, nodes;
    double uploaded_seconds; ///< of the last update
} StudioAmount;

StudioStore *studio_store_new(void);
void studio_store_free(StudioStore *store);
/// Sends what differs from the last view.
void studio_store_update(StudioStore *store, const StudioView *view);
/// Holds nothing any more but pictures.
void studio_store_clear(StudioStore *store);
void studio_store_add_picture(StudioStore *store, const StudioPicture *picture);
StudioAmount studio_store_amount(const StudioStore *store);
/// The box around everything; min > max if there is nothing.
void studio_store_bounds(const StudioStore *store, double min[3], double max[3]);
/// Unit vector towards the sun of the scene.
void studio_store_sun(const StudioStore *store, float sun[3]);

/// The light of the scene; its own, until the next update.
const FrShading *studio_store_shading(const StudioStore *store);

/// From where plants are seen.
typedef struct StudioOutlook {
    mat4s clip;
    float eye[3];
    float slack; ///< how far the wind may move them, parts of their size
} StudioOutlook;

/// All that is seen (NULL: all there is), in pieces of at most `most` triangles (StudioPiece).
GArray *studio_store_list_fine(const StudioStore *store, const StudioOutlook *outlook,
                               uint64_t most);
/// About `budget` triangles of what is seen: coarse wood, coarse leaves, and fewer of them, each
/// larger. In pieces of at most `most` triangles.
GArray *studio_store_list_coarse(const StudioStore *store, const StudioOutlook *outlook,
                                 uint64_t budget, uint64_t most);
/// Calls `draw` for the skeleton of each plant that stands somewhere.
void studio_store_each_skeleton(const StudioStore *store,
                                void (*draw)(void *user, const mat4s *model, GLuint points,
                                             uint32_t count),
                                void *user);
