// One skinning of a plant on its way: first everything is planned and counted, then written.
#pragma once

#include "skin/organs.h"

/// What a slot holds.
typedef struct FrSlotSum {
    uint64_t vertices, indices;
    bool is_foliage;
} FrSlotSum;

/// The wood of a plant, measured. Shared by skinnings of plants that have the same wood.
typedef struct FrWood {
    FrPlan plan;
    FrSlotSum *sums;   ///< by slot
    FrBox *boxes;      ///< by tube, once it has been written
    FrDigest inputs;   ///< what it depends on besides the plant's nodes and axes
    FrDigest *digests; ///< by run: see piece.h; NULL where nobody wants to know
} FrWood;

typedef struct FrSkinJob {
    FrWood *wood;
    FrOrganPlan organs;
    FrUpAxis up;
    FrMeshPart *parts;
    uint32_t part_count;
    uint32_t *part_of;          ///< of wood by slot, then of organs; FR_NONE without any
    uint64_t vertices, indices; ///< of all parts
    FrScopes *scopes;           ///< of deformations; NULL
    FrPlant *moved;             ///< moved by those of the skeleton; NULL
    uint32_t deformations;
    FrDeformNote *notes; ///< by worker, then deformation
} FrSkinJob;

/// Plans and counts. `same`, if not NULL, is of a plant that has the same rows as this one, whose
/// wood has the inputs fr_wood_inputs() and which nothing deforms. `is_timed`: see took.h. What
/// fails leaves a job that must be cleared.
FR_MUST_USE FrStatus fr_job_begin(FrSkinJob *job, const FrPlant *plant, const FrSkinParams *params,
                                  FrUpAxis up, const FrSkinJob *same, bool is_timed,
                                  const FrContext *context);
void fr_job_clear(FrSkinJob *job);
/// Checks so many against the limits.
FR_MUST_USE FrStatus fr_job_check(const FrSkinJob *job, uint64_t vertices, uint64_t indices);
/// Room for a mesh of its parts; NULL, with a diagnostic, if there is none.
FrMesh *fr_job_mesh(const FrSkinJob *job, uint64_t vertices, uint64_t indices);
/// Whether any branch is welded to its parent, or has an end of another material: patch.h. Then a
/// mesh is written whole.
bool fr_job_is_patched(const FrSkinJob *job);
/// Writes all of it. FR_CANCELLED or FR_ERR_MACHINE or, of welds, FR_ERR_LIMIT may leave a mesh.
FR_MUST_USE FrStatus fr_job_write(FrSkinJob *job, FrMesh **mesh);
/// Reports what was noted about deformations.
void fr_job_report(FrSkinJob *job, const FrPlant *plant);
/// What the wood depends on besides nodes and axes: profiles, sizes of bark tiles.
FrDigest fr_wood_inputs(const FrPlant *plant);
FrWood *fr_wood_ref(FrWood *wood);
void fr_wood_unref(FrWood *wood);

static inline uint32_t fr_job_slots(const FrSkinJob *job) {
    return job->wood->plan.slots;
}
static inline FrDeformNote *fr_job_notes(const FrSkinJob *job, int worker) {
    return job->notes != NULL ? job->notes + (size_t)worker * job->deformations : NULL;
}
