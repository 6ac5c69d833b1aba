/// @file gltf.h
/// A glTF 2.0 asset while it is put together: the parts of its JSON, and the arrays of its buffer,
/// borrowed from where they lie.
#pragma once

#include "io/meshes.h"
#include "io/output.h"
#include "io/surfaces.h"

#include <jansson.h>

typedef struct FrGltf {
    const FrScene *scene;
    const FrContext *context;
    FrSurfaces surfaces;

    json_t *meshes, *accessors, *views;
    GString *nodes; ///< text of the nodes, comma separated; there may be millions
    uint32_t node_count;
    json_t *roots;  ///< nodes of the scene
    bool instances; ///< EXT_mesh_gpu_instancing is used

    GArray *chunks;         ///< FrChunk, the buffer
    uint64_t size;          ///< of the buffer so far
    GPtrArray *kept;        ///< memory that only the buffer refers to
    GPtrArray *kept_meshes; ///< FrMesh *, meshes of shapes

    uint64_t triangles; ///< drawn, with every instance counted
    uint64_t vertices;  ///< stored
} FrGltf;

/// A name as a JSON string, whatever bytes it holds.
json_t *fr_gltf_name(const char *name);

enum {
    FR_GLTF_VERTICES = 34962, ///< bufferView targets
    FR_GLTF_INDICES = 34963,
    FR_GLTF_FLOAT = 5126, ///< component types
    FR_GLTF_UINT = 5125,
};

/// Appends an array to the buffer, in place; returns its bufferView. 0 leaves stride or target out.
int fr_gltf_add_view(FrGltf *gltf, const void *data, uint64_t size, int stride, int target);
int fr_gltf_add_accessor(FrGltf *gltf, int view, uint64_t offset, int component_type,
                         uint64_t count, const char *type);

/// Accessors of one mesh part.
typedef struct FrGltfPart {
    int position, normal, uv, indices;
    int tangent;       ///< −1 until a material needs it
    uint32_t material; ///< of the plant
    bool is_foliage;
    const FrMesh *mesh;
    const FrMeshPart *part;
} FrGltfPart;

/// Views and accessors of all parts that have triangles, into `parts` (room for part_count).
uint32_t fr_gltf_add_arrays(FrGltf *gltf, const FrMesh *mesh, FrGltfPart *parts);
/// A mesh of these parts; −1 if there are none. Makes the materials that it needs, and tangents
/// where these have a normal map.
FrStatus fr_gltf_add_mesh(FrGltf *gltf, const char *name, const FrPlant *plant, FrGltfPart *parts,
                          uint32_t count, int *mesh);

/// Adds materials, textures, images and samplers as members of the asset, from the surfaces.
/// Pictures go into the buffer, or stay files if `are_files`.
void fr_gltf_add_materials(FrGltf *gltf, json_t *root, bool are_files);

/// Nodes and meshes of the whole scene from the meshes of its plants.
FrStatus fr_gltf_add_scene(FrGltf *gltf, const FrIoMeshes *meshes, const FrIoOptions *options);
