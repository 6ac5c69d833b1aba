/// @file nurbs_skin.h
/// A plant's surface as rational B-splines: for CAD programs, where circles are circles.
/// Beneš. Generating a Model of Plant Using NURBS. CTU Prague.
///
/// The points of a branch, in order, are the path of a sweep: at each stands the control polygon of
/// a circle or profile, turned as the joint is; together they are the control net of a generalized
/// cylinder, cubic along the branch. A branch begins inside its parent, with the last points of the
/// branch that bears it. A leaf is a petiole and two patches from the midrib to the margin.
#pragma once

#include "frond/nurbs.h"
#include "frond/plant.h"

/// How a branch begins where another bears it.
typedef enum FrNurbsJoin {
    FR_JOIN_NEAR, ///< its path shares the fork and the direction in which its parent comes there,
                  ///< from so near that it is inside the parent's wood
    FR_JOIN_TANGENT, ///< its path shares two points with its parent's: one tangent (as published)
    FR_JOIN_SMOOTH,  ///< it shares three and knots are uniform: the same curvature too
} FrNurbsJoin;

typedef enum FrNurbsFrames {
    FR_FRAMES_MINIMAL, ///< never twist about the branch
    FR_FRAMES_FRENET,  ///< turn with the osculating plane, as published; flip where a branch bends
                       ///< the other way
} FrNurbsFrames;

/// Settings of a rational skin. X rows as in param.h.
#define FR_NURBS_PARAMS(X)                                                                         \
    X(CHOICE, circle, "triangle", 0, 0, "", "triangle square nine cubic",                          \
      "which exact circle is swept: seven points of a triangle or square, nine points, cubic")     \
    X(CHOICE, join, "near", 0, 0, "", "near tangent smooth",                                       \
      "what a branch shares with its parent: the fork, two points, three for one curvature")       \
    X(CHOICE, frames, "minimal", 0, 0, "", "minimal frenet", "how profiles turn along a branch")   \
    X(INTEGER, profile_degree, "3", 1, 3, "", "", "profiles: 1 keeps corners, 3 is smooth")        \
    X(SWITCH, caps, "yes", 0, 1, "", "", "close the ends of tubes")                                \
    X(SWITCH, foliage, "yes", 0, 1, "", "", "with organs; without: wood only")

typedef struct FrNurbsParams {
    FR_NURBS_PARAMS(FR_PARAM_FIELD)
} FrNurbsParams;

typedef enum FrNurbsKind {
    FR_NURBS_TUBE,  ///< u goes around, closed unless its profile is open; v from base to tip
    FR_NURBS_FOOT,  ///< cap at the base of the tube before it; v from the centre to the rim
    FR_NURBS_CAP,   ///< cap at the tip of the tube before it; v from the rim to the centre
    FR_NURBS_RIGHT, ///< half of a blade; u from base to tip, v from the margin to the midrib
    FR_NURBS_LEFT,  ///< the other half, behind it: v from the midrib, which both share, to the
                    ///< margin
    FR_NURBS_PATCH, ///< anything else, on its own
} FrNurbsKind;

/// A surface of the skin; du × dv points outwards, for blades upwards.
typedef struct FrNurbsPiece {
    FrNurbsSurface surface; ///< borrows from the skin
    uint32_t kind;          ///< FrNurbsKind
    uint32_t material;      ///< index into the plant's materials, FR_NONE
    uint32_t axis;          ///< what it belongs to: an axis …
    uint32_t organ;         ///< … or an organ; FR_NONE
} FrNurbsPiece;

typedef struct FrNurbsSkin {
    FrNurbsPiece *pieces; ///< wood in the order of its branches, then organs
    uint64_t count;
    double *knots;       ///< of all pieces
    double (*points)[4]; ///< of all pieces
    uint64_t knot_count, point_count;
} FrNurbsSkin;

FR_API const FrParamTable *fr_nurbs_table(void);
FR_API FrNurbsParams fr_nurbs_default(void);
/// The surfaces of a whole plant, with free-form deformations acting on the control points.
/// FR_ERR_LIMIT if they would take too many bytes; then *skin is NULL and nothing was allocated.
FR_API FR_MUST_USE FrStatus fr_nurbs_plant(const FrPlant *plant, const FrNurbsParams *params,
                                           const FrContext *context, FrNurbsSkin **skin);
FR_API void fr_nurbs_skin_free(FrNurbsSkin *skin);
/// Bytes of all arrays.
FR_API uint64_t fr_nurbs_skin_bytes(const FrNurbsSkin *skin);
/// Digest of all control points, knots and pieces.
FR_API FrDigest fr_nurbs_skin_digest(const FrNurbsSkin *skin);
