// One call of fr_nurbs_plant(), and its parts.
#pragma once

#include "skin/mesh.h"
#include "skin/nurbs.h"
#include "skin/organs.h"

/// Where what a tube or organ makes is written.
typedef struct FrNurbsPlace {
    uint64_t piece, point, knot;
    uint32_t section; ///< tubes
    uint32_t model;   ///< organs that are copies; FR_NONE
    bool has_fork;    ///< tubes: fork surfaces follow its caps
    uint32_t rows;    ///< of tubes, surfaces of organs; 0: nothing
} FrNurbsPlace;

/// A shape and where its knots are kept, once for all organs that have it.
typedef struct FrNurbsShapeForms {
    GArray *forms; ///< FrNurbsForm; NULL if no organ has it
    uint64_t knot, points, textures;
    uint64_t texture; ///< where its coordinates are kept
} FrNurbsShapeForms;

/// A shape in one size, which copies are placements of.
typedef struct FrNurbsModel {
    uint32_t shape, uses;
    double scale;
    uint64_t piece, point; ///< where its surfaces are kept
} FrNurbsModel;

/// One call of fr_nurbs_plant().
typedef struct FrNurbsJob {
    const FrNurbsParams *params;
    const FrContext *context;
    int share; ///< which organs are copies
    FrPlan plan;
    FrScopes *scopes;    ///< of deformations; NULL
    FrPlant *moved;      ///< by the deformations of the skeleton; NULL
    FrDeformNote *notes; ///< by worker and deformation
    FrNurbsSections sections;
    uint64_t *section_knot;    ///< by section
    FrNurbsPlace *tubes;       ///< by tube
    FrNurbsPlace *organs;      ///< by organ
    FrNurbsShapeForms *shapes; ///< by shape
    GArray *models;            ///< FrNurbsModel, in the order of their first organs
    FrNurbsPath *paths;        ///< by worker
    FrNurbsSkin *skin;
    uint32_t organ_count;
    uint64_t pieces, points, knots, textures, copies, own_pieces;
} FrNurbsJob;

/// Knots of what is ruled: the first four of every skin.
enum { FR_RULED_KNOTS = 4 };

/// Takes control points through the free-form deformations around them.
void fr_nurbs_deform(const FrNurbsJob *job, uint32_t scope, double (*points)[4], uint64_t count,
                     int worker);

// ---- nurbs_fork.c ------------------------------------------------------------------------------

enum { FR_FORK_PIECES = 3, FR_FORK_POINTS = 105, FR_FORK_KNOTS = 19 };
/// Knots of all fork surfaces: 8 along u, 11 along v; after those of what is ruled.
extern const double fr_fork_knots[FR_FORK_KNOTS];
/// True if a branch gets fork surfaces where it begins.
bool fr_fork_is_wanted(const FrNurbsJob *job, const FrTube *tube);
/// Writes them: FR_FORK_PIECES pieces of FR_FORK_POINTS control points together.
void fr_fork_write(const FrNurbsJob *job, const FrTube *tube, const double *knots,
                   FrNurbsPiece *pieces, double (*points)[4]);

// nurbs_left_out.c

/// Warns once of each plant whose branches have a finish that surfaces leave out.
void fr_nurbs_tell_left_out(const FrNurbsJob *job);

// nurbs_tubes.c, nurbs_organs.c: count what there is, give it its places, write it.

void fr_nurbs_place_tubes(FrNurbsJob *job);
void fr_nurbs_write_tubes(FrNurbsJob *job);
/// FR_ERR_LIMIT if the shapes alone would take too many bytes; then none has been made.
FrStatus fr_nurbs_make_shapes(FrNurbsJob *job);
void fr_nurbs_place_organs(FrNurbsJob *job);
/// Writes knots and coordinates of shapes, then what organs make of them.
void fr_nurbs_write_organs(FrNurbsJob *job);
