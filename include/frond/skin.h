/// @file skin.h
/// A plant's surface: tubes along its axes, blades and primitives at its organs, as triangles.
///
/// The skeleton comes first and skin only reads it: level of detail never moves a branch. Counting
/// comes before writing; every vertex and index is written once, in its final place.
///
/// Bark: u goes around with a whole number of tiles; v is 0 at the base and falls towards the tip,
/// so pictures stand upright; tiles shrink with the radius and keep their shape. An axis of point
/// sets has a ring at its base and at the tip of each node. From the second level
/// of detail on ever fewer leaves are drawn, each enlarged (at most twice) to keep the whole area;
/// the last of a component stays.
#pragma once

#include "frond/plant.h"

/// 32 bytes, interleaved: what glTF, OpenGL and Embree take as they are.
typedef struct FrVertex {
    float position[3];
    float normal[3]; ///< unit
    float uv[2];     ///< in tiles of bark; in the picture of a blade
} FrVertex;

/// What one material covers. Indices count from the part's first vertex.
typedef struct FrMeshPart {
    uint32_t material; ///< index into the plant's materials, FR_NONE
    bool is_foliage;   ///< blades: seen from both sides
    uint64_t first_vertex, vertex_count;
    uint64_t first_index, index_count;
    float min[3], max[3]; ///< exact bounds of the positions
} FrMeshPart;

typedef struct FrMesh {
    FrVertex *vertices;
    uint64_t vertex_count;
    uint32_t *indices; ///< three a triangle, counter-clockwise from outside
    uint64_t index_count;
    FrMeshPart *parts;
    uint32_t part_count;
} FrMesh;

typedef enum FrUpAxis { FR_UP_Z, FR_UP_Y } FrUpAxis;

/// Settings of a skin. X rows as in param.h; in the struct `bend` is in radians.
#define FR_SKIN_PARAMS(X)                                                                          \
    X(INTEGER, lod, "0", 0, 8, "", "", "level of detail: 0 is finest, each level has some 40 %")   \
    X(REAL, bend, "3.5", 0.5, 90, "deg", "", "a ring for every so many degrees a branch turns")    \
    X(REAL, side_length, "0.02", 0.0001, 10, "m", "", "wanted length of a side of a tube")         \
    X(INTEGER, min_sides, "4", 3, 128, "", "", "sides of the thinnest twigs")                      \
    X(INTEGER, max_sides, "48", 3, 128, "", "", "sides of the thickest stems")                     \
    X(REAL, collar, "1", 0, 4, "", "", "size of the collar at a branch's base; 0: none")           \
    X(SWITCH, caps, "yes", 0, 1, "", "", "close the ends of tubes")                                \
    X(SWITCH, foliage, "yes", 0, 1, "", "", "with organs; without: wood only")

typedef struct FrSkinParams {
    FR_SKIN_PARAMS(FR_PARAM_FIELD)
} FrSkinParams;

FR_API const FrParamTable *fr_skin_table(void);
FR_API FrSkinParams fr_skin_default(void);

/// The mesh of a whole plant: one part per material of wood, then one per material of organs.
/// FR_ERR_LIMIT if it would have too many triangles; then *mesh is NULL and nothing was allocated.
FR_API FR_MUST_USE FrStatus fr_skin_plant(const FrPlant *plant, const FrSkinParams *params,
                                          FrUpAxis up, const FrContext *context, FrMesh **mesh);
/// The mesh of one shape at scale 1 in its own frame, one part, for instancing.
FR_API FR_MUST_USE FrStatus fr_skin_shape(const FrPlant *plant, uint32_t shape,
                                          const FrSkinParams *params, FrUpAxis up,
                                          const FrContext *context, FrMesh **mesh);
/// What the level of detail does to organs, for whoever places instances of shapes: the factor of
/// each one's scale, 0 where it is left out or not seen. `factors` has one element an organ. Fails
/// as fr_skin_plant() does where shapes are too large.
FR_API FR_MUST_USE FrStatus fr_skin_organ_factors(const FrPlant *plant, const FrSkinParams *params,
                                                  const FrContext *context, float *factors);
FR_API void fr_mesh_free(FrMesh *mesh);
/// Picture coordinates at the barycentric (u, v) of a triangle of a part.
FR_API void fr_mesh_uv(const FrMesh *mesh, uint32_t part, uint32_t triangle, float u, float v,
                       float uv[2]);
/// Digest of vertices, indices and parts.
FR_API FrDigest fr_mesh_digest(const FrMesh *mesh);

// ---- skinning again ---------------------------------------------------------------------------

/// The surface of a plant that changes: its parts stay where they are, and only what differs is
/// written. Each part has memory of its own, as a graphics card wants it.
typedef struct FrSkin FrSkin;

/// One part of a skin. The pointers hold until the next update; `first_vertex` and `first_index` of
/// `part` are where it would begin in one mesh of all.
typedef struct FrSkinPart {
    FrMeshPart part;
    const FrVertex *vertices;
    const uint32_t *indices;
    bool is_moved; ///< by the last update: the pointers are others, all of it was written
    uint64_t changed_vertex, changed_vertex_end; ///< what the last update wrote of it
    uint64_t changed_index, changed_index_end;
} FrSkinPart;

/// What the last update did.
typedef struct FrSkinWork {
    uint64_t runs, runs_written; ///< tubes that go on from one another
    uint64_t organs, organs_written;
} FrSkinWork;

FR_API FrSkin *fr_skin_new(const FrSkinParams *params, FrUpAxis up);
FR_API void fr_skin_free(FrSkin *skin);
/// Makes it the skin of `plant`, with the bits that fr_skin_plant() gives. `has_same_rows`: nodes,
/// axes and organs are those of the last update, as fr_pgraph_build_shares() tells. What fails
/// leaves the skin as it was; once counted, writing is no longer cancelled.
FR_API FR_MUST_USE FrStatus fr_skin_update(FrSkin *skin, const FrPlant *plant, bool has_same_rows,
                                           const FrContext *context);
/// Its parts, borrowed until the next update.
FR_API const FrSkinPart *fr_skin_parts(const FrSkin *skin, uint32_t *count);
FR_API FrSkinWork fr_skin_work(const FrSkin *skin);
/// How long one thread takes for the wood of each component, measured on a sample of what was
/// written; as many as the plant has, which is the one of the last update.
FR_API void fr_skin_seconds(const FrSkin *skin, const FrPlant *plant, double *seconds);
/// A copy in one piece; NULL if there is no memory for it.
FR_API FrMesh *fr_skin_mesh(const FrSkin *skin);
