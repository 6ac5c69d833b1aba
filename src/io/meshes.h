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

typedef struct FrIoMeshes {
    FrMesh **meshes; ///< one for each plant of the scene; NULL where it stands nowhere
    uint32_t length; ///< plants of the scene
    FrIoCount count;
} FrIoMeshes;

/// Skins every plant that stands somewhere. `expands`: the format repeats a mesh for each stand, so
/// that counts against the limit of triangles.
FrStatus fr_io_meshes_make(FrIoMeshes *meshes, const FrScene *scene, const FrSkinParams *skin,
                           FrUpAxis up, bool expands, const FrContext *context);
void fr_io_meshes_clear(FrIoMeshes *meshes);

const FrPlant *fr_io_plant(const FrScene *scene, uint32_t plant);
const FrStand *fr_io_stand(const FrScene *scene, guint stand);
/// How often a plant stands in the scene.
uint32_t fr_io_stand_count(const FrScene *scene, uint32_t plant);

/// How a stand moves points of a mesh with that up axis: turned, scaled, moved.
typedef struct FrPose {
    double at[3];
    double cosine, sine, scale;
    FrUpAxis up;
} FrPose;

FrPose fr_io_pose(const FrStand *stand, FrUpAxis up);
/// A vertex where it stands; normal and texture coordinates too.
FrVertex fr_io_posed(const FrPose *pose, const FrVertex *vertex);
