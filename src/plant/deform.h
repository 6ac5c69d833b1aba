/// @file deform.h
/// Free-form deformation of a plant: points and frames taken through the scopes around them.
///
/// Scopes work at two levels. Those of the *skeleton* move nodes, and with them what nodes bear;
/// then those of *triangles* move the vertices of the skin that was made around the moved
/// skeleton. At each level the innermost scope comes first.
#pragma once

#include "frond/plant.h"

/// A place on its way through scopes, and how space around it was stretched and turned.
typedef struct FrFlow {
    double at[3];
    double turn[3][3]; ///< Jacobian of all maps so far
} FrFlow;

/// What went wrong with one deformation.
typedef struct FrDeformNote {
    bool is_singular;  ///< somewhere it flattened space, so a normal or frame could not follow
    FrExprFault fault; ///< of those met the first in the text
    int axis;          ///< of the expression at fault
} FrDeformNote;

/// A place and a rotation (columns are its axes) in the plant's coordinates.
typedef struct FrFooting {
    double at[3];
    double axes[3][3];
} FrFooting;

/// Where a scope stands: as it was made, and moved with the skeleton around it.
typedef struct FrScopeFooting {
    FrFooting made, moved;
    FrFooting carried; ///< `moved` taken through the triangle scopes around it: for cuts
    bool is_known;     ///< the latter two
} FrScopeFooting;

typedef struct FrScopes {
    const FrPlant *plant;
    FrScopeFooting *stands; ///< by scope
    bool *has_triangles;    ///< by scope: the level of triangles moves what is in it
    bool has_skeleton;      ///< any scope deforms the skeleton
} FrScopes;

typedef enum FrDeformLevel { FR_LEVEL_SKELETON, FR_LEVEL_TRIANGLES } FrDeformLevel;

// ---- deform_map.c: one deformation -------------------------------------------------------------

/// Moves `at`, in the plant's coordinates, by the deformation of one scope that stands at `stand`.
void fr_deform_map(const FrPlant *plant, const FrDeformer *scope, const FrFooting *stand,
                   FrFlow *flow, FrDeformNote *note);
/// The rotation nearest to `matrix` (Higham 1986). False if there is none, as it flattens space
/// or turns it inside out; then `rotation` is the identity.
bool fr_deform_rotation(const double matrix[3][3], double rotation[3][3]);
/// a · b.
void fr_deform_product(const double a[3][3], const double b[3][3], double product[3][3]);
/// Turns a rotation's columns into a unit quaternion.
versors fr_deform_quaternion(const double axes[3][3]);
void fr_deform_matrix(versors rotation, double axes[3][3]);
double fr_deform_determinant(const double m[3][3]);
/// Cofactors of m: its inverse transpose times its determinant.
void fr_deform_cofactors(const double m[3][3], double out[3][3]);

// ---- deform.c: scopes within scopes ------------------------------------------------------------

/// The scopes of a plant, or NULL if it has none. Reads the cache.
FrScopes *fr_scopes_new(const FrPlant *plant);
void fr_scopes_free(FrScopes *scopes);
/// A flow that begins at `at`.
FrFlow fr_flow_at(const double at[3]);
/// Takes a flow through `scope` and those around it, up to but not including `end` (FR_NONE for
/// all). False if a cut was met: then what is outside has acted already. `notes`, by deformation,
/// may be NULL.
bool fr_scopes_pass(const FrScopes *scopes, uint32_t scope, uint32_t end, FrDeformLevel level,
                    FrFlow *flow, FrDeformNote *notes);
/// Works out how all scopes are carried where the skeleton does not move.
void fr_scopes_settle(FrScopes *scopes);
/// Sets where a scope is carried, once it is known where it has moved to.
void fr_scopes_carry(FrScopes *scopes, uint32_t scope);
/// Moves a vertex of what is in `scope` through the triangle level. False if space is turned
/// inside out there, so that triangles must be turned round.
bool fr_scopes_move_vertex(const FrScopes *scopes, uint32_t scope, vec3s *at, vec3s *normal,
                           FrDeformNote *notes);

// ---- deform_skeleton.c -------------------------------------------------------------------------

/// A copy of the plant moved by the skeleton's scopes; sets where every scope has moved to.
FrPlant *fr_scopes_move_skeleton(FrScopes *scopes, FrDeformNote *notes);
/// Writes the warnings of a plant's notes.
void fr_deform_report(const FrPlant *plant, const FrDeformNote *notes, FrDiags *diags);
/// Gathers in `to` what `from` noted, whichever came first.
void fr_deform_join_notes(FrDeformNote *to, const FrDeformNote *from, uint32_t count);
