/// @file patch_mode.h
/// The control points of the selected Hyperpatch in the picture, dragged with the pointer.
#pragma once

#include "studio/window.h"

typedef struct StudioPatchMode StudioPatchMode;

/// `overlay` is around the viewport, and gets a bar of what can be done.
StudioPatchMode *studio_patch_mode_new(StudioWindow *window, GtkOverlay *overlay);
void studio_patch_mode_free(StudioPatchMode *mode);
/// What is selected, or where it stands, may be another.
void studio_patch_mode_update(StudioPatchMode *mode);
