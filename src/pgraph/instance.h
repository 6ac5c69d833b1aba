/// @file instance.h
/// One instance on its way from a row of a level to nodes, axes, organs and children.
#pragma once

#include "pgraph/field.h"
#include "pgraph/level.h"
#include "pgraph/stem.h"
#include "pgraph/unroll.h"

/// Everything a build has, shared by the loops over its levels.
typedef struct FrExpansion {
    const FrPgraph *graph;
    const FrUnrolled *unrolled;
    const FrPrepared *prepared; ///< of each component
    FrPlant *plant;
    FrLevel level, next;
    GHashTable **faults;        ///< of each worker
    const FrProgress *progress; ///< once cancelled, what is made need not be good; NULL
    FrShape *blades;      ///< of this level's organs, for shapes to be found after the loop; NULL
    uint32_t first_organ; ///< of this level
    GArray *fields;       ///< FrField
    uint32_t depth;       ///< of this level, from 0
    const struct FrTwins *twins;       ///< instances of the last build; NULL
    const FrLightField *light;         ///< that Worlds sample; NULL
    const struct FrGrafting *grafting; ///< what stands at this level's grafts
    const struct FrEdits *edits;       ///< by hand; NULL: none
    uint64_t *places;       ///< of the next level, for fr_pgraph_path(); NULL: not asked for
    uint32_t *ramps;        ///< of each material, see fr_ramps_add(); NULL: none has one
    struct FrTimer *timers; ///< of each worker, see timing.h; NULL: nothing is timed
    double tick;            ///< s that reading the clock takes
} FrExpansion;

/// Where and how large an instance is, its own transformation applied.
typedef struct FrPose {
    uint32_t bearer;
    vec3s offset;
    versors rotation;
    double scale;
    bool is_turned_or_moved;
} FrPose;

/// What a parent hands to one child.
typedef struct FrChild {
    FrPose site;
    FrKey key; ///< of the place; the child's id is still to be hashed in
    uint32_t i, n;
    bool is_multiplied;
    uint16_t arms; ///< of a stem that forks: which it is on, see edit.h
    uint8_t joint;
    uint16_t order;
    float x, parent_length, parent_radius, stretch;
    float age; ///< of the clock around it, years; less than 0: not yet there
    uint32_t axis;
} FrChild;

static inline const FrStage *fr_instance_stage(const FrExpansion *expansion, uint32_t row) {
    return &g_array_index(expansion->unrolled->stages, FrStage, expansion->level.stage[row]);
}

static inline const FrStageLink *fr_stage_link(const FrExpansion *expansion, const FrStage *stage,
                                               uint32_t k) {
    return &g_array_index(expansion->unrolled->links, FrStageLink, stage->first_link + k);
}

static inline const FrPrepared *fr_stage_prepared(const FrExpansion *expansion, uint32_t stage) {
    return &expansion
                ->prepared[g_array_index(expansion->unrolled->stages, FrStage, stage).component];
}

/// The edit of the instance in that row, NULL if it has none.
const struct FrGraphEdit *fr_instance_edit(const FrExpansion *expansion, uint32_t row);
/// Sets the variables of the instance in that row.
void fr_instance_enter(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// Sets the variables that are a place in the plant.
void fr_place_set(FrVars *vars, vec3s place);
/// Its pose; the variables must be set.
FrPose fr_instance_pose(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// What its stem grows from, where it stands with that pose.
FrStemBase fr_instance_stem_base(const FrExpansion *expansion, uint32_t row, FrPose pose);
/// Turns `frame` so that its direction `from` comes nearer to `to` by `part` of the angle.
versors fr_turned_towards(versors frame, vec3s from, vec3s to, double part);
/// The fields it grows in.
FrFields fr_instance_fields(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// The material of what it makes, and that of its colour.
uint32_t fr_instance_material(const FrExpansion *expansion, uint32_t row);
uint32_t fr_instance_look(const FrExpansion *expansion, uint32_t row);
/// A pose moved and turned within itself.
FrPose fr_pose_moved(FrPose pose, vec3s by, versors turn);
/// Variables for the parameters that a multiplier has for each child.
void fr_place_enter(FrEvaluator *place, const FrEvaluator *parent, const FrLevel *level,
                    uint32_t row, uint32_t i, uint32_t n, FrKey key);
/// Writes a child into row `at` of the next level, where `link` is of the instance in `row`.
void fr_child_write(const FrExpansion *expansion, uint32_t row, const FrStageLink *link,
                    const FrChild *child, uint32_t at);

/// Lets the instance in row `at` of a level be another, as an edit says.
void fr_edit_apply(const FrExpansion *expansion, const FrLevel *level, uint32_t at, uint32_t edit);
/// Counts what the instance in `row` makes, except children that flags decide about.
void fr_instance_measure(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// Children that are made, by flags.
uint32_t fr_instance_children(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// Makes it: the counts have become indices.
void fr_instance_make(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                      FrEvaluator *place);

/// A child that is not multiplied, of the instance in `row`.
FrChild fr_single_child(const FrExpansion *expansion, uint32_t row, FrPose site);
/// The variables of a leaf's shape: close ones are taken as one.
void fr_enter_leaf_shape(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// Writes row `organ` of the plant's organs and returns it.
uint32_t fr_write_organ(const FrExpansion *expansion, uint32_t row, uint32_t organ, FrPose pose,
                        uint32_t shape);

/// The shape of a leaf, or FR_NONE if it is found after the loop over the level. The variables of
/// the instance must be set if its shape is evaluated; they are changed.
uint32_t fr_instance_leaf_shape(const FrExpansion *expansion, uint32_t row, uint32_t organ,
                                FrEvaluator *evaluator);
/// Gives an organ of the instance in `row` the shape and the material of a piece.
void fr_piece_write(const FrExpansion *expansion, uint32_t row, uint32_t organ,
                    const FrPiece *piece);
/// Writes the pieces of its primitive from row `organ` on; returns the row after.
uint32_t fr_write_pieces(const FrExpansion *expansion, uint32_t row, uint32_t organ, FrPose pose);

/// The kinds, each from the file of its name.
void fr_make_graft(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
void fr_make_stem(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                  FrEvaluator *place);
void fr_make_golden(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                    FrEvaluator *place);
void fr_make_star(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                  FrEvaluator *place);
void fr_make_scatter(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator,
                     FrEvaluator *place);
/// How many children a scatter strews, as yet not whole.
double fr_scatter_count(const FrPrepared *prepared, FrEvaluator *evaluator);
void fr_make_revo(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator);
/// Writes the branches of a Tree's stem into the next level from `at` on; returns the row after.
uint32_t fr_make_branches(const FrExpansion *expansion, uint32_t row, const FrStem *stem,
                          FrPose base, FrEvaluator *evaluator, FrEvaluator *place, uint32_t at);
/// Makes the children that are not multiplied, from `at` on; returns the row after. They have keys
/// below the child's, or below the instance's where that is 0.
uint32_t fr_make_single_children(const FrExpansion *expansion, uint32_t row, FrChild child,
                                 uint32_t at);
