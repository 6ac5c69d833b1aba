// Organs: copies of shape meshes, gathered by material.
//
// From the second level of detail on, ever fewer leaves are drawn: a leaf stays while the random
// number of its path is below the part that stays (so the leaves of a level are among those of the
// one before), and those that stay are enlarged to keep the whole area, at most twice. The leaf of
// a component with the lowest number always stays, so that no kind of leaf vanishes
// (Cook, Halstead, Planck, Ryu. Stochastic Simplification of Aggregate Detail. SIGGRAPH 2007).
#pragma once

#include "skin/shape.h"
#include "skin/tube.h"

/// The leaves of one component.
typedef struct FrLeafGroup {
    uint32_t all, staying;
    double lowest; ///< random number of any
    float enlarged;
} FrLeafGroup;

typedef struct FrOrganPlan {
    const FrPlan *plan;
    FrShapeMesh *shapes;                    ///< by shape; empty where no organ has it
    uint64_t *vertex;                       ///< by organ: its first vertex in its part
    uint64_t *index;                        ///< by organ: its first index in its part
    uint64_t *slot_vertices, *slot_indices; ///< by slot
    bool *slot_foliage;                     ///< by slot
    bool *is_used;                          ///< by shape
    FrLeafGroup *groups;                    ///< by component, then those without one
    double staying;                         ///< part of the leaves
} FrOrganPlan;

/// Neither shed nor hidden, nor on something shed.
bool fr_organ_is_drawn(const FrPlan *plan, uint32_t organ);
/// FR_ERR_LIMIT if the shapes alone would take too many bytes; then no shape has been made.
FrStatus fr_organs_init(FrOrganPlan *organs, const FrPlan *plan);
void fr_organs_clear(FrOrganPlan *organs);
/// Writes organs [begin, end).
void fr_write_organs(const FrOrganPlan *organs, size_t begin, size_t end, FrUpAxis up, FrMesh *mesh,
                     const uint32_t *part_of, FrBox *boxes, FrDeformNote *notes);
