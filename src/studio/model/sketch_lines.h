/// @file sketch_lines.h
/// Lines in space as a picture in which what is near is thick: the cue of depth that is read best.
///
/// After: Sketch-based plant variation (2006), section 4.2: of colour, intensity and thickness, the
/// thickness of lines in perspective says most clearly how far away they are.
#pragma once

#include "frond/api.h"

#include <cglm/types-struct.h>

typedef struct StudioLine {
    float from[3], to[3];
    float width;       ///< pixels at the lens' unit
    uint8_t colour[4]; ///< red, green, blue, opacity
} StudioLine;

/// How lines are seen. `project` takes coordinates to a cube from −1 to 1 after division by w, and
/// w is the distance from the eye along its direction.
typedef struct StudioLens {
    mat4s project;
    float unit;    ///< distance at which a line is as thick as its width
    float nearest; ///< what is nearer is not drawn: it lies before the window
} StudioLens;

/// Pixels of 32 bits, opacity in the highest byte, then red, green, blue times opacity.
typedef struct StudioRaster {
    uint32_t width, height;
    uint32_t *pixels;
    float *depth; ///< of what is in front, as w
} StudioRaster;

/// A point as it is seen: pixels from the top left. False: it is nearer than the lens shows.
bool studio_lens_see(const StudioLens *lens, uint32_t width, uint32_t height, const float at[3],
                     float seen[2]);
/// Pixels that a line is thick at a distance.
float studio_lens_thickness(const StudioLens *lens, float width, float distance);

/// An empty picture of that size; what it had goes. At most 16384 pixels a side.
void studio_raster_reset(StudioRaster *raster, uint32_t width, uint32_t height);
void studio_raster_clear(StudioRaster *raster);
/// Draws lines with smooth edges, what is in front over what is behind; `scale`: pixels of the
/// picture a pixel of widths.
void studio_raster_draw(StudioRaster *raster, const StudioLens *lens, const StudioLine *lines,
                        size_t count, double scale);
