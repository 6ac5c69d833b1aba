/// @file renderer.h
/// Draws what a store holds. While the view moves, a coarse picture within a budget that goes by
/// how fast the machine is; when it rests, the fine one, a slice at a time, so that nothing ever
/// waits for it. All calls need the context of the viewport to be current.
#pragma once

#include "studio/model/camera.h"
#include "studio/model/overlay.h"
#include "studio/view/display.h"
#include "studio/view/store.h"

typedef struct StudioRenderer StudioRenderer;

/// What drawing took; the last of each.
typedef struct StudioPace {
    double coarse_seconds, fine_seconds;
    uint64_t coarse_triangles, fine_triangles;
} StudioPace;

/// NULL with an error if the driver is not good enough.
StudioRenderer *studio_renderer_new(GError **error);
void studio_renderer_free(StudioRenderer *renderer);
StudioStore *studio_renderer_store(StudioRenderer *renderer);
/// Pixels of the framebuffer, and how many make one of the desktop's along a side: a dense screen
/// takes no longer than another.
void studio_renderer_resize(StudioRenderer *renderer, int width, int height, int scale);
/// The camera or the display has changed; with `is_geometry` what stands there, too.
void studio_renderer_invalidate(StudioRenderer *renderer, bool is_geometry);
/// The overlay of that name is this one, which stays the caller's; NULL: there is none any more.
/// The pictures of the plants stay as they are.
void studio_renderer_set_overlay(StudioRenderer *renderer, const char *name,
                                 const StudioOverlay *overlay);
/// Draws to the framebuffer that is bound. True if the fine picture is not done yet: call again.
bool studio_renderer_draw(StudioRenderer *renderer, const StudioCamera *camera,
                          const StudioDisplay *display, bool is_moving);
StudioPace studio_renderer_pace(const StudioRenderer *renderer);
