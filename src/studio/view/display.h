/// @file display.h
/// How a view is shown.
#pragma once

#include "studio/model/wind.h"

typedef enum StudioMode { STUDIO_SHADED, STUDIO_WIREFRAME, STUDIO_SKELETON } StudioMode;

typedef struct StudioDisplay {
    StudioMode mode;
    bool has_shadow, has_occlusion, has_grid;
    bool is_dark;
    bool has_wind; ///< a coarse picture that never rests
    bool is_clear; ///< nothing is behind the plants: alpha is how much of a pixel they cover
    bool is_bare;  ///< no overlays
    StudioWind wind;
    double cell;  ///< m, of the grid
    double scale; ///< pixels of the framebuffer for one of the desktop's
} StudioDisplay;
