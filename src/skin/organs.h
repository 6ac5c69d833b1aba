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

/// One organ that is drawn: a copy of its shape.
typedef struct FrOrganPiece {
    uint32_t organ;
    uint32_t vertex; ///< first vertex in its part
    uint64_t index;  ///< first index in its part
} FrOrganPiece;

typedef struct FrOrganPlan {
    const FrPlan *plan;
    FrShapeMesh *shapes; ///< by shape; empty where no organ has it
    uint32_t shape_count;
    FrOrganPiece *pieces; ///< slot by slot, in the order of organs; atomic rc box
    uint32_t piece_count;
    bool shares_pieces;                     ///< with another plan
    uint32_t *slot_pieces;                  ///< by slot and one more: its first piece
    uint64_t *slot_vertices, *slot_indices; ///< by slot
    bool *slot_foliage;                     ///< by slot
    bool *is_used;                          ///< by shape
    FrLeafGroup *groups;                    ///< by component, then those without one
    double staying;                         ///< part of the leaves
    vec3s crown;                            ///< middle of the leaves that are shaded away from it
} FrOrganPlan;

/// What fr_write_piece() writes.
typedef enum FrPieceWriting {
    FR_WRITE_VERTICES = 1 << 0,
    FR_WRITE_INDICES = 1 << 1,
    FR_WRITE_STREAM = 1 << 2, ///< past the caches; fr_stream_end() follows
} FrPieceWriting;

/// Where an organ is and how its shape is copied.
typedef struct FrOrganPose {
    vec3s at;
    versors rotation;
    float scale;
} FrOrganPose;

/// Neither shed nor hidden, nor on something shed.
bool fr_organ_is_drawn(const FrPlan *plan, uint32_t organ);
/// FR_ERR_LIMIT if the shapes alone would take too many bytes; then no shape has been made.
/// `same` (NULL: none) is of a plant with the same rows, whose pieces are shared if they can be.
FrStatus fr_organs_init(FrOrganPlan *organs, const FrPlan *plan, const FrOrganPlan *same);
void fr_organs_clear(FrOrganPlan *organs);
static inline uint32_t fr_piece_slot(const FrOrganPlan *organs, uint32_t piece) {
    return fr_slot(organs->plan->plant->organs.material[organs->pieces[piece].organ]);
}
/// How much the level of detail enlarges it.
float fr_piece_enlarged(const FrOrganPlan *organs, uint32_t piece);
FrOrganPose fr_piece_pose(const FrOrganPlan *organs, uint32_t piece);
/// Writes a piece at its place in the slab of its slot, FrPieceWriting says what of it. `box`
/// receives that of its vertices if they are written.
void fr_write_piece(const FrOrganPlan *organs, uint32_t piece, FrUpAxis up, const FrSlab *slab,
                    unsigned writing, FrBox *box, FrDeformNote *notes);
