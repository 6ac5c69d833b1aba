/// @file path.h
/// Light along one path. Private to render.
#pragma once

#include "render/sampler.h"
#include "render/world.h"

/// What one path through a pixel brought, and what it met first.
typedef struct FrPathSample {
    vec3s radiance;
    vec3s albedo; ///< of the first surface; white for the sky
    vec3s normal; ///< of the first surface; zero for the sky
    bool is_sky;
} FrPathSample;

/// Follows a path from the camera with at most `bounces` changes of direction.
FrPathSample fr_path_trace(const FrWorld *world, vec3s origin, vec3s direction, FrSampler *sampler,
                           uint32_t bounces);
