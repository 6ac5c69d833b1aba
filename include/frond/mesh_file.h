/// @file mesh_file.h
/// Triangles read from files: `.obj`, `.stl`, `.gltf`, `.glb`, and rational surfaces of `.igs` and
/// of `.obj` with free-form statements.
#pragma once

#include "frond/context.h"
#include "frond/digest.h"
#include "frond/material.h"
#include "frond/nurbs.h"
#include "frond/vector.h"

/// Triangles of one material.
typedef struct FrMeshFilePart {
    uint32_t first_index, index_count;
    FrMaterial *material; ///< what the file says of it; owned reference; NULL: nothing
} FrMeshFilePart;

/// What a file holds, all its pieces where they stand, z up: `.gltf`, `.glb` and `.obj` have y up
/// and are turned. Immutable, reference counted.
typedef struct FrMeshFile {
    gatomicrefcount references;
    vec3s *positions, *normals; ///< owned
    float (*uvs)[2];            ///< owned; (0, 0) at the top left of pictures
    uint32_t *indices;          ///< owned; counter-clockwise from outside
    uint32_t vertex_count, index_count;
    FrMeshFilePart *parts; ///< owned
    uint32_t part_count;
    GArray *surfaces; ///< FrNurbsSurface, of which the triangles of the first part are cut; owned;
                      ///< NULL
    vec3s min, max;   ///< of positions that triangles use
    bool is_closed;   ///< every edge has a triangle on both sides
    FrDigest digest;  ///< of all of it
} FrMeshFile;

/// Reads the file `name`, a path relative to `folder` that does not lead out of it. Files it names
/// itself must lie beside or below it. NULL, *status and a diagnostic at `span` if it cannot be
/// read, is no such file, holds no triangles or more than the context's limits allow; sizes are
/// compared with the limits before anything is read.
FR_API FrMeshFile *fr_mesh_file_load(const char *folder, const char *name, FrSpan span,
                                     const FrContext *context, FrStatus *status);
/// Triangles that are made, not read, of one part. Takes the arrays; `normals` may be NULL: smooth
/// ones are made. Takes a reference to `material`, which may be NULL.
FR_API FrMeshFile *fr_mesh_file_new(vec3s *positions, vec3s *normals, float (*uvs)[2],
                                    uint32_t vertex_count, uint32_t *indices, uint32_t index_count,
                                    FrMaterial *material);
FR_API FrMeshFile *fr_mesh_file_ref(FrMeshFile *file);
FR_API void fr_mesh_file_unref(FrMeshFile *file);
