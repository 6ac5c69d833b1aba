// What will be written, and where: the plan of a skin.
//
//     run   a chain of axes that continue one another, skinned without a seam
//     tube  a visible stretch of a run with one material: what is written as one piece
//     ring  a cross-section of a tube; most stand at nodes that are marked in `keep`
#pragma once

#include "frond/skin.h"

#include "plant/deform.h"
#include "skin/section.h"

#include <math.h>

/// Settings as the algorithms want them, with the level of detail already applied.
typedef struct FrDetail {
    int lod;
    float bend_chord;   ///< distance of two unit directions as far apart as a band may turn
    float sag_share;    ///< how far a band may cut a corner, in radii …
    float sag_length;   ///< … plus metres
    float taper_twig;   ///< how far a band may miss a node's radius, in radii of a twig …
    float taper_stem;   ///< … and of a stem, whose outline is seen from nearer: in radii …
    float taper_length; ///< … plus metres
    float side_length;  ///< m
    uint32_t min_sides, max_sides;
    float collar;
    bool caps, foliage;
} FrDetail;

FrDetail fr_detail(const FrSkinParams *params);

typedef enum FrTubeStart {
    FR_START_FREE,   ///< stands on the ground or on nothing: closed by a cap
    FR_START_BRANCH, ///< grows out of a parent: see collar.h
    FR_START_JOINT,  ///< goes on from the tube before it in the run
} FrTubeStart;

typedef enum FrTubeEnd {
    FR_END_POINT,
    FR_END_FLAT, ///< closed by a cap
    FR_END_OPEN, ///< the next tube of the run goes on
} FrTubeEnd;

typedef struct FrTube {
    uint32_t axis;        ///< the first one of it
    uint32_t from;        ///< node at whose tip it begins; FR_NONE: the axis' origin
    uint32_t first, last; ///< nodes
    uint32_t slot;        ///< of its material, see FrPlan.slots
    uint32_t section;     ///< index into FrPlan.sections
    uint32_t scope;       ///< of a deformation that moves its vertices; FR_NONE
    uint32_t rings;       ///< 0: nothing to draw
    uint8_t collar_rings; ///< FR_START_BRANCH: rings that lie on the parent or lead from it …
    bool has_join;        ///< … followed by a full ring where the branch is clear of its parent
    bool is_welded;       ///< its first ring is to be one with the parent's surface: see weld.c
    uint8_t start, end;
    bool is_point_sets;
    bool has_shoulder;                 ///< FR_END_POINT: blunt, so a ring shortly before the tip
    uint8_t cap;                       ///< FrCap, for FR_END_FLAT
    bool is_open;                      ///< its base, for FR_START_FREE
    bool is_rough;                     ///< its rings are not those of its section: ridges or relief
    uint32_t wall_rings;               ///< of these: what its own end adds, see cap.c
    float cap_height;                  ///< radii
    float wall;                        ///< radii, 0: solid
    uint32_t face;                     ///< slot of the material of its end; 0: its own
    uint64_t face_index, face_indices; ///< of the triangles of that, from first_index on
    uint64_t first_vertex, first_index; ///< in the part
    uint64_t vertices, indices;
} FrTube;

typedef struct FrRun {
    uint32_t first_tube, tube_count;
    float radius;        ///< m, greatest
    bool follows_frames; ///< not round: turned as its nodes' frames say
    uint32_t finish;     ///< with ridges or relief; FR_NONE
} FrRun;

/// A node's marks.
enum {
    FR_NODE_GONE = 1 << 0,  ///< shed, or borne by something shed
    FR_NODE_BLUNT = 1 << 1, ///< last of its axis, but bears a branch: no point
    FR_NODE_RING = 1 << 2,  ///< a ring stands at it, however straight its axis is
};

/// From this level of detail on no branch is welded.
enum { FR_WELD_GONE = 2 };

/// What is thicker than so many of its parent's radii has no room on its surface.
#define FR_THICKER 1.25F

/// Values of FrPlan.keep.
enum {
    FR_KEEP_RING = 1,
    FR_KEEP_SHOULDER = 2, ///< the last node of a tube with a ring shortly before its tip
};

typedef struct FrPlan {
    const FrPlant *plant;
    const FrContext *context;
    const FrScopes *scopes; ///< of its deformations, NULL if there are none
    FrDetail detail;
    uint32_t *successor; ///< by axis: the one that continues it, FR_NONE
    uint32_t *before;    ///< by axis: the one it continues, FR_NONE
    uint8_t *marks;      ///< by node: FR_NODE_GONE, FR_NODE_BLUNT
    uint8_t *keep;       ///< by node: FR_KEEP_RING where a ring stands or a tube ends
    uint32_t *section;   ///< by axis: index into sections
    GArray *runs;        ///< FrRun
    GArray *tubes;       ///< FrTube, run by run
    FrSection *sections; ///< [0, max_sides]: round ones by number of sides; then by profile
    uint32_t section_count;
    float (*tiles)[2]; ///< by slot: width and height of a bark tile, m
    uint32_t slots;    ///< materials + 1; slot 0 is the plain default
    float *took;       ///< by run: see took.h; NULL: nobody wants to know
    double tick;       ///< s that reading the clock takes
} FrPlan;

/// Finds runs and tubes. FR_CANCELLED leaves a plan that can be freed. `scopes` may be NULL; their
/// skeletons have been moved in `plant` already.
void fr_plan_init(FrPlan *plan, const FrPlant *plant, const FrScopes *scopes,
                  const FrSkinParams *params, const FrContext *context);
void fr_plan_clear(FrPlan *plan);
/// Chooses rings and sides and counts the triangles of runs [begin, end). Different runs may be
/// measured in different threads.
void fr_measure_runs(FrPlan *plan, size_t begin, size_t end);

static inline uint32_t fr_slot(uint32_t material) {
    return material == FR_NONE ? 0 : material + 1;
}

/// The node after `node` on its axis or on the axis that continues it; FR_NONE at the end.
static inline uint32_t fr_plan_next(const FrPlan *plan, uint32_t node) {
    const FrNodes *nodes = &plan->plant->nodes;
    uint32_t next = nodes->next[node];
    if (next != FR_NONE) {
        return next;
    }
    uint32_t axis = plan->successor[nodes->axis[node]];
    return axis == FR_NONE ? FR_NONE : plan->plant->axes.first[axis];
}

/// The scope whose deformations move the vertices of what names `deformer`; FR_NONE without any.
static inline uint32_t fr_plan_scope(const FrPlan *plan, uint32_t deformer) {
    bool acts =
        plan->scopes != NULL && deformer != FR_NONE && plan->scopes->has_triangles[deformer];
    return acts ? deformer : FR_NONE;
}

/// Deforms vertices that have been written, and turns triangles round where space is turned inside
/// out. `notes` are by deformation.
void fr_deform_vertices(const FrPlan *plan, uint32_t scope, FrUpAxis up, FrVertex *vertices,
                        uint64_t count, uint32_t *indices, uint64_t index_count,
                        FrDeformNote *notes);

/// Where a tube begins and how thick it is there.
vec3s fr_tube_origin(const FrPlan *plan, const FrTube *tube);
float fr_tube_base_radius(const FrPlan *plan, const FrTube *tube);
/// The finish of an axis, or NULL if it is plain.
const FrFinish *fr_plan_finish(const FrPlan *plan, uint32_t axis);
/// The section of a profile, or NULL if it is round.
const FrSection *fr_plan_profile(const FrPlan *plan, uint32_t profile);
/// How far along its last band, 0 to 1, a blunt tube keeps its thickness.
float fr_shoulder_part(vec3s from, vec3s tip, float radius);
/// Length below which two points of a tube count as one: far enough apart in single precision.
static inline float fr_smallest_length(vec3s at, float radius) {
    float x = fabsf(at.x), y = fabsf(at.y), z = fabsf(at.z);
    float reach = MAX(MAX(x, y), MAX(z, 1.0F));
    return MAX(1e-3F * radius, 4e-6F * reach);
}
