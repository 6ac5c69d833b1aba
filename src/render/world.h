/// @file world.h
/// A scene made ready for rays: meshes, where they stand, their looks, sky and ground. Private to
/// render.
///
/// Coordinates are relative to `origin`, near the middle of the scene, so that floats are exact
/// enough far from the world's origin; z is the world's.
#pragma once

#include "frond/rays.h"
#include "frond/scene.h"
#include "render/ground.h"
#include "render/lamps.h"
#include "render/look.h"
#include "render/sky.h"

typedef struct FrWorldMesh {
    FrMesh *mesh;  ///< owned
    FrLook *looks; ///< owned, one for each part
} FrWorldMesh;

typedef struct FrWorldStand {
    uint32_t mesh;
    mat4s transform;
    mat3s normals; ///< of the mesh to the world's, not to unit length
} FrWorldStand;

typedef struct FrWorld {
    FrRays *rays;
    GArray *meshes; ///< FrWorldMesh, numbered as in rays
    GArray *stands; ///< FrWorldStand, numbered as in rays
    FrDecoder decoder;
    FrSky *sky;       ///< owned
    FrGround *ground; ///< owned; NULL: none
    FrLampSet lamps;  ///< owned
    bool has_clear;   ///< something lets light straight through
    vec3s white;      ///< irradiance of white things, roughly: what exposure and colours go by
    double origin[3];
    bool is_framed; ///< views show this box, not what there is
    vec3s frame_min, frame_max;
} FrWorld;

/// What a ray met.
typedef enum FrMet { FR_MET_SKY, FR_MET_GROUND, FR_MET_PLANT } FrMet;

typedef struct FrSurface {
    FrBsdf bsdf;
    vec3s point;    ///< moved off the surface towards the viewer
    vec3s below;    ///< the same moved to the other side, for light that goes through
    float distance; ///< INFINITY: nothing but the sky
} FrSurface;

/// Nothing but a sky; both are taken over. `ground` may be NULL.
FrWorld *fr_world_new(FrSky *sky, FrGround *ground);
void fr_world_free(FrWorld *world);
/// Takes over the mesh and `looks`, one for each of its parts.
uint32_t fr_world_add_mesh(FrWorld *world, FrMesh *mesh, FrLook *looks);
void fr_world_add_stand(FrWorld *world, uint32_t mesh, mat4s transform);
void fr_world_commit(FrWorld *world);

/// The world of a scene. *world is NULL unless FR_OK.
FR_MUST_USE FrStatus fr_world_of_scene(const FrScene *scene, const FrSkinParams *skin,
                                       const FrContext *context, FrWorld **world);

/// The first thing along a ray with unit direction.
FrMet fr_world_trace(const FrWorld *world, vec3s origin, vec3s direction, FrSurface *surface);
/// The part of the light that comes to `origin` from what is `far` away, straight through clear
/// glass; black where anything else stands between. INFINITY is the sky.
vec3s fr_world_passes(const FrWorld *world, vec3s origin, vec3s direction, float far);
/// Surfaces of clear glass that light goes through, one behind the other; after so many it ends.
enum { FR_CLEAR_SURFACES = 64 };
