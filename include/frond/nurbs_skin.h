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
#include "frond/skin.h"

/// How a branch begins where another bears it.
typedef enum FrNurbsJoin {
    FR_JOIN_NEAR, ///< its path shares the fork and the direction in which its parent comes there,
                  ///< from so near that it is inside the parent's wood
    FR_JOIN_TANGENT, ///< its path shares two points with its parent's: one tangent (as published)
    FR_JOIN_SMOOTH,  ///< it shares three and knots are uniform: the same curvature too
} FrNurbsJoin;

enum { FR_FORKS_PLAIN, FR_FORKS_RAMIFORM };
enum { FR_MARGINS_SMOOTH, FR_MARGINS_EXACT };

typedef enum FrNurbsFrames {
    FR_FRAMES_MINIMAL, ///< never twist about the branch
    FR_FRAMES_FRENET,  ///< turn with the osculating plane, as published; flip where a branch bends
                       ///< the other way
} FrNurbsFrames;

#define FR_NURBS_WEIGHT_PARAMS(X)                                                                  \
    X(CHOICE, weights, "own", 0, 0, "", "own weibel strahler strands pipe",                        \
      "radii of branches: the plant's own, by an order of its branches, by the tips they bear, "   \
      "or by the pipe model")                                                                      \
    X(REAL, thinnest, "0.003", 0.000001, 100, "m", "", "weights: radius of the thinnest branches") \
    X(REAL, ratio, "1.5", 1, 100, "", "",                                                          \
      "weights weibel and strahler: how much thicker an order is than the next thinner one")       \
    X(REAL, pipe_exponent, "2", 1, 4, "", "", "weights pipe: powers of radii that add up")

/// Global factors: wind, light and gravity (Beneš, Figure 6).
#define FR_NURBS_FACTOR_PARAMS(X)                                                                  \
    X(VECTOR, wind, "0, 0, 0", -100, 100, "", "", "where the wind blows, as long as it is strong") \
    X(VECTOR, light, "0, 0, 0", -100, 100, "", "", "where the light is; branches turn to it")      \
    X(VECTOR, gravity, "0, 0, 0", -100, 100, "", "", "where weight pulls, like 0, 0, -0.5")        \
    X(REAL, yield, "20", 0, 360, "deg", "",                                                        \
      "how far the tip of a branch of the radius below turns to a vector of length 1")             \
    X(REAL, yield_radius, "0.005", 0.000001, 100, "m", "", "thicker branches yield less …")        \
    X(REAL, yield_exponent, "2", 0, 8, "", "", "… by this power of the radius; 4: elastic beams")  \
    X(REAL, blade_yield, "25", 0, 360, "deg", "",                                                  \
      "how far margins of blades turn to a vector of length 1, and the midrib not at all")         \
    X(REAL, gust, "0.6", 0, 1, "", "", "part of the wind that comes and goes")                     \
    X(REAL, wave, "0.7", 0.0001, 100000, "m", "", "length of the waves of the wind")               \
    X(REAL, phase, "0", -3600000, 3600000, "deg", "", "of the waves, at time 0")                   \
    X(REAL, period, "2.4", 0.000001, 1000000, "a", "",                                             \
      "time in which the waves come round; see frame-time of a scene")

/// Triangles of rational surfaces.
#define FR_NURBS_MESH_PARAMS(X)                                                                    \
    X(REAL, tolerance, "0", 0, 100, "m", "",                                                       \
      "farthest that triangles are from the surface, 0: 1/2000 of the plant's size; twice that "   \
      "for each level of detail")                                                                  \
    X(REAL, turn, "30", 1, 90, "deg", "", "wanted turn from one row of triangles to the next")     \
    X(REAL, thickness, "0", 0, 10, "m", "", "of the triangles of blades; 0: open sheets")          \
    X(REAL, voxel, "0", 0, 1000, "m", "",                                                          \
      "make one watertight solid of all that is closed, on a lattice of this width, at most half " \
      "of what is thinnest; 0: do not")

#define FR_NURBS_STEP_PARAMS(X)                                                                    \
    X(CHOICE, step, "ap214", 0, 0, "", "ap214 ap203", "application protocol of STEP files")        \
    X(CHOICE, share, "equal", 0, 0, "", "no equal near",                                           \
      "in STEP files: organs of equal shape and size are written once, or also those that are "    \
      "near in size, which become equal: 2 % larger at most")

enum { FR_STEP_AP214, FR_STEP_AP203 };
enum { FR_SHARE_NO, FR_SHARE_EQUAL, FR_SHARE_NEAR };

/// Settings of a rational skin. X rows as in param.h.
#define FR_NURBS_PARAMS(X)                                                                         \
    X(CHOICE, circle, "triangle", 0, 0, "", "triangle square nine cubic",                          \
      "which exact circle is swept: seven points of a triangle or square, nine points, cubic")     \
    X(CHOICE, join, "near", 0, 0, "", "near tangent smooth",                                       \
      "what a branch shares with its parent: the fork, two points, three for one curvature")       \
    X(CHOICE, forks, "plain", 0, 0, "", "plain ramiform",                                          \
      "where branches begin: as their tubes meet, or with patches that lead into each other")      \
    X(CHOICE, frames, "minimal", 0, 0, "", "minimal frenet", "how profiles turn along a branch")   \
    X(INTEGER, profile_degree, "3", 1, 3, "", "", "profiles: 1 keeps corners, 3 is smooth")        \
    X(CHOICE, margins, "smooth", 0, 0, "", "smooth exact",                                         \
      "halves of blades: through the rows of the outline, or Coons patches between the midrib "    \
      "and the outline itself, teeth and all")                                                     \
    X(SWITCH, corners, "yes", 0, 1, "", "",                                                        \
      "more control points at bends that a surface would leave by more than a part of its radius") \
    X(SWITCH, caps, "yes", 0, 1, "", "", "close the ends of tubes")                                \
    X(SWITCH, foliage, "yes", 0, 1, "", "", "with organs; without: wood only")                     \
    FR_NURBS_WEIGHT_PARAMS(X)                                                                      \
    FR_NURBS_FACTOR_PARAMS(X)                                                                      \
    FR_NURBS_MESH_PARAMS(X)                                                                        \
    FR_NURBS_STEP_PARAMS(X)

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
    FrNurbsSurface surface;     ///< borrows from the skin
    uint32_t kind;              ///< FrNurbsKind
    uint32_t material;          ///< index into the plant's materials, FR_NONE
    uint32_t axis;              ///< what it belongs to: an axis …
    uint32_t organ;             ///< … or an organ; FR_NONE
    const double (*texture)[2]; ///< place in the picture of each control point; NULL
} FrNurbsPiece;

/// An organ whose surfaces are those of its shape, placed.
typedef struct FrNurbsCopy {
    uint32_t organ, piece_count;
    uint64_t first_piece;     ///< of the shape in its size
    double axes[3][3], at[3]; ///< where its x, y, z lie, of length 1; its origin
} FrNurbsCopy;

typedef struct FrNurbsSkin {
    FrNurbsPiece *pieces; ///< wood in the order of its branches, then organs, then shapes of copies
    uint64_t count;       ///< without those of shapes
    FrNurbsCopy *copies;
    uint64_t copy_count;
    double *knots;         ///< of all pieces
    double (*points)[4];   ///< of all pieces
    double (*textures)[2]; ///< of the shapes that have them
    uint64_t knot_count, point_count, texture_count;
} FrNurbsSkin;

FR_API const FrParamTable *fr_nurbs_table(void);
FR_API FrNurbsParams fr_nurbs_default(void);
/// The surfaces of a whole plant, with free-form deformations acting on the control points.
/// FR_ERR_LIMIT if they would take too many bytes; then *skin is NULL and nothing was allocated.
FR_API FR_MUST_USE FrStatus fr_nurbs_plant(const FrPlant *plant, const FrNurbsParams *params,
                                           const FrContext *context, FrNurbsSkin **skin);
/// The same, but organs that nothing bends and that have their like are copies, as `share` says.
FR_API FR_MUST_USE FrStatus fr_nurbs_plant_shared(const FrPlant *plant, const FrNurbsParams *params,
                                                  const FrContext *context, FrNurbsSkin **skin);
/// Surfaces with those of all copies counted.
FR_API uint64_t fr_nurbs_skin_surfaces(const FrNurbsSkin *skin);
/// The plant as its surfaces see it: radii by `weights`, bent by the global factors. NULL if both
/// leave it as it is.
FR_API FrPlant *fr_nurbs_posed(const FrPlant *plant, const FrNurbsParams *params);
/// The triangles of a plant's surfaces, in parts like those of fr_skin_plant(): tubes and their
/// caps, and the halves of a blade, share their rims. `lod` as there; `span` is where the settings
/// are written. FR_ERR_DOCUMENT if `voxel` leaves nothing of what there is.
FR_API FR_MUST_USE FrStatus fr_nurbs_mesh(const FrPlant *plant, const FrNurbsParams *params,
                                          int lod, FrUpAxis up, FrSpan span,
                                          const FrContext *context, FrMesh **mesh);
FR_API void fr_nurbs_skin_free(FrNurbsSkin *skin);
/// Bytes of all arrays.
FR_API uint64_t fr_nurbs_skin_bytes(const FrNurbsSkin *skin);
/// Digest of all control points, knots and pieces.
FR_API FrDigest fr_nurbs_skin_digest(const FrNurbsSkin *skin);
