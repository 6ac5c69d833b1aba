// A mesh that is written, with triangles taken out of it and others put in. Private to skin.
#pragma once

#include "skin/job.h"

/// What is added to the wood of a slot.
typedef struct FrAddition {
    GArray *vertices; ///< FrVertex; NULL: nothing
    GArray *indices;  ///< uint32_t, from the part's first vertex
} FrAddition;

typedef struct FrPatch {
    FrSkinJob *job;
    FrMesh *mesh;
    uint8_t *is_gone;      ///< by triangle of the mesh
    FrAddition *additions; ///< by slot
} FrPatch;

void fr_patch_init(FrPatch *patch, FrSkinJob *job, FrMesh *mesh);
void fr_patch_clear(FrPatch *patch);
/// The part of a tube's slot.
static inline const FrMeshPart *fr_patch_part(const FrPatch *patch, uint32_t slot) {
    return &patch->mesh->parts[patch->job->part_of[slot]];
}
/// Adds vertices to the wood of a slot; answers the index of the first.
uint32_t fr_patch_add(FrPatch *patch, uint32_t slot, const FrVertex *vertices, uint32_t count);
void fr_patch_add_triangle(FrPatch *patch, uint32_t slot, const uint32_t corner[3]);
/// Writes it all anew, without vertices that nothing uses; the job's parts are then those of the
/// new mesh. FR_ERR_LIMIT if it would have too many triangles.
FR_MUST_USE FrStatus fr_patch_write(FrPatch *patch, FrMesh **mesh);

// ---- what makes use of it ----------------------------------------------------------------------

/// weld.c. Welds the tubes that are marked so: their first ring moves onto the parent's triangles,
/// those under it go, and what is left open is closed by triangles that share its places.
FR_MUST_USE FrStatus fr_weld(FrPatch *patch);
/// faces.c. Gives ends of tubes the material that they have of their own.
void fr_face_ends(FrPatch *patch);
