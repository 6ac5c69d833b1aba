/// @file overlays.h
/// Overlays on the graphics card, drawn over a finished picture by its depths: what plants hide
/// shines through as the overlay says. All calls need the context of the viewport to be current.
#pragma once

#include "studio/model/overlay.h"

#include <cglm/struct.h>
#include <epoxy/gl.h>

typedef struct StudioOverlays StudioOverlays;

/// The picture that is drawn over.
typedef struct StudioUnder {
    mat4s clip;
    GLuint depths;     ///< texture of its depths
    float near, far;   ///< its planes
    int width, height; ///< pixels of the framebuffer that is bound
    float scale;       ///< pixels of it for one of a mark's size
} StudioUnder;

/// NULL with an error if the driver is not good enough.
StudioOverlays *studio_overlays_new(GError **error);
void studio_overlays_free(StudioOverlays *overlays);
/// The layer of that name becomes this, which stays the caller's; NULL: there is none any more.
void studio_overlays_set(StudioOverlays *overlays, const char *name, const StudioOverlay *overlay);
/// Layers in the order of their names.
void studio_overlays_draw(const StudioOverlays *overlays, const StudioUnder *under);
