/// @file meshes.h
/// The meshes of a scene's plants, and how each stand moves them.
#pragma once

#include "frond/io.h"

/// Sizes of all meshes: `once` as they are stored, `everywhere` with each stand counted.
typedef struct FrIoCount {
    uint64_t meshes;
    uint64_t vertices, triangles;
    uint64_t vertices_everywhere, triangles_everywhere;
} FrIoCount;

/// The stands of each plant of a scene: those of plant p are number[first[p]] … number[first[p + 1]
/// − 1], in the scene's order.
typedef struct FrIoStands {
    uint32_t *first, *number;
} FrIoStands;

typedef struct FrIoMeshes {
    FrMesh **meshes; ///< one for each plant of the scene; NULL where it stands nowhere
    FrIoStands stands;
    uint32_t length; ///< plants of the scene
    FrIoCount count;
} FrIoMeshes;

/// Skins every plant that stands somewhere. `expands`: the format repeats a mesh for each stand, so
/// that counts against the limit of triangles.
FrStatus fr_io_meshes_make(FrIoMeshes *meshes, const FrScene *scene, const FrSkinParams *skin,
                           FrUpAxis up, bool expands, const FrContext *context);
/// Where the plant is described of which most triangles stand in the scene.
FrSpan fr_io_largest_place(const FrIoMeshes *meshes, const FrScene *scene);
void fr_io_meshes_clear(FrIoMeshes *meshes);

const FrPlant *fr_io_plant(const FrScene *scene, uint32_t plant);
const FrStand *fr_io_stand(const FrScene *scene, guint stand);
/// Gathered in one pass. Free with fr_io_stands_clear().
FrIoStands fr_io_stands_of(const FrScene *scene);
void fr_io_stands_clear(FrIoStands *stands);
/// How often a plant stands in the scene.
static inline uint32_t fr_io_stand_count(const FrIoStands *stands, uint32_t plant) {
    return stands->first[plant + 1] - stands->first[plant];
}

/// How a stand moves points of a mesh with that up axis: turned, scaled, moved.
typedef struct FrPose {
    double at[3];
    double cosine, sine, scale;
    FrUpAxis up;
} FrPose;

FrPose fr_io_pose(const FrStand *stand, FrUpAxis up);
/// A vertex where it stands; normal and texture coordinates too.
FrVertex fr_io_posed(const FrPose *pose, const FrVertex *vertex);
