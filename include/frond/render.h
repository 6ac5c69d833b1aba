/// @file render.h
/// Path-traced stills: sun, physical sky, ground, masked and translucent leaves.
#pragma once

#include "frond/scene.h"

#define FR_RENDER_PARAMS(X)                                                                        \
    X(INTEGER, width, "960", 1, 32768, "", "", "pixels across")                                    \
    X(INTEGER, height, "1200", 1, 32768, "", "", "pixels down")                                    \
    X(INTEGER, samples, "64", 1, 65536, "", "", "paths per pixel")                                 \
    X(INTEGER, bounces, "6", 0, 64, "", "", "longest path")                                        \
    X(TEXT, view, "", 0, 0, "", "", "name of the view; empty: the first, or one that fits")

typedef struct FrRenderParams {
    FR_RENDER_PARAMS(FR_PARAM_FIELD)
} FrRenderParams;

FR_API const FrParamTable *fr_render_table(void);

/// Renders the scene; the same for any number of threads.
FR_API FR_MUST_USE FrStatus fr_render(const FrScene *scene, const FrRenderParams *params,
                                      const FrSkinParams *skin, const FrContext *context,
                                      FrImage **image);

/// The light that the scene's plants sense, in false colours, along a slice across `axis` (0, 1, 2:
/// x, y, z) at `at` metres; the plants' skeletons are drawn on top. Black is dark; white is full
/// light, or nearly the brightest of the slice where the scene has no measure of full light. Of
/// the parameters only the size counts. The scene must have surroundings.
FR_API FR_MUST_USE FrStatus fr_render_light(const FrScene *scene, int axis, double at,
                                            const FrRenderParams *params, const FrContext *context,
                                            FrImage **image);

/// Where the light of a scene is shown.
typedef enum FrLightAt {
    FR_LIGHT_AT_GRID,   ///< on a grid that fills the box around everything
    FR_LIGHT_AT_ORGANS, ///< at every leaf, flower and tip of a stem
} FrLightAt;

/// What the brightest of these colours stands for: full light, or nearly the brightest of `count`
/// values where the scene has no measure of full light.
FR_API float fr_light_scale_top(const FrScene *scene, const float *light, size_t count);
/// The colour of a part of the scale, sRGB: from black over blue, red and yellow to white, evenly
/// brighter.
FR_API void fr_light_scale_paint(uint8_t *pixel, float part);
/// Where light is asked for, in the world.
typedef struct FrLightPlaces {
    GArray *at;         ///< vec3s, owned
    float radius, line; ///< of a ball there and of the longest line to the light, m
} FrLightPlaces;

/// `count` is as in fr_render_light_points(). FR_ERR_LIMIT if they would take more than
/// FrLimits.bytes. On FR_OK free `at` with g_array_unref().
FR_API FR_MUST_USE FrStatus fr_light_places(const FrScene *scene, FrLightAt where, uint32_t count,
                                            const FrContext *context, FrLightPlaces *places);

/// The same light at points, as balls in false colours seen through a view, among plants and
/// obstacles in grey. A line leads from each to the light; its length is the confidence. `count`
/// points lie along the longest side of the grid, 1 to 128. Of the parameters, size and view count.
FR_API FR_MUST_USE FrStatus fr_render_light_points(const FrScene *scene, FrLightAt where,
                                                   uint32_t count, const FrRenderParams *params,
                                                   const FrSkinParams *skin,
                                                   const FrContext *context, FrImage **image);
