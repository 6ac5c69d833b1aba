/// @file light.h
/// How much light there is at a place, and from where it comes.
///
/// A light scene says what stands in the way and what shines. A backend makes an FrLight of it:
/// views of the sky, density of rays, shadow voxels. All of them answer the same question in
/// batches of points, so that whoever asks (an L-system, growing plants, a picture of the light)
/// needs not know which one answers. World coordinates, z up, metres.
#pragma once

#include "frond/rays.h"

/// What becomes of light that arrives on one side of a surface. Fractions of 0 … 1 whose sum is at
/// most 1; what is left is absorbed.
typedef struct FrOptics {
    float diffuse;           ///< thrown back into all directions by Lambert's law
    float specular;          ///< thrown back as by a mirror
    float transmit_diffuse;  ///< let through and scattered by Lambert's law, as leaves do
    float transmit_specular; ///< let through unturned, as thin glass does
} FrOptics;

/// A surface has two sides; a leaf is an ordinary surface with both lit. All zero: black.
typedef struct FrLightMaterial {
    FrOptics front; ///< light that arrives on the outer side (corners counter-clockwise)
    FrOptics back;
    uint32_t mask; ///< what FrMaskFn is asked about; 0: whole, without holes
} FrLightMaterial;

/// True if the mask has a hole at picture coordinates (s, t), those of FrVertex.uv: light goes on
/// through it. Called from any thread; must answer the same always, and a number must name the
/// same mask for as long as an FrLight lives.
typedef bool (*FrMaskFn)(void *user, uint32_t mask, float s, float t);

/// A mesh, and what the backends must know of it beyond its triangles.
typedef struct FrLightMesh {
    const FrMesh *mesh;               ///< z up; borrowed, as all pointers of a light scene
    const FrLightMaterial *materials; ///< one for each part
    /// The element that collects the light each triangle absorbs, the triangles of all parts one
    /// after the other; a leaf is an element, say. NULL: every triangle is its own.
    const uint32_t *elements;
    uint32_t element_count; ///< every number in `elements` is below; unused if that is NULL
} FrLightMesh;

/// A mesh where it stands. Its transform is affine.
typedef struct FrLightStand {
    uint32_t mesh; ///< index into the meshes of the scene
    mat4s transform;
} FrLightStand;

typedef enum FrLampKind {
    FR_LAMP_POINT, ///< into all directions alike
    FR_LAMP_SPOT,  ///< a cone about `direction`
    FR_LAMP_AREA,  ///< a parallelogram, by Lambert's law, on the side of side[0] × side[1]
    FR_LAMP_SUN,   ///< parallel light along `direction`
    FR_LAMP_SKY,   ///< the upper half of the sphere
} FrLampKind;

typedef enum FrSkyKind {
    FR_SKY_UNIFORM,  ///< equally bright everywhere
    FR_SKY_OVERCAST, ///< CIE overcast: three times as bright at the zenith as at the horizon
    FR_SKY_CLEAR,    ///< CIE clear: brightest around the sun; the sun itself is another lamp
} FrSkyKind;

/// What a lamp does not use of this is ignored. A lamp without power is dark.
typedef struct FrLamp {
    FrLampKind kind;
    /// Point, spot and area: all the light it gives (W, or any unit of your own). Sun: what
    /// arrives on a square metre that faces it. Sky: on a square metre of open level ground.
    double power;
    vec3s position;  ///< point, spot; a corner of the area
    vec3s direction; ///< spot, sun: the way the light goes, any length but 0
    vec3s side[2];   ///< area: the two edges that meet in `position`
    float angle;     ///< spot: half the opening of the cone, radians, at most π; even within it
    FrSkyKind sky;
    vec3s sun; ///< clear sky: towards the sun, any length but 0, not below the horizon
} FrLamp;

typedef struct FrLightScene {
    const FrLightMesh *meshes;
    uint32_t mesh_count;
    const FrLightStand *stands;
    uint32_t stand_count;
    const FrLamp *lamps;
    uint32_t lamp_count;
    FrMaskFn mask; ///< NULL: nothing has holes
    void *mask_user;
    /// The part of the world that suns and skies shine on. Keep it while plants grow, so that
    /// they stay what changes. min > max: the bounds of what stands in the scene.
    vec3s min, max;
    bool has_reference;
    vec3s reference; ///< answers are relative to the light at this place
    FrSpan span;     ///< where a document names that place, for messages
} FrLightScene;

/// The light at a point.
typedef struct FrLightAnswer {
    /// Relative to the light at the reference. Without a reference: as the backend counts it, for
    /// ray density the fluence in the lamps' unit per square metre, for the others 1 in the open.
    float intensity;
    float confidence; ///< 0: from everywhere alike; 1: all from one direction
    vec3s direction;  ///< to the light, unit; 0 where there is none
    uint32_t samples; ///< rays or views that told so
} FrLightAnswer;

/// What a backend has done and holds; what it does not know is 0.
typedef struct FrLightStats {
    uint64_t photons;    ///< emitted
    uint64_t rays;       ///< stored
    uint64_t recast;     ///< rays traced by the last change of the scene
    uint64_t cells;      ///< of its spatial structure
    uint64_t references; ///< in all cells
    uint64_t points;     ///< places the structure is refined around
    uint64_t bytes;      ///< held in all
} FrLightStats;

/// A part of a photon's way: from the lamp or the surface that it left to what it met.
typedef struct FrLightRay {
    vec3s from, to;
    uint32_t photon, bounce; ///< bounce 0: from the lamp
    bool is_met;             ///< it ends at a surface; else it is cut off where nothing is any more
} FrLightRay;

/// A cube of the structure by which rays are found.
typedef struct FrLightCell {
    double min[3], width;
    uint32_t level;     ///< 0: all of it; each level is half as wide
    uint32_t ray_count; ///< that pass through it
} FrLightCell;

typedef struct FrLight FrLight;

FR_API void fr_light_free(FrLight *light);
/// Makes the scene the one that is lit. After the first time only what the difference touches is
/// done anew; the outcome is the same, bit for bit, as that of a new FrLight. The scene is not
/// kept, but its meshes and its mask function must stay as they are until the next one is set or
/// the light is freed. Errors leave the light without a scene.
FR_API FR_MUST_USE FrStatus fr_light_set_scene(FrLight *light, const FrLightScene *scene,
                                               const FrContext *context);
/// Answers for `count` points; a scene must be set. The same for any number of threads.
FR_API FR_MUST_USE FrStatus fr_light_query(FrLight *light, const vec3s *points, size_t count,
                                           const FrContext *context, FrLightAnswer *answers);
/// Tells that the points asked for so far are done with: a backend may drop what it made for them.
FR_API void fr_light_forget(FrLight *light);
/// The light that each element of a stand has absorbed, in the lamps' unit, as many as its mesh
/// has elements (see FrLightMesh). Borrowed until the next change of the scene. NULL if the
/// backend does not know it.
FR_API const double *fr_light_absorbed(const FrLight *light, uint32_t stand);
FR_API FrLightStats fr_light_stats(const FrLight *light);
/// The whole ways of up to `most` photons, evenly chosen of all (FrLightRay, by photon and bounce).
/// Empty for backends that keep no rays. Free with g_array_unref().
FR_API GArray *fr_light_rays(const FrLight *light, uint32_t most);
/// The innermost cells that were made for the points asked for since the last change (FrLightCell);
/// where they are more than `most`, those of the deepest level that has no more. Empty for backends
/// that keep no rays. Free with g_array_unref().
FR_API GArray *fr_light_cells(const FrLight *light, uint32_t most);

/// How bright the sky of a lamp of kind FR_LAMP_SKY is in a unit direction, as a part of its
/// brightness at the zenith; 0 below the horizon.
FR_API double fr_lamp_sky_brightness(const FrLamp *lamp, vec3s direction);
