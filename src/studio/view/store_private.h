/// @file store_private.h
/// What the files of the store share.
#pragma once

#include "studio/view/pictures.h"
#include "studio/view/store.h"

// A mesh or a part of one.
typedef struct Part {
    GLuint vertices, indices;
    size_t vertex_size, index_size; // bytes of the buffers
    uint64_t index_count;
    uint32_t material;
    bool is_blade;
} Part;

typedef struct Look {
    FrDigest digest;
    StudioDress dress;
    float picture_tint[3];
} Look;

typedef struct Plant {
    const FrSkin *skin;                   // whose parts are held; never followed
    GArray *wood;                         // Part
    GArray *coarse[STUDIO_COARSE_LEVELS]; // Part; empty: there is none yet
    GArray *foliage;                      // Part
    GArray *shapes;                       // Part: fine and coarse in turn
    GArray *batches;                      // StudioBatch
    GArray *looks;                        // Look
    GLuint leaves, points;
    uint32_t point_count;
    uint64_t leaf_triangles, wood_triangles;
    vec3s middle; // of a ball around it
    float radius; // < 0: there is nothing
} Plant;

typedef struct Stand {
    mat4s model;
    uint32_t plant;
    bool is_still; // an obstacle
} Stand;

struct StudioStore {
    GPtrArray *plants; // Plant *
    GArray *stands;    // Stand
    StudioPictures *pictures;
    FrShading shading;
    double min[3], max[3];
    float sun[3];
    StudioAmount amount;
};

static inline const Plant *studio_store_plant(const StudioStore *store, const Stand *stand) {
    return g_ptr_array_index(store->plants, stand->plant);
}
