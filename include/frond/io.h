/// @file io.h
/// Model files. A file appears whole or not at all: it is written beside its name, then renamed.
#pragma once

#include "frond/nurbs_skin.h"
#include "frond/scene.h"

/// How organs stand in a .glb or .gltf.
typedef enum FrLeaves {
    FR_LEAVES_MERGED, ///< one mesh per plant and material: opens everywhere
    FR_LEAVES_NODES,  ///< a node each, sharing one mesh per shape
    FR_LEAVES_GPU,    ///< EXT_mesh_gpu_instancing
} FrLeaves;

typedef struct FrIoOptions {
    FrLeaves leaves;
    FrSkinParams skin;
    FrNurbsParams nurbs; ///< of .igs and .stp files and .nurbs.obj
} FrIoOptions;

/// What was written.
typedef struct FrIoStats {
    uint64_t meshes, vertices, triangles; ///< triangles: with every instance counted
    uint64_t surfaces;                    ///< rational ones; then there are no triangles
    uint64_t entities;                    ///< of an .mtg, .opf or .txt, which are no surfaces
    uint64_t bytes;
    double skin_seconds, write_seconds;
} FrIoStats;

FR_API FrIoOptions fr_io_options_default(void);
/// True if the extension of `path` is one that fr_io_write() knows.
FR_API bool fr_io_can_write(const char *path);
/// True if the format of `path` holds the skin of plants; graphs and lines do not.
FR_API bool fr_io_has_surface(const char *path);
/// True if the format of `path` can place leaves that share a mesh, as FrIoOptions.leaves says.
FR_API bool fr_io_has_instances(const char *path);
/// The extensions, e.g. ".glb", for messages; NULL-terminated.
FR_API const char *const *fr_io_extensions(void);
/// Writes the scene in the format of the extension of `path`: .glb .gltf .usda .obj .ply .stl .3mf,
/// the topology as .mtg and .opf, lines as .txt, and as rational surfaces .igs .iges .stp .step and
/// .nurbs.obj (free-form statements).
FR_API FR_MUST_USE FrStatus fr_io_write(const FrScene *scene, const char *path,
                                        const FrIoOptions *options, const FrContext *context,
                                        FrIoStats *stats);
/// Replaces a file at once with what `write` puts into it; nothing is left behind on failure.
FR_API FR_MUST_USE FrStatus fr_io_replace_file(const char *path,
                                               bool (*write)(void *user, int descriptor),
                                               void *user, FrDiags *diags);
