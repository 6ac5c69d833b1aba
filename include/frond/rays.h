/// @file rays.h
/// Ray queries over triangles. The one interface of Frond that stands on Embree; its answers feed
/// pictures and light, never the order in which something is decided.
#pragma once

#include "frond/skin.h"

typedef struct FrRays FrRays;

/// What a ray met first.
typedef struct FrHit {
    float distance;    ///< INFINITY: nothing
    uint32_t mesh;     ///< as fr_rays_add_mesh() returned it
    uint32_t part;     ///< of that mesh
    uint32_t stand;    ///< as fr_rays_add_stand() returned it
    uint32_t triangle; ///< of that part
    float u, v;        ///< barycentric
    vec3s normal;      ///< geometric, unit, in world coordinates, on the outer side
} FrHit;

/// True if the ray goes on through this point (a hole of an alpha mask). Called from any thread.
typedef bool (*FrHoleFn)(void *user, uint32_t mesh, uint32_t part, uint32_t triangle, float u,
                         float v);

FR_API FrRays *fr_rays_new(FrHoleFn hole, void *user);
FR_API void fr_rays_free(FrRays *rays);
/// The mesh (z up) must outlive the rays.
FR_API uint32_t fr_rays_add_mesh(FrRays *rays, const FrMesh *mesh);
/// Stands a mesh somewhere; `transform` is affine, column-major 4 × 4.
FR_API uint32_t fr_rays_add_stand(FrRays *rays, uint32_t mesh, mat4s transform);
/// Builds the search structure; afterwards only queries.
FR_API void fr_rays_commit(FrRays *rays);
FR_API FrHit fr_rays_trace(const FrRays *rays, vec3s origin, vec3s direction, float near,
                           float far);
FR_API bool fr_rays_is_blocked(const FrRays *rays, vec3s origin, vec3s direction, float near,
                               float far);
