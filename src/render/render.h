/// @file render.h
/// Rendering a world that is already made. Private to render; tests make worlds of their own.
#pragma once

#include "frond/render.h"
#include "render/world.h"

/// Renders `world`, seen as `view` says (NULL: framed by itself), `stops` brighter than automatic.
/// The parameters have been checked. Sets the ground's haze.
FR_MUST_USE FrStatus fr_render_world(FrWorld *world, const FrViewParams *view, double stops,
                                     const FrRenderParams *params, const FrContext *context,
                                     FrImage **image);
/// The view of that name, the first without one, NULL if there is none at all.
FR_MUST_USE FrStatus fr_render_find_view(const FrScene *scene, const char *name,
                                         const FrContext *context, const FrViewParams **view);
/// Refuses pictures without pixels and those beyond the limits.
FR_MUST_USE FrStatus fr_render_check_size(const FrRenderParams *params, const FrContext *context);
