/// @file plant.h
/// FrPlant: the one structure that every engine makes and everything else reads.
///
/// A plant is a set of *axes* (stems and branches), each a chain of *nodes* (one per internode),
/// that bear *organs* (leaves, petals, fruits: placements of a few shared *shapes*) and *buds*.
/// All are columns of arrays indexed by 32-bit ids; parents are stored before their children:
///
///     for (uint32_t i = 0; i < nodes.count; i++)      acropetal: base to tips
///     for (uint32_t i = nodes.count; i-- > 0;)         basipetal: tips to base
///
///         ┌ organ (placement of a shape)
///     ●───●───●───●   axis 1: nodes 5 6 7 8, bearer = node 1
///         │ offset
///     ●───●───●───●   axis 0: nodes 1 2 3 4          ● = tip of an internode
///
/// The *truth* of a node is its local rotation and its length; `position` and `frame` are a cache
/// that fr_plant_update_frames() rebuilds. Frames have z along the internode (vector.h). Lengths
/// are metres relative to the plant's origin. 72 bytes a node, all columns together.
///
/// Engines may write the columns directly and in parallel once they have appended the rows.
#pragma once

#include "frond/context.h"
#include "frond/curve.h"
#include "frond/digest.h"
#include "frond/expr.h"
#include "frond/lattice.h"
#include "frond/material.h"
#include "frond/mesh_file.h"
#include "frond/random.h"
#include "frond/vector.h"

/// Marks of nodes, axes and organs.
enum {
    FR_SHED = 1 << 0,       ///< fallen off; kept until fr_plant_compact()
    FR_HIDDEN = 1 << 1,     ///< made but not shown
    FR_CONTINUES = 1 << 2,  ///< axis: begins at its bearer's tip and goes on in its direction, so
                            ///< skin joins the two without a collar or a cap
    FR_CUT = 1 << 3,        ///< axis: ends in a flat face, not in a point
    FR_POINT_SETS = 1 << 4, ///< axis: rings of its profile exactly at its base and nodes
    FR_FORK = 1 << 5,       ///< axis: arm of a fork: begins at its bearer's tip, out of its whole
                            ///< thickness, while the bearer's axis goes on to another side
    FR_PART = 1 << 6,       ///< node: a straight part of an internode that is bent, and not its
                            ///< last; nothing is borne by it
};

/// Internodes, or straight parts of bent ones (FR_PART). Node i runs from the tip of its parent
/// (for the first node of an axis: from the axis' origin) to its own tip.
typedef struct FrNodes {
    uint32_t count, capacity;
    uint32_t *parent;  ///< node it grows from; the bearer for the first of an axis; FR_NONE
    uint32_t *next;    ///< next node on the same axis, FR_NONE at its end
    uint32_t *axis;    ///< axis it belongs to
    versors *rotation; ///< relative to the parent's frame (to the plant's if there is none)
    float *length;     ///< m, ≥ 0
    float *radius;     ///< m, at the tip
    float *flatness;   ///< second radius (along y) over the first (along x); 1 is round
    uint16_t *birth;   ///< step or frame of birth
    uint16_t *flags;   ///< FR_SHED, FR_HIDDEN, FR_PART
    vec3s *position;   ///< cache: tip, in the plant's coordinates
    versors *frame;    ///< cache: rotation from the internode's frame to the plant's
} FrNodes;

/// Stems and branches.
typedef struct FrAxes {
    uint32_t count, capacity;
    uint32_t *first, *last; ///< nodes; FR_NONE for an axis without any
    uint32_t *bearer;       ///< node that bears it, FR_NONE for a stem on the ground
    vec3s *offset;          ///< origin, from the bearer's tip in the bearer's frame (from the
                            ///< plant's origin where there is no bearer)
    float *base_radius;     ///< m, at its origin
    uint16_t *order;        ///< 0 main stem, 1 its branches, …
    uint16_t *flags;        ///< FR_SHED … FR_POINT_SETS
    uint32_t *profile;      ///< cross-section, index into profiles; FR_NONE is a circle
    uint32_t *finish;       ///< of its surface, index into finishes; FR_NONE is plain
    uint32_t *material;     ///< index into materials; FR_NONE is the plain default
    uint32_t *deformer;     ///< scope, index into deformers; FR_NONE
    uint32_t *component;    ///< what made it: a component, production or stroke (provenance)
    FrKey *path;            ///< where in the plant: key of random draws and of edits by hand
} FrAxes;

/// Leaves, petals, fruits, primitives.
typedef struct FrOrgans {
    uint32_t count, capacity;
    uint32_t *node;      ///< bearing node, FR_NONE: the plant's origin
    vec3s *offset;       ///< from the node's tip, in its frame
    versors *rotation;   ///< shape to node frame; a blade grows along z, its upper face is y
    float *scale;        ///< of the shape, > 0
    uint32_t *shape;     ///< index into shapes
    uint32_t *material;  ///< index into materials, FR_NONE
    uint16_t *birth;     ///< step or frame of birth
    uint16_t *flags;     ///< FR_SHED, FR_HIDDEN
    uint32_t *deformer;  ///< as for axes
    uint32_t *component; ///< as for axes
    FrKey *path;         ///< as for axes
} FrOrgans;

typedef enum FrBudKind { FR_BUD_APICAL, FR_BUD_LATERAL, FR_BUD_FLORAL } FrBudKind;
typedef enum FrBudState { FR_BUD_ACTIVE, FR_BUD_DORMANT, FR_BUD_DEAD, FR_BUD_SPROUTED } FrBudState;

typedef struct FrBuds {
    uint32_t count, capacity;
    uint32_t *node;     ///< node at whose tip it sits
    uint8_t *kind;      ///< FrBudKind
    uint8_t *state;     ///< FrBudState
    uint16_t *dormancy; ///< steps it has slept
    vec3s *direction;   ///< unit, in the plant's coordinates
    uint64_t *id;       ///< stable for the life of the plant
} FrBuds;

/// A polygon in two dimensions: the cross-section of an axis or the outline of a blade.
typedef struct FrProfile {
    double (*points)[2]; ///< owned
    uint32_t count;
    bool is_closed;
} FrProfile;

/// How an axis ends that is FR_CUT.
typedef enum FrCap {
    FR_CAP_FLAT,
    FR_CAP_ROUND,  ///< a dome
    FR_CAP_BROKEN, ///< splinters, other ones for each path
    FR_CAP_OPEN,   ///< nothing closes it
} FrCap;

/// How a branch meets its parent.
typedef enum FrJunction {
    FR_JUNCTION_COLLAR, ///< on its surface, with its normals
    FR_JUNCTION_PLAIN,  ///< a tube that begins within it
    FR_JUNCTION_WELDED, ///< one surface with it: no triangle of either is within the other
} FrJunction;

/// What makes the surface of an axis more than a plain tube. Only skin reads it. Ridges and relief
/// stand out from the tube, so that what sits on it never floats; those of a chain of axes that
/// continue one another are its first one's.
typedef struct FrFinish {
    uint32_t cap;        ///< FrCap
    uint32_t junction;   ///< FrJunction
    uint32_t is_open;    ///< 1: its base is not closed where it stands on nothing
    uint32_t buttresses; ///< ridges around the foot
    float cap_height;    ///< of a dome or of splinters, in radii of the end
    float wall;          ///< of a hollow axis that ends flat, broken or open, in radii; 0: solid
    float buttress_depth, buttress_height; ///< at the base, in radii of it
    float buttress_width;                  ///< part of the foot that they take, 0 to 1
    float irregularity;                    ///< how much they differ, 0 to 1
    float relief;                          ///< depth of the furrows, in radii
    float relief_count;                    ///< how many around
    float relief_stretch;                  ///< how much longer than wide
    /// Material of its flat and broken ends and of the inside of a hollow axis, + 1; 0: its own.
    uint32_t face;
} FrFinish;

/// What the edge of a blade is like.
typedef enum FrLeafMargin {
    FR_MARGIN_ENTIRE,
    FR_MARGIN_SERRATE, ///< teeth that point to the tip
    FR_MARGIN_DENTATE, ///< teeth that point outwards
    FR_MARGIN_CRENATE, ///< round teeth
    FR_MARGIN_LOBED,   ///< cut into lobes
} FrLeafMargin;

/// Where the normals of a leaf point, for shading.
typedef enum FrLeafNormals {
    FR_NORMALS_SURFACE, ///< as the surface
    FR_NORMALS_FLAT,    ///< all as the blade's upper side
    FR_NORMALS_ROUND,   ///< apart, as those of a ball below the blade
    FR_NORMALS_CROWN,   ///< away from the middle of all leaves; single shapes: as the surface
} FrLeafNormals;

/// How leaflets stand on a rachis.
typedef enum FrCompound {
    FR_COMPOUND_SIMPLE,
    FR_COMPOUND_PINNATE,
    FR_COMPOUND_BIPINNATE, ///< on pinnae, which stand on the rachis
    FR_COMPOUND_PALMATE,   ///< at the end of the petiole
} FrCompound;

/// Leaf blade, petal or sepal in its own frame: base at the origin, midrib along z, upper face y.
/// Angles in radians, lengths in metres at organ scale 1.
typedef struct FrBlade {
    float length, width;
    float petiole_length, petiole_radius; ///< petiole from the origin, the blade begins at its end
    float petiole_bend;                   ///< how far the petiole bends towards y, over its length
    float curvature_along;                ///< turn of the midrib from base to tip, > 0 towards y
    float curvature_across; ///< turn of a half blade from midrib to margin, > 0 towards y
    float fold;             ///< angle each half is lifted about the midrib
    float twist;            ///< turn about the midrib from base to tip
    float wave, waves;      ///< height of margin waves over the width; how many along the blade
    uint32_t outline;       ///< profile: points (along 0–1, half width 0–0.5 of `width`), both
                            ///< halves if closed; FR_NONE is elliptic
    uint32_t along_curve, across_curve; ///< profiles as y(x) that spread the curvatures, FR_NONE
    uint32_t across_along, fold_along, twist_along,
        wave_along; ///< one more than the profile whose
                    ///< y(x) multiplies curvature_across, fold, the rate of twist, wave
                    ///< from base to tip; 0: the same all along
    uint16_t segments_along, segments_across; ///< ≥ 1; across: per half
    float edge_curl;                          ///< further turn of the outer third, > 0 towards y
    float tip_droop;                          ///< further turn of the last half, > 0 away from y
    float undulation, undulations; ///< height of bumps over the width; how many along the blade
    float phase;                   ///< which bumps
    uint32_t margin;               ///< FrLeafMargin
    uint32_t teeth;                ///< of each side
    float tooth_depth;             ///< over the width
    float tooth_sharpness;         ///< 0 round to 1 hollow, 0.5 straight
    uint32_t normals;              ///< FrLeafNormals
    // A compound leaf: length, width and all above but the petiole are those of a leaflet.
    uint32_t compound;      ///< FrCompound
    uint32_t leaflets;      ///< pairs on a rachis, or leaflets of a palm
    uint32_t pinnae;        ///< pairs
    uint32_t is_terminal;   ///< 1: another at the end
    float rachis_length;    ///< from the lowest leaflet to the end
    float rachis_curvature; ///< turn from its beginning to its end, > 0 towards y
    float leaflet_angle;    ///< from the rachis; of a palm: of the outermost
    float leaflet_petiole;  ///< length of its petiole
    uint32_t leaflet_curve; ///< one more than the profile whose y(x) is their size; 0: the same
} FrBlade;

typedef enum FrShapeKind {
    FR_SHAPE_BLADE,
    FR_SHAPE_BOX,
    FR_SHAPE_SPHERE,
    FR_SHAPE_CONE,
    FR_SHAPE_CYLINDER,
    FR_SHAPE_TORUS,
    FR_SHAPE_SQUARE,
    FR_SHAPE_CIRCLE,
    FR_SHAPE_TRIANGLE,
    FR_SHAPE_MESH,       ///< triangles of a profile, see FrShape.detail
    FR_SHAPE_REVOLUTION, ///< an outline turned about the z axis
    FR_SHAPE_FILE,       ///< triangles of a part of a file
} FrShapeKind;

/// What organs are placements of. Equal parameters give the same shape.
typedef struct FrShape {
    FrShapeKind kind;
    vec3s size;      ///< primitives: extent along x, y, z; they stand on the origin, along z
    uint32_t detail; ///< primitives: segments around, ≥ 3. FR_SHAPE_MESH: the profile whose points
                     ///< come in pairs, (x, y) and (z, 0), a corner each, three a triangle; at
                     ///< most 2600 triangles, scaled by `size`. FR_SHAPE_FILE: index into files,
                     ///< scaled by `size`
    uint32_t
        outline; ///< FR_SHAPE_FILE: the part. FR_SHAPE_REVOLUTION: profile whose points are (along
                 ///< 0–1, half width 0–0.5) of `size`, in the order in which its outer side lies to
                 ///< the right of one who goes up; open ends that are not on the axis stay open
    FrBlade blade; ///< for FR_SHAPE_BLADE
} FrShape;

typedef enum FrDeformationKind {
    FR_DEFORM_NOTHING,   ///< leaves everything where it is
    FR_DEFORM_FUNCTIONS, ///< by three expressions
    FR_DEFORM_LATTICE,   ///< by the control points of a box
} FrDeformationKind;

/// How space is deformed, in the coordinates of the scope that does it.
typedef struct FrDeformation {
    FrDeformationKind kind;
    bool is_skeleton;  ///< moves the nodes of axes and keeps cross-sections and organs as they are;
                       ///< otherwise every vertex is moved
    bool is_cut;       ///< scopes around it move what is within as one rigid body
    FrExpr *map[3];    ///< FR_DEFORM_FUNCTIONS: the new x, y, z from x, y, z, amount; references
    FrLattice lattice; ///< FR_DEFORM_LATTICE
    uint32_t component; ///< what made it, for messages; FR_NONE
} FrDeformation;

/// Scope of a free-form deformation: where one stands. Skin applies it to the axes and organs that
/// name the scope, then the one around it, and so on; scopes come after those around them.
typedef struct FrDeformer {
    uint32_t outer;       ///< scope around it, FR_NONE
    uint32_t deformation; ///< index into deformations
    uint32_t node;        ///< where it stands, as an organ does; FR_NONE: the plant's origin
    vec3s offset;         ///< from the node's tip, in its frame
    versors rotation;     ///< scope to node frame
    float scale;          ///< metres of a unit of its coordinates, > 0
    float strength;       ///< 0 nothing moves, 1 all the way
    float amount;         ///< the variable of its functions
} FrDeformer;

/// Name of what made an axis or an organ.
typedef struct FrComponent {
    char *id; ///< owned
    FrSpan span;
} FrComponent;

typedef struct FrPlant {
    char *name; ///< owned
    FrNodes nodes;
    FrAxes axes;
    FrOrgans organs;
    FrBuds buds;
    GArray *shapes;            ///< FrShape
    GArray *profiles;          ///< FrProfile
    GArray *finishes;          ///< FrFinish
    GPtrArray *materials;      ///< FrMaterial *, owned references
    GPtrArray *files;          ///< FrMeshFile *, owned references
    GArray *deformers;         ///< FrDeformer
    GArray *deformations;      ///< FrDeformation
    GArray *components;        ///< FrComponent
    GHashTable *shape_index;   ///< private to fr_plant_add_shape()
    GHashTable *profile_index; ///< private to fr_plant_add_profile()
} FrPlant;

FR_API FrPlant *fr_plant_new(const char *name);
FR_API void fr_plant_free(FrPlant *plant);
/// A deep copy (materials and sources are shared).
FR_API FrPlant *fr_plant_copy(const FrPlant *plant);

// ---- building ---------------------------------------------------------------------------------
// Each appends `count` rows and returns the index of the first. The rows hold: FR_NONE in index
// columns, identity rotations, scale, flatness 1, zero elsewhere. The caller has checked FrLimits.

FR_API uint32_t fr_plant_append_nodes(FrPlant *plant, uint32_t count);
/// Room for so many nodes and axes in all; appending them then moves nothing.
FR_API void fr_plant_reserve(FrPlant *plant, uint32_t nodes, uint32_t axes);
FR_API uint32_t fr_plant_append_axes(FrPlant *plant, uint32_t count);
FR_API uint32_t fr_plant_append_organs(FrPlant *plant, uint32_t count);
FR_API uint32_t fr_plant_append_buds(FrPlant *plant, uint32_t count);

/// Convenience for engines that grow one by one: appends a node to the end of `axis`, wires
/// parent, next, first and last, and brings its cache up to date.
FR_API uint32_t fr_plant_add_node(FrPlant *plant, uint32_t axis, versors rotation, float length,
                                  float radius);
/// Appends an empty axis borne by `bearer` (order = the bearer's + 1, or 0).
FR_API uint32_t fr_plant_add_axis(FrPlant *plant, uint32_t bearer, vec3s offset, float base_radius);
/// The index of an equal shape, appended if there is none.
FR_API uint32_t fr_plant_add_shape(FrPlant *plant, const FrShape *shape);
/// Copies the points; equal profiles are shared.
FR_API uint32_t fr_plant_add_profile(FrPlant *plant, const double (*points)[2], uint32_t count,
                                     bool is_closed);
/// Appends a finish.
FR_API uint32_t fr_plant_add_finish(FrPlant *plant, const FrFinish *finish);
/// Takes a reference; a material already there gives its index.
FR_API uint32_t fr_plant_add_material(FrPlant *plant, FrMaterial *material);
/// Takes a reference; a file already there gives its index.
FR_API uint32_t fr_plant_add_file(FrPlant *plant, FrMeshFile *file);
/// Appends a way of deforming; takes references to its expressions.
FR_API uint32_t fr_plant_add_deformation(FrPlant *plant, const FrDeformation *deformation);
/// Appends scopes without outer one, node, turn; scale and strength 1. Returns the first.
FR_API uint32_t fr_plant_append_deformers(FrPlant *plant, uint32_t count);
FR_API uint32_t fr_plant_add_component(FrPlant *plant, const char *id, FrSpan span);

// ---- passes -----------------------------------------------------------------------------------
// Straight loops over the columns. They see every row, marked FR_SHED or not (bounds excepted):
// compact first to leave out what has fallen.

/// Rebuilds position and frame of nodes first … count−1. One forward loop.
FR_API void fr_plant_update_frames(FrPlant *plant, uint32_t first);
/// Where an axis begins, in the plant's coordinates. Reads the cache.
FR_API vec3s fr_plant_axis_origin(const FrPlant *plant, uint32_t axis);
/// Position and rotation of an organ in the plant's coordinates. Reads the cache.
FR_API void fr_plant_organ_pose(const FrPlant *plant, uint32_t organ, vec3s *position,
                                versors *rotation);

/// Strahler number of every internode: 1 at tips; where the two largest children are equal, one
/// more, else the largest. `order` has nodes.count elements.
FR_API void fr_plant_strahler(const FrPlant *plant, uint32_t *order);
/// Weibel generation of every internode: 0 at the base, one more behind each fork.
FR_API void fr_plant_weibel(const FrPlant *plant, uint32_t *order);
/// Botanical (Gravelius) order: that of the axis.
FR_API void fr_plant_botanical(const FrPlant *plant, uint32_t *order);
/// Radii by the pipe model (Shinozaki 1964; Murray 1926 for exponent 3): r^e is the sum of the
/// children's r^e, tips have `tip_radius`. Sets node radii and, to the radius of their first node,
/// the base radii of axes. exponent in [1, 4].
FR_API void fr_plant_pipe_radii(FrPlant *plant, double exponent, double tip_radius);
/// What the radii of branches follow.
typedef enum FrWeights {
    FR_WEIGHTS_OWN,      ///< those that the plant has
    FR_WEIGHTS_WEIBEL,   ///< generations from the base
    FR_WEIGHTS_STRAHLER, ///< orders from the tips
    FR_WEIGHTS_STRANDS,  ///< √ of the number of tips above (Holton 1994)
    FR_WEIGHTS_PIPE,     ///< the pipe model
} FrWeights;

/// Sets all radii by weights: `thinnest` at tips, `ratio` from one order to the next, `exponent` of
/// the pipe model.
FR_API void fr_plant_weigh(FrPlant *plant, FrWeights weights, double thinnest, double ratio,
                           double exponent);
/// Removes what is marked FR_SHED and everything borne by it: with an internode go the rest of its
/// axis and its branches, organs and buds. The order of what stays is kept.
FR_API void fr_plant_compact(FrPlant *plant);
/// How many internodes it has: nodes that are no FR_PART.
FR_API uint32_t fr_plant_internodes(const FrPlant *plant);
/// Smallest box around node tips, axis origins and organ positions (not their shapes) of what is
/// neither shed nor hidden. min > max for an empty plant. Reads the cache.
FR_API void fr_plant_bounds(const FrPlant *plant, vec3s *min, vec3s *max);

/// A copy whose axes and organs stand where the deformations of the skeleton move them, for whoever
/// reads the skeleton only; skin needs no such copy. Reads the cache.
FR_API FrPlant *fr_plant_deformed(const FrPlant *plant);

/// Internodes that fr_plant_refined() makes, to be checked against the limits first.
FR_API uint64_t fr_plant_refined_nodes(const FrPlant *plant, const uint16_t *joints);
/// A copy in which axis `a` has joints[a] internodes at least: where it has fewer they are cut into
/// equal pieces, and what stands along them moves to the piece it stands at. Nothing changes its
/// place. Axes that are FR_POINT_SETS stay as they are.
FR_API FrPlant *fr_plant_refined(const FrPlant *plant, const uint16_t *joints);

/// Digest of everything that is truth: all columns but the cache, shapes, profiles, finishes,
/// deformers.
FR_API FrDigest fr_plant_digest(const FrPlant *plant);
/// Bytes allocated for all columns.
FR_API uint64_t fr_plant_bytes(const FrPlant *plant);
/// True if every index is in range, parents come first and chains are whole; `why` (may be NULL)
/// receives the first violation, to be freed with g_free(). For tests and after importing.
FR_API bool fr_plant_is_valid(const FrPlant *plant, char **why);
