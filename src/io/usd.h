/// @file usd.h
/// The text of a USD layer while it is written.
#pragma once

#include "io/meshes.h"
#include "io/organ_groups.h"
#include "io/output.h"
#include "io/surfaces.h"

typedef struct FrUsd {
    const FrScene *scene;
    const FrContext *context;
    const FrIoOptions *options;
    FrIoMeshes meshes;
    FrSurfaces surfaces;
    GPtrArray *plants; ///< struct FrUsdPlant *, by plant of the scene; NULL where it stands nowhere
    FrOutput output;
    int depth; ///< of braces, for indentation
    uint64_t bytes;
} FrUsd;

/// What is kept of a plant that stands somewhere.
typedef struct FrUsdPlant {
    GArray *groups;          ///< FrOrganGroup, placed by point instancers; NULL: leaves are merged
    FrMesh **shapes;         ///< by shape of the plant; NULL where no group needs it
    uint32_t *part_surface;  ///< by part of the plant's mesh: index of its surface
    uint32_t *group_surface; ///< by group
    uint64_t triangles;      ///< that one stand shows
} FrUsdPlant;

/// A line, formatted, indented by the depth.
void fr_usd_line(FrUsd *usd, const char *format, ...) G_GNUC_PRINTF(2, 3);
/// A line and an opening brace on the next; a closing brace.
void fr_usd_open(FrUsd *usd, const char *format, ...) G_GNUC_PRINTF(2, 3);
void fr_usd_close(FrUsd *usd);
void fr_usd_indent(FrUsd *usd);
/// `what = [`, tuples or numbers with commas between, then `]` and, unless NULL, what is said about
/// the list.
void fr_usd_begin_list(FrUsd *usd, const char *what);
void fr_usd_tuple(FrUsd *usd, const float *values, int count, int decimals, bool first);
void fr_usd_end_list(FrUsd *usd, const char *about);
/// A name as USD allows it: letters, digits and `_`, no digit first. Free with g_free().
char *fr_usd_name(const char *name);

/// The surfaces and shapes that a plant of the scene needs; to be freed whatever *status says.
FrUsdPlant *fr_usd_plant_new(FrUsd *usd, uint32_t plant, FrStatus *status);
void fr_usd_plant_free(FrUsdPlant *own, const FrPlant *plant);
/// Everything of a plant below the prim of that path, which has been opened.
void fr_usd_plant(FrUsd *usd, uint32_t plant, const char *path);

/// Materials below `path`, a Scope: those surfaces for which `used` is true.
void fr_usd_materials(FrUsd *usd, const char *path, const bool *used);
/// The name of the material of a surface below that path. Free with g_free().
char *fr_usd_material_name(const FrUsd *usd, uint32_t surface);
